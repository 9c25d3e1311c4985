//! White noise: every pixel has a random value of its own.
//!
//! Specification 2.8. The grain is one pixel of the working image, so supersampling averages it.

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far values may leave the middle grey, in levels of 255.
        amplitude: int [hard 0..=127 soft 0..=127] = 127;
        /// Whether red, green and blue of a pixel are equal.
        grayscale: bool = true;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<SimpleNoise>(About {
    id: "simple noise",
    summary: "A random value in each pixel.",
    outputs: &[output("image", Planes::ByParameters)],
    uses_seed: true,
    in_pixels: "the grain, which is one pixel",
    ..About::DEFAULT
});

struct SimpleNoise {
    amplitude: f64,
    /// The index of the first draw (specification, appendix A).
    first: i32,
}

impl PointBlock for SimpleNoise {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let first = cx.seed32().wrapping_mul(64);
        Ok(Self { amplitude: f64::from(params.amplitude), first })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        // Draws go pixel by pixel, and channel by channel in a pixel; their indices wrap.
        let channels = convert::low_bits(out.planes() as u64);
        let pixel = u64::from(cx.y) * u64::from(cx.width) + u64::from(cx.x);
        let start = convert::low_bits(pixel).wrapping_mul(channels);
        let mut first = self.first.wrapping_add(start);
        for plane in out.iter_mut() {
            let mut index = first;
            for value in plane {
                *value = self.value::<L>(index);
                index = index.wrapping_add(channels);
            }
            first = first.wrapping_add(1);
        }
    }

    fn is_grey(params: &Params) -> bool {
        params.grayscale
    }
}

impl SimpleNoise {
    /// The value of the draw at an index.
    #[inline(always)]
    fn value<L: Levels>(&self, index: i32) -> f32 {
        if L::EIGHT_BIT {
            // The engine's store leans upward; of many values one in a thousand would be wrong,
            // and an automaton that starts from them looks different all over.
            let level = convert::truncate64_to_i32(128.0 + self.amplitude * elias::noise64(index));
            levels::from_level(convert::level(level))
        } else {
            let amplitude = convert::single(self.amplitude);
            (128.0 + amplitude * elias::noise(index)) * (1.0 / 255.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    #[test]
    fn grey_noise_draws_in_raster_order() {
        let levels = Trial::of(&BLOCK).size(300, 200).seed(3).levels(0);
        for (k, level) in (192..).zip(levels) {
            let expected = convert::truncate64(128.0 + 127.0 * elias::noise64(k));
            assert_eq!(i64::from(level), expected, "draw {k}");
        }
    }

    #[test]
    fn coloured_noise_draws_channel_by_channel() {
        let trial = Trial::of(&BLOCK).size(8, 8).int("amplitude", 60).flag("grayscale", false);
        for channel in 0..3_u8 {
            let levels = trial.levels(usize::from(channel));
            for (k, level) in (i32::from(channel)..).step_by(3).zip(levels) {
                let expected = convert::truncate64(128.0 + 60.0 * elias::noise64(k));
                assert_eq!(i64::from(level), expected, "draw {k}");
            }
        }
    }

    #[test]
    fn rows_are_the_same_bits_however_they_are_asked_for() {
        Trial::of(&BLOCK).size(61, 5).seed(u64::MAX).assert_same_bits();
        Trial::of(&BLOCK).size(61, 5).flag("grayscale", false).assert_same_bits();
    }
}
