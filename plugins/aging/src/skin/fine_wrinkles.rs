//! A small pattern, repeated over the image.
//!
//! The input is a tile; the output shows it `repeat x` times across and `repeat y` times down. All
//! images of a graph have the same size, so a pixel shows exactly `repeat x` × `repeat y` pixels of
//! the tile: their mean, which needs no filter and leaves no seam. Means come from sums over all
//! rectangles that begin in the corner (F. C. Crow, "Summed-Area Tables for Texture Mapping",
//! SIGGRAPH 1984): a mean takes four reads, however many pixels it is of.

use ptlib_plugin::{Image, prelude::*};

const TILE: usize = 0;

/// Rows between two questions whether to stop.
const ROWS: u32 = 16;

params! {
    /// Parameters of [`FineWrinkles`].
    Params {
        /// How many times the tile fits into the width of the image.
        repeat_x "repeat x": int [hard 1..=1024 soft 1..=64] = 8;
        /// How many times the tile fits into the height of the image.
        repeat_y "repeat y": int [hard 1..=1024 soft 1..=64] = 8;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct FineWrinkles {
    repeats: [usize; 2],
    sums: Sums,
}

impl Block for FineWrinkles {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.fine wrinkles",
        name: c"Fine wrinkles",
        category: c"skin",
        summary: c"Repeats a height map as a small pattern, such as the pores of skin.",
        inputs: &[&input(c"tile", Kind::Image)
            .anywhere()
            .doc(c"What is repeated: heights, in the red channel. It should wrap around.")],
        outputs: &[&output(c"image", Planes::Grey).doc(c"The tile, repeated.")],
        shape: Shape::Gather,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        let tile = setup.image(TILE).ok_or_else(|| BlockError::unconnected("needs a tile"))?;
        let repeats = [params.repeat_x, params.repeat_y].map(|n| n.unsigned_abs().max(1) as usize);
        let sums = if repeats == [1, 1] { Sums::default() } else { Sums::of(tile, setup)? };
        Ok(Self { repeats, sums })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let tile = call.image(TILE)?;
        let mut out = call.output(0)?;
        let (x, y) = (out.x() as usize, out.y());
        for row in 0..out.height() {
            let to = out.row_mut(0, row);
            if self.repeats == [1, 1] {
                // The mean of one pixel is that pixel, without the rounding of sums.
                to.copy_from_slice(&tile.row(0, y + row)[x..x + to.len()]);
            } else {
                self.write((x, (y + row) as usize), to);
            }
        }
        Ok(())
    }

    fn memory(_: &Params, width: u32, height: u32) -> u64 {
        (u64::from(width) + 1) * (u64::from(height) + 1) * size_of::<f64>() as u64
    }
}

impl FineWrinkles {
    /// Writes a part of a row from a pixel on.
    fn write(&self, (x, y): (usize, usize), to: &mut [f32]) {
        let rows = Circle::new(self.repeats[1], self.sums.height).spans(y).span();
        let [above, below, all] =
            [rows.start, rows.end, self.sums.height].map(|row| self.sums.row(row));
        if rows.turns == 0.0 {
            self.write_means(x, to, |column| below[column] - above[column]);
        } else {
            let turns = rows.turns;
            self.write_means(x, to, |column| below[column] - above[column] + turns * all[column]);
        }
    }

    /// Writes means, of the sums that a band of rows has to the left of each column.
    #[inline(always)]
    fn write_means(&self, x: usize, to: &mut [f32], left_of: impl Fn(usize) -> f64) {
        let ([across, down], width) = (self.repeats, self.sums.width);
        let (share, all) = (1.0 / (across * down) as f64, left_of(width));
        let mut spans = Circle::new(across, width).spans(x);
        for pixel in to {
            let columns = spans.span();
            spans.go_on();
            let sum = left_of(columns.end) - left_of(columns.start) + columns.turns * all;
            *pixel = math::single((sum * share).clamp(0.0, 1.0));
        }
    }
}

/// What a pixel shows of a line that repeats: from one place to another after some whole turns.
struct Span {
    start: usize,
    end: usize,
    turns: f64,
}

/// A line that repeats, of which each pixel shows equally many places.
#[derive(Clone, Copy)]
struct Circle {
    repeats: usize,
    length: usize,
    /// Whole turns from the first place of a pixel to its last one, and the places beyond.
    turns: usize,
    rest: usize,
}

impl Circle {
    fn new(repeats: usize, length: usize) -> Self {
        let last = repeats - 1;
        Self { repeats, length, turns: last / length, rest: last % length }
    }

    fn spans(self, pixel: usize) -> Spans {
        let start = pixel * self.repeats % self.length;
        Spans { circle: self, step: self.repeats % self.length, start }
    }
}

/// The spans of one pixel after the other, without a division.
struct Spans {
    circle: Circle,
    step: usize,
    start: usize,
}

impl Spans {
    #[inline(always)]
    fn span(&self) -> Span {
        let Circle { length, turns, rest, .. } = self.circle;
        let last = self.start + rest;
        // The end of the line is not its start yet, so that whole turns are rare.
        let crosses = last >= length;
        let end = if crosses { last - length } else { last } + 1;
        Span { start: self.start, end, turns: (turns + usize::from(crosses)) as f64 }
    }

    #[inline(always)]
    fn go_on(&mut self) {
        let next = self.start + self.step;
        self.start = if next >= self.circle.length { next - self.circle.length } else { next };
    }
}

/// The sums of all rectangles of an image that begin in its left upper corner: one row and column
/// more than the image has.
#[derive(Debug, Default)]
struct Sums {
    width: usize,
    height: usize,
    sums: Vec<f64>,
}

impl Sums {
    fn of(image: Image<'_>, setup: &Setup<'_>) -> Result<Self, BlockError> {
        let [width, height] = [image.width() as usize, image.height() as usize];
        let none = || BlockError::no_memory("there is no memory for the sums of the tile");
        let len = (width + 1).checked_mul(height + 1).ok_or_else(none)?;
        let mut sums = Vec::new();
        sums.try_reserve_exact(len).map_err(|_| none())?;
        sums.resize(len, 0.0);
        let mut rows = sums.chunks_exact_mut(width + 1);
        let mut above = rows.next().unwrap_or_default();
        for (row, y) in rows.zip(0..) {
            if y % ROWS == 0 {
                setup.check()?;
            }
            let mut sum = 0.0;
            let pairs = row[1..].iter_mut().zip(&above[1..]).zip(image.row(0, y));
            for ((own, above), value) in pairs {
                sum += f64::from(*value);
                *own = above + sum;
            }
            above = row;
        }
        Ok(Self { width, height, sums })
    }

    /// The sums of all that lies above a row.
    #[inline(always)]
    fn row(&self, row: usize) -> &[f64] {
        &self.sums[row * (self.width + 1)..][..=self.width]
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{Image, params::ParamValue};

    use super::super::trial;

    const BLOCK: &str = "aging.fine wrinkles";

    fn repeats(x: i32, y: i32) -> [(&'static str, ParamValue); 2] {
        [("repeat x", ParamValue::Int(x)), ("repeat y", ParamValue::Int(y))]
    }

    fn grains(size: (u32, u32)) -> Image {
        trial::picture(size, 1, |_, x, y| trial::grain(x, y))
    }

    #[test]
    fn pixels_are_the_means_of_what_they_cover() {
        for size in trial::SIZES {
            for (across, down) in [(1, 2), (3, 1), (8, 8), (40, 90), (1024, 1024)] {
                let tile = grains(size);
                let image = trial::made(BLOCK, &[Some(&tile)], &repeats(across, down));
                for (x, y) in [(0, 0), (size.0 / 2, size.1 / 2), (size.0 - 1, size.1 - 1)] {
                    let [from_x, from_y] = [x * across.unsigned_abs(), y * down.unsigned_abs()];
                    let mut sum = 0.0_f64;
                    for row in from_y..from_y + down.unsigned_abs() {
                        let row = tile.row(0, row % size.1);
                        let columns = from_x..from_x + across.unsigned_abs();
                        sum += columns
                            .map(|column| f64::from(row[(column % size.0) as usize]))
                            .sum::<f64>();
                    }
                    let mean = sum / f64::from(across) / f64::from(down);
                    let found = f64::from(image.row(0, y)[x as usize]);
                    assert!((found - mean).abs() < 1e-6, "{size:?}, {x} {y}: {found}, {mean}");
                }
            }
        }
    }

    #[test]
    fn one_repeat_is_the_tile_bit_for_bit() {
        let tile = grains((37, 20));
        let image = trial::made(BLOCK, &[Some(&tile)], &repeats(1, 1));
        assert_eq!(trial::bits(&image), trial::bits(&tile));
    }

    #[test]
    fn it_repeats_without_a_seam() {
        let tile =
            trial::picture((96, 64), 1, |_, x, y| trial::wave(x as f32 / 96.0 + y as f32 / 64.0));
        let image = trial::made(BLOCK, &[Some(&tile)], &repeats(6, 4));
        for y in 0..64_u32 {
            for x in 0..80_usize {
                let (row, below) = (image.row(0, y), image.row(0, (y + 16) % 64));
                assert!((row[x] - row[x + 16]).abs() < 1e-6);
                assert!((row[x] - below[x]).abs() < 1e-6);
            }
        }
        let [across, inside] = trial::steps(&image);
        assert!(across <= inside * 1.001, "{across} against {inside}");
    }

    #[test]
    fn threads_and_strips_do_not_matter_at_any_size() {
        for size in trial::SIZES {
            let tile = grains(size);
            trial::same_on_all_threads(BLOCK, &[Some(&tile)], &repeats(5, 9));
        }
    }
}
