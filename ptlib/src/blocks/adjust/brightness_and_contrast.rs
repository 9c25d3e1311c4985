//! Brightness and contrast.
//!
//! Specification 2.37. Brightness moves values toward white or black, then contrast turns the
//! curve around the middle grey: at 1 it is a threshold, at -1 everything is the middle grey.

use std::f64::consts::FRAC_PI_4;

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// From -1 (black) over 0 (unchanged) to 1 (white). If this or the contrast lies outside
        /// -1..1, the picture stays as it is.
        brightness: float [hard -1000.0..=1000.0 soft -1.0..=1.0] = 0.0;
        /// From -1 (grey) over 0 (unchanged) to 1 (black and white only).
        contrast: float [hard -1000.0..=1000.0 soft -1.0..=1.0] = 0.0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<BrightnessAndContrast>(About {
    id: "brightness and contrast",
    summary: "Makes a picture lighter or darker, and its differences larger or smaller.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::As(IMAGE))],
    ..About::DEFAULT
});

/// (v · `gain` + `offset`) · `slope` + `middle`.
struct BrightnessAndContrast {
    gain: f32,
    offset: f32,
    slope: f32,
    middle: f32,
}

impl PointBlock for BrightnessAndContrast {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let Params { brightness, contrast } = *params;
        if brightness.abs() > 1.0 || contrast.abs() > 1.0 {
            return Ok(Self { gain: 1.0, offset: 0.0, slope: 1.0, middle: 0.0 });
        }
        // The slope of contrast 1 is 1.6·10¹⁶. It stays apart from the gain: multiplied out, the
        // middle grey would drown in the rounding.
        Ok(Self {
            gain: convert::single(1.0 - brightness.abs()),
            offset: convert::single(brightness.max(0.0) - 0.5),
            slope: convert::single(elementary::tan64((contrast + 1.0) * FRAC_PI_4)),
            middle: 0.5,
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let Self { gain, offset, slope, middle } = *self;
        out.map(inputs, IMAGE, |value| (value * gain + offset) * slope + middle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(levels: &[u8], brightness: f64, contrast: f64) -> Trial {
        let width = u32::try_from(levels.len()).unwrap();
        Trial::of(&BLOCK)
            .size(width, 1)
            .input(IMAGE, image_of_levels(width, &[levels]))
            .float("brightness", brightness)
            .float("contrast", contrast)
    }

    #[test]
    fn follows_the_vectors_of_the_specification() {
        let lighter = trial(&[0, 64, 100, 127, 200, 255], 0.3, -0.4);
        assert_eq!(lighter.levels(0), [101, 124, 137, 146, 172, 192]);
        let darker = trial(&[64, 100, 127, 128, 200, 254], -0.2, 0.5);
        assert_eq!(darker.levels(0), [0, 12, 64, 66, 205, 255]);
        darker.assert_same_bits();
    }

    #[test]
    fn ends_of_the_ranges() {
        let levels = [0, 1, 127, 128, 254, 255];
        assert_eq!(trial(&levels, 0.0, 1.0).levels(0), [0, 0, 0, 255, 255, 255]);
        assert_eq!(trial(&levels, 0.0, -1.0).levels(0), [127; 6]);
        assert_eq!(trial(&levels, 1.0, 0.0).levels(0), [255; 6]);
        assert_eq!(trial(&levels, -1.0, 0.0).levels(0), [0; 6]);
        for unchanged in [(0.0, 0.0), (1.01, 0.5), (0.5, -1.01)] {
            assert_eq!(trial(&levels, unchanged.0, unchanged.1).levels(0), levels);
        }
    }
}
