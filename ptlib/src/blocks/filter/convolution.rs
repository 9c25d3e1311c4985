//! Convolution: each pixel becomes a weighted sum of the pixels around it.
//!
//! Specification 2.35; [`Matrix`] makes the sums. They wrap around, also where the
//! matrix is larger than the image, so the result tiles.

// Pictured: `matrix data` `0 -1 0 -1 5 -1 0 -1 0`.
// Pictured: `matrix width` `9`, `matrix height` `1`,
//   `matrix data` `0.11 0.11 0.11 0.11 0.11 0.11 0.11 0.11 0.11`.

use crate::block::prelude::*;
use convolution::{MAX_SIDE, Matrix};

const IMAGE: usize = 0;

/// PT Designer reads no more weights: the last one of a full matrix is always 0.
const MOST_WEIGHTS: usize = MAX_SIDE * MAX_SIDE - 1;

/// Weights are at most this large, so that no sum is infinite.
const LARGEST: f64 = 1e30;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Columns of the matrix. The pixel itself is at the middle one, or right of the middle.
        width "matrix width": int [hard 1..=16 soft 1..=11 unit "px"] = 3;
        /// Rows of the matrix. The pixel itself is at the middle one, or below the middle.
        height "matrix height": int [hard 1..=16 soft 1..=11 unit "px"] = 3;
        /// The weights row by row from the upper left: decimal numbers with blanks between them, as
        /// in `0.1 0.1 0.1 0.1 0.2 0.1 0.1 0.1 0.1` for 3 × 3, at most 255. Missing ones are 0, as
        /// are all from the first one that is not a number on. Weights that sum to 1 keep the
        /// brightness.
        weights "matrix data": text = "";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Convolution>(About {
    id: "convolution",
    summary: "Sums the pixels around each pixel, with weights from a matrix.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    in_pixels: "matrix width, matrix height",
    ..About::DEFAULT
});

struct Convolution {
    image: Image,
    matrix: Matrix,
}

impl GatherBlock for Convolution {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let [width, height] = [params.width, params.height].map(i64::from).map(convert::index);
        let mut weights = read(&params.weights);
        weights.resize(width * height, 0.0);
        let matrix = Matrix::new::<L>(width, &weights);
        Ok(Self { image: cx.image(IMAGE)?.clone(), matrix })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            self.matrix.write::<L>(&self.image, channel, cx.y, out);
        }
    }
}

/// The numbers that a text starts with. Blanks behind the last one are nothing (PT Designer takes
/// them for the last number once more, a BUG).
fn read(mut text: &str) -> Vec<f64> {
    let mut numbers = Vec::new();
    while numbers.len() < MOST_WEIGHTS
        && let Some((number, rest)) = decimal::prefix(text)
    {
        numbers.push(number.clamp(-LARGEST, LARGEST));
        text = rest;
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::super::tests as naive;
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(size: (u32, u32), levels: &[u8], matrix: (i32, i32), weights: &[f64]) -> Trial {
        let texts: Vec<_> = weights.iter().map(f64::to_string).collect();
        Trial::of(&BLOCK)
            .size(size.0, size.1)
            .input(IMAGE, image_of_levels(size.0, &[levels]))
            .int("matrix width", matrix.0)
            .int("matrix height", matrix.1)
            .text("matrix data", &texts.join(" "))
    }

    /// Weights that single precision sums exactly, or does not; some of them are 0.
    fn weights(count: i32, unit: f64) -> Vec<f64> {
        (0..count).map(|i| f64::from(i * 7919 % 11 - 4) * unit).collect()
    }

    #[test]
    fn sums_are_those_of_the_definition() {
        for size in [(1, 1), (7, 5), (4, 19), (300, 3)] {
            let levels = naive::noise(size.0 * size.1);
            for matrix in [(1, 1), (3, 3), (5, 5), (2, 4), (1, 9), (16, 1), (11, 7), (16, 15)] {
                for unit in [0.125, 0.1, 1.0 / 7.0] {
                    let weights = weights(matrix.0 * matrix.1, unit);
                    let (columns, rows) = (i64::from(matrix.0), i64::from(matrix.1));
                    let weight = |i: i64, j: i64| {
                        weights[convert::index((j + rows / 2) * columns + i + columns / 2)]
                    };
                    let expected = naive::convolved(&levels, size, (columns, rows), weight);
                    let found = trial(size, &levels, matrix, &weights);
                    assert_eq!(found.levels(0), expected, "{size:?} {matrix:?} {unit}");
                    for (value, level) in found.image().channel(0).iter().zip(expected) {
                        let level = f64::from(level);
                        let is_near =
                            (level - 0.01..level + 1.01).contains(&(f64::from(*value) * 255.0));
                        assert!(is_near || level == 255.0, "{value} for {level}");
                    }
                }
            }
        }
    }

    #[test]
    fn weights_are_read_as_far_as_they_are_numbers() {
        assert_eq!(read("1 -2.5  .5\n1e1 "), [1.0, -2.5, 0.5, 10.0]);
        assert_eq!(read("1 2 x 3"), [1.0, 2.0]);
        assert_eq!(read("1,2"), [1.0]);
        assert_eq!(read(""), []);
        assert_eq!(read("1e999 -1e999"), [LARGEST, -LARGEST]);
        assert_eq!(read(&"1 ".repeat(300)).len(), 255);
    }

    #[test]
    fn missing_weights_are_0_and_surplus_ones_are_not_read() {
        let levels = naive::noise(35);
        let found = |text| trial((7, 5), &levels, (3, 3), &[]).text("matrix data", text).levels(0);
        assert_eq!(found(""), [0; 35]);
        assert_eq!(found("0 0 0 0 1"), levels);
        assert_eq!(found("0 0 0 0 1 0 0 0 0 9 9 9"), levels);
        // A weight at the upper left moves the image down to the right.
        assert_eq!(found("1")[8], levels[0]);
    }

    #[test]
    fn the_greatest_weights_give_finite_sums() {
        for weight in [LARGEST, -LARGEST] {
            let image = trial((7, 5), &[255; 35], (16, 16), &[weight; 256]).image();
            let expected = if weight > 0.0 { 1.0 } else { 0.0 };
            assert!(image.channel(0).iter().all(|value| *value == expected));
        }
    }

    #[test]
    fn rows_are_the_same_bits_at_every_simd_level() {
        let levels = naive::noise(145 * 20);
        for unit in [0.25, 0.1] {
            let trial = trial((145, 20), &levels, (7, 3), &weights(21, unit));
            trial.assert_same_bits();
            trial.eight_bit().assert_same_bits();
        }
    }
}
