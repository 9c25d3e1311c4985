//! Emboss: light from the lower right on the slopes of a relief.
//!
//! Specification 2.39 and 2.0 (CONV): over the (2I+1)² square around a pixel, pixels below and
//! right of the diagonal that rises to the right are added, those above and left of it subtracted.
//! Everything wraps around, also where the square is larger than the image, so the result tiles.
//!
//! Every intensity costs the same. From one pixel to the next in its row, the sum gains the
//! column of 2I pixels that enters at the right, and the one at the left that is no longer
//! subtracted; it loses the pixels of two diagonals, which become 0 and -1. Both columns and both
//! diagonals are sums that slide themselves ([`box_sum`]). The sums at column 0 slide down the
//! rows in the same manner, from the first one, which alone is added up pixel by pixel.

use crate::block::prelude::*;
use box_sum::{Extent, FixedPoint, LinePlan, LineSums, Mean, RunningSum, Tap, Window};

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far the slope around a pixel is taken. A higher intensity gives harder contrasts;
        /// 0 changes nothing.
        intensity: int [hard 0..=1000 soft 0..=10 unit "px"] = 3;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Emboss>(About {
    id: "emboss",
    summary: "Shows the image as a relief: slopes that fall to the upper left are bright.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    in_pixels: "intensity",
    ..About::DEFAULT
});

enum Emboss {
    Nothing(Image),
    Slopes(Slopes),
}

/// The sums that make slopes, all over the 2I rows from I above a pixel on.
struct Slopes {
    radius: i64,
    extent: Extent,
    columns: LineSums,
    /// Down to the left.
    diagonals: LineSums,
    /// For each channel, the slopes at column 0.
    starts: Vec<Vec<i64>>,
    unit: Mean,
}

impl GatherBlock for Emboss {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(IMAGE)?;
        let radius = params.intensity.unsigned_abs();
        if radius == 0 {
            return Ok(Self::Nothing(image.clone()));
        }
        let size = (image.width(), image.height());
        let fixed = FixedPoint::new::<L>(2 * radius);
        let window = Window::new(-i64::from(radius), 2 * radius);
        let along = |slope| {
            cx.line_sums(&LinePlan::new(size, slope, [window], fixed), image, image.planes())
        };
        let mut slopes = Slopes {
            radius: i64::from(radius),
            extent: extent(radius, fixed),
            columns: along(0)?,
            diagonals: along(-1)?,
            starts: Vec::new(),
            unit: Mean::of(1.0, fixed),
        };
        let mut starts = vec![Vec::new(); image.planes()];
        cx.parallel_pieces(&mut starts, 1, |channel, starts| {
            starts[0] = slopes.down_column_0(image, channel, fixed, cx)?;
            Ok(())
        })?;
        slopes.starts = starts;
        Ok(Self::Slopes(slopes))
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            match self {
                Self::Nothing(image) => out.copy_from_slice(image.row(channel, cx.y)),
                Self::Slopes(slopes) => {
                    let slope = slopes.along_row(channel, cx);
                    slope.along(|sum| sum, out, |out, sum| *out = slopes.unit.store::<L>(sum));
                }
            }
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        if params.intensity == 0 { 0 } else { 2 * Image::bytes_of(width, height, planes) }
    }
}

/// How large slopes may be: those of a white half of the square beside a black one.
fn extent(radius: u32, fixed: FixedPoint) -> Extent {
    Extent::of_signed(f64::from(2 * radius + 1) * f64::from(radius) * fixed.one())
}

impl Slopes {
    /// The slopes of a row, which run to the right.
    fn along_row(&self, channel: usize, cx: &RowContext<'_>) -> RunningSum<'_, i32, 2> {
        let below = if cx.y + 1 == cx.height { 0 } else { cx.y + 1 };
        let tap = |(row, column_0): (_, usize), x| Tap::new(row, column_0 as i64 + x);
        let columns = |y| self.columns.row(channel, y);
        let diagonals = |y| self.diagonals.row(channel, y);
        RunningSum {
            extent: self.extent,
            sum: self.starts[channel][cx.y as usize],
            gained: [tap(columns(cx.y), -self.radius), tap(columns(below), self.radius + 1)],
            lost: [tap(diagonals(cx.y), 0), tap(diagonals(below), 0)],
        }
    }

    /// The slopes at column 0, which run down.
    fn down_column_0(
        &self,
        image: &Image,
        channel: usize,
        fixed: FixedPoint,
        cx: &PrepareContext<'_>,
    ) -> Result<Vec<i64>, Error> {
        let (radius, height) = (self.radius, image.height());
        let sum = |first: i64, count: i64, y: i64| {
            let count = u32::try_from(count).unwrap_or(0);
            let row = image.row(channel, convert::wrap(y, height));
            Window::new(first, count).sum(row, |value| fixed.integer(value))
        };
        let diagonal = |x: i64, y: i64| {
            let (row, column_0) = self.diagonals.row(channel, convert::wrap(y, height));
            i64::from(row[convert::wrap(column_0 as i64 + x, image.width()) as usize])
        };
        let mut slope = 0;
        for j in -radius..=radius {
            cx.check()?;
            slope += sum(1 - j, radius + j, j) - sum(-radius, radius - j, j);
        }
        let mut slopes = Vec::with_capacity(height as usize);
        for y in 0..i64::from(height) {
            cx.check()?;
            slopes.push(slope);
            // What `along_row` does, with rows and columns exchanged.
            slope += sum(-radius, 2 * radius, y - radius);
            slope += sum(1 - radius, 2 * radius, y + radius + 1);
            slope -= diagonal(-1, y + 1) + diagonal(0, y + 1);
        }
        Ok(slopes)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests as naive;
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(size: (u32, u32), levels: &[&[u8]], radius: i32) -> Trial {
        let image = image_of_levels(size.0, levels);
        Trial::of(&BLOCK).size(size.0, size.1).input(IMAGE, image).int("intensity", radius)
    }

    #[test]
    fn below_right_minus_above_left() {
        for size in [(1, 1), (7, 5), (4, 9), (1, 6), (270, 3)] {
            let planes = naive::noise(3 * size.0 * size.1);
            let planes: Vec<_> = planes.chunks((size.0 * size.1) as usize).collect();
            for radius in [0, 1, 2, 3, 5, 8, 11] {
                let trial = trial(size, &planes, radius);
                for (channel, levels) in planes.iter().enumerate() {
                    let weight = |i: i64, j: i64| (i + j).signum() as f64;
                    let expected = naive::convolved(levels, size, naive::square(radius), weight);
                    let expected = if radius == 0 { levels.to_vec() } else { expected };
                    assert_eq!(trial.levels(channel), expected, "{size:?}, radius {radius}");
                }
            }
        }
    }

    #[test]
    fn a_step_up_is_bright_and_flat_areas_are_black() {
        let levels = naive::of_the_test_row(&Trial::of(&BLOCK).int("intensity", 1));
        assert_eq!(levels, [0, 0, 0, 200, 200, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        let flat = trial((40, 24), &[&[77; 960]], 1000).image();
        assert!(flat.channel(0).iter().all(|value| *value == 0.0));
    }

    #[test]
    fn rows_are_the_same_bits_at_every_simd_level() {
        let levels = naive::noise(45 * 20);
        trial((45, 20), &[&levels], 3).assert_same_bits();
        trial((45, 20), &[&levels], 3).eight_bit().assert_same_bits();
    }
}
