//! Blocks that move pixels to other places.

crate::family!("transform": circle_transform, glass, tile);
