//! Blocks that make a pixel from its neighbourhood.

crate::family!("filter": blur, convolution, edge_detection, emboss, sharpen);

#[cfg(test)]
mod tests;
