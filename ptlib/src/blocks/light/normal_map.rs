//! Normal map: the direction in which a surface of the image's heights looks.
//!
//! Specification 2.29: the slope is the mean difference of the two halves of a square around each
//! pixel, with equal weights, and a difference of one level of 255 tilts the surface by 45°. Both
//! slopes come from sums that slide ([`box_sum`]): along x from the column sums of the square,
//! along y from the differences of the half columns above and below. Any size costs the same, and
//! everything wraps around.

use crate::block::prelude::*;
use box_sum::{Extent, FixedPoint, LinePlan, LineSums, SlidingSum, Window};

const HEIGHTS: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far around each pixel heights are compared; 0 counts as 1.
        size "neighbourhood size": int [hard 0..=65536 soft 1..=50 unit "px"] = 5;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<NormalMap>(About {
    id: "normal map",
    summary: "The directions of a surface whose heights are the red channel, as colours.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("normals", Planes::Colour)],
    in_pixels: "neighbourhood size",
    ..About::DEFAULT
});

struct NormalMap {
    /// Σ over each column of the square.
    columns: LineSums,
    /// Σ over the half column above minus Σ over that below.
    differences: LineSums,
    along_x: SlidingSum<2>,
    along_y: SlidingSum<1>,
    /// From a sum to the mean difference in levels.
    to_slope: f32,
}

impl GatherBlock for NormalMap {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(HEIGHTS)?;
        let size = params.size.unsigned_abs().max(1);
        let fixed = FixedPoint::new::<L>(2 * size + 1);
        let square = Window::around(size);
        let halves = [Window::new(-i64::from(size), size), Window::new(1, size).negative()];
        let pairs = f64::from(size) * f64::from(2 * size + 1);
        let dimensions = (image.width(), image.height());
        let columns = LinePlan::new(dimensions, 0, [square], fixed);
        let differences = LinePlan::new(dimensions, 0, halves, fixed);
        let extent = Extent::of_signed(pairs * fixed.one());
        Ok(Self {
            columns: cx.line_sums(&columns, image, 1)?,
            differences: cx.line_sums(&differences, image, 1)?,
            along_x: SlidingSum::new(halves, image.width()).reaching(extent),
            along_y: SlidingSum::new([square], image.width()).reaching(extent),
            to_slope: convert::single(255.0 / (pairs * fixed.one())),
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let [red, green, blue] = out.rgb();
        #[expect(clippy::cast_precision_loss, reason = "24 bits of a slope are enough")]
        let slope = |sum: i64| sum as f32 * self.to_slope;
        self.along_x.along(self.columns.row(0, cx.y).0, |sum| sum, red, slope);
        self.along_y.along(self.differences.row(0, cx.y).0, |sum| sum, green, slope);
        for ((red, green), blue) in red.iter_mut().zip(green).zip(blue) {
            let (x, y) = (*red, *green);
            let scale = (128.0 / 255.0) / (x * x + y * y + 1.0).sqrt();
            *red = x * scale + 127.0 / 255.0;
            *green = y * scale + 127.0 / 255.0;
            *blue = scale + 127.0 / 255.0;
        }
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32, _: usize) -> u64 {
        2 * Image::bytes_of(width, height, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(width: u32, levels: &[u8], size: i32) -> Trial {
        let height = u32::try_from(levels.len()).unwrap() / width;
        Trial::of(&BLOCK)
            .size(width, height)
            .input(HEIGHTS, image_of_levels(width, &[levels]))
            .int("neighbourhood size", size)
    }

    #[test]
    fn slopes_are_those_of_the_definition() {
        for (width, height) in [(1_u32, 1_u32), (7, 5), (4, 9), (270, 3)] {
            let levels: Vec<u8> =
                (0..width * height).map(|i| (i * i % 241 / 8).to_le_bytes()[0]).collect();
            let height_at = |x: i64, y: i64| {
                let place = convert::wrap(y, height) * width + convert::wrap(x, width);
                f64::from(levels[place as usize])
            };
            for size in [1_i64, 2, 3, 6, 10] {
                let trial = trial(width, &levels, i32::try_from(size).unwrap());
                let image = trial.image();
                for place in 0..levels.len() {
                    let (x, y) = (place as i64 % i64::from(width), place as i64 / i64::from(width));
                    let (mut dx, mut dy) = (0.0, 0.0);
                    for j in -size..=size {
                        for i in 1..=size {
                            dx += height_at(x - i, y + j) - height_at(x + i, y + j);
                            dy += height_at(x + j, y - i) - height_at(x + j, y + i);
                        }
                    }
                    let pairs = f64::from(i32::try_from(size * (2 * size + 1)).unwrap());
                    let (dx, dy) = (dx / pairs, dy / pairs);
                    let length = (dx * dx + dy * dy + 1.0).sqrt();
                    for (channel, c) in [dx / length, dy / length, 1.0 / length].iter().enumerate()
                    {
                        let expected = ((128.0 * c + 127.0) / 255.0).clamp(0.0, 1.0);
                        let value = f64::from(image.channel(channel)[place]);
                        assert!((value - expected).abs() < 1e-5, "{x},{y} size {size}");
                    }
                }
            }
        }
    }

    #[test]
    fn follows_the_vector_of_the_specification() {
        let row: Vec<u8> = (0..64)
            .map(|x| {
                if x < 32 {
                    0
                } else if x < 40 {
                    100
                } else {
                    60
                }
            })
            .collect();
        let trial = trial(64, &row.repeat(8), 0);
        let levels: [_; 3] = std::array::from_fn(|channel| trial.levels(channel));
        let at = |x: usize| levels.each_ref().map(|levels| levels[64 + x]);
        assert_eq!((at(31), at(32)), ([0, 127, 128], [0, 127, 128]));
        assert_eq!((at(39), at(40)), ([254, 127, 130], [254, 127, 130]));
        assert_eq!((at(28), at(35)), ([127, 127, 255], [127, 127, 255]));
    }
}
