//! Blocks that make a pattern from nothing.

crate::family!(
    "noise": bump_noise, fault_formation_noise, perlin_noise, simple_noise, voronoi_diagram,
);

mod bump_sizes;
mod fault;
pub(in crate::blocks) mod lattice;
mod voronoi;
