//! Blocks that make one picture of several.

crate::family!("mix": mix, mix_channels);
