//! Blocks that move pixels to other places.

crate::family!("transform": circle_transform, geometric_transform, glass, radius_transform, tile);
