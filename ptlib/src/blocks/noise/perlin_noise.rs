//! Clouds: random values on lattices that get finer and weaker from octave to octave, summed.
//!
//! Specification 2.5. The name is PT Designer's; it is value noise, not Perlin's gradient noise.
//! The lattices divide the image, so it tiles for every frequency. [`LatticeNoise`] computes it.

use super::lattice::{LatticeNoise, Settings, VALUE_OF_LEVEL};
use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far the first octave may leave the middle grey, in levels of 255; each further one
        /// may by half as much. No octave goes beyond 127: with 255, the first two are equally
        /// strong.
        amplitude: int [hard 0..=255 soft 0..=127] = 127;
        /// Lattice points of the first octave across the image; each further one has twice as many.
        frequency: int [hard 1..=65536 soft 1..=64] = 6;
        /// The most octaves; -1 for as many as leave a trace. 0 gives plain grey.
        max_iterations "max iterations": int [hard -1..=99 soft -1..=16] = -1;
        /// How values between the points of a lattice are found.
        interpolation: choice [Interpolation] = Interpolation::Linear;
        /// Whether octaves with fewer than 10 points across are blurred, by up to 9 px.
        smooth: bool = true;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<LatticeNoise>(About {
    id: "perlin noise",
    summary: "Clouds: noise of several sizes, the smaller the weaker.",
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    in_pixels: "the blur of \"smooth\"",
    ..About::DEFAULT
});

impl Params {
    fn settings(&self) -> Settings {
        Settings {
            amplitude: self.amplitude.unsigned_abs(),
            frequency: self.frequency.unsigned_abs(),
            max_octaves: u32::try_from(self.max_iterations).ok(),
            interpolation: self.interpolation.into(),
            smooth: self.smooth,
        }
    }
}

impl PointBlock for LatticeNoise {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        Self::new::<L>(&params.settings(), cx.seed32(), cx)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        self.write_levels::<L>(cx, out.grey());
        out.change(|level| level * VALUE_OF_LEVEL);
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        params.settings().scratch_bytes(width, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{block::testing::Trial, value};

    /// A case: its size, parameters and seed.
    struct Case {
        size: (u32, u32),
        seed: u8,
        amplitude: i32,
        frequency: i32,
        octaves: i32,
        interpolation: u32,
        smooth: bool,
    }

    impl Case {
        fn trial(&self) -> Trial {
            Trial::of(&BLOCK)
                .size(self.size.0, self.size.1)
                .seed(u64::from(self.seed))
                .int("amplitude", self.amplitude)
                .int("frequency", self.frequency)
                .int("max iterations", self.octaves)
                .choice("interpolation", self.interpolation)
                .flag("smooth", self.smooth)
        }

        /// As the specification tells it: image after image, in levels. `truncates` is what 8-bit
        /// precision does and real numbers do not.
        fn naive(&self, truncates: bool) -> Vec<f64> {
            let (width, height) = self.size;
            let whole = |value: f64| if truncates { value.floor() } else { value };
            let mut sums = vec![128.0; (width * height) as usize];
            let mut frequency = u32::try_from(self.frequency).unwrap();
            let mut amplitude = self.amplitude;
            let mut k = 0;
            while k != self.octaves && amplitude > 0 && frequency <= width.max(height) {
                let rows = (frequency * height / width).max(1);
                let seed = i32::from(self.seed) + 80_124 * k;
                let lattice = |column: usize, row: usize| {
                    let k = 64 * i64::from(seed) + (row * frequency as usize + column) as i64;
                    let noise = elias::noise64(convert::low_bits(k.cast_unsigned()));
                    whole(128.0 + f64::from(amplitude.min(127)) * noise)
                };
                let octave = self.resampled(lattice, (frequency, rows), whole);
                let radius = if self.smooth { 10_u32.saturating_sub(frequency) } else { 0 };
                let octave = boxed(&octave, self.size, i64::from(radius), whole);
                for (sum, value) in sums.iter_mut().zip(octave) {
                    *sum = (*sum + value - 128.0).clamp(0.0, 255.0);
                }
                (frequency, amplitude, k) = (frequency * 2, amplitude / 2, k + 1);
            }
            sums
        }

        fn resampled(
            &self,
            lattice: impl Fn(usize, usize) -> f64,
            (columns, rows): (u32, u32),
            whole: impl Fn(f64) -> f64,
        ) -> Vec<f64> {
            let interpolation = match self.interpolation {
                0 => value::Interpolation::Nearest,
                1 => value::Interpolation::Linear,
                _ => value::Interpolation::Sine,
            };
            let (width, height) = self.size;
            let across = Axis::new(columns, width, interpolation);
            let down = Axis::new(rows, height, interpolation);
            let mut out = Vec::new();
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let (left, right, u) = across.at(x);
                let (top, bottom, v) = down.at(y);
                // Weights are rounded to single precision, which must not cost a level.
                let slack = if whole(0.5) < 0.5 { 5e-5 } else { 0.0 };
                let between = |a: f64, b: f64, t: f32| whole(a + (b - a) * f64::from(t) + slack);
                let [above, below] =
                    [top, bottom].map(|row| between(lattice(left, row), lattice(right, row), u));
                out.push(between(above, below, v));
            }
            out
        }
    }

    fn boxed(
        image: &[f64],
        (width, height): (u32, u32),
        radius: i64,
        whole: impl Fn(f64) -> f64,
    ) -> Vec<f64> {
        let mut out = Vec::new();
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let mut sum = 0.0;
            for (i, j) in (-radius..=radius).flat_map(|i| (-radius..=radius).map(move |j| (i, j))) {
                let x = convert::wrap(i64::from(x) + i, width);
                let y = convert::wrap(i64::from(y) + j, height);
                sum += image[(y * width + x) as usize];
            }
            let side = f64::from(2 * i32::try_from(radius).unwrap() + 1);
            out.push(whole(sum / (side * side)));
        }
        out
    }

    const DEFAULT: Case = Case {
        size: (64, 64),
        seed: 0,
        amplitude: 127,
        frequency: 6,
        octaves: -1,
        interpolation: 1,
        smooth: true,
    };

    fn cases() -> Vec<Case> {
        vec![
            Case { size: (97, 64), seed: 9, ..DEFAULT },
            Case { size: (64, 97), frequency: 3, interpolation: 2, ..DEFAULT },
            Case { amplitude: 255, frequency: 1, interpolation: 0, ..DEFAULT },
            Case { amplitude: 200, frequency: 2, smooth: false, ..DEFAULT },
            Case { frequency: 64, seed: 200, ..DEFAULT },
            Case { frequency: 9, octaves: 2, ..DEFAULT },
            Case { octaves: 0, ..DEFAULT },
            Case { frequency: 65, ..DEFAULT },
            // A lattice finer than the pixels, and boxes wider than the image.
            Case { size: (3, 40), ..DEFAULT },
            Case { size: (40, 1), ..DEFAULT },
            Case { size: (1, 1), frequency: 1, ..DEFAULT },
            Case { size: (2, 3), frequency: 1, ..DEFAULT },
            Case { size: (1100, 2), frequency: 700, ..DEFAULT },
            Case { size: (20, 3000), frequency: 2900, octaves: 1, ..DEFAULT },
        ]
    }

    #[test]
    fn levels_equal_the_specification_literally() {
        for case in cases() {
            let levels = case.trial().levels(0);
            for (i, (level, expected)) in levels.iter().zip(case.naive(true)).enumerate() {
                let Case { size, frequency, .. } = case;
                assert_eq!(f64::from(*level), expected, "{size:?} frequency {frequency}: at {i}");
            }
        }
    }

    #[test]
    fn numbers_equal_the_specification_without_truncation() {
        for case in cases() {
            let image = case.trial().image();
            for (i, (value, expected)) in image.channel(0).iter().zip(case.naive(false)).enumerate()
            {
                let Case { size, frequency, .. } = case;
                let error = (f64::from(*value) * 255.0 - expected).abs();
                assert!(error < 1e-3, "{size:?} frequency {frequency}: off by {error} at {i}");
            }
        }
    }

    #[test]
    fn rows_are_the_same_bits_however_they_are_asked_for() {
        for case in cases() {
            case.trial().assert_same_bits();
            case.trial().eight_bit().assert_same_bits();
        }
    }

    #[test]
    fn another_seed_gives_another_picture() {
        let trial = DEFAULT.trial();
        assert_ne!(trial.levels(0), trial.clone().seed(1).levels(0));
    }

    #[test]
    fn the_highest_frequency_is_no_burden() {
        let trial = Trial::of(&BLOCK).int("frequency", 65_536).size(8, 8);
        assert_eq!(trial.levels(0), [128; 64]);
    }
}
