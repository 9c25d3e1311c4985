//! Simplex noise.
//!
//! Perlin's simplex noise ("Noise hardware", SIGGRAPH 2001 course notes) on the grid of Gustavson
//! and McEwan ("Tiling simplex noise and flow noise in two and three dimensions", JCGT 11(1),
//! 2022): triangles of width and height 1, whose rows are shifted by a half. Each corner gives a
//! gradient that fades within a circle; three corners matter at a place. An even number of rows
//! makes the grid wrap around.

use ptlib_plugin::prelude::*;

use crate::{
    fractal::{Octave, Params, octaves},
    lattice::Gradients,
};

/// Squared radius of the circle that a corner matters in.
const RADIUS: f32 = 0.8;

/// The noise of one octave then fills ±1 (Gustavson and McEwan).
const SCALE: f32 = 10.9;

/// Simplex noise, prepared.
#[derive(Debug)]
pub struct Simplex {
    params: Params,
    octaves: Vec<(Octave, Gradients)>,
}

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
        let octaves = octaves(params, [setup.width(), setup.height()], 2).into_iter();
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
                let at_y = place(y + row, size[1], octave.cells[1]);
                for (x, value) in (x..).zip(noise.iter_mut()) {
                    let at = [place(x, size[0], octave.cells[0]), at_y];
                    *value = value_at(gradients, octave.cells, at);
                }
                self.params.fractal.add(target, &noise, octave.weight);
            }
            self.params.fractal.finish(target);
        }
        Ok(())
    }
}

/// The middle of a pixel, in cells.
#[inline(always)]
fn place(pixel: u32, pixels: u32, cells: u32) -> f32 {
    let (twice, unit) = ((2 * u64::from(pixel) + 1) * u64::from(cells), 2 * u64::from(pixels));
    math::single(twice as f64 / unit as f64)
}

/// The noise at a place, -1..1.
#[inline(always)]
fn value_at(gradients: &Gradients, cells: [u32; 2], at: [f32; 2]) -> f32 {
    // On the skewed grid, triangles are halves of squares.
    let skewed = [at[0] + at[1] * 0.5, at[1]];
    let corner = skewed.map(f32::floor);
    let within = [skewed[0] - corner[0], skewed[1] - corner[1]];
    let is_right = within[0] >= within[1];
    let second = if is_right { [1.0, 0.0] } else { [0.0, 1.0] };
    let corners = [[0.0, 0.0], second, [1.0, 1.0]];
    let mut sum = 0.0;
    for [x, y] in corners.map(|[x, y]| [corner[0] + x, corner[1] + y]) {
        let distance = [at[0] - (x - y * 0.5), at[1] - y];
        let near = RADIUS - distance[0] * distance[0] - distance[1] * distance[1];
        if near > 0.0 {
            let [gx, gy] = gradients.at(wrapped(x, y, cells), wrapped_row(y, cells[1]));
            let fading = near * near;
            sum += fading * fading * (gx * distance[0] + gy * distance[1]);
        }
    }
    sum * SCALE
}

/// The column of a corner, wrapped around: going over all rows moves it by half of their number.
#[inline(always)]
fn wrapped(x: f32, y: f32, cells: [u32; 2]) -> u32 {
    let (x, y, down) = (whole(x), whole(y), i64::from(cells[1]));
    let turns = y.div_euclid(down);
    let column = (x - turns * (down / 2)).rem_euclid(i64::from(cells[0]));
    u32::try_from(column).unwrap_or_default()
}

#[inline(always)]
fn wrapped_row(y: f32, down: u32) -> u32 {
    u32::try_from(whole(y).rem_euclid(i64::from(down))).unwrap_or_default()
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a whole number, and a small one")]
fn whole(number: f32) -> i64 {
    number as i64
}
