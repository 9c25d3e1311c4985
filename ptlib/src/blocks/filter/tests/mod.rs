//! The definition of CONV, for tests that hold a block against it.

use crate::{
    block::testing::{Trial, image_of_levels},
    math::convert,
};

/// Levels of no order, for an image of that many pixels.
pub(super) fn noise(pixels: u32) -> Vec<u8> {
    let mut number = 7_u32;
    let mut next = || {
        number = number.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        number.to_be_bytes()[0]
    };
    (0..pixels).map(|_| next()).collect()
}

/// CONV of one channel, for offsets from -⌊size/2⌋ on in each direction,
/// column by column.
pub(super) fn convolved(
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
pub(super) fn square(radius: i32) -> (i64, i64) {
    (2 * i64::from(radius) + 1, 2 * i64::from(radius) + 1)
}

/// Specification 5: what becomes of a row 0…0|100 from x = 32|60 from x = 40 to 63, at x = 28
/// to 43, if all rows are like it.
pub(super) fn of_the_test_row(trial: &Trial) -> Vec<u8> {
    let row: Vec<u8> = (0..64).map(|x| [0, 0, 0, 0, 100, 60, 60, 60][x / 8]).collect();
    let image = image_of_levels(64, &[&row.repeat(64)]);
    trial.clone().input(0, image).levels(0)[640 + 28..][..16].to_vec()
}
