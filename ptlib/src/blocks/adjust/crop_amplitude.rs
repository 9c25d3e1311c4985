//! Values limited from below and from above.
//!
//! Specification 2.25: reads red only, and where the limits are crossed the lower one wins.

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Darker pixels get this level.
        lower "lower limit": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 50;
        /// Lighter pixels get this level.
        upper "upper limit": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 200;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<CropAmplitude>(About {
    id: "crop amplitude",
    summary: "Cuts off what is darker or lighter than two limits, in the red channel.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});

struct CropAmplitude {
    lower: f32,
    upper: f32,
}

impl PointBlock for CropAmplitude {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let value = |level: i32| levels::from_level(level as f32);
        Ok(Self { lower: value(params.lower), upper: value(params.upper) })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let Self { lower, upper } = *self;
        out.map(inputs, IMAGE, |value| {
            // Not `clamp`, which cannot do with crossed limits.
            let below = if value > upper { upper } else { value };
            if value < lower { lower } else { below }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn crossed_limits_make_two_levels() {
        let image = image_of_levels(4, &[&[0, 99, 100, 255], &[9; 4], &[9; 4]]);
        let trial = Trial::of(&BLOCK).size(4, 1).input(IMAGE, image);
        assert_eq!(trial.levels(0), [50, 99, 100, 200]);
        let trial = trial.int("lower limit", 100).int("upper limit", 20);
        assert_eq!(trial.levels(0), [100, 100, 20, 20]);
        trial.assert_same_bits();
    }
}
