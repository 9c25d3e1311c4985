//! Blocks that make colours, or give colours to a grey image.

crate::family!("color": color_fill, color_transition, map_transition);
