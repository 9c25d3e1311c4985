//! How octaves become a picture. An octave is a noise of -1..1; each has more cells than the one
//! before, and counts less.

use ptlib_plugin::{BlockError, Call, Setup, choice, math, noise, params};

use crate::lattice::Gradients;

choice! {
    /// How octaves are added up.
    Fractal {
        /// As they are: clouds.
        Fbm = "fbm",
        /// By how near they are to 0, squared: sharp ridges.
        Ridged = "ridged",
        /// By how far they are from 0: billows with sharp valleys.
        Turbulence = "turbulence",
    }
}

params! {
    /// Parameters of both noises.
    Params {
        /// How many cells of the coarsest octave lie along the width.
        frequency: int [hard 1..=1024 soft 1..=32] = 6;
        /// How many noises are added up, each finer than the one before.
        octaves: int [hard 1..=12 soft 1..=8] = 5;
        /// How many times as many cells each octave has as the one before. A whole number, so that
        /// all of them tile.
        lacunarity: int [hard 1..=8 soft 2..=4] = 2;
        /// How much each octave counts, compared with the one before.
        gain: float [hard 0.0..=1.0 soft 0.2..=0.8] = 0.5;
        /// How octaves are added up.
        fractal: choice [Fractal] = Fractal::Fbm;
    }
}

/// The most cells along a side: finer octaves would be below all pixels, and are left out.
const MOST_CELLS: u32 = 1 << 16;

/// An octave to come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Octave {
    /// Cells along the width and the height.
    pub(crate) cells: [u32; 2],
    /// Which octave it is, for its random numbers.
    pub(crate) number: u32,
    /// How much it counts; all octaves together count 1.
    pub(crate) weight: f32,
}

/// The octaves of an image of that size. The cells are as square as whole numbers of them allow;
/// along the height their number is a multiple of `step`.
pub(crate) fn octaves(params: &Params, size: [u32; 2], step: u32) -> Vec<Octave> {
    let mut octaves = Vec::new();
    let mut across = params.frequency.unsigned_abs();
    let mut weight = 1.0;
    for number in 0..params.octaves.unsigned_abs() {
        if across > MOST_CELLS && number > 0 {
            break;
        }
        // Rounded to the nearest multiple.
        let [width, height] = size.map(|side| u64::from(side.max(1)));
        let unit = width * u64::from(step);
        let down = (u64::from(across) * height + unit / 2) / unit * u64::from(step);
        let down = u32::try_from(down).unwrap_or(MOST_CELLS).clamp(step, MOST_CELLS * step);
        octaves.push(Octave { cells: [across, down], number, weight: math::single(weight) });
        across = across.saturating_mul(params.lacunarity.unsigned_abs());
        weight *= params.gain;
    }
    let total: f32 = octaves.iter().map(|octave| octave.weight).sum();
    octaves.iter_mut().for_each(|octave| octave.weight /= total);
    octaves
}

/// Parts of a cell that octaves are shifted by whole numbers of.
const SHIFTS: u32 = 16;

/// An octave, its gradients, and how far it is shifted.
#[derive(Debug)]
pub(crate) struct Layer {
    pub(crate) octave: Octave,
    pub(crate) gradients: Gradients,
    /// Sixteenths of a cell. Without it all octaves would be 0 at the corners of the coarsest one.
    shift: [u32; 2],
}

/// A part of a row in an octave.
pub(crate) struct Segment<'a> {
    pub(crate) layer: &'a Layer,
    at: [u32; 2],
    size: [u32; 2],
}

/// Where the middle of a pixel lies in cells: in whole numbers, so that it is exact.
pub(crate) struct Place {
    /// The cell.
    pub(crate) cell: u32,
    /// How many parts of the cell lie before it.
    pub(crate) part: u32,
    /// Parts from pixel to pixel.
    pub(crate) step: u32,
    /// Parts of a cell: an even number.
    pub(crate) unit: u32,
}

impl Place {
    fn of(pixel: u32, pixels: u32, cells: u32, shift: u32) -> Self {
        let (step, unit) = (2 * SHIFTS * cells, 2 * SHIFTS * pixels);
        let parts =
            (2 * u64::from(pixel) + 1) * u64::from(step / 2) + u64::from(shift * 2 * pixels);
        let (cell, part) = (parts / u64::from(unit), parts % u64::from(unit));
        let small = |number| u32::try_from(number).unwrap_or(u32::MAX);
        Self { cell: small(cell), part: small(part), step, unit }
    }

    /// The part of the cell before it, 0..1.
    pub(crate) fn within(&self) -> f32 {
        self.part as f32 / self.unit as f32
    }
}

impl Segment<'_> {
    /// Where the first pixel lies along the width and the height.
    pub(crate) fn places(&self) -> [Place; 2] {
        let cells = self.layer.octave.cells;
        [0, 1].map(|axis| {
            Place::of(self.at[axis], self.size[axis], cells[axis], self.layer.shift[axis])
        })
    }
}

/// Octaves that are added up: what both blocks prepare.
#[derive(Debug)]
pub(crate) struct Sum {
    fractal: Fractal,
    layers: Vec<Layer>,
}

impl Sum {
    /// Of a lattice whose rows wrap around after a multiple of `step`.
    pub(crate) fn new(params: &Params, setup: &Setup<'_>, step: u32) -> Self {
        let octaves = octaves(params, [setup.width(), setup.height()], step).into_iter();
        let layer = |octave: Octave| Layer {
            octave,
            gradients: Gradients::new(setup.seed(), octave.number),
            shift: [1, 2].map(|axis| noise::hash(setup.seed(), octave.number, axis, 0) % SHIFTS),
        };
        Self { fractal: params.fractal, layers: octaves.map(layer).collect() }
    }

    /// Writes the output, row by row; `write_row` writes an octave, -1..1.
    pub(crate) fn write(
        &self,
        call: &mut Call<'_>,
        write_row: impl Fn(&Segment<'_>, &mut [f32]),
    ) -> Result<(), BlockError> {
        let mut out = call.output(0)?;
        let mut noise = vec![0.0; out.width() as usize];
        let size = [out.image_width(), out.image_height()];
        let (x, y) = (out.x(), out.y());
        for row in 0..out.height() {
            let target = out.row_mut(0, row);
            target.fill(0.0);
            for layer in &self.layers {
                write_row(&Segment { layer, at: [x, y + row], size }, &mut noise);
                self.fractal.add(target, &noise, layer.octave.weight);
            }
            self.fractal.finish(target);
        }
        Ok(())
    }
}

impl Fractal {
    /// Adds an octave, -1..1, to a row.
    pub(crate) fn add(self, row: &mut [f32], octave: &[f32], weight: f32) {
        let pairs = row.iter_mut().zip(octave);
        match self {
            Self::Fbm => pairs.for_each(|(sum, noise)| *sum += noise * weight),
            Self::Ridged => pairs.for_each(|(sum, noise)| {
                let ridge = 1.0 - noise.abs();
                *sum += ridge * ridge * weight;
            }),
            Self::Turbulence => pairs.for_each(|(sum, noise)| *sum += noise.abs() * weight),
        }
    }

    /// Brings the sum of all octaves to 0..1.
    pub(crate) fn finish(self, row: &mut [f32]) {
        if self == Self::Fbm {
            row.iter_mut().for_each(|sum| *sum = *sum * 0.5 + 0.5);
        }
    }
}
