//! Files of hair: what is in them, and the formats.

pub mod bytes;
pub mod glb;
pub mod hairs;
pub mod ply;
pub mod usda;
pub mod yuksel;
