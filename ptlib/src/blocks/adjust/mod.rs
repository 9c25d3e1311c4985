//! Blocks that change values pixel by pixel.

crate::family!("adjust": invert);
