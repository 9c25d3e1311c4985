//! The built-in blocks, by family: one file a block.

mod adjust;
mod color;
mod mix;
mod noise;
mod results;

use crate::block::Family;

/// Every family of built-in blocks.
pub static FAMILIES: &[&Family] = &[
    &adjust::FAMILY,
    &color::FAMILY,
    &mix::FAMILY,
    &noise::FAMILY,
    &results::FAMILY,
];
