//! Red, green and blue made lighter or darker, each by an amount of its own.
//!
//! Specification 2.12.

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What is added to red. Sums below 0 or above 255 become 0 or 255.
        red: int [hard -255..=255 soft -255..=255 unit "levels of 255"] = 0;
        /// What is added to green.
        green: int [hard -255..=255 soft -255..=255 unit "levels of 255"] = 0;
        /// What is added to blue.
        blue: int [hard -255..=255 soft -255..=255 unit "levels of 255"] = 0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<AdjustRgb>(About {
    id: "adjust rgb",
    summary: "Adds an amount to each of red, green and blue.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Colour)],
    ..About::DEFAULT
});

struct AdjustRgb {
    amounts: [f32; 3],
}

impl PointBlock for AdjustRgb {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let amounts = [params.red, params.green, params.blue];
        Ok(Self { amounts: amounts.map(|amount| levels::from_level(convert::level(amount))) })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for ((out, values), amount) in out.iter_mut().zip(inputs.rgb(IMAGE)).zip(self.amounts) {
            for (out, value) in out.iter_mut().zip(values) {
                *out = value + amount;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn sums_are_exact_and_clamped() {
        let levels: Vec<u8> = (0..=255).collect();
        let image = image_of_levels(256, &[&levels]);
        for amounts in [[40, -30, 5], [0, 255, -255], [1, -1, 128]] {
            let trial = Trial::of(&BLOCK)
                .size(256, 1)
                .input(IMAGE, image.clone())
                .int("red", amounts[0])
                .int("green", amounts[1])
                .int("blue", amounts[2]);
            for (channel, amount) in amounts.into_iter().enumerate() {
                let sum = |level: &u8| convert::clamped_byte(i32::from(*level) + amount);
                let expected: Vec<u8> = levels.iter().map(sum).collect();
                assert_eq!(trial.levels(channel), expected, "{amount}");
            }
            trial.assert_same_bits();
        }
    }
}
