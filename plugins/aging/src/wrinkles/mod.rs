//! Wrinkles as height maps.

pub mod age_height;
mod arith;
mod faults;
mod fibre;
mod field;
pub mod grammar;
mod kernels;
mod scan;
pub mod wrinkle_map;
