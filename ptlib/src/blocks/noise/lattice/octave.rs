//! One octave: a lattice of random values, seen at the size of the image.

use std::marker::PhantomData;

use super::{
    Band,
    footprint::{BLOCK, Between, Footprint},
};
use crate::{block::prelude::*, value};

/// Rows are computed in parts of at most this many pixels, so that everything that a part needs
/// stays in the first-level cache and on the stack.
pub(super) const CHUNK: usize = 1024;

/// Lattice points that a part of a row lies between, at most. A pixel by itself lies between fewer.
const POINTS: usize = MOST + LANES;
const MOST: usize = CHUNK + 256;

/// The number of lattice points down the image.
pub(super) fn rows(frequency: u32, width: u32, height: u32) -> u32 {
    let rows = u64::from(frequency) * u64::from(height) / u64::from(width.max(1));
    u32::try_from(rows).unwrap_or(u32::MAX).max(1)
}

/// Memory to compute a part of a row in.
pub(super) struct Scratch {
    /// What [`Octave::write`] gives.
    pub(super) values: [f32; CHUNK + BLOCK],
    above: [f32; POINTS],
    below: [f32; POINTS],
}

impl Scratch {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { values: [0.0; CHUNK + BLOCK], above: [0.0; POINTS], below: [0.0; POINTS] }
    }
}

#[derive(Debug, Clone)]
pub(super) struct Octave {
    /// Lattice points across and down the image.
    columns: u32,
    rows: u32,
    amplitude: f32,
    /// The index of the first draw.
    first_draw: i32,
    across: Footprint,
    down: Footprint,
}

impl Octave {
    pub(super) fn new(
        band: Band,
        seed: i32,
        interpolation: value::Interpolation,
        cx: &Context<'_>,
    ) -> Self {
        let columns = band.frequency;
        let rows = rows(columns, cx.width, cx.height);
        let axis = Axis::new(columns, cx.width, interpolation);
        let across = Footprint::new(&axis, columns, cx.width, band.radius);
        let axis = Axis::new(rows, cx.height, interpolation);
        let down = Footprint::new(&axis, rows, cx.height, band.radius);
        let amplitude = convert::pixels(band.amplitude);
        let first_draw = seed.wrapping_mul(64);
        Self { columns, rows, amplitude, first_draw, across, down }
    }

    /// Writes how far pixels `x..x + len` of row `y` are from the middle grey, in levels, and
    /// unspecified numbers after them.
    #[inline(always)]
    pub(super) fn write<L: Levels>(&self, x: usize, y: u32, len: usize, scratch: &mut Scratch) {
        let Scratch { values, above, below } = scratch;
        let first = self.across.first(x);
        let last = self.across.first(x + len - 1);
        let points = convert::index(i64::from(last - first)) + self.across.followers() + 1;
        // A lattice finer than the pixels has too many points for a whole part; a pixel by itself
        // lies between few.
        let step = if points > MOST { 1 } else { len };
        for i in (0..len).step_by(step) {
            if L::EIGHT_BIT {
                self.write_levels::<L>(x + i, y, step, &mut values[i..], (above, below));
            } else {
                self.write_numbers(x + i, y, step, &mut values[i..], above);
            }
        }
    }

    /// As [`write`](Self::write), of real numbers: interpolates down the image first, lattice
    /// point by lattice point.
    #[inline(always)]
    fn write_numbers(
        &self,
        x: usize,
        y: u32,
        len: usize,
        out: &mut [f32],
        points: &mut [f32; POINTS],
    ) {
        let first = self.across.first(x);
        let followers = self.across.followers();
        let last = self.across.first(x + len - 1);
        let count = convert::index(i64::from(last - first)) + followers + 1;
        self.interpolate_down(y, first, count, points);
        let points = &*points;
        self.across
            .expand(x, len, out, |k| Line { base: points[k], step: points[k + 1] - points[k] });
        for n in 1..followers {
            self.across.add(x, len, n, out, |k| points[k + n + 1] - points[k]);
        }
    }

    /// Writes the values of row `y` at `count` lattice columns from `first` on, as distances from
    /// the middle grey, and unspecified numbers after them.
    #[inline(always)]
    fn interpolate_down(&self, y: u32, first: i32, count: usize, points: &mut [f32; POINTS]) {
        let y = y as usize;
        let row = self.down.first(y);
        let weights = (0..self.down.followers()).map(|n| self.down.weight(n, y));
        let rest = 1.0 - weights.clone().fold(0.0, |sum, weight| sum + weight);
        for (start, column) in self.pieces(first, count) {
            for (n, weight) in std::iter::once(rest).chain(weights.clone()).enumerate() {
                let draw = self.draw(row, n, column);
                let scale = weight * self.amplitude;
                let end = (start + self.columns as usize - column as usize).min(count);
                // Whole registers, the last one beyond the end: the next piece overwrites that.
                for at in (start..end).step_by(LANES) {
                    let values = &mut points[at..at + LANES];
                    let draw = draw.wrapping_add(offset(at - start));
                    let mut sums = [0.0; LANES];
                    for lane in 0..LANES {
                        let before = if n == 0 { 0.0 } else { values[lane] };
                        sums[lane] = before + scale * elias::noise(draw.wrapping_add(STEPS[lane]));
                    }
                    values.copy_from_slice(&sums);
                }
            }
        }
    }

    /// As [`write`](Self::write), truncating wherever the specification does: lattice values, both
    /// lattice rows across the image, and what lies between them.
    #[inline(always)]
    fn write_levels<L: Levels>(
        &self,
        x: usize,
        y: u32,
        len: usize,
        out: &mut [f32],
        (above, below): (&mut [f32; POINTS], &mut [f32; POINTS]),
    ) {
        let first = self.across.first(x);
        let points = convert::index(i64::from(self.across.first(x + len - 1) - first)) + 2;
        let row = self.down.first(y as usize);
        let down = self.down.weight(0, y as usize);
        self.lattice_levels(row, first, &mut above[..points]);
        self.lattice_levels(row + 1, first, &mut below[..points]);
        let (above, below) = (&*above, &*below);
        self.across.expand(x, len, out, |k| Cell::<L> {
            above: (above[k], above[k + 1] - above[k]),
            below: (below[k], below[k + 1] - below[k]),
            down,
            levels: PhantomData,
        });
    }

    /// Writes the levels of lattice row `row` at columns from `first` on.
    #[inline(always)]
    fn lattice_levels(&self, row: i32, first: i32, levels: &mut [f32]) {
        let amplitude = f64::from(self.amplitude);
        for (start, column) in self.pieces(first, levels.len()) {
            let draw = self.draw(row, 0, column);
            let end = (start + self.columns as usize - column as usize).min(levels.len());
            for (level, i) in levels[start..end].iter_mut().zip(0..) {
                let exact = 128.0 + amplitude * elias::noise64(draw.wrapping_add(i));
                *level = convert::single(exact.trunc());
            }
        }
    }

    /// `count` lattice columns from `first` on in pieces that do not pass the last column: the
    /// place where a piece starts, and its first column.
    #[inline(always)]
    fn pieces(&self, first: i32, count: usize) -> impl Iterator<Item = (usize, u32)> {
        let columns = self.columns as usize;
        let column = convert::wrap(i64::from(first), self.columns);
        let rest = (columns - column as usize..count).step_by(columns).map(|start| (start, 0));
        std::iter::once((0, column)).chain(rest)
    }

    /// The index of the draw for a lattice point `n` rows after `row`.
    #[inline(always)]
    fn draw(&self, row: i32, n: usize, column: u32) -> i32 {
        let row = convert::wrap(i64::from(row) + n as i64, self.rows);
        let place = u64::from(row) * u64::from(self.columns) + u64::from(column);
        self.first_draw.wrapping_add(convert::low_bits(place))
    }
}

const LANES: usize = 8;
const STEPS: [i32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];

/// A place as a distance between draws.
#[inline(always)]
fn offset(place: usize) -> i32 {
    convert::low_bits(place as u64)
}

/// A cell of a lattice row on real numbers: a straight line.
struct Line {
    base: f32,
    step: f32,
}

impl Between for Line {
    #[inline(always)]
    fn at(&self, weight: f32) -> f32 {
        self.base + self.step * weight
    }
}

/// A cell between two lattice rows on levels: the values at its left, and the steps to its right.
struct Cell<L> {
    above: (f32, f32),
    below: (f32, f32),
    /// The weight of the row below.
    down: f32,
    levels: PhantomData<L>,
}

impl<L: Levels> Between for Cell<L> {
    #[inline(always)]
    fn at(&self, weight: f32) -> f32 {
        let above = L::store_level(self.above.0 + self.above.1 * weight);
        let below = L::store_level(self.below.0 + self.below.1 * weight);
        L::store_level(above + (below - above) * self.down) - 128.0
    }
}
