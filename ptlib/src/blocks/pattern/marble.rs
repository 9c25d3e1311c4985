//! Marble: sine stripes that noise pushes back and forth.
//!
//! Specification 2.16. A stripe's phase is the position along the direction, in widths of the
//! image, plus the noise.
//!
//! In 8-bit precision the intensity is quantised to tenths, and positions down the image are
//! measured in widths as well, as PT Designer does. In float precision the intensity is exact, and
//! a position down the image is measured in heights, so that the stripes tile in every direction.
//!
//! Sines are single-precision polynomials. In 8-bit precision what comes near a whole level, where
//! truncation decides, is computed again in double precision.

use std::f64::consts::PI;

use super::{
    super::noise::lattice::LatticeNoise,
    grain::{self, Direction},
};
use crate::block::prelude::*;

const NOISE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many stripes there are from edge to edge. 0 leaves only what the noise draws.
        periods: int [hard 0..=99999 soft 0..=50] = 5;
        /// How far the noise pushes the stripes. 0 leaves them straight. Larger images are pushed
        /// further: 10 is as much as their own width at 500 pixels.
        intensity: int [hard 0..=999999 soft 0..=10] = 4;
        /// How far the stripes leave the middle grey, in levels of 255. 0 gives plain grey.
        amplitude: int [hard 0..=127 soft 0..=127] = 127;
        /// The direction in which stripe follows stripe.
        direction: choice [Direction] = Direction::Right;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Marble>(About {
    id: "marble",
    summary: "Stripes, distorted by noise.",
    inputs: &[input("noise", Kind::Image).optional()],
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    in_pixels: "how far noise pushes the stripes, which grows with the width; and the blur of its \
                own noise",
    tiling: Tiling::ExceptInEightBit(
        "stripes that follow each other downwards are measured by the width, so they tile only \
         where the height equals it",
    ),
    ..About::DEFAULT
});

/// Pixels that are computed side by side.
const PIECE: usize = 64;

/// More than the error of a level.
const NEAR: f32 = 1.0 / 512.0;

struct Marble {
    /// What pushes the stripes, unless an input does.
    noise: Option<LatticeNoise>,
    periods: f64,
    /// How far white pushes, in widths of the image.
    push: f64,
    amplitude: f32,
    direction: Direction,
}

impl PointBlock for Marble {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let noise = if cx.is_connected(NOISE) {
            None
        } else {
            Some(LatticeNoise::new::<L>(&grain::noise(), cx.seed32(), cx)?)
        };
        let tenths = f64::from(cx.width) / 500.0 * f64::from(params.intensity);
        Ok(Self {
            noise,
            periods: f64::from(params.periods),
            // Q: whole tenths.
            push: if L::EIGHT_BIT { tenths.trunc() } else { tenths } / 10.0,
            amplitude: convert::level(params.amplitude),
            direction: params.direction,
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let out = out.grey();
        match &self.noise {
            Some(noise) => noise.write_row::<L>(cx, out),
            None => out.copy_from_slice(inputs.channel(NOISE, 0)),
        }
        let mut x = i64::from(cx.x);
        for piece in out.chunks_mut(PIECE) {
            self.stripes::<L>(cx, x, piece);
            x += PIECE as i64;
        }
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        grain::noise().scratch_bytes(width, height)
    }
}

impl Marble {
    /// Turns noise into marble, from column `x` on.
    #[inline(always)]
    fn stripes<L: Levels>(&self, cx: &RowContext<'_>, x: i64, piece: &mut [f32]) {
        let (right, _) = self.direction.step();
        let start = self.start::<L>(cx);
        // Where a pixel lies, in widths of the image.
        let position = |i: usize| (start + (right * (x + i as i64)) as f64) / f64::from(cx.width);
        let mut noise = [0.0; PIECE];
        for (noise, value) in noise.iter_mut().zip(&*piece) {
            let level = f64::from(*value * 255.0);
            *noise = if L::EIGHT_BIT { (level + 0.5).floor() } else { level } / 255.0;
        }
        for (i, (level, noise)) in piece.iter_mut().zip(&noise).enumerate() {
            let turns = self.periods * (position(i) + noise * self.push);
            let sine = elementary::sin_turns(convert::single(turns - turns.floor()));
            *level = 127.0 + self.amplitude * sine;
        }
        if L::EIGHT_BIT {
            grain::truncate(piece, NEAR, |i| {
                let turns = self.periods * (position(i) + noise[i] * self.push);
                127.0 + f64::from(self.amplitude) * elementary::sin64(2.0 * PI * turns)
            });
        }
        for level in piece {
            *level = levels::from_level(*level);
        }
    }

    /// Where the row begins along the direction, in pixels of its width.
    #[inline(always)]
    fn start<L: Levels>(&self, cx: &RowContext<'_>) -> f64 {
        let (right, down) = self.direction.step();
        let down = (down * i64::from(cx.y)) as f64;
        let width = f64::from(cx.width);
        // Q: 8-bit precision measures rows by the width.
        let down = if L::EIGHT_BIT { down } else { down / f64::from(cx.height) * width };
        if right < 0 { width + down } else { down }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn noise(count: u32) -> Vec<u8> {
        (0..count).map(|i| (i * i % 251).to_le_bytes()[0]).collect()
    }

    #[test]
    fn levels_are_those_of_the_specification() {
        let black = image_of_levels(64, &[&[0; 64]]);
        let trial = Trial::of(&BLOCK).size(64, 1).input(NOISE, black).int("periods", 2);
        let levels = trial.levels(0);
        let found: Vec<_> = levels.iter().step_by(4).take(10).copied().collect();
        assert_eq!(found, [127, 216, 254, 216, 127, 37, 0, 37, 126, 216]);
    }

    #[test]
    fn levels_equal_the_formula() {
        let (width, height) = (131, 70);
        let levels = noise(width * height);
        for (direction, periods, intensity) in
            [(0, 3, 6), (1, 5, 10), (2, 40, 8), (3, 99_999, 20), (0, 1, 999_999)]
        {
            let trial = Trial::of(&BLOCK)
                .size(width, height)
                .input(NOISE, image_of_levels(width, &[&levels]))
                .int("periods", periods)
                .int("intensity", intensity)
                .choice("direction", direction);
            trial.assert_same_bits();
            trial.clone().eight_bit().assert_same_bits();
            let push = (f64::from(width) / 500.0 * f64::from(intensity)).trunc() / 10.0;
            for (i, level) in (0..).zip(trial.levels(0)) {
                let (x, y) = (i % width, i / width);
                let q = [x, y, x + y, width - x + y][direction as usize];
                let noise = f64::from(levels[i as usize]) / 255.0;
                let turns = f64::from(periods) * (f64::from(q) / f64::from(width) + noise * push);
                let expected = 127.0 + 127.0 * elementary::sin64(2.0 * PI * turns);
                assert_eq!(
                    i64::from(level),
                    convert::truncate64(expected),
                    "{direction}: {x}, {y}"
                );
            }
        }
    }

    #[test]
    fn in_float_precision_every_direction_tiles() {
        // A constant noise: columns and rows one period further are equal.
        for direction in 0..4 {
            let flat = image_of_levels(60, &[&[100; 60 * 40]]);
            let trial = Trial::of(&BLOCK).size(60, 40).input(NOISE, flat).int("periods", 4);
            let image = trial.choice("direction", direction).image();
            let value = |x: usize, y: usize| image.channel(0)[y % 40 * 60 + x % 60];
            for (x, y) in (0..60).flat_map(|x| (0..40).map(move |y| (x, y))) {
                assert!((value(x, y) - value(x + 15, y)).abs() < 1e-5, "{direction}: {x}, {y}");
                assert!((value(x, y) - value(x, y + 10)).abs() < 1e-5, "{direction}: {x}, {y}");
            }
        }
    }

    #[test]
    fn without_an_input_it_makes_noise_of_its_own() {
        let trial = Trial::of(&BLOCK).size(130, 50);
        assert_ne!(trial.levels(0), trial.clone().seed(1).levels(0));
        assert_eq!(trial.clone().int("amplitude", 0).levels(0), [127; 130 * 50]);
        trial.assert_same_bits();
        trial.eight_bit().assert_same_bits();
    }
}
