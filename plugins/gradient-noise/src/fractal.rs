//! How octaves become a picture. An octave is a noise of -1..1; each has more cells than the one
//! before, and counts less.

use ptlib_plugin::{choice, math, params};

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
