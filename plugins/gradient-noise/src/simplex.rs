//! Simplex noise.
//!
//! Perlin's simplex noise ("Noise hardware", SIGGRAPH 2001 course notes) on the grid of Gustavson
//! and McEwan ("Tiling simplex noise and flow noise in two and three dimensions", JCGT 11(1),
//! 2022): triangles of width and height 1, whose rows are shifted by a half. Each corner gives a
//! gradient that fades within a circle; three corners matter at a place. An even number of rows
//! makes the grid wrap around.
//!
//! A row of pixels is written triangle by triangle: the pixels of one have the same three corners,
//! so they are computed side by side.

use ptlib_plugin::prelude::*;

use crate::{
    fractal::{Params, Segment, Sum},
    lattice::GradientRow,
};

/// Squared radius of the circle that a corner matters in.
const RADIUS: f32 = 0.8;

/// The noise of one octave then fills ±1 (Gustavson and McEwan).
const SCALE: f32 = 10.9;

/// Simplex noise, prepared.
#[derive(Debug)]
pub struct Simplex(Sum);

impl Block for Simplex {
    type Params = Params;

    const ABOUT: About = About {
        id: c"gradient-noise.simplex",
        name: c"Simplex noise",
        category: c"noise",
        summary: c"Noise from gradients on a grid of triangles, in several octaves.",
        outputs: &[&output(c"image", Planes::Grey)],
        uses_seed: true,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(Sum::new(params, setup, 2)))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        self.0.write(call, write_row)
    }
}

/// Writes an octave, -1..1, from a pixel on.
fn write_row(segment: &Segment<'_>, mut row: &mut [f32]) {
    let [x, y] = segment.places();
    let unit = i64::from(x.unit);
    // On the skewed grid, triangles are halves of squares: the right half of each starts where the
    // part of x is that of y. In whole parts of a cell, so that every pixel knows its triangle.
    let within = whole(f64::from(y.part) * unit as f64 / f64::from(y.unit));
    let skew = (i64::from(y.cell) * unit + within) / 2;
    let rows = [y.cell, y.cell + 1].map(|number| Corners::of(segment, number));
    let mut at = i64::from(x.cell) * unit + i64::from(x.part);
    while !row.is_empty() {
        let column = (at + skew).div_euclid(unit);
        let part = at + skew - column * unit;
        let (second, end) = if part >= within {
            (rows[0].gradient(column + 1), unit)
        } else {
            (rows[1].gradient(column), within)
        };
        let here = (end - part + i64::from(x.step) - 1) / i64::from(x.step);
        let here = usize::try_from(here).unwrap_or(row.len()).min(row.len());
        let triangle = Triangle {
            gradients: [rows[0].gradient(column), second, rows[1].gradient(column + 1)],
            is_right: part >= within,
            below: y.within(),
        };
        // How far the first pixel lies to the right of the first corner.
        let from = at - column * unit + i64::from(y.cell) * unit / 2;
        let (pixels, others) = row.split_at_mut(here);
        triangle.write([small(from), x.step.cast_signed(), x.unit.cast_signed()], pixels);
        row = others;
        at += i64::from(x.step) * here as i64;
    }
}

/// A row of corners.
struct Corners<'a> {
    gradients: GradientRow<'a>,
    across: i64,
    /// Columns that it is turned by: going over all rows moves them by half of their number.
    turned: i64,
}

impl<'a> Corners<'a> {
    fn of(segment: &Segment<'a>, number: u32) -> Self {
        let [across, down] = segment.layer.octave.cells;
        Self {
            gradients: segment.layer.gradients.row(number % down),
            across: i64::from(across),
            turned: i64::from(number / down) * i64::from(down / 2),
        }
    }

    #[inline(always)]
    fn gradient(&self, column: i64) -> [f32; 2] {
        let column = (column - self.turned).rem_euclid(self.across);
        self.gradients.at(u32::try_from(column).unwrap_or_default())
    }
}

/// A triangle that a row of pixels crosses.
struct Triangle {
    /// Of its upper left corner (or the upper one), the second, and the lower right one.
    gradients: [[f32; 2]; 3],
    /// Whether its second corner lies at the right of the first; if not, below and to the left.
    is_right: bool,
    /// How far the pixels lie below the first corner.
    below: f32,
}

impl Triangle {
    /// Writes pixels of it. The first lies `from` of `unit` parts to the right of the first corner,
    /// each other one `step` parts further.
    #[inline(always)]
    fn write(&self, [from, step, unit]: [i32; 3], pixels: &mut [f32]) {
        let unit = unit as f32;
        let second = if self.is_right { [1.0, 0.0] } else { [-0.5, 1.0] };
        let corners = [[0.0, 0.0], second, [0.5, 1.0]];
        for (pixel, number) in pixels.iter_mut().zip(0_i32..) {
            let at = (from + number * step) as f32 / unit;
            let mut sum = 0.0;
            for ([x, y], [gx, gy]) in corners.into_iter().zip(self.gradients) {
                let distance = [at - x, self.below - y];
                let near = RADIUS - distance[0] * distance[0] - distance[1] * distance[1];
                let near = if near > 0.0 { near } else { 0.0 };
                let fading = near * near;
                sum += fading * fading * (gx * distance[0] + gy * distance[1]);
            }
            *pixel = sum * SCALE;
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a whole number, and a small one")]
fn whole(number: f64) -> i64 {
    number as i64
}

fn small(parts: i64) -> i32 {
    i32::try_from(parts).unwrap_or(i32::MAX)
}
