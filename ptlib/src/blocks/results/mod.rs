//! Blocks that end a graph: its results.

crate::family!("results": end);
