//! Few tones, with or without a grain that makes up for the missing ones.
//!
//! Specification 2.24. Channels are independent. In 8-bit precision a value is one of 256 levels,
//! and what becomes of each is a table; float precision computes the same from real numbers.
//!
//! Error propagation goes through the whole picture, pixel by pixel, before any row is asked for.
//! The other methods need nothing but their pixel.

use super::dithering::{Choice, Choices, Ordered, Random, Threshold, propagate};
use crate::block::prelude::*;

const IMAGE: usize = 0;

/// Pixels that get their grain together.
const PIECE: usize = 64;

choice! {
    /// How a value becomes one of the tones.
    Method {
        /// The tone of the part of the range in which the value lies.
        Threshold = "threshold",
        /// The tone below or above, at random: the nearer one more often.
        Random = "random",
        /// The tone of the part of the range; the error is passed on to the pixels around.
        ErrorPropagation = "error propagation",
        /// The tone below or above, as a regular pattern says that is denser in light parts.
        Ordered = "ordered",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many tones of each channel are left, black and white included. (The method
        /// ordered has one more.)
        levels: int [hard 2..=255 soft 2..=32] = 8;
        /// How the tones are chosen.
        method: choice [Method] = Method::Ordered;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Dither>(About {
    id: "dither",
    summary: "Leaves a few tones of each channel, mixed so that others seem to be there.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    tiling: Tiling::Except(
        "an ordered pattern tiles only if its side, the root of the number of tones, divides \
         width and height; and errors are propagated downward, but not across the bottom edge",
    ),
    in_pixels: "the grain and the pattern, whose cells are one pixel",
    ..About::DEFAULT
});

struct Dither {
    /// What rows are made of; with error propagation, what they are.
    image: Image,
    method: Method,
    threshold: Threshold,
    random: Random,
    ordered: Ordered,
    /// What the method does with each level.
    choices: Choices,
}

impl GatherBlock for Dither {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let count = params.levels.unsigned_abs();
        let (mut image, threshold) = (cx.image(IMAGE)?.clone(), Threshold::new(count));
        let choices = match params.method {
            Method::Threshold | Method::ErrorPropagation => Threshold::choices(count),
            Method::Random => Random::choices(count),
            Method::Ordered => Ordered::choices(count),
        };
        if params.method == Method::ErrorPropagation {
            let tones = choices.each_ref().map(|choice| choice.at(0.0));
            image = propagate::<L>(cx, &image, threshold, &tones)?;
        }
        Ok(Self {
            image,
            method: params.method,
            threshold,
            random: Random::new(count),
            ordered: Ordered::new(count),
            choices,
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        match self.method {
            Method::Threshold => {
                self.write::<L>(cx, out, |_| 0.0, |value| self.threshold.choice(value));
            }
            Method::Random => {
                let start = u64::from(cx.y) * u64::from(cx.width);
                let grain = |x| self.random.grain::<L>(convert::low_bits(start + x as u64));
                self.write::<L>(cx, out, grain, |value| self.random.choice(value));
            }
            Method::Ordered => {
                let numbers = self.ordered.grain(cx.y);
                let grain = |x| numbers[x % numbers.len()];
                self.write::<L>(cx, out, grain, |value| self.ordered.choice(value));
            }
            Method::ErrorPropagation => {
                for (channel, out) in out.iter_mut().enumerate() {
                    let x = cx.x as usize;
                    out.copy_from_slice(&self.image.row(channel, cx.y)[x..][..out.len()]);
                }
            }
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        if params.method == Method::ErrorPropagation {
            Image::bytes_of(width, height + 2, planes)
        } else {
            0
        }
    }
}

impl Dither {
    /// Writes the tones of all channels. `grain` gives that of a column, `choice` what becomes of
    /// a real number.
    #[inline(always)]
    fn write<L: Levels>(
        &self,
        cx: &RowContext<'_>,
        out: &mut OutputRow<'_>,
        grain: impl Fn(usize) -> f32,
        choice: impl Fn(f32) -> Choice,
    ) {
        let (first, count) = (cx.x as usize, out.plane(0).len());
        for start in (0..count).step_by(PIECE) {
            let grains: [f32; PIECE] = std::array::from_fn(|i| grain(first + start + i));
            let end = count.min(start + PIECE);
            for (channel, out) in out.iter_mut().enumerate() {
                let values = &self.image.row(channel, cx.y)[first + start..first + end];
                let pixels = out[start..end].iter_mut().zip(values);
                for ((out, value), grain) in pixels.zip(grains) {
                    let choice = if L::EIGHT_BIT {
                        self.choices[convert::truncate_masked(*value * 255.0 + 0.01, 255)]
                    } else {
                        choice(*value)
                    };
                    *out = choice.at(grain);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(width: u32, levels: &[u8], count: i32, method: u32) -> Trial {
        let height = u32::try_from(levels.len()).unwrap() / width;
        Trial::of(&BLOCK)
            .size(width, height)
            .input(IMAGE, image_of_levels(width, &[levels]))
            .int("levels", count)
            .choice("method", method)
    }

    fn ramp() -> Vec<u8> {
        (0..=255).collect()
    }

    #[test]
    fn thresholds_follow_the_vectors_of_the_specification() {
        assert_eq!(trial(2, &[127, 128], 2, 0).levels(0), [0, 255]);
        assert_eq!(trial(2, &[100, 200], 3, 0).levels(0), [127, 255]);
        let eight = trial(4, &[64, 127, 128, 200], 8, 0);
        assert_eq!(eight.levels(0), [72, 109, 145, 218]);
        eight.assert_same_bits();
    }

    #[test]
    fn ordered_follows_the_vectors_of_the_specification() {
        for level in [0, 64, 127] {
            assert_eq!(trial(4, &[level; 16], 2, 3).levels(0), [0; 16]);
        }
        let white = trial(2, &[255; 4], 2, 3).levels(0);
        assert_eq!(white, [127, 255, 127, 127]);
    }

    #[test]
    fn ordered_is_the_formula_of_the_specification() {
        for count in 2..=255_i32 {
            let side = (2..=16).find(|side| side * side >= count).unwrap();
            let numbers = Ordered::new(count.unsigned_abs());
            let out = trial(256, &ramp(), count, 3).levels(0);
            for (x, (level, out)) in ramp().into_iter().zip(out).enumerate() {
                let (v, l) = (f64::from(level), f64::from(count));
                let k = (1..=count).find(|k| v <= f64::from(*k) * 255.0 / l).unwrap() - 1;
                let number = -convert::truncate(numbers.grain(0)[x % convert::index(side.into())]);
                let k = if k + number > side * side { k + 1 } else { k };
                assert_eq!(i64::from(out), convert::truncate64(f64::from(k) * 255.0 / l));
            }
        }
    }

    #[test]
    fn random_draws_once_a_pixel() {
        for count in [2, 4, 5, 8, 100, 255] {
            let image = image_of_levels(256, &[&ramp(), &[128; 256], &ramp()]);
            let trial = trial(256, &ramp(), count, 1).input(IMAGE, image);
            let (red, blue) = (trial.levels(0), trial.levels(2));
            assert_eq!(red, blue);
            let step = 255.0 / f64::from(count - 1);
            let mut draws = elias::Draws::from_index(0);
            for (level, out) in ramp().into_iter().zip(red) {
                let v = f64::from(level);
                let k = (0..count - 1).find(|k| v <= f64::from(k + 1) * step).unwrap_or(count - 1);
                let error = convert::truncate64(v - f64::from(k) * step);
                let up = error >= draws.next_integer(0, convert::round64(step.ceil()));
                let expected = f64::from(k + i32::from(up)) * step;
                assert_eq!(i64::from(out), convert::truncate64(expected).min(255), "{level}");
            }
            trial.clone().eight_bit().assert_same_bits();
            trial.assert_same_bits();
        }
    }

    #[test]
    fn errors_are_propagated_as_a_plain_reading_does() {
        let (width, height) = (23, 11);
        for (width, height) in [(width, height), (1, 9), (2, 5), (9, 1)] {
            let levels: Vec<u8> =
                (0..width * height).map(|i: u32| (i * i % 256).to_le_bytes()[0]).collect();
            for count in [2, 5, 255_i32] {
                let tones = Threshold::choices(count.unsigned_abs());
                let mut values: Vec<f64> = levels.iter().map(|level| f64::from(*level)).collect();
                let mut expected = Vec::new();
                for i in 0..width * height {
                    let (x, y) = (i64::from(i % width), i / width);
                    let value = values[i as usize].trunc().clamp(0.0, 255.0);
                    let place = convert::index(convert::truncate64(value));
                    let tone = convert::to_byte(tones[place].at(0.0));
                    expected.push(tone);
                    let error = value - f64::from(tone);
                    if x + 1 < i64::from(width) {
                        values[i as usize + 1] += error * 7.0 / 16.0;
                    }
                    for (dx, weight) in [(-1, 3.0), (0, 5.0), (1, 1.0)] {
                        let below = ((y + 1) * width + convert::wrap(x + dx, width)) as usize;
                        if let Some(value) = values.get_mut(below) {
                            *value += error * weight / 16.0;
                        }
                    }
                }
                assert_eq!(trial(width, &levels, count, 2).levels(0), expected);
            }
        }
    }

    #[test]
    fn propagated_errors_keep_the_mean() {
        for level in [10, 100, 128, 200] {
            let image = trial(64, &vec![level; 64 * 64], 3, 2).image();
            let sum: f32 = image.channel(0).iter().sum();
            assert!((sum / 4096.0 - f32::from(level) / 255.0).abs() < 0.01, "{level}");
            assert!(image.channel(0).iter().all(|value| [0.0, 0.5, 1.0].contains(value)));
        }
    }

    #[test]
    fn channels_are_independent() {
        let reversed: Vec<u8> = ramp().into_iter().rev().collect();
        for method in 0..4 {
            let image = image_of_levels(16, &[&ramp(), &reversed, &[77; 256]]);
            let colour = trial(16, &ramp(), 4, method).input(IMAGE, image);
            for (channel, levels) in [&ramp()[..], &reversed, &[77; 256]].into_iter().enumerate() {
                let alone = trial(16, levels, 4, method);
                assert_eq!(colour.levels(channel), alone.levels(0), "method {method}");
                assert_eq!(colour.image().channel(channel), alone.image().channel(0));
            }
            colour.assert_same_bits();
        }
    }
}
