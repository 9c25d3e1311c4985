//! The noise that steers lines of particles: "turtle noise" of specification 2.45.
//!
//! A particle turns at every level of the noise, so one level in one pixel leads it elsewhere. In
//! 8-bit precision the noise is therefore made literally as the specification says (2.0, 2.5), in
//! double precision and without the slack that keeps levels from being lost: some are lost, and
//! they have to be the same ones. On real numbers it is the noise that other blocks make.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::super::super::noise::lattice::{LatticeNoise, Settings};
use crate::block::prelude::*;
use box_sum::LevelBox;

/// The seed, for every turtle (specification, appendix A).
const SEED: i32 = 4;

/// How far the first octave may leave the middle grey.
const AMPLITUDE: u8 = 128;

/// Rows of pixels that one task makes.
const ROWS: usize = 16;

/// The most memory that [`steering`] takes, in bytes, its result included.
pub(super) fn bytes_of(intensity: f64, width: u32, height: u32) -> u64 {
    let lattices = settings(intensity).scratch_bytes(width, height);
    // The result, the sums of an octave, and a lattice about as fine.
    u64::from(width) * u64::from(height) * 8 + lattices
}

/// The noise at that intensity 0..1, row by row.
pub(super) fn steering<L: Levels>(intensity: f64, cx: &Context<'_>) -> Result<Vec<f32>, Error> {
    let settings = settings(intensity);
    let slope = elementary::tan64(intensity * FRAC_PI_4);
    let mut noise = vec![f32::from(AMPLITUDE); cx.width as usize * cx.height as usize];
    if L::EIGHT_BIT {
        for k in 0.. {
            let Some(octave) = Octave::new(settings.frequency, k, cx) else { break };
            octave.add_to(&mut noise, cx)?;
        }
    } else {
        let lattice = LatticeNoise::new::<L>(&settings, SEED, cx)?;
        rows(&mut noise, cx, |y, row| {
            let place = cx.row(y);
            lattice.write_row::<L>(&place, row);
            row.iter_mut().for_each(|value| *value *= 255.0);
        })?;
    }
    rows(&mut noise, cx, |_, row| {
        row.iter_mut().for_each(|level| *level = contrasted::<L>(*level, slope));
    })?;
    Ok(noise)
}

fn settings(intensity: f64) -> Settings {
    let frequency = convert::truncate64(12.0 * intensity + 3.0);
    Settings {
        amplitude: u32::from(AMPLITUDE),
        frequency: u32::try_from(frequency).unwrap_or(1),
        max_octaves: None,
        interpolation: Interpolation::Sine.into(),
        smooth: true,
    }
}

/// A level with more contrast, as in specification 2.37, as a value 0..1. At slope 0 everything is
/// the middle grey.
fn contrasted<L: Levels>(level: f32, slope: f64) -> f32 {
    let value = ((f64::from(level) / 255.0 - 0.5) * slope + 0.5).clamp(0.0, 1.0);
    let level = if L::EIGHT_BIT { (value * 255.0).trunc() } else { value * 255.0 };
    levels::from_level(convert::single(level))
}

/// Runs `change` for all rows of an image, with their numbers.
fn rows<T: Send>(
    image: &mut [T],
    cx: &Context<'_>,
    change: impl Fn(u32, &mut [T]) + Sync,
) -> Result<(), Error> {
    let width = cx.width as usize;
    cx.parallel_pieces(image, ROWS * width, |piece, rows| {
        for (row, y) in rows.chunks_exact_mut(width).zip(piece * ROWS..) {
            cx.check()?;
            change(u32::try_from(y).unwrap_or(u32::MAX), row);
        }
        Ok(())
    })
}

/// An octave in 8-bit levels.
struct Octave {
    lattice: Vec<u8>,
    columns: u32,
    rows: u32,
    /// Of the box that blurs it.
    radius: u32,
}

/// Between which two points of a lattice a pixel lies, and the weight of the second.
#[derive(Debug, Clone, Copy)]
struct Between(usize, usize, f64);

impl Between {
    fn new(pixel: u32, pixels: u32, points: u32) -> Self {
        let place = f64::from(pixel) / f64::from(pixels) * f64::from(points);
        let first = place.trunc();
        let second = convert::wrap(convert::truncate64(first) + 1, points);
        let weight = elementary::sin64((place - first) * FRAC_PI_2);
        Self(convert::index(convert::truncate64(first)), second as usize, weight)
    }

    /// The level between two. Rounded as the original rounds: between equal levels it may be lower.
    #[inline]
    fn level(self, a: u8, b: u8) -> u8 {
        let level = f64::from(a) * (1.0 - self.2) + f64::from(b) * self.2;
        convert::truncate64_to_i32(level).to_le_bytes()[0]
    }
}

impl Octave {
    /// Octave number `k`, unless it leaves no trace.
    fn new(frequency: u32, k: u8, cx: &Context<'_>) -> Option<Self> {
        let amplitude = AMPLITUDE.checked_shr(u32::from(k)).filter(|amplitude| *amplitude > 0)?;
        let columns = frequency << k;
        if columns > cx.width.max(cx.height) {
            return None;
        }
        let rows = u64::from(columns) * u64::from(cx.height) / u64::from(cx.width);
        let rows = u32::try_from(rows.max(1)).ok()?;
        let seed = SEED.wrapping_add(80_124_i32.wrapping_mul(i32::from(k)));
        let first = seed.wrapping_mul(64);
        let amplitude = f64::from(amplitude.min(127));
        let lattice = (0..u64::from(columns) * u64::from(rows)).map(|i| {
            let noise = elias::noise64(first.wrapping_add(convert::low_bits(i)));
            convert::truncate64_to_i32(128.0 + amplitude * noise).to_le_bytes()[0]
        });
        let radius = 10_u32.saturating_sub(columns);
        Some(Self { lattice: lattice.collect(), columns, rows, radius })
    }

    /// Adds the octave to levels, which stay in 0..=255.
    fn add_to(&self, noise: &mut [f32], cx: &Context<'_>) -> Result<(), Error> {
        let columns = self.columns as usize;
        let across: Vec<_> =
            (0..cx.width).map(|x| Between::new(x, cx.width, self.columns)).collect();
        let boxes = LevelBox::new(self.radius, cx.width);
        let mut sums = vec![0; noise.len()];
        rows(&mut sums, cx, |y, sums| {
            let down = Between::new(y, cx.height, self.rows);
            let row = |row: usize| &self.lattice[row * columns..][..columns];
            let (above, below) = (row(down.0), row(down.1));
            let level = |across: &Between| {
                let level = |row: &[u8]| across.level(row[across.0], row[across.1]);
                down.level(level(above), level(below))
            };
            boxes.across(&across.iter().map(level).collect::<Vec<_>>(), sums);
        })?;
        cx.parallel_pieces(noise, ROWS * cx.width as usize, |piece, levels| {
            cx.check()?;
            boxes.down(&sums, piece * ROWS, levels, |level, mean| {
                *level = (*level + convert::level(mean) - 128.0).clamp(0.0, 255.0);
            });
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        block::{Registry, testing::Trial},
        math::levels::{Continuous, EightBit},
    };

    /// The same noise from the block that makes it, without contrast.
    fn perlin(frequency: i32, size: (u32, u32)) -> Trial {
        let registry = Registry::builtin();
        Trial::of(registry.find("perlin noise").unwrap())
            .size(size.0, size.1)
            .seed(4)
            .int("amplitude", 128)
            .int("frequency", frequency)
            .choice("interpolation", 2)
    }

    #[test]
    fn it_is_the_noise_of_other_blocks_but_for_lost_levels() {
        for (intensity, frequency, size) in
            [(0.0, 3, (64, 48)), (0.3, 6, (50, 70)), (1.0, 15, (64, 64)), (1.0, 15, (9, 7))]
        {
            let trial = perlin(frequency, size);
            let levels = trial.levels(0);
            let slope = elementary::tan64(intensity * FRAC_PI_4);
            let found = trial.with_context(&|_, _| (), |cx| steering::<EightBit>(intensity, cx));
            for (found, level) in found.unwrap().iter().zip(levels) {
                let expected = contrasted::<Continuous>(f32::from(level), slope);
                // A lost level in each of up to five octaves, and one in the contrast.
                let lost = (expected - found) * 255.0;
                assert!((-1e-3..6.0).contains(&lost), "{intensity}: {lost}");
            }
        }
    }

    #[test]
    fn real_numbers_lose_nothing() {
        let trial = perlin(9, (40, 40));
        let slope = elementary::tan64(0.5 * FRAC_PI_4);
        let found = trial.with_context(&|_, _| (), |cx| steering::<Continuous>(0.5, cx)).unwrap();
        for (found, value) in found.iter().zip(trial.image().channel(0)) {
            assert_eq!(*found, contrasted::<Continuous>(*value * 255.0, slope));
        }
        let flat = trial.with_context(&|_, _| (), |cx| steering::<Continuous>(0.0, cx)).unwrap();
        assert!(flat.iter().all(|value| *value == 0.5));
        let flat = trial.with_context(&|_, _| (), |cx| steering::<EightBit>(0.0, cx)).unwrap();
        assert!(flat.iter().all(|value| *value == 127.0 / 255.0));
    }
}
