//! Blur: the mean of a square, or of a short line, around each pixel.
//!
//! Specification 2.6 and 2.0 (BOX). The sums slide ([`box_sum`]), so every intensity costs the
//! same: the square is summed along the columns once, then along each row when it is asked for.
//! Both wrap around, also where the square is larger than the image, so the result tiles.

use crate::block::prelude::*;
use box_sum::{FixedPoint, LinePlan, LineSums, Mean, SlidingSum, SquareSums, Window};

const IMAGE: usize = 0;

choice! {
    /// The line along which a motion blur takes its mean.
    Direction {
        /// From left to right.
        Horizontal = "horizontal",
        /// From top to bottom.
        Vertical = "vertical",
        /// From the upper left to the lower right.
        FallingDiagonal = "falling diagonal",
        /// From the lower left to the upper right.
        RisingDiagonal = "rising diagonal",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far the blur reaches in each direction; 0 changes nothing.
        intensity: int [hard 0..=65536 soft 0..=100 unit "px"] = 10;
        /// Whether to blur along one direction only, as a moving camera does.
        motion: bool = false;
        /// The direction of a motion blur.
        direction: choice [Direction] = Direction::Horizontal;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Blur>(About {
    id: "blur",
    summary: "Blurs all around each pixel, or along one direction.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    in_pixels: "intensity",
    ..About::DEFAULT
});

/// What is left to do for a row.
enum Blur {
    Nothing(Image),
    Square(SquareSums),
    Row { image: Image, row: SlidingSum<1>, fixed: FixedPoint, mean: Mean },
    Line { sums: LineSums, mean: Mean },
}

impl GatherBlock for Blur {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(IMAGE)?;
        let radius = params.intensity.unsigned_abs();
        if radius == 0 {
            return Ok(Self::Nothing(image.clone()));
        }
        let side = f64::from(2 * radius + 1);
        if !params.motion {
            return Ok(Self::Square(cx.square_sums::<L>(radius, image)?));
        }
        let window = Window::around(radius);
        let fixed = FixedPoint::new::<L>(2 * radius + 1);
        let mean = Mean::of(side, fixed);
        let slope = match params.direction {
            Direction::Horizontal => {
                let row = SlidingSum::new([window], image.width());
                return Ok(Self::Row { image: image.clone(), row, fixed, mean });
            }
            Direction::Vertical => 0,
            Direction::FallingDiagonal => 1,
            Direction::RisingDiagonal => -1,
        };
        let plan = LinePlan::new((image.width(), image.height()), slope, [window], fixed);
        let sums = cx.line_sums(&plan, image, image.planes())?;
        Ok(Self::Line { sums, mean })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            match self {
                Self::Nothing(image) => out.copy_from_slice(image.row(channel, cx.y)),
                Self::Square(sums) => sums.means::<L>(channel, cx.y, out),
                Self::Row { image, row, fixed, mean } => row.along(
                    image.row(channel, cx.y),
                    |value| fixed.integer(value),
                    out,
                    |sum| mean.store::<L>(sum),
                ),
                Self::Line { sums, mean } => {
                    let (line_sums, start) = sums.row(channel, cx.y);
                    let ring = line_sums[start..].iter().chain(&line_sums[..start]);
                    for (out, sum) in out.iter_mut().zip(ring) {
                        *out = mean.store::<L>(i64::from(*sum));
                    }
                }
            }
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        let is_row_only = params.motion && params.direction == Direction::Horizontal;
        if params.intensity == 0 || is_row_only {
            0
        } else {
            Image::bytes_of(width, height, planes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::noise;
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    /// ⌊mean⌋ of the pixels that `is_in` picks from the square of that radius.
    fn naive(
        levels: &[u8],
        (width, height): (u32, u32),
        radius: i64,
        is_in: impl Fn(i64, i64) -> bool,
    ) -> Vec<u8> {
        let mut out = Vec::new();
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let (mut sum, mut count) = (0_u64, 0);
            for (i, j) in (-radius..=radius).flat_map(|j| (-radius..=radius).map(move |i| (i, j))) {
                if is_in(i, j) {
                    let x = convert::wrap(i64::from(x) + i, width);
                    let y = convert::wrap(i64::from(y) + j, height);
                    sum += u64::from(levels[(y * width + x) as usize]);
                    count += 1;
                }
            }
            out.push(u8::try_from(sum / count).unwrap());
        }
        out
    }

    #[test]
    fn a_box_is_the_floor_of_the_mean_of_its_square() {
        for size in [(1, 1), (7, 5), (4, 9), (270, 3)] {
            let levels = noise(size.0 * size.1);
            for radius in [0, 1, 2, 3, 5, 8, 11] {
                let trial = Trial::of(&BLOCK)
                    .size(size.0, size.1)
                    .input(IMAGE, image_of_levels(size.0, &[&levels]))
                    .int("intensity", radius);
                let expected = naive(&levels, size, i64::from(radius), |_, _| true);
                assert_eq!(trial.levels(0), expected, "{size:?}, radius {radius}");
            }
        }
    }

    #[test]
    fn motion_takes_the_mean_of_a_line() {
        let is_in: [fn(i64, i64) -> bool; 4] =
            [|_, j| j == 0, |i, _| i == 0, |i, j| i == j, |i, j| i == -j];
        for size in [(1, 1), (7, 5), (6, 4), (270, 3)] {
            let levels = noise(size.0 * size.1);
            for (direction, is_in) in (0..).zip(is_in) {
                for radius in [1, 2, 3, 9, 25] {
                    let trial = Trial::of(&BLOCK)
                        .size(size.0, size.1)
                        .input(IMAGE, image_of_levels(size.0, &[&levels]))
                        .int("intensity", radius)
                        .flag("motion", true)
                        .choice("direction", direction);
                    let expected = naive(&levels, size, i64::from(radius), is_in);
                    assert_eq!(trial.levels(0), expected, "{size:?}, {direction}, {radius}");
                }
            }
        }
    }

    #[test]
    fn a_step_becomes_a_ramp() {
        // Specification 5: a row 0…0|100 from x = 32|60 from x = 40 to 63.
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
        let trial = Trial::of(&BLOCK).input(IMAGE, image_of_levels(64, &[&row.repeat(64)]));
        let levels = trial.int("intensity", 2).levels(0);
        let expected = [0, 0, 20, 40, 60, 80, 100, 100, 100, 100, 92, 84, 76, 68, 60, 60];
        assert_eq!(levels[640 + 28..][..16], expected);
    }

    #[test]
    fn the_largest_blur_of_a_constant_is_that_constant() {
        for motion in [false, true] {
            for direction in 0..4 {
                let trial = Trial::of(&BLOCK)
                    .size(9, 6)
                    .input(IMAGE, image_of_levels(9, &[&[200; 54], &[255; 54], &[0; 54]]))
                    .int("intensity", 65_536)
                    .flag("motion", motion)
                    .choice("direction", direction);
                for (channel, level) in [(0, 200), (1, 255), (2, 0)] {
                    assert_eq!(trial.levels(channel), [level; 54]);
                    let error = trial.image().channel(channel)[5] - f32::from(level) / 255.0;
                    assert!(error.abs() < 1e-4, "{motion} {direction}");
                }
            }
        }
    }
}
