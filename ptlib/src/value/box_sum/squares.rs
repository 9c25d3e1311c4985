//! Sums over squares.

use super::{Extent, FixedPoint, LineSums, Mean, RunningSum, SlidingSum, Window};
use crate::math::levels::Levels;

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
        let extent = if self.spare_bits() == 0 { Extent::Unsigned32 } else { Extent::Large };
        self.along.reaching(extent).on(self.columns.row(channel, y).0, |sum| sum)
    }

    /// Writes the means for row `y` of channel `channel`.
    ///
    /// In float precision, sums of columns are rounded until those of squares fit 32 bits, which
    /// are made faster. Up to a radius of 255, the sum of a column keeps more digits than a result.
    #[inline(always)]
    pub fn means<L: Levels>(&self, channel: usize, y: u32, out: &mut [f32]) {
        let count = f64::from(self.side) * f64::from(self.side);
        let bits = self.spare_bits();
        if bits == 0 || L::EIGHT_BIT {
            let mean = Mean::of(count, self.fixed);
            self.row(channel, y).along(|sum| sum, out, |out, sum| *out = mean.store::<L>(sum));
            return;
        }
        let mean = Mean::of(count / f64::from(1_u32 << bits), self.fixed);
        let half = (1_u32 << bits) / 2;
        let load = |sum: i32| ((sum.cast_unsigned() + half) >> bits).cast_signed();
        let along = self.along.reaching(Extent::Unsigned32);
        let sums = along.on(self.columns.row(channel, y).0, load);
        sums.along(load, out, |out, sum| *out = mean.store::<L>(sum));
    }

    /// By how many bits the sums of columns have to become shorter, for those of squares to fit 32.
    fn spare_bits(&self) -> u32 {
        let (side, most) = (f64::from(self.side), f64::from(u32::MAX));
        let largest = |bits: u32| side * (side * self.fixed.one() / f64::from(1_u32 << bits) + 1.0);
        let is_exact = side * side * self.fixed.one() <= most;
        if is_exact { 0 } else { (1..31).find(|bits| largest(*bits) <= most).unwrap_or(31) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        math::levels::{Continuous, EightBit},
        value::{BufferPool, Image},
    };

    #[test]
    fn sums_of_columns_are_shortened_as_little_as_possible() {
        let bits = |radius: u32, fixed: FixedPoint| {
            let image = Image::new(&BufferPool::new(), 3, 2, 1).unwrap();
            SquareSums::new(LineSums::new(image), radius, fixed).spare_bits()
        };
        let of_pixels = |radius: u32| bits(radius, FixedPoint::new::<Continuous>(2 * radius + 1));
        assert_eq!([1, 10, 11, 100, 255].map(of_pixels), [0, 0, 1, 7, 8]);
        assert_eq!(of_pixels(65_536), 16);
        let of_levels = |radius: u32| bits(radius, FixedPoint::new::<EightBit>(2 * radius + 1));
        assert_eq!([2051, 2052].map(of_levels), [0, 1]);
    }
}
