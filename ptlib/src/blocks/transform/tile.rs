//! A picture repeated, each copy smaller.
//!
//! Specification 2.10: the picture is reduced by averaging squares of `times` × `times` pixels.
//! Where `times` does not divide a side, 8-bit precision cuts the last copy, as PT Designer does;
//! in float precision every pixel averages the square at `times` times its position instead, so
//! that the result tiles. Where it divides both sides, the two are the same.

use crate::block::prelude::*;
use box_sum::{FixedPoint, Mean};

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How often the picture is repeated in each direction.
        times: int [hard 1..=65536 soft 1..=32] = 2;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Tile>(About {
    id: "tile",
    summary: "Repeats a picture, each copy reduced accordingly.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    tiling: Tiling::ExceptInEightBit(
        "the last copy is cut where the number of copies does not divide the \
         width or the height",
    ),
    ..About::DEFAULT
});

struct Tile {
    /// The different pixels of the result.
    reduced: Image,
}

impl GatherBlock for Tile {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(IMAGE)?;
        let times = params.times.unsigned_abs();
        if times == 1 {
            return Ok(Self { reduced: image.clone() });
        }
        let width = distinct::<L>(image.width(), times);
        let height = distinct::<L>(image.height(), times);
        let mut reduced = cx.new_image_sized(width, height, image.planes())?;
        for (channel, plane) in reduced.planes_mut().enumerate() {
            cx.parallel_pieces(plane, width as usize, |y, out| {
                cx.check()?;
                let top = convert::wrap(y as i64 * i64::from(times), image.height());
                squares::<L>(image, channel, top, times, out);
                Ok(())
            })?;
        }
        Ok(Self { reduced })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let y = cx.y % self.reduced.height();
        for (channel, out) in out.iter_mut().enumerate() {
            let row = self.reduced.row(channel, y);
            for copy in out.chunks_mut(row.len()) {
                copy.copy_from_slice(&row[..copy.len()]);
            }
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        let times = params.times.unsigned_abs();
        if times == 1 {
            return 0;
        }
        // Float precision needs no fewer than 8-bit precision.
        let (width, height) = (width / gcd(width, times), height / gcd(height, times));
        Image::bytes_of(width, height, planes)
    }
}

/// How many different squares there are along a side. Each is a whole number of `times` away from
/// the first one, around the end of the side in float precision.
fn distinct<L: Levels>(length: u32, times: u32) -> u32 {
    if L::EIGHT_BIT { (length / times).max(1) } else { length / gcd(length, times) }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Writes the means of the squares whose upper edge is row `top`. A square is not larger than the
/// image.
fn squares<L: Levels>(image: &Image, channel: usize, top: u32, times: u32, out: &mut [f32]) {
    let (width, height) = (image.width() as usize, image.height());
    let (columns, rows) = (times.min(image.width()), times.min(height));
    let fixed = FixedPoint::new::<L>(rows);
    let mean = Mean::of(f64::from(columns) * f64::from(rows), fixed);
    let mut sums = vec![0_i32; width + columns as usize];
    for row in 0..rows {
        let values = image.row(channel, (top + row) % height);
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += fixed.integer(*value);
        }
    }
    // The squares at the right edge go on at the left one.
    let (row, beyond) = sums.split_at_mut(width);
    beyond.copy_from_slice(&row[..columns as usize]);
    let mut left = 0;
    for out in out {
        let sum = sums[left..][..columns as usize].iter().map(|sum| i64::from(*sum)).sum();
        *out = mean.store::<L>(sum);
        left = (left + times as usize) % width;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(width: u32, height: u32, times: i32) -> Trial {
        let level = |i: u32| (i * 37 % 251).to_le_bytes()[0];
        let levels: Vec<u8> = (0..width * height).map(level).collect();
        Trial::of(&BLOCK)
            .size(width, height)
            .input(IMAGE, image_of_levels(width, &[&levels]))
            .int("times", times)
    }

    #[test]
    fn copies_are_means_of_squares() {
        let image = image_of_levels(4, &[&[0, 2, 4, 6, 1, 4, 4, 7]]);
        let trial = Trial::of(&BLOCK).size(4, 2).input(IMAGE, image);
        assert_eq!(trial.levels(0), [1, 5, 1, 5, 1, 5, 1, 5]);
        assert!((trial.image().channel(0)[1] - 5.25 / 255.0).abs() < 1e-7);
    }

    #[test]
    fn eight_bit_precision_cuts_the_last_copy() {
        let image = image_of_levels(5, &[&[0, 2, 4, 6, 99]]);
        let trial = Trial::of(&BLOCK).size(5, 1).input(IMAGE, image);
        assert_eq!(trial.levels(0), [1, 5, 1, 5, 1]);
    }

    #[test]
    fn float_precision_tiles_for_any_number_of_copies() {
        let (width, height, times) = (9, 6, 4);
        let trial = trial(width, height, times);
        let image = trial.image();
        let source = trial.clone().int("times", 1).image();
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let times = times.unsigned_abs();
            let square = (0..times).flat_map(|j| (0..times).map(move |i| (i, j)));
            let sum: f32 = square
                .map(|(i, j)| {
                    let row = source.row(0, (y * times + j) % height);
                    row[((x * times + i) % width) as usize]
                })
                .sum();
            let mean = sum / convert::pixels(times * times);
            assert!((image.row(0, y)[x as usize] - mean).abs() < 1e-5, "{x},{y}");
        }
    }

    #[test]
    fn more_copies_than_pixels_are_the_mean_of_all() {
        for times in [9, 100, 65_536] {
            let levels = trial(9, 6, times).levels(0);
            assert!(levels.iter().all(|level| *level == levels[0]), "{times} copies");
        }
    }
}
