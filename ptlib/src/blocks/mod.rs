//! The built-in blocks, by family: one file a block.

mod adjust;
mod automaton;
mod color;
mod drawing;
mod files;
mod filter;
mod inputs;
mod light;
mod mix;
mod noise;
mod pattern;
mod results;
#[cfg(feature = "test-blocks")]
mod testing;
mod transform;

use crate::block::Family;

/// Every family of built-in blocks.
pub static FAMILIES: &[&Family] = &[
    &adjust::FAMILY,
    &automaton::FAMILY,
    &color::FAMILY,
    &drawing::FAMILY,
    &files::FAMILY,
    &filter::FAMILY,
    &inputs::FAMILY,
    &light::FAMILY,
    &mix::FAMILY,
    &noise::FAMILY,
    &pattern::FAMILY,
    &results::FAMILY,
    #[cfg(feature = "test-blocks")]
    &testing::FAMILY,
    &transform::FAMILY,
];
