//! Wrinkles as height maps.

pub mod age_height;
