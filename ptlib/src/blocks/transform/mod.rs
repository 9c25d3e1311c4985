//! Blocks that move pixels to other places.

crate::family!("transform": circle_transform, geometric_transform, glass, tile);
