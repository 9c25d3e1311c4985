//! Blocks that draw a pattern: stone, wood, cracks, tiles.

crate::family!("pattern": marble);

mod grain;
