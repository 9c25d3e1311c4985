//! Blocks that draw a pattern: stone, wood, cracks, tiles.

crate::family!("pattern": marble, wood);

mod grain;
mod rings;
