//! Conversions between integers and floating-point numbers, each named after how it rounds.
//!
//! All of them saturate and turn NaN into 0, so that no value from outside can leave the range of
//! the result.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "truncating is what these functions are for; Rust's casts saturate"
)]

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

/// The integer part of `value` as an index: negative values become 0.
#[inline(always)]
#[must_use]
pub fn truncate_to_index(value: f32) -> usize {
    value as usize
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

/// `value` 0..1 as a byte, rounded to nearest.
#[inline(always)]
#[must_use]
pub fn to_byte(value: f32) -> u8 {
    (value * 255.0 + 0.5) as u8
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
        assert_eq!(to_byte(f32::NAN), 0);
        assert_eq!(to_byte(7.0), 255);
        assert_eq!(to_word(-1.0), 0);
    }

    #[test]
    fn truncation_goes_toward_zero_and_rounding_away_from_it() {
        assert_eq!(truncate(-1.9), -1);
        assert_eq!(truncate64(-1.9), -1);
        assert_eq!(round64(-2.5), -3);
        assert_eq!(round64(2.5), 3);
    }

    #[test]
    fn wrap_is_never_negative() {
        assert_eq!(wrap(-1, 5), 4);
        assert_eq!(wrap(-5, 5), 0);
        assert_eq!(wrap(12, 5), 2);
    }
}
