//! Boxes around coordinates.

/// The smallest and the largest coordinates of the positions of a value; zeros if it has none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bounds {
    /// The smallest x, y, z.
    pub min: [f32; 3],
    /// The largest x, y, z.
    pub max: [f32; 3],
}
