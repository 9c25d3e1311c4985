//! Perlin's gradient noise.
//!
//! Ken Perlin, "Improving Noise", SIGGRAPH 2002: at each corner of a square lattice there is a
//! gradient; between corners, the planes that the four of them span are interpolated along
//! 6t⁵ - 15t⁴ + 10t³. Corners wrap around, so the noise tiles.
//!
//! In a row of pixels, what a column of corners gives is a line in x: its slope and its height are
//! interpolated along y once a row. A pixel then costs two lines and one interpolation.

use ptlib_plugin::prelude::*;

use crate::{
    fractal::{Octave, Params, octaves},
    lattice::Gradients,
};

/// The noise of one octave lies within ±√½; by this it fills ±1.
const SCALE: f32 = std::f32::consts::SQRT_2;

/// Perlin's gradient noise, prepared.
#[derive(Debug)]
pub struct Perlin {
    params: Params,
    octaves: Vec<(Octave, Gradients)>,
}

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
        let octaves = octaves(params, [setup.width(), setup.height()], 1).into_iter();
        let with_gradients = |octave: Octave| {
            let gradients = Gradients::new(setup.seed(), octave.number);
            (octave, gradients)
        };
        Ok(Self { params: params.clone(), octaves: octaves.map(with_gradients).collect() })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let mut out = call.output(0)?;
        let mut noise = vec![0.0; out.width() as usize];
        let size = [out.image_width(), out.image_height()];
        let (x, y) = (out.x(), out.y());
        for row in 0..out.height() {
            let target = out.row_mut(0, row);
            target.fill(0.0);
            for (octave, gradients) in &self.octaves {
                write_row(octave, gradients, [x, y + row], size, &mut noise);
                self.params.fractal.add(target, &noise, octave.weight);
            }
            self.params.fractal.finish(target);
        }
        Ok(())
    }
}

/// What a column of corners gives in a row: a line over the distance from the column.
#[derive(Clone, Copy)]
struct Line {
    slope: f32,
    height: f32,
}

/// Writes an octave, -1..1, from a pixel on.
fn write_row(
    octave: &Octave,
    gradients: &Gradients,
    at: [u32; 2],
    size: [u32; 2],
    row: &mut [f32],
) {
    let [across, down] = octave.cells;
    let (cell_y, t) = place(at[1], size[1], down);
    let fade_y = fade(t);
    let line = |column: u32| {
        let column = column % across;
        let [above, below] =
            [cell_y, (cell_y + 1) % down].map(|corner| gradients.at(column, corner));
        Line {
            slope: mix(above[0], below[0], fade_y),
            height: mix(above[1] * t, below[1] * (t - 1.0), fade_y),
        }
    };
    let mut column = place(at[0], size[0], across).0;
    let mut lines = [line(column), line(column + 1)];
    for (x, value) in (at[0]..).zip(row) {
        let (cell, t) = place(x, size[0], across);
        if cell != column {
            lines = [if cell == column + 1 { lines[1] } else { line(cell) }, line(cell + 1)];
            column = cell;
        }
        let [left, right] = lines;
        let left = left.slope * t + left.height;
        let right = right.slope * (t - 1.0) + right.height;
        *value = mix(left, right, fade(t)) * SCALE;
    }
}

/// The cell that the middle of a pixel lies in, and where in it, 0..1.
#[inline(always)]
fn place(pixel: u32, pixels: u32, cells: u32) -> (u32, f32) {
    // In whole numbers, so that it is exact: twice the pixel's middle, in cells.
    let (twice, unit) = ((2 * u64::from(pixel) + 1) * u64::from(cells), 2 * u64::from(pixels));
    let cell = twice / unit;
    let within = (twice - cell * unit) as f32 / unit as f32;
    (u32::try_from(cell).unwrap_or(u32::MAX), within)
}

#[inline(always)]
fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}
