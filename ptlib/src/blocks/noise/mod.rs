//! Blocks that make a pattern from nothing.

crate::family!("noise": bump_noise, perlin_noise, simple_noise, voronoi_diagram);

pub(in crate::blocks) mod lattice;
mod voronoi;
