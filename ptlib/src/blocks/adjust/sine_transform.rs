//! Grey levels bent into waves.
//!
//! Specification 2.20: the sine of the grey level, which runs through a number of periods from
//! black to white. In 8-bit precision there are 256 results, so they are a table.

use std::f64::consts::PI;

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Where in its period the wave is at black. 0 starts at the middle grey, going up.
        phase: float [hard -1000000.0..=1000000.0 soft -6.3..=6.3 unit "rad"] = 0.0;
        /// How many waves there are from black to white.
        periods: int [hard 1..=2147483647 soft 1..=32] = 5;
        /// How far the wave leaves the middle grey, in levels of 255. 0 gives plain grey.
        amplitude: int [hard 0..=128 soft 0..=127] = 127;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<SineTransform>(About {
    id: "sine transform",
    summary: "Bends the grey levels of a picture into sine waves.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});

struct SineTransform {
    periods: f64,
    /// The phase, in turns.
    phase: f64,
    amplitude: f32,
    /// The values of the 256 grey levels.
    by_level: Box<[f32; 256]>,
}

impl PointBlock for SineTransform {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let (periods, amplitude) = (f64::from(params.periods), f64::from(params.amplitude));
        let mut by_level = Box::new([0.0; 256]);
        for (grey, value) in (0..=255_u8).zip(by_level.iter_mut()) {
            let angle = 2.0 * PI * periods * f64::from(grey) / 255.0 + params.phase;
            let wave = elementary::sin64(angle) / 2.0 + 0.5;
            let level = convert::truncate64(2.0 * amplitude * wave + 128.0 - amplitude);
            // BUG of the specification, fixed: 256 at the crests of amplitude 128 is white.
            *value = levels::from_level(convert::distance(level.min(255)));
        }
        let phase = params.phase / (2.0 * PI);
        Ok(Self { periods, phase, amplitude: convert::level(params.amplitude), by_level })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let [red, green, blue] = inputs.rgb(IMAGE);
        let is_grey = inputs.planes(IMAGE) == 1;
        for (((out, red), green), blue) in out.grey().iter_mut().zip(red).zip(green).zip(blue) {
            let mean = (red + green + blue) / 3.0;
            let grey = if is_grey { *red } else { mean };
            *out = if L::EIGHT_BIT {
                // Levels are whole but for rounding, their means are a third apart.
                self.by_level[convert::truncate_masked(grey * 255.0 + 0.01, 255)]
            } else {
                self.at(grey)
            };
        }
    }
}

impl SineTransform {
    /// The value of a grey value, in real numbers.
    #[inline(always)]
    fn at(&self, grey: f32) -> f32 {
        // Whole turns go in double precision: there may be many.
        let turns = f64::from(grey) * self.periods + self.phase;
        let turns = convert::single(turns - turns.floor());
        (self.amplitude * elementary::sin_turns(turns) + 128.0) * (1.0 / 255.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(levels: &[u8]) -> Trial {
        let width = u32::try_from(levels.len()).unwrap();
        Trial::of(&BLOCK).size(width, 1).input(IMAGE, image_of_levels(width, &[levels]))
    }

    #[test]
    fn follows_the_vectors_of_the_specification() {
        let trial = trial(&[0, 1, 64, 100, 200, 254, 255]);
        assert_eq!(trial.levels(0), [128, 143, 254, 97, 67, 112, 127]);
        trial.clone().eight_bit().assert_same_bits();
        trial.assert_same_bits();
    }

    #[test]
    fn both_precisions_follow_the_same_wave() {
        let levels: Vec<u8> = (0..=255).collect();
        for (phase, periods, amplitude) in [(0.0, 1, 127), (-7.3, 3, 60), (1e6, 200, 128)] {
            let trial = trial(&levels)
                .float("phase", phase)
                .int("periods", periods)
                .int("amplitude", amplitude);
            let real = trial.image();
            for (level, real) in trial.levels(0).iter().zip(real.channel(0)) {
                let step = real * 255.0 - f32::from(*level);
                assert!((-0.02..1.02).contains(&step), "{level} for {}", real * 255.0);
            }
        }
    }

    #[test]
    fn crests_of_amplitude_128_are_white() {
        let crest = trial(&[0]).float("phase", PI / 2.0).int("amplitude", 128);
        assert_eq!(crest.levels(0), [255]);
        assert_eq!(trial(&[0, 77]).int("amplitude", 0).levels(0), [128, 128]);
    }

    #[test]
    fn colours_count_as_the_floor_of_their_mean() {
        let image = image_of_levels(1, &[&[0], &[2], &[3]]);
        assert_eq!(trial(&[0]).input(IMAGE, image).levels(0), [143]);
    }
}
