//! A plug-in for ptlib: patterns of two substances that react with each other and spread.
//!
//! The model is that of Gray and Scott as J. E. Pearson studied it ("Complex Patterns in a Simple
//! System", Science 261, 1993): spots that divide, corals, mazes, waves. `grid` computes it on a
//! torus of cells, so the pattern tiles; `gray_scott` is the block.

mod gray_scott;
mod grid;

use ptlib_plugin::export_plugin;

pub use gray_scott::GrayScott;

export_plugin! {
    id: c"reaction-diffusion",
    name: c"Reaction and diffusion",
    vendor: c"The ptlib project",
    license: c"MIT OR Apache-2.0",
    blocks: [GrayScott],
}

#[cfg(test)]
mod tests;
