//! Sums tap by tap, for matrices of every kind.

use std::ops::{Add, Mul};

use super::MAX_SIDE;
use crate::{
    math::{
        convert,
        levels::{self, Levels},
        simd,
    },
    value::{Image, ring},
};

/// Pixels whose neighbourhoods are fetched together.
const PIECE: usize = 128;

/// A piece of a row with what a matrix reads beyond its end.
const PIECE_AND_MARGIN: usize = PIECE + MAX_SIDE - 1;

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

/// The taps of a matrix.
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

impl<T: Number> Taps<T> {
    pub(super) fn new(width: usize, weights: &[f64]) -> Self {
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

    /// Writes the sums for row `y`, those of `BLOCK` pixels at a time. Pieces are whole blocks.
    #[inline(always)]
    pub(super) fn write<L: Levels, const BLOCK: usize>(
        &self,
        image: &Image,
        channel: usize,
        y: u32,
        out: &mut [f32],
    ) {
        let mut near = [[T::ZERO; PIECE_AND_MARGIN]; MAX_SIDE];
        for (piece, out) in out.chunks_mut(PIECE).enumerate() {
            let first = (piece * PIECE) as i64 - self.left as i64;
            simd::fetch_to_write(out);
            for (near, below) in near.iter_mut().zip(&self.rows) {
                let y = convert::wrap_near(i64::from(y) + below, image.height());
                let wanted = &mut near[..out.len() + self.width - 1];
                ring::copy(image.row(channel, y), first, load::<L, T>, wanted);
            }
            for (block, out) in out.chunks_mut(BLOCK).enumerate() {
                let sums = self.sums::<BLOCK>(&near, block * BLOCK);
                put(sums, out, |out, sum| *out = store::<L, T>(sum));
            }
        }
    }

    /// The sums of the pixels from number `start` of a piece on.
    #[inline(always)]
    fn sums<const BLOCK: usize>(
        &self,
        near: &[[T; PIECE_AND_MARGIN]; MAX_SIDE],
        start: usize,
    ) -> [T; BLOCK] {
        let mut sums = [T::ZERO; BLOCK];
        for tap in &self.taps {
            add_weighted(&mut sums, &near[tap.row][start + tap.column..], tap.weight);
        }
        sums
    }
}

/// Adds as many numbers as there are sums, times `weight`. (Of an array, the compiler knows the
/// length, and keeps the sums in registers.)
#[inline(always)]
pub(super) fn add_weighted<T: Number, const BLOCK: usize>(
    sums: &mut [T; BLOCK],
    numbers: &[T],
    weight: T,
) {
    let numbers: &[T; BLOCK] = numbers.first_chunk().expect("a block has its neighbours beside it");
    for (sum, number) in sums.iter_mut().zip(numbers) {
        *sum = *sum + *number * weight;
    }
}

/// Hands sums to `store`, with what belongs to each in `out`. The last block of a row may be short;
/// all others stay in registers.
#[inline(always)]
pub(super) fn put<T: Copy, const BLOCK: usize>(
    sums: [T; BLOCK],
    out: &mut [f32],
    store: impl Fn(&mut f32, T),
) {
    if let Some(out) = out.first_chunk_mut::<BLOCK>() {
        out.iter_mut().zip(sums).for_each(|(out, sum)| store(out, sum));
    } else {
        out.iter_mut().zip(sums).for_each(|(out, sum)| store(out, sum));
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
