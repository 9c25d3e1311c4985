//! Convolution: weighted sums of the pixels around each pixel.
//!
//! Specification 2.0 (CONV). The matrix is not mirrored, sums are neither scaled nor shifted, and
//! pixels are read around the edges. A [`Matrix`] is a list of taps, those of weight 0 left
//! out. Sums are made for some pixels of a row at a time, which stay in registers, and always in
//! the same order, so that every split of the work gives the same bits.
//!
//! PT Designer sums levels 0..255 in double precision, and then truncates. Single precision could
//! end on the other side of a level; so it is taken in 8-bit precision only for matrices whose sums
//! it represents exactly, which are those with weights like 1, -2 or 0.25. They need half the time.
//!
//! In float precision, a matrix that is a column of weights times a row of weights, as every
//! Gaussian is, costs only as much as the two: see `separable`.
//!
//! Matrices whose weights follow a rule (squares, slopes) slide instead: see
//! [`box_sum`](super::box_sum).

mod separable;
mod taps;

use super::Image;
use crate::math::levels::Levels;
use separable::Separable;
use taps::Taps;

/// The most columns and rows of a matrix.
pub const MAX_SIDE: usize = 16;

/// Weights of the pixels around a pixel.
#[derive(Debug)]
pub struct Matrix(Sums);

#[derive(Debug)]
enum Sums {
    /// Made in single precision.
    Single(Taps<f32>),
    /// Made in double precision.
    Double(Taps<f64>),
    /// Made in single precision, of columns first.
    Separate(Separable),
}

impl Matrix {
    /// A matrix of `width` columns with those weights, row by row. The pixel itself is at column
    /// and row number ⌊size/2⌋. No side is longer than [`MAX_SIDE`].
    #[must_use]
    pub fn new<L: Levels>(width: usize, weights: &[f64]) -> Self {
        Self(if !L::EIGHT_BIT {
            match Separable::of(width, weights) {
                Some(separable) => Sums::Separate(separable),
                None => Sums::Single(Taps::new(width, weights)),
            }
        } else if is_exact_in_single(weights) {
            Sums::Single(Taps::new(width, weights))
        } else {
            Sums::Double(Taps::new(width, weights))
        })
    }

    /// Writes the sums for row `y` of a channel of `image`.
    #[inline(always)]
    pub fn write<L: Levels>(&self, image: &Image, channel: usize, y: u32, out: &mut [f32]) {
        match &self.0 {
            Sums::Single(taps) => taps.write::<L, 64>(image, channel, y, out),
            Sums::Double(taps) => taps.write::<L, 32>(image, channel, y, out),
            Sums::Separate(separable) => separable.write(image, channel, y, out),
        }
    }
}

/// Whether sums of levels with these weights are whole multiples of a power of two below 2²⁴ of
/// it: then nothing is rounded in single precision, whatever the order.
fn is_exact_in_single(weights: &[f64]) -> bool {
    let sum: f64 = weights.iter().map(|weight| weight.abs()).sum();
    (0..=16).map(|bits| f64::from(1 << bits)).any(|per_unit| {
        weights.iter().all(|weight| (weight * per_unit).fract() == 0.0)
            && sum * per_unit * 255.0 <= 16_777_216.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::levels::{Continuous, EightBit};

    #[test]
    fn single_precision_is_for_weights_that_it_sums_exactly() {
        let is_single =
            |weights: &[f64]| matches!(Matrix::new::<EightBit>(1, weights).0, Sums::Single(_));
        assert!(is_single(&[1.0, -2.0, 0.25, 0.0]));
        assert!(is_single(&[65_793.0]));
        assert!(!is_single(&[65_794.0]));
        assert!(!is_single(&[0.1]));
        assert!(is_single(&[1.0, 1.0 / 65_536.0]));
        assert!(!is_single(&[1.0, 1.0 / 131_072.0]));
        assert!(matches!(Matrix::new::<Continuous>(1, &[0.1]).0, Sums::Single(_)));
    }

    #[test]
    fn eight_bit_sums_are_never_separated() {
        let weights = [0.0625, 0.125, 0.0625, 0.125, 0.25, 0.125, 0.0625, 0.125, 0.0625];
        assert!(matches!(Matrix::new::<EightBit>(3, &weights).0, Sums::Single(_)));
        assert!(matches!(Matrix::new::<Continuous>(3, &weights).0, Sums::Separate(_)));
    }
}
