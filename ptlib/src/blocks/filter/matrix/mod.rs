//! Weighted sums of the pixels around each pixel, and reading rows around their ends.
//!
//! Specification 2.0 (CONV). A matrix is a list of taps, those of weight 0 left out. Sums are made
//! for a piece of a row at a time: a few taps in one go, while the sums of several pixels stay in
//! registers, and always in the same order, so that every split of the work gives the same bits.
//!
//! PT Designer sums levels 0..255 in double precision, and then truncates. Single precision could
//! end on the other side of a level; so it is taken in 8-bit precision only for matrices whose sums
//! it represents exactly, which are those with weights like 1, -2 or 0.25. They need half the time.

use std::ops::{Add, Mul};

use crate::block::prelude::*;

/// Pixels that are computed side by side.
const PIECE: usize = 64;

/// The most columns and rows of a matrix.
pub(super) const MAX_SIDE: usize = 16;

/// A piece of a row with what a matrix reads beyond its end.
const PIECE_AND_MARGIN: usize = PIECE + MAX_SIDE - 1;

/// The most taps that are added in one go.
const GROUP: usize = 9;

/// A number that sums are made of.
pub(super) trait Number: Copy + Add<Output = Self> + Mul<Output = Self> {
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
pub(super) enum Matrix {
    /// Whose sums are made in single precision.
    Single(Taps<f32>),
    /// Whose sums are made in double precision.
    Double(Taps<f64>),
}

#[derive(Debug)]
pub(super) struct Taps<T> {
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
    /// A matrix of `width` columns with those weights, row by row.
    pub(super) fn new<L: Levels>(width: usize, weights: &[f64]) -> Self {
        if !L::EIGHT_BIT || is_exact_in_single(weights) {
            Self::Single(Taps::new(width, weights))
        } else {
            Self::Double(Taps::new(width, weights))
        }
    }

    /// Writes the sums for a row of a channel of `image`.
    #[inline(always)]
    pub(super) fn write<L: Levels>(
        &self,
        image: &Image,
        channel: usize,
        cx: &RowContext<'_>,
        out: &mut [f32],
    ) {
        match self {
            Self::Single(taps) => taps.write::<L>(image, channel, cx, out),
            Self::Double(taps) => taps.write::<L>(image, channel, cx, out),
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
    fn write<L: Levels>(
        &self,
        image: &Image,
        channel: usize,
        cx: &RowContext<'_>,
        out: &mut [f32],
    ) {
        let mut near = [[T::ZERO; PIECE_AND_MARGIN]; MAX_SIDE];
        for (piece, out) in out.chunks_mut(PIECE).enumerate() {
            let first = (piece * PIECE) as i64 - self.left as i64;
            for (near, below) in near.iter_mut().zip(&self.rows) {
                let y = convert::wrap_near(i64::from(cx.y) + below, cx.height);
                let wanted = &mut near[..out.len() + self.width - 1];
                copy_ring(image.row(channel, y), first, load::<L, T>, wanted);
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

/// Writes `load` of the numbers of a ring from place `first` on, which may be some turns back.
#[inline(always)]
pub(super) fn copy_ring<S: Copy, T>(ring: &[S], first: i64, load: impl Fn(S) -> T, out: &mut [T]) {
    let mut rest = out;
    let mut start = convert::index(first.rem_euclid(ring.len() as i64));
    while !rest.is_empty() {
        let count = rest.len().min(ring.len() - start);
        let (piece, behind) = rest.split_at_mut(count);
        for (out, number) in piece.iter_mut().zip(&ring[start..]) {
            *out = load(*number);
        }
        (rest, start) = (behind, 0);
    }
}

/// The definition of CONV, for tests that hold a block against it.
#[cfg(test)]
pub(super) mod naive {
    use crate::{
        block::testing::{Trial, image_of_levels},
        math::convert,
    };

    /// Levels of no order, for an image of that many pixels.
    pub(in crate::blocks::filter) fn noise(pixels: u32) -> Vec<u8> {
        let mut number = 7_u32;
        let mut next = || {
            number = number.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            number.to_be_bytes()[0]
        };
        (0..pixels).map(|_| next()).collect()
    }

    /// CONV of one channel, for offsets from -⌊size/2⌋ on in each direction,
    /// column by column.
    pub(in crate::blocks::filter) fn convolved(
        levels: &[u8],
        (width, height): (u32, u32),
        matrix: (i64, i64),
        weight: impl Fn(i64, i64) -> f64,
    ) -> Vec<u8> {
        let mut out = Vec::new();
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let mut sum = 0.0;
            for i in -(matrix.0 / 2)..matrix.0 - matrix.0 / 2 {
                for j in -(matrix.1 / 2)..matrix.1 - matrix.1 / 2 {
                    let column = convert::wrap(i64::from(x) + i, width);
                    let row = convert::wrap(i64::from(y) + j, height);
                    sum += weight(i, j) * f64::from(levels[(row * width + column) as usize]);
                }
            }
            out.push(convert::clamped_byte(convert::truncate64_to_i32(sum)));
        }
        out
    }

    /// A square of `radius` pixels in each direction.
    pub(in crate::blocks::filter) fn square(radius: i32) -> (i64, i64) {
        (2 * i64::from(radius) + 1, 2 * i64::from(radius) + 1)
    }

    /// Specification 5: what becomes of a row 0…0|100 from x = 32|60 from x = 40 to 63, at x = 28
    /// to 43, if all rows are like it.
    pub(in crate::blocks::filter) fn of_the_test_row(trial: &Trial) -> Vec<u8> {
        let row: Vec<u8> = (0..64).map(|x| [0, 0, 0, 0, 100, 60, 60, 60][x / 8]).collect();
        let image = image_of_levels(64, &[&row.repeat(64)]);
        trial.clone().input(0, image).levels(0)[640 + 28..][..16].to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::levels::{Continuous, EightBit};

    #[test]
    fn single_precision_is_for_weights_that_it_sums_exactly() {
        let is_single =
            |weights: &[f64]| matches!(Matrix::new::<EightBit>(1, weights), Matrix::Single(_));
        assert!(is_single(&[1.0, -2.0, 0.25, 0.0]));
        assert!(is_single(&[65_793.0]));
        assert!(!is_single(&[65_794.0]));
        assert!(!is_single(&[0.1]));
        assert!(is_single(&[1.0, 1.0 / 65_536.0]));
        assert!(!is_single(&[1.0, 1.0 / 131_072.0]));
        assert!(matches!(Matrix::new::<Continuous>(1, &[0.1]), Matrix::Single(_)));
    }

    #[test]
    fn rings_are_copied_around_their_ends() {
        let copied = |first| {
            let mut out = [0; 8];
            copy_ring(&[1, 2, 3], first, |number| 2 * number, &mut out);
            out
        };
        assert_eq!(copied(0), [2, 4, 6, 2, 4, 6, 2, 4]);
        assert_eq!(copied(-7), copied(2));
        assert_eq!(copied(2), [6, 2, 4, 6, 2, 4, 6, 2]);
    }
}
