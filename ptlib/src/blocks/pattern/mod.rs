//! Blocks that draw a pattern: stone, wood, cracks, tiles.

crate::family!("pattern": marble, square_mosaic, substrate, wood);

mod cracks;
mod grain;
mod outline;
mod rings;
mod stamps;
