//! Sums over squares.

use super::{FixedPoint, LineSums, RunningSum, SlidingSum, Window};

/// The sums of the (2r+1)² pixels around each pixel of an image.
#[derive(Debug)]
pub struct SquareSums {
    columns: LineSums,
    along: SlidingSum<1>,
    fixed: FixedPoint,
    side: u32,
}

impl SquareSums {
    /// The sums of squares whose `columns`, those of [`Window::around`] the radius, are summed
    /// already, of pixels that became `fixed` integers.
    #[must_use]
    pub fn new(columns: LineSums, radius: u32, fixed: FixedPoint) -> Self {
        let along = SlidingSum::new([Window::around(radius)], columns.width());
        Self { columns, along, fixed, side: 2 * radius + 1 }
    }

    /// How many pixels a square has.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        u64::from(self.side) * u64::from(self.side)
    }

    /// How pixels became integers.
    #[must_use]
    pub fn fixed(&self) -> FixedPoint {
        self.fixed
    }

    /// The sums for row `y` of channel `channel`.
    #[inline(always)]
    #[must_use]
    pub fn row(&self, channel: usize, y: u32) -> RunningSum<'_, i32, 1> {
        self.along.on(self.columns.row(channel, y).0, |sum| sum)
    }
}
