//! Conversions between integers and floating-point numbers, each named after how it rounds.
//!
//! All of them saturate and turn NaN into 0, so that no value from outside can leave the range of
//! the result.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "truncating is what these functions are for; Rust's casts saturate"
)]

/// A count that is far below 2³²: of channels, of pixels in a row, of bytes of a struct.
#[inline(always)]
#[must_use]
pub const fn count(number: usize) -> u32 {
    number as u32
}

/// The lower and the upper half of `number`.
#[inline(always)]
#[must_use]
pub fn words(number: u64) -> [u32; 2] {
    [number as u32, (number >> 32) as u32]
}

/// The integer part of `value`.
#[inline(always)]
#[must_use]
pub fn truncate(value: f32) -> i32 {
    value as i32
}

/// The integer part of `value`, from double precision.
#[inline(always)]
#[must_use]
pub fn truncate64(value: f64) -> i64 {
    value as i64
}

/// The integer part of `value` from double precision, in 32 bits: loops over it vectorise.
#[inline(always)]
#[must_use]
pub fn truncate64_to_i32(value: f64) -> i32 {
    value as i32
}

/// The integer part of `value` as an index: negative values become 0.
#[inline(always)]
#[must_use]
pub fn truncate_to_index(value: f32) -> usize {
    value as usize
}

/// The integer part of `value` in the low bits of an index; `mask` says which of them count. A loop
/// over a table of `mask` + 1 entries vectorises this way, and needs no check.
#[inline(always)]
#[must_use]
pub fn truncate_masked(value: f32, mask: u32) -> usize {
    (truncate(value).cast_unsigned() & mask) as usize
}

/// The nearest integer, halves away from zero.
#[inline(always)]
#[must_use]
pub fn round64(value: f64) -> i64 {
    value.round() as i64
}

/// The nearest single-precision number.
#[inline(always)]
#[must_use]
pub fn single(value: f64) -> f32 {
    value as f32
}

/// A length or position in pixels as a number. Exact: images are at most 65,536 pixels wide.
#[inline(always)]
#[must_use]
pub fn pixels(length: u32) -> f32 {
    length as f32
}

/// A distance in pixels as a number, negative ones included. Exact below 2²⁴.
#[inline(always)]
#[must_use]
pub fn distance(pixels: i64) -> f32 {
    pixels as f32
}

/// An index into a row of pixels as a number. Exact: images are at most 65,536 pixels wide.
#[inline(always)]
#[must_use]
pub fn position(index: usize) -> f32 {
    index as f32
}

/// A level or another small whole number as a number. Exact below 2²⁴.
#[inline(always)]
#[must_use]
pub fn level(level: i32) -> f32 {
    level as f32
}

/// A whole number as an index: negative values become 0.
#[inline(always)]
#[must_use]
pub fn index(value: i64) -> usize {
    value.max(0) as usize
}

/// `value` 0..1 as a byte, rounded to nearest.
#[inline(always)]
#[must_use]
pub fn to_byte(value: f32) -> u8 {
    (value * 255.0 + 0.5) as u8
}

/// `level` as a byte, clamped to 0..255.
#[inline(always)]
#[must_use]
pub fn clamped_byte(level: i32) -> u8 {
    level.clamp(0, 255) as u8
}

/// `value` 0..1 as a 16-bit number, rounded to nearest.
#[inline(always)]
#[must_use]
pub fn to_word(value: f32) -> u16 {
    (value * 65535.0 + 0.5) as u16
}

/// `value` modulo `period`, 0 ≤ result < `period`.
///
/// # Panics
/// If `period` is 0.
#[inline(always)]
#[must_use]
pub fn wrap(value: i64, period: u32) -> u32 {
    value.rem_euclid(i64::from(period)) as u32
}

/// As [`wrap`], for values that mostly lie in 0..`period` already: dividing is slow.
///
/// # Panics
/// If `period` is 0.
#[inline(always)]
#[must_use]
pub fn wrap_near(value: i64, period: u32) -> u32 {
    if (0..i64::from(period)).contains(&value) { value as u32 } else { wrap(value, period) }
}

/// The low 32 bits of `value`, as a signed number: how seeds of old files become 32-bit seeds.
#[inline(always)]
#[must_use]
pub fn low_bits(value: u64) -> i32 {
    value as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conversions_saturate_and_nan_is_zero() {
        assert_eq!(truncate(f32::NAN), 0);
        assert_eq!(truncate(1e30), i32::MAX);
        assert_eq!(truncate_to_index(-3.0), 0);
        assert_eq!((truncate_masked(300.9, 255), truncate_masked(f32::NAN, 255)), (44, 0));
        assert_eq!(to_byte(f32::NAN), 0);
        assert_eq!(to_byte(7.0), 255);
        assert_eq!(to_word(-1.0), 0);
    }

    #[test]
    fn truncation_goes_toward_zero_and_rounding_away_from_it() {
        assert_eq!(truncate(-1.9), -1);
        assert_eq!(truncate64(-1.9), -1);
        assert_eq!((truncate64_to_i32(-1.9), truncate64_to_i32(1e30)), (-1, i32::MAX));
        assert_eq!(round64(-2.5), -3);
        assert_eq!(round64(2.5), 3);
    }

    #[test]
    fn wrap_is_never_negative() {
        assert_eq!(wrap(-1, 5), 4);
        assert_eq!(wrap(-5, 5), 0);
        assert_eq!(wrap(12, 5), 2);
        assert!((-12..12).all(|value| wrap_near(value, 5) == wrap(value, 5)));
    }
}
