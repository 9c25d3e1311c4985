//! Heads: read, given frames and coordinates.

mod around;
pub mod files;
pub mod load_mesh;
pub mod mesh_frames;
pub mod mesh_input;
pub mod sphere_coordinates;
#[cfg(test)]
pub(crate) mod testing;
