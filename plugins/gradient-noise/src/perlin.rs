//! Perlin's gradient noise.
//!
//! Ken Perlin, "Improving Noise", SIGGRAPH 2002: at each corner of a square lattice there is a
//! gradient; between corners, the planes that the four of them span are interpolated along
//! 6t⁵ - 15t⁴ + 10t³. Corners wrap around, so the noise tiles.
//!
//! In a row of pixels, what a column of corners gives is a line in x: its slope and its height are
//! interpolated along y once a row. A row is written cell by cell: the pixels of a cell have the
//! same two lines, so they are computed side by side.

use ptlib_plugin::prelude::*;

use crate::{
    fractal::{Params, Segment, Sum},
    lattice::GradientRow,
};

/// The noise of one octave lies within ±√½; by this it fills ±1.
const SCALE: f32 = std::f32::consts::SQRT_2;

/// Perlin's gradient noise, prepared.
#[derive(Debug)]
pub struct Perlin(Sum);

impl Block for Perlin {
    type Params = Params;

    const ABOUT: About = About {
        id: c"gradient-noise.perlin",
        name: c"Perlin's gradient noise",
        category: c"noise",
        summary: c"Noise from gradients on a square lattice, in several octaves.",
        outputs: &[&output(c"image", Planes::Grey)],
        uses_seed: true,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(Sum::new(params, setup, 1)))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        self.0.write(call, write_row)
    }
}

/// What a column of corners gives in a row: a line over the distance from the column.
#[derive(Clone, Copy)]
struct Line {
    slope: f32,
    height: f32,
}

/// Writes an octave, -1..1, from a pixel on.
fn write_row(segment: &Segment<'_>, mut row: &mut [f32]) {
    let [across, down] = segment.layer.octave.cells;
    let [x, y] = segment.places();
    let rows = [y.cell % down, (y.cell + 1) % down].map(|row| segment.layer.gradients.row(row));
    let within = y.within();
    let faded = fade(within);
    let line = |column: u32| Line::of(rows, column % across, within, faded);
    let (mut column, mut part) = (x.cell, x.part);
    let mut lines = [line(column), line(column + 1)];
    while !row.is_empty() {
        // Pixels until the next column of corners.
        let here = ((x.unit - part).div_ceil(x.step) as usize).min(row.len());
        let (pixels, others) = row.split_at_mut(here);
        write_cell(lines, [part, x.step, x.unit], pixels);
        row = others;
        part += x.step * u32::try_from(here).unwrap_or(u32::MAX);
        let cells = part / x.unit;
        part -= cells * x.unit;
        column += cells;
        lines = [if cells == 1 { lines[1] } else { line(column) }, line(column + 1)];
    }
}

impl Line {
    #[inline(always)]
    fn of(rows: [GradientRow<'_>; 2], column: u32, t: f32, faded: f32) -> Self {
        let [above, below] = rows.map(|row| row.at(column));
        Self {
            slope: mix(above[0], below[0], faded),
            height: mix(above[1] * t, below[1] * (t - 1.0), faded),
        }
    }
}

/// Writes the pixels of a cell. The first lies `part` of `unit` parts to the right of the left
/// corners, each other one `step` parts further.
#[inline(always)]
fn write_cell([left, right]: [Line; 2], [part, step, unit]: [u32; 3], pixels: &mut [f32]) {
    // Signed numbers are faster to turn into floats.
    let [part, step, unit] = [part, step, unit].map(u32::cast_signed);
    let unit = unit as f32;
    for (pixel, number) in pixels.iter_mut().zip(0_i32..) {
        let t = (part + number * step) as f32 / unit;
        let from_left = left.slope * t + left.height;
        let from_right = right.slope * (t - 1.0) + right.height;
        *pixel = mix(from_left, from_right, fade(t)) * SCALE;
    }
}

#[inline(always)]
fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}
