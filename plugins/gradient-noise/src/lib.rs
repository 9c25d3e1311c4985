//! A plug-in for ptlib: Perlin's gradient noise and simplex noise.
//!
//! The noises of ptlib itself interpolate values on a lattice, which leaves its axes visible. Noise
//! from gradients has no such blocks. Both kinds here tile at every size: their lattices wrap
//! around (`perlin`, `simplex`), and octaves are added up by `fractal`.

mod fractal;
mod lattice;
mod perlin;
mod simplex;

use ptlib_plugin::export_plugin;

pub use fractal::Fractal;
pub use perlin::Perlin;
pub use simplex::Simplex;

export_plugin! {
    id: c"gradient-noise",
    name: c"Gradient noise",
    vendor: c"The ptlib project",
    license: c"MIT OR Apache-2.0",
    blocks: [Perlin, Simplex],
}

#[cfg(test)]
mod tests;
