//! Precision: what a block's stored values are.
//!
//! PT Designer computes in 8-bit levels and truncates whenever it stores one (specification, "How
//! ptlib uses this specification"). New graphs compute on real numbers. Both go through one
//! implementation of each block: a block is written over [`Levels`], and the engine picks
//! [`EightBit`] or [`Continuous`].

use super::convert::truncate64_to_i32;

/// What a graph computes in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// Levels k/255, truncated at each store: the pictures of PT Designer.
    EightBit,
    /// Real numbers 0..1, never truncated.
    #[default]
    Float,
}

/// Arithmetic of one [`Precision`], chosen at compile time so that rows stay free of branches.
pub trait Levels: Copy + Send + Sync + 'static {
    /// Whether values are levels k/255.
    const EIGHT_BIT: bool;

    /// A value 0..1 as it is stored: truncated to a level, or unchanged.
    fn store(value: f32) -> f32;

    /// A level 0..255 as it is stored: truncated, or unchanged. For intermediate results that are
    /// kept in levels, where [`store`](Self::store) would divide and multiply by 255 each time.
    fn store_level(level: f32) -> f32;
}

/// Levels k/255.
#[derive(Debug, Clone, Copy)]
pub struct EightBit;

/// Real numbers.
#[derive(Debug, Clone, Copy)]
pub struct Continuous;

/// Added before truncating to a level, in levels. Single precision misses an exact level by up to
/// 2⁻¹⁵ of one; without this, a chain of identities would lose a level at each step.
const TRUNCATION_SLACK: f32 = 1.0 / 1024.0;

/// The same for numbers that were never divided by 255: interpolating between two levels in single
/// precision errs by less than 2⁻¹⁵ of one.
const LEVEL_SLACK: f32 = 1.0 / 16_384.0;

impl Levels for EightBit {
    const EIGHT_BIT: bool = true;

    #[inline(always)]
    fn store(value: f32) -> f32 {
        from_level(to_level(value))
    }

    #[inline(always)]
    fn store_level(level: f32) -> f32 {
        (level + LEVEL_SLACK).trunc()
    }
}

impl Levels for Continuous {
    const EIGHT_BIT: bool = false;

    #[inline(always)]
    fn store(value: f32) -> f32 {
        value
    }

    #[inline(always)]
    fn store_level(level: f32) -> f32 {
        level
    }
}

/// The level of `value`, truncated toward zero: 0.5 is 127. Values outside 0..1 keep their sign and
/// size, as intermediate results need it.
#[inline(always)]
#[must_use]
pub fn to_level(value: f32) -> f32 {
    let scaled = value * 255.0;
    (scaled + TRUNCATION_SLACK.copysign(scaled)).trunc()
}

/// The value of level `level`; 255 is 1.
#[inline(always)]
#[must_use]
pub fn from_level(level: f32) -> f32 {
    level / 255.0
}

/// How light a colour of values 0..1 is, 0..1; in 8-bit precision a level, truncated.
///
/// Specification 0, `luma`. The weight of red is that of PT Designer, not the usual 0.299, so that
/// white gives 237/255 only; files are tuned to that.
#[inline(always)]
#[must_use]
pub fn luma<L: Levels>(rgb: [f32; 3]) -> f32 {
    if !L::EIGHT_BIT {
        return 0.229 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
    }
    // Where the sum is a whole level, double precision decides whether it falls short of it.
    let [red, green, blue] = rgb.map(|value| f64::from(to_level(value)));
    let level = truncate64_to_i32(0.229 * red + 0.587 * green + 0.114 * blue);
    from_level(super::convert::level(level))
}

#[cfg(test)]
mod tests {
    use super::{super::convert, *};

    #[test]
    fn every_level_survives_storing() {
        for level in 0..=255_u8 {
            let value = from_level(f32::from(level));
            assert_eq!(EightBit::store(value), value, "level {level}");
            assert_eq!(to_level(value), f32::from(level));
        }
    }

    #[test]
    fn luma_follows_the_vectors_of_the_specification() {
        for (level, expected) in [(64, 59), (100, 93), (128, 119), (200, 186), (255, 237)] {
            let value = from_level(convert::level(level));
            assert_eq!(to_level(luma::<EightBit>([value; 3])), convert::level(expected));
            assert!((luma::<Continuous>([value; 3]) - 0.93 * value).abs() < 1e-6);
        }
        let luma = luma::<EightBit>([10.0, 20.0, 30.0].map(from_level));
        assert_eq!(to_level(luma), 17.0, "17.45 is truncated");
    }

    #[test]
    fn storing_truncates() {
        assert_eq!(to_level(0.5), 127.0);
        assert_eq!(to_level(127.99 / 255.0), 127.0);
        assert_eq!(to_level(-1.5 / 255.0), -1.0);
        assert_eq!(Continuous::store(0.5), 0.5);
        assert_eq!(EightBit::store_level(99.999), 99.0);
        assert_eq!(EightBit::store_level(100.0 - 2e-5), 100.0);
        assert_eq!(Continuous::store_level(99.5), 99.5);
    }
}
