//! The tones of a dithered picture, and what decides between two of them.
//!
//! Every method but error propagation is of one form: a value has a tone below, one above, and a
//! number that the grain of its pixel must not exceed for the one above to be taken.

mod propagation;

pub(super) use propagation::propagate;

use crate::block::prelude::*;

/// How far a value times a number of tones may miss a whole number that it stands for: single
/// precision errs by less than 2⁻¹⁴ there, and levels k/255 that miss it do so by 1/255 and more.
const SLACK: f32 = 1.0 / 4096.0;

/// What becomes of a value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Choice {
    below: f32,
    above: f32,
    /// Up to this grain, the tone above is taken.
    rise: f32,
}

impl Choice {
    /// The tone where the grain is `grain`.
    #[inline(always)]
    pub(super) fn at(self, grain: f32) -> f32 {
        if grain <= self.rise { self.above } else { self.below }
    }
}

/// The choices of the 256 levels.
pub(super) type Choices = Box<[Choice; 256]>;

/// The choices that `choice` makes for levels 0..255.
fn by_level(choice: impl Fn(f64) -> Choice) -> Choices {
    let mut choices = Box::new([Choice::default(); 256]);
    for (level, entry) in (0..=255_u8).zip(choices.iter_mut()) {
        *entry = choice(f64::from(level));
    }
    choices
}

/// A level as PT Designer stores it, as a value.
fn stored(level: f64) -> f32 {
    levels::from_level(convert::single(level.trunc().clamp(0.0, 255.0)))
}

/// The smallest i from `first` to `last` that `is_found` accepts, or `last`.
fn search(first: u32, last: u32, is_found: impl Fn(f64) -> bool) -> f64 {
    f64::from((first..last).find(|i| is_found(f64::from(*i))).unwrap_or(last))
}

/// Method threshold: as many equal parts of the range as there are tones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Threshold {
    count: f32,
}

impl Threshold {
    pub(super) fn new(count: u32) -> Self {
        Self { count: convert::pixels(count) }
    }

    /// The tone of a value, in real numbers.
    #[inline(always)]
    pub(super) fn tone(self, value: f32) -> f32 {
        (value * self.count + SLACK).floor().min(self.count - 1.0) / (self.count - 1.0)
    }

    #[inline(always)]
    pub(super) fn choice(self, value: f32) -> Choice {
        Choice { below: self.tone(value), above: 1.0, rise: -1.0 }
    }

    pub(super) fn choices(count: u32) -> Choices {
        let tones = f64::from(count);
        by_level(|level| {
            let i = search(1, count, |i| level < i * 255.0 / tones);
            Choice { below: stored((i - 1.0) * 255.0 / (tones - 1.0)), above: 1.0, rise: -1.0 }
        })
    }
}

/// Method random: the tones around a value, and how far it is from the lower one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Random {
    steps: f32,
    /// The largest grain in 8-bit precision.
    last: u16,
}

impl Random {
    pub(super) fn new(count: u32) -> Self {
        let last = u16::try_from(255_u32.div_ceil(count - 1)).unwrap_or(255);
        Self { steps: convert::pixels(count - 1), last }
    }

    #[inline(always)]
    pub(super) fn choice(self, value: f32) -> Choice {
        let scaled = value * self.steps;
        let below = ((scaled - SLACK).ceil() - 1.0).max(0.0);
        let above = (below + 1.0) / self.steps;
        Choice { below: below / self.steps, above, rise: scaled - below }
    }

    pub(super) fn choices(count: u32) -> Choices {
        let step = 255.0 / f64::from(count - 1);
        by_level(|level| {
            let k = search(0, count - 1, |k| level <= (k + 1.0) * step);
            let rise = convert::single((level - k * step).trunc());
            Choice { below: stored(k * step), above: stored((k + 1.0) * step), rise }
        })
    }

    /// The grain of the pixel with that number: a whole number of levels in 8-bit precision, else
    /// a share of the step between two tones.
    #[inline(always)]
    pub(super) fn grain<L: Levels>(self, pixel: i32) -> f32 {
        if L::EIGHT_BIT {
            convert::level(elias::integer(pixel, self.last))
        } else {
            (elias::noise(pixel) + 1.0) * 0.5
        }
    }
}

/// Method ordered: a square matrix of numbers, repeated all over the picture.
#[derive(Debug, Clone)]
pub(super) struct Ordered {
    count: f32,
    side: usize,
    /// The grain: numbers of the matrix, row by row, negated so that large ones rise.
    grain: Vec<f32>,
}

impl Ordered {
    pub(super) fn new(count: u32) -> Self {
        let side = side(count);
        let grain = matrix(side).into_iter().map(|number| -convert::pixels(number)).collect();
        Self { count: convert::pixels(count), side: side as usize, grain }
    }

    /// The grain of a row of pixels, once around.
    pub(super) fn grain(&self, y: u32) -> &[f32] {
        &self.grain[y as usize % self.side * self.side..][..self.side]
    }

    #[inline(always)]
    pub(super) fn choice(&self, value: f32) -> Choice {
        let below = ((value * self.count - SLACK).ceil() - 1.0).max(0.0);
        let cells = convert::position(self.side * self.side);
        let above = (below + 1.0) / self.count;
        Choice { below: below / self.count, above, rise: below - cells - 1.0 }
    }

    pub(super) fn choices(count: u32) -> Choices {
        let (tones, cells) = (f64::from(count), f64::from(side(count).pow(2)));
        by_level(|level| {
            let k = search(1, count, |k| level <= k * 255.0 / tones) - 1.0;
            Choice {
                below: stored(k * 255.0 / tones),
                above: stored((k + 1.0) * 255.0 / tones),
                rise: convert::single(k - cells - 1.0),
            }
        })
    }
}

/// The side of the smallest matrix with a cell for each tone.
fn side(count: u32) -> u32 {
    let root = count.isqrt();
    if root * root < count { root + 1 } else { root }
}

/// The numbers of a matrix, row by row. Specification 2.24: a Bayer matrix where there is one,
/// otherwise a fixed permutation.
fn matrix(side: u32) -> Vec<u32> {
    match side {
        2 => vec![1, 4, 3, 2],
        4 | 8 => {
            let bayer = bayer(side);
            let transposed =
                (0..side).flat_map(|x| (0..side).map(move |y| (y * side + x) as usize));
            transposed.map(|place| bayer[place]).collect()
        }
        _ => permutation(side),
    }
}

/// Bayer, "An optimum method for two-level rendition of continuous-tone pictures", 1973; for sides
/// that are powers of two.
fn bayer(side: u32) -> Vec<u32> {
    if side == 1 {
        return vec![0];
    }
    let half = side / 2;
    let quarter = bayer(half);
    let place = |i: u32| (i / side, i % side);
    let number = |(y, x): (u32, u32)| {
        let base = 4 * quarter[(y % half * half + x % half) as usize];
        base + [[0, 3], [2, 1]][(y / half) as usize][(x / half) as usize]
    };
    (0..side * side).map(place).map(number).collect()
}

/// The numbers from 1 on, each in the next free cell that the draws hit (appendix A).
fn permutation(side: u32) -> Vec<u32> {
    let last = u16::try_from(side - 1).unwrap_or(u16::MAX);
    let mut numbers = vec![0; (side * side) as usize];
    let mut index = 0;
    for number in 1..=side * side {
        loop {
            let (x, y) = (elias::integer(index, last), elias::integer(index + 1, last));
            index += 2;
            let cell = &mut numbers[convert::index(i64::from(y * i32::from(last + 1) + x))];
            if *cell == 0 {
                *cell = number;
                break;
            }
        }
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_are_those_of_the_specification() {
        assert_eq!(matrix(3), [8, 7, 2, 3, 1, 6, 9, 5, 4]);
        assert_eq!(bayer(2), [0, 3, 2, 1]);
        assert_eq!(bayer(4)[..8], [0, 12, 3, 15, 8, 4, 11, 7]);
        assert_eq!(matrix(4)[..8], [0, 8, 2, 10, 12, 4, 14, 6]);
    }

    #[test]
    fn every_matrix_has_each_number_once() {
        assert_eq!([2, 4, 5, 8, 9, 225, 226, 255].map(side), [2, 2, 3, 3, 3, 15, 16, 16]);
        for side in 2..=16 {
            let mut numbers = matrix(side);
            numbers.sort_unstable();
            let first = u32::from(!matches!(side, 4 | 8));
            assert_eq!(numbers, (first..side * side + first).collect::<Vec<_>>(), "side {side}");
        }
    }

    #[test]
    fn choices_in_real_numbers_are_near_those_of_levels() {
        for count in [2, 3, 4, 7, 8, 16, 100, 255] {
            let (threshold, random) = (Threshold::new(count), Random::new(count));
            let ordered = Ordered::new(count);
            let step = 255.0 / convert::pixels(count - 1);
            for level in 0..=255_u8 {
                let value = levels::from_level(f32::from(level));
                let place = usize::from(level);
                let near =
                    |real: f32, level: f32| (-0.01..1.01).contains(&((real - level) * 255.0));
                let (real, levels) = (threshold.choice(value), Threshold::choices(count)[place]);
                assert!(near(real.below, levels.below), "threshold {count}, {level}");
                let (real, levels) = (random.choice(value), Random::choices(count)[place]);
                assert!(near(real.below, levels.below), "random {count}, {level}");
                assert!(near(real.rise * step / 255.0, levels.rise / 255.0));
                let (real, levels) = (ordered.choice(value), Ordered::choices(count)[place]);
                assert!(near(real.below, levels.below), "ordered {count}, {level}");
                assert_eq!(real.rise, levels.rise);
            }
        }
    }
}
