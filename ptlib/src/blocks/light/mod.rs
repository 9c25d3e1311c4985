//! Blocks that make a picture look like a lit surface.

crate::family!("light": normal_map, light);
