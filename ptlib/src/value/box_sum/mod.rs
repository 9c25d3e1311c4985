//! Sums over sliding windows: what box blurs, slopes and averages are made of.
//!
//! A window that moves by one place gains a number and loses one, so its sum costs the same for
//! every size. Floating-point numbers would make that sum drift; here values become integers
//! first ([`FixedPoint`]), and the sums are exact: they do not depend on where a run of additions
//! starts, and every split of the work gives the same bits.
//!
//! Everything wraps around, for any size of window: one that is longer than the ring counts whole
//! turns. [`SlidingSum`] sums along one row, a [`RunningSum`] may follow several; [`LinePlan`] sums
//! along all columns (or diagonals) of an image, in bands of columns that may be filled in any
//! order. [`SquareSums`], the BOX of the specification (2.0), are both: sums along the columns of
//! an image, summed along a row when that is asked for; a [`LevelBox`] is the same for bytes.
//!
//! Rejected: a summed-area table. It needs 64-bit numbers for every pixel, and a pass along the
//! columns and one along the rows with nothing in between is as cheap and stays in the cache.

mod levels;
mod lines;
mod rows;
mod scan;
mod squares;

pub use levels::LevelBox;
pub use lines::{Band, LinePlan, LineSums};
pub use rows::{Extent, RunningSum, SlidingSum, Tap};
pub use squares::SquareSums;

use std::ops::Range;

use crate::math::{convert, levels::Levels};

/// How numbers 0..1 become integers whose sums are exact: levels 0..255 in 8-bit precision, else
/// the finest power of two that `summands` of them cannot overflow an `i32` with, up to 2²³.
#[derive(Debug, Clone, Copy)]
pub struct FixedPoint {
    factor: f32,
    offset: f32,
    one: f64,
}

impl FixedPoint {
    /// Integers of which `summands` can be added.
    #[must_use]
    pub fn new<L: Levels>(summands: u32) -> Self {
        if L::EIGHT_BIT {
            return Self { factor: 255.0, offset: 8_388_608.0, one: 255.0 };
        }
        let bits = (i32::MAX.cast_unsigned() / summands.max(1)).max(1).ilog2().min(23);
        Self { factor: 1.0, offset: (1_u32 << (23 - bits)) as f32, one: f64::from(1_u32 << bits) }
    }

    /// The integer that stands for 1.
    #[must_use]
    pub fn one(&self) -> f64 {
        self.one
    }

    /// The integer nearest to `value`, which is clamped to 0..1.
    #[inline(always)]
    #[must_use]
    pub fn integer(self, value: f32) -> i32 {
        // Comparisons instead of `clamp`: they are one instruction each, and turn NaN into 0.
        let value = if value > 0.0 { value } else { 0.0 };
        let value = if value < 1.0 { value } else { 1.0 };
        // In this binade the mantissa counts steps of 1/one: adding rounds, subtracting the bits
        // leaves the count.
        let rounded = value * self.factor + self.offset;
        rounded.to_bits().wrapping_sub(self.offset.to_bits()).cast_signed()
    }
}

/// The mean of a number of [`FixedPoint`] values, from their sum.
#[derive(Debug, Clone, Copy)]
pub struct Mean {
    per_level: f64,
    per_unit: f64,
}

/// From here to twice this, double-precision numbers are the integers.
const TWO_TO_52: f64 = 4_503_599_627_370_496.0;

impl Mean {
    /// The mean of `count` values.
    #[must_use]
    pub fn of(count: f64, fixed: FixedPoint) -> Self {
        Self { per_level: 1.0 / count, per_unit: 1.0 / (count * fixed.one) }
    }

    /// The mean whose sum is `sum` ≥ 0: in 8-bit precision the level ⌊sum/count⌋.
    #[inline(always)]
    #[must_use]
    pub fn store<L: Levels>(self, sum: i64) -> f32 {
        self.store_number::<L>(number(sum))
    }

    /// The same for a sum that is a number already.
    #[inline(always)]
    #[must_use]
    pub fn store_number<L: Levels>(self, sum: f64) -> f32 {
        if L::EIGHT_BIT {
            // Half a summand more: the quotient is then at least 0.5/count away from any integer,
            // far more than its rounding error, and its floor is the nearest integer to what is
            // half below it. Adding 2⁵² rounds to that; converting would cost more.
            let rounded = (sum + 0.5) * self.per_level - 0.5 + TWO_TO_52 - TWO_TO_52;
            convert::single(rounded) * (1.0 / 255.0)
        } else {
            convert::single(sum * self.per_unit)
        }
    }
}

/// A sum as a number. Exact: sums are below 2⁵².
#[inline(always)]
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "sums are below 2⁵²")]
pub fn number(sum: i64) -> f64 {
    sum as f64
}

/// Places relative to the one that a sum is for.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    first: i64,
    count: u32,
    is_negative: bool,
}

impl Window {
    /// `count` places from `first` on.
    #[must_use]
    pub fn new(first: i64, count: u32) -> Self {
        Self { first, count, is_negative: false }
    }

    /// The 2 · `radius` + 1 places around the middle one.
    #[must_use]
    pub fn around(radius: u32) -> Self {
        Self::new(-i64::from(radius), 2 * radius + 1)
    }

    /// The window, subtracted instead of added.
    #[must_use]
    pub fn negative(mut self) -> Self {
        self.is_negative = true;
        self
    }

    /// The sum over the window around place 0 of a ring. `load` makes an integer of a number.
    #[must_use]
    pub fn sum<T: Copy>(self, ring: &[T], load: impl Fn(T) -> i32) -> i64 {
        self.on_ring(ring.len() as u64).sum(ring, &load)
    }

    /// Where the window lies on a ring of `length` places, for place 0.
    fn on_ring(self, length: u64) -> RingWindow {
        let count = u64::from(self.count);
        let start = self.first.rem_euclid(length.cast_signed()).cast_unsigned();
        let (turns, rest) = (count / length, count % length);
        let end = (start + rest) % length;
        let (plus, minus) = if self.is_negative { (start, end) } else { (end, start) };
        RingWindow { start, rest, turns, plus, minus, is_negative: self.is_negative }
    }
}

/// A [`Window`] on a ring: whole turns, and `rest` places from `start` on. When it moves by one
/// place, the sum gains the number at `plus` and loses that at `minus`.
#[derive(Debug, Clone, Copy)]
struct RingWindow {
    start: u64,
    rest: u64,
    turns: u64,
    plus: u64,
    minus: u64,
    is_negative: bool,
}

/// The places 0..`count` of a ring, cut into runs in which no tap wraps, with the taps for the
/// first place of each. (An iterator, because a closure would not be compiled for the SIMD level.)
struct Runs<const K: usize> {
    /// Positions on the ring for the next place.
    taps: [[usize; K]; 2],
    length: usize,
    done: usize,
    count: usize,
}

impl<const K: usize> Runs<K> {
    #[inline(always)]
    fn new(taps: [[usize; K]; 2], length: usize, count: usize) -> Self {
        Self { taps, length, done: 0, count }
    }
}

impl<const K: usize> Iterator for Runs<K> {
    type Item = (Range<usize>, [[usize; K]; 2]);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.done == self.count {
            return None;
        }
        let rest = self.count - self.done;
        let to_wrap = self.taps.iter().flatten().map(|tap| self.length - tap).min().unwrap_or(rest);
        let step = to_wrap.min(rest);
        let run = (self.done..self.done + step, self.taps);
        self.done += step;
        for tap in self.taps.iter_mut().flatten() {
            *tap = if *tap + step == self.length { 0 } else { *tap + step };
        }
        Some(run)
    }
}

impl RingWindow {
    /// The sum at place 0.
    fn sum<T: Copy>(&self, row: &[T], load: &impl Fn(T) -> i32) -> i64 {
        let total = |row: &[T]| row.iter().map(|number| i64::from(load(*number))).sum::<i64>();
        let (start, rest) = (index(self.start), index(self.rest));
        let to_wrap = rest.min(row.len() - start);
        let mut sum = total(&row[start..][..to_wrap]) + total(&row[..rest - to_wrap]);
        if self.turns > 0 {
            sum += self.turns.cast_signed() * total(row);
        }
        if self.is_negative { -sum } else { sum }
    }
}

/// A place on a ring as an index.
fn index(place: u64) -> usize {
    usize::try_from(place).expect("a ring has as many places as an image has pixels")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::levels::{Continuous, EightBit};

    #[test]
    fn fixed_point_numbers_never_overflow_and_are_fine() {
        for summands in [1, 255, 256, 131_073, u32::MAX] {
            let fixed = FixedPoint::new::<Continuous>(summands);
            assert!(f64::from(fixed.integer(1.0)) == fixed.one());
            assert!(summands > 1 << 31 || fixed.one() * f64::from(summands) < 2_147_483_648.0);
        }
        let fixed = FixedPoint::new::<Continuous>(255);
        assert_eq!((fixed.integer(0.5), fixed.integer(-1.0)), (1 << 22, 0));
        assert_eq!((fixed.integer(9.0), fixed.integer(f32::NAN)), (1 << 23, 0));
    }

    #[test]
    fn an_eight_bit_mean_is_the_floor_of_the_quotient() {
        let fixed = FixedPoint::new::<EightBit>(1);
        for count in [3_i64, 441, 40_401, 131_073 * 131_073] {
            let mean = Mean::of(count as f64, fixed);
            for level in 1..=255_i64 {
                for (sum, floor) in [(level * count, level), (level * count - 1, level - 1)] {
                    let mean = crate::math::levels::to_level(mean.store::<EightBit>(sum));
                    assert_eq!(mean, floor as f32, "{sum}/{count}");
                }
            }
        }
    }
}
