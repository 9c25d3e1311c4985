//! Convolution: weighted sums of the pixels around each pixel.
//!
//! Specification 2.0 (CONV). The matrix is not mirrored, sums are neither scaled nor shifted, and
//! pixels are read around the edges. A [`Matrix`] is a list of taps, those of weight 0 left out.
//! Sums are made for a piece of a row at a time: a few taps in one go, while the sums of several
//! pixels stay in registers, and always in the same order, so that every split of the work gives
//! the same bits.
//!
//! Matrices whose weights follow a rule (squares, slopes) slide instead: see
//! [`box_sum`](super::box_sum).
//!
//! PT Designer sums levels 0..255 in double precision, and then truncates. Single precision could
//! end on the other side of a level; so it is taken in 8-bit precision only for matrices whose sums
//! it represents exactly, which are those with weights like 1, -2 or 0.25. They need half the time.

use std::ops::{Add, Mul};

use super::{Image, ring};
use crate::math::{
    convert,
    levels::{self, Levels},
};

/// Pixels that are computed side by side.
const PIECE: usize = 64;

/// The most columns and rows of a matrix.
pub const MAX_SIDE: usize = 16;

/// A piece of a row with what a matrix reads beyond its end.
const PIECE_AND_MARGIN: usize = PIECE + MAX_SIDE - 1;

/// The most taps that are added in one go.
const GROUP: usize = 9;

/// A number that sums are made of.
trait Number: Copy + Add<Output = Self> + Mul<Output = Self> {
    const ZERO: Self;
    /// The nearest number of this kind.
    fn nearest(value: f64) -> Self;
    fn from_single(value: f32) -> Self;
    fn single(self) -> f32;
    /// The integer part.
    fn truncate(self) -> i32;
}

impl Number for f32 {
    const ZERO: Self = 0.0;

    fn nearest(value: f64) -> Self {
        convert::single(value)
    }

    #[inline(always)]
    fn from_single(value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn single(self) -> f32 {
        self
    }

    #[inline(always)]
    fn truncate(self) -> i32 {
        convert::truncate(self)
    }
}

impl Number for f64 {
    const ZERO: Self = 0.0;

    fn nearest(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn from_single(value: f32) -> Self {
        Self::from(value)
    }

    #[inline(always)]
    fn single(self) -> f32 {
        convert::single(self)
    }

    #[inline(always)]
    fn truncate(self) -> i32 {
        convert::truncate64_to_i32(self)
    }
}

/// Weights of the pixels around a pixel.
#[derive(Debug)]
pub struct Matrix(Sums);

#[derive(Debug)]
enum Sums {
    /// Made in single precision.
    Single(Taps<f32>),
    /// Made in double precision.
    Double(Taps<f64>),
}

#[derive(Debug)]
struct Taps<T> {
    /// Columns from the first one to the middle.
    left: usize,
    /// Columns of the matrix.
    width: usize,
    /// How many rows each row of the matrix lies below the pixel.
    rows: Vec<i64>,
    /// Column by column, the order of PT Designer: in 8-bit precision, it decides where a sum that
    /// should be whole ends.
    taps: Vec<Tap<T>>,
}

#[derive(Debug, Clone, Copy)]
struct Tap<T> {
    /// Its place in [`Taps::rows`].
    row: usize,
    column: usize,
    weight: T,
}

impl Matrix {
    /// A matrix of `width` columns with those weights, row by row. The pixel itself is at column
    /// and row number ⌊size/2⌋. No side is longer than [`MAX_SIDE`].
    #[must_use]
    pub fn new<L: Levels>(width: usize, weights: &[f64]) -> Self {
        Self(if !L::EIGHT_BIT || is_exact_in_single(weights) {
            Sums::Single(Taps::new(width, weights))
        } else {
            Sums::Double(Taps::new(width, weights))
        })
    }

    /// Writes the sums for row `y` of a channel of `image`.
    #[inline(always)]
    pub fn write<L: Levels>(&self, image: &Image, channel: usize, y: u32, out: &mut [f32]) {
        match &self.0 {
            Sums::Single(taps) => taps.write::<L>(image, channel, y, out),
            Sums::Double(taps) => taps.write::<L>(image, channel, y, out),
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

impl<T: Number> Taps<T> {
    fn new(width: usize, weights: &[f64]) -> Self {
        let middle = weights.len() / width / 2;
        let is_empty = |row: &[f64]| row.iter().all(|weight| *weight == 0.0);
        let rows = weights.chunks(width).enumerate();
        let used: Vec<_> = rows.filter(|(_, row)| !is_empty(row)).map(|(j, _)| j).collect();
        let mut taps = Vec::new();
        for column in 0..width {
            for (row, j) in used.iter().enumerate() {
                let weight = weights[j * width + column];
                if weight != 0.0 {
                    taps.push(Tap { row, column, weight: T::nearest(weight) });
                }
            }
        }
        let rows = used.iter().map(|j| *j as i64 - middle as i64).collect();
        Self { left: width / 2, width, rows, taps }
    }

    #[inline(always)]
    fn write<L: Levels>(&self, image: &Image, channel: usize, y: u32, out: &mut [f32]) {
        let mut near = [[T::ZERO; PIECE_AND_MARGIN]; MAX_SIDE];
        for (piece, out) in out.chunks_mut(PIECE).enumerate() {
            let first = (piece * PIECE) as i64 - self.left as i64;
            for (near, below) in near.iter_mut().zip(&self.rows) {
                let y = convert::wrap_near(i64::from(y) + below, image.height());
                let wanted = &mut near[..out.len() + self.width - 1];
                ring::copy(image.row(channel, y), first, load::<L, T>, wanted);
            }
            let mut sums = [T::ZERO; PIECE];
            for taps in self.taps.chunks(GROUP) {
                match taps.len() {
                    1 => add::<T, 1>(&mut sums, &near, taps),
                    2 => add::<T, 2>(&mut sums, &near, taps),
                    3 => add::<T, 3>(&mut sums, &near, taps),
                    4 => add::<T, 4>(&mut sums, &near, taps),
                    5 => add::<T, 5>(&mut sums, &near, taps),
                    6 => add::<T, 6>(&mut sums, &near, taps),
                    7 => add::<T, 7>(&mut sums, &near, taps),
                    8 => add::<T, 8>(&mut sums, &near, taps),
                    _ => add::<T, GROUP>(&mut sums, &near, taps),
                }
            }
            for (out, sum) in out.iter_mut().zip(sums) {
                *out = store::<L, T>(sum);
            }
        }
    }
}

/// What a pixel counts: in 8-bit precision its level.
#[inline(always)]
fn load<L: Levels, T: Number>(value: f32) -> T {
    if !L::EIGHT_BIT {
        return T::from_single(value);
    }
    // Numbers from here on are whole: adding rounds.
    const WHOLE: f32 = 8_388_608.0;
    T::from_single(value * 255.0 + WHOLE - WHOLE)
}

/// The value of a sum of what [`load`] gives.
#[inline(always)]
fn store<L: Levels, T: Number>(sum: T) -> f32 {
    if L::EIGHT_BIT {
        levels::from_level(convert::level(sum.truncate().clamp(0, 255)))
    } else {
        sum.single()
    }
}

/// Adds `COUNT` taps to the sums of a piece.
#[inline(always)]
fn add<T: Number, const COUNT: usize>(
    sums: &mut [T; PIECE],
    near: &[[T; PIECE_AND_MARGIN]; MAX_SIDE],
    taps: &[Tap<T>],
) {
    let taps: [(&[T], T); COUNT] = std::array::from_fn(|k| {
        let Tap { row, column, weight } = taps[k];
        (&near[row][column..][..PIECE], weight)
    });
    for (i, sum) in sums.iter_mut().enumerate() {
        *sum = taps.iter().fold(*sum, |sum, (near, weight)| sum + near[i] * *weight);
    }
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
}
