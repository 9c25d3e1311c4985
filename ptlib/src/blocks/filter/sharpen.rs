//! Sharpen: every pixel is pushed away from the sum of the pixels around it.
//!
//! Specification 2.38 and 2.0 (CONV): over the (2I+1)² square around a pixel, the pixel counts
//! (2I+1)² times and each of the others -1 times. With n = (2I+1)² that is the pixel itself, plus
//! n times the pixel minus the sum of the square. The sum slides ([`box_sum`]) as that of a blur
//! does, so every intensity costs the same. It wraps around, also where the square is larger than
//! the image, so the result tiles.

use crate::block::prelude::*;
use box_sum::{Mean, SquareSums, number};

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far around it a pixel is compared with others. A higher intensity gives harder
        /// contrasts; 0 changes nothing.
        intensity: int [hard 0..=65536 soft 0..=10 unit "px"] = 3;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Sharpen>(About {
    id: "sharpen",
    summary: "Raises the contrast of each pixel with the pixels around it.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    in_pixels: "intensity",
    ..About::DEFAULT
});

struct Sharpen {
    image: Image,
    /// The sums of the squares around pixels; `None` if nothing changes.
    squares: Option<SquareSums>,
}

impl GatherBlock for Sharpen {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(IMAGE)?.clone();
        let squares = match params.intensity.unsigned_abs() {
            0 => None,
            radius => Some(cx.square_sums::<L>(radius, &image)?),
        };
        Ok(Self { image, squares })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            out.copy_from_slice(self.image.row(channel, cx.y));
            let Some(squares) = &self.squares else {
                continue;
            };
            let (count, fixed) = (number(squares.pixels().cast_signed()), squares.fixed());
            let unit = Mean::of(1.0, fixed);
            squares.row(channel, cx.y).along(
                |sum| sum,
                out,
                |pixel, sum| {
                    // Both from the same integers: where all pixels are equal, this is exactly 0.
                    let difference = count * f64::from(fixed.integer(*pixel)) - number(sum);
                    *pixel += unit.store_number::<L>(difference);
                },
            );
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        if params.intensity == 0 { 0 } else { Image::bytes_of(width, height, planes) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests as naive;
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn the_pixel_counts_as_much_as_all_others() {
        for size in [(1, 1), (7, 5), (4, 9), (270, 3)] {
            let levels = naive::noise(size.0 * size.1);
            for radius in [0, 1, 2, 3, 5, 8, 11] {
                let trial = Trial::of(&BLOCK)
                    .size(size.0, size.1)
                    .input(IMAGE, image_of_levels(size.0, &[&levels]))
                    .int("intensity", radius);
                let count = f64::from((2 * radius + 1).pow(2));
                let weight = |i, j| if (i, j) == (0, 0) { count } else { -1.0 };
                let expected = naive::convolved(&levels, size, naive::square(radius), weight);
                assert_eq!(trial.levels(0), expected, "{size:?}, radius {radius}");
            }
        }
    }

    #[test]
    fn edges_overshoot() {
        let levels = naive::of_the_test_row(&Trial::of(&BLOCK).int("intensity", 1));
        let expected = [0, 0, 0, 0, 255, 100, 100, 100, 100, 100, 100, 220, 0, 60, 60, 60];
        assert_eq!(levels, expected);
    }

    #[test]
    fn flat_areas_stay_as_they_are_at_every_intensity() {
        let image = image_of_levels(9, &[&[200; 54], &[255; 54], &[1; 54]]);
        for radius in [3, 100, 65_536] {
            let trial = Trial::of(&BLOCK).size(9, 6).input(IMAGE, image.clone());
            let sharpened = trial.int("intensity", radius).image();
            for channel in 0..3 {
                assert_eq!(sharpened.channel(channel), image.channel(channel));
            }
        }
    }

    #[test]
    fn rows_are_the_same_bits_at_every_simd_level() {
        let image = image_of_levels(45, &[&naive::noise(45 * 20)]);
        let trial = Trial::of(&BLOCK).size(45, 20).input(IMAGE, image);
        trial.assert_same_bits();
        trial.eight_bit().assert_same_bits();
    }
}
