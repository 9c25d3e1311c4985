//! Where hair grows, and until which age.

mod distance;
mod even;
mod flood;
pub mod hair_mask;
pub mod hair_transition;
mod masks;
