//! Blocks that draw a pattern: stone, wood, cracks, tiles.

crate::family!("pattern": marble, substrate, wood);

mod cracks;
mod grain;
mod rings;
