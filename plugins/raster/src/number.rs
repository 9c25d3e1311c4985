//! Conversions of numbers, each with the reason why nothing is lost.

/// The nearest number of single precision.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
pub(crate) fn single(x: f64) -> f32 {
    x as f32
}

/// The largest whole number that is not above, of a number far inside of ±2³¹.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the caller keeps it in range")]
pub(crate) fn floor(x: f64) -> i32 {
    x.floor() as i32
}

/// A whole number that is not negative; 0 for others.
#[inline]
pub(crate) fn index(x: i32) -> usize {
    usize::try_from(x).unwrap_or_default()
}

/// The whole part of a number that is not negative.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "pixels of a picture")]
#[expect(clippy::cast_sign_loss, reason = "the caller keeps it in range")]
pub(crate) fn truncate(x: f32) -> usize {
    x as usize
}

/// A count of pixels or tiles, which is below 2³¹.
#[inline]
pub(crate) fn signed(x: usize) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX)
}

/// The index of a triangle or a line, of which there are less than 2³².
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the counts of values have 32 bits")]
pub(crate) fn word(x: usize) -> u32 {
    x as u32
}

#[inline]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
