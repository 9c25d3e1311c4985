//! Normals of height maps, and fine detail.

pub mod blend_normals;
pub mod fine_wrinkles;
pub mod height_to_normal;
mod packing;

#[cfg(test)]
pub(crate) mod trial;
