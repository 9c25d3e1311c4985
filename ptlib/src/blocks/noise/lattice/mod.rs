//! Lattice value noise: what the specification calls NOISE (2.0, 2.5). Other blocks build on it.
//!
//! An octave is a lattice of random values, resampled to the image; octaves are summed and clamped
//! one after the other. A lattice is never stored: its values come from a stateless hash, so a row
//! draws the few that it lies between, interpolates them downwards once, and then runs along the
//! pixels of each cell with precomputed weights ([`octave`]).
//!
//! Low octaves may be blurred by a box. On real numbers the box of an interpolation is an
//! interpolation with blurred weights ([`footprint`]), so it costs nothing. 8-bit levels are
//! truncated in between, so there the blurred octaves are made as an image first ([`blurred`]).

mod blurred;
mod footprint;
mod octave;

use octave::{CHUNK, Octave, Scratch};

use crate::{block::prelude::*, value};

/// What noise to make.
#[derive(Debug, Clone, Copy)]
pub(in crate::blocks) struct Settings {
    /// How far the first octave may leave the middle grey, in levels; 0..=255.
    pub(in crate::blocks) amplitude: u32,
    /// Lattice points of the first octave across the image, at least 1.
    pub(in crate::blocks) frequency: u32,
    /// The most octaves.
    pub(in crate::blocks) max_octaves: Option<u32>,
    /// How values between lattice points are found.
    pub(in crate::blocks) interpolation: value::Interpolation,
    /// Whether low octaves are blurred.
    pub(in crate::blocks) smooth: bool,
}

/// What distinguishes an octave.
#[derive(Debug, Clone, Copy)]
struct Band {
    /// Lattice points across the image.
    frequency: u32,
    /// How far values may leave the middle grey, in levels.
    amplitude: u32,
    /// The radius of the box that blurs it, in pixels.
    radius: u32,
}

impl Settings {
    fn bands(&self, width: u32, height: u32) -> impl Iterator<Item = Band> {
        let (smooth, max_octaves) = (self.smooth, self.max_octaves.unwrap_or(u32::MAX));
        // Amplitudes are below 2⁸ and frequencies that matter at most 2¹⁶, so that neither shift
        // leaves its range before the octaves end.
        let (amplitude, frequency) = (self.amplitude, u64::from(self.frequency));
        (0..max_octaves.min(16))
            .map(move |k| (amplitude >> k, frequency << k))
            .take_while(move |(amplitude, frequency)| {
                *amplitude > 0 && *frequency <= u64::from(width.max(height))
            })
            .map(move |(amplitude, frequency)| {
                let frequency = u32::try_from(frequency).unwrap_or(u32::MAX);
                let radius = if smooth { 10_u32.saturating_sub(frequency) } else { 0 };
                Band { frequency, amplitude: amplitude.min(127), radius }
            })
    }

    /// The most memory that [`LatticeNoise::new`] takes, in bytes.
    pub(in crate::blocks) fn scratch_bytes(&self, width: u32, height: u32) -> u64 {
        let octaves = self.bands(width, height);
        let footprints = octaves.map(|band| {
            footprint::bytes_of(band.frequency, width, band.radius)
                + footprint::bytes_of(octave::rows(band.frequency, width, height), height, 9)
        });
        let blurs = self.bands(width, height).any(|band| band.radius > 0);
        footprints.sum::<u64>() + if blurs { blurred::bytes_of(width, height) } else { 0 }
    }
}

/// Noise that is ready to write rows.
pub(in crate::blocks) struct LatticeNoise {
    /// The octaves that rows compute, coarsest first.
    octaves: Vec<Octave>,
    /// The levels that rows start from, if some octaves were computed as an image.
    start: Option<Vec<u8>>,
}

/// A level times this is its value.
pub(in crate::blocks) const VALUE_OF_LEVEL: f32 = 1.0 / 255.0;

/// The level of a picture without any noise.
const MIDDLE: u8 = 128;

impl LatticeNoise {
    pub(in crate::blocks) fn new<L: Levels>(
        settings: &Settings,
        seed: i32,
        cx: &Context<'_>,
    ) -> Result<Self, Error> {
        let mut noise = Self { octaves: Vec::new(), start: None };
        // Each octave has its own draws (specification, appendix A).
        for (band, k) in settings.bands(cx.width, cx.height).zip(0..) {
            cx.check()?;
            let seed = seed.wrapping_add(80_124_i32.wrapping_mul(k));
            let blurs_levels = L::EIGHT_BIT && band.radius > 0;
            let radius = if blurs_levels { 0 } else { band.radius };
            let octave = Octave::new(Band { radius, ..band }, seed, settings.interpolation, cx);
            if blurs_levels {
                let pixels = cx.width as usize * cx.height as usize;
                let start = noise.start.get_or_insert_with(|| vec![MIDDLE; pixels]);
                blurred::add(&octave, band.radius, start, cx)?;
            } else {
                noise.octaves.push(octave);
            }
        }
        Ok(noise)
    }

    /// Writes a part of a row, 0..1.
    #[inline(always)]
    pub(in crate::blocks) fn write_row<L: Levels>(&self, cx: &RowContext<'_>, out: &mut [f32]) {
        self.write_levels::<L>(cx, out);
        for value in out {
            *value *= VALUE_OF_LEVEL;
        }
    }

    /// Writes a part of a row in levels, 0..255.
    #[inline(always)]
    pub(in crate::blocks) fn write_levels<L: Levels>(&self, cx: &RowContext<'_>, out: &mut [f32]) {
        let mut scratch = Scratch::new();
        let mut x = cx.x as usize;
        for out in out.chunks_mut(CHUNK) {
            match &self.start {
                Some(start) => {
                    let start = &start[cx.y as usize * cx.width as usize + x..];
                    for (level, start) in out.iter_mut().zip(start) {
                        *level = f32::from(*start);
                    }
                }
                None => out.fill(f32::from(MIDDLE)),
            }
            for octave in &self.octaves {
                octave.write::<L>(x, cx.y, out.len(), &mut scratch);
                for (level, value) in out.iter_mut().zip(&scratch.values) {
                    *level = (*level + value).clamp(0.0, 255.0);
                }
            }
            x += out.len();
        }
    }
}
