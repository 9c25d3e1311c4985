//! Two pictures mixed into one.
//!
//! Specification 2.15. Each picture has a weight: at 50 % both count fully, toward 0 % only the
//! first, toward 100 % only the second. An alpha map gives each pixel its own percentage.

use crate::block::prelude::*;

const FIRST: usize = 0;
const SECOND: usize = 1;
const ALPHA: usize = 2;

choice! {
    /// What is done with two weighted values.
    Method {
        /// Their sum.
        Add = "add",
        /// The first minus the second.
        Subtract = "subtract",
        /// Their weighted mean.
        Average = "average",
        /// Their product.
        Multiply = "multiply",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// From 0 (the first picture only) over 50 (both fully) to 100 (the second only). An alpha
        /// map takes its place: black there is 0, white is 100.
        percentage: int [hard 0..=100 soft 0..=100 unit "%"] = 50;
        /// How the pictures are mixed.
        method: choice [Method] = Method::Average;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Mix>(About {
    id: "mix",
    summary: "Mixes two pictures, everywhere alike or as the red channel of an alpha map says.",
    inputs: &[
        input("first", Kind::Image),
        input("second", Kind::Image),
        input("alpha", Kind::Image).optional(),
    ],
    outputs: &[output("image", Planes::Most(&[FIRST, SECOND]))],
    ..About::DEFAULT
});

struct Mix {
    method: Method,
    weights: Weights,
    /// The weights of each whole percentage, for alpha maps in 8-bit precision. Its length is a
    /// power of two so that a masked index needs no check.
    by_percent: Box<[Weights; 128]>,
}

/// What the values of the two pictures are multiplied with.
#[derive(Clone, Copy, Default)]
struct Weights {
    first: Weight,
    second: Weight,
}

/// A factor, and what is added to the product before it is stored.
///
/// Many products of a weight and a level are whole numbers, but the weight in double precision is
/// a little less or a little more, and then so is the product. Single precision cannot hold that;
/// `lean` makes up for it where the specified arithmetic ends below a level.
#[derive(Clone, Copy, Default)]
struct Weight {
    factor: f32,
    lean: f32,
}

impl PointBlock for Mix {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let mut by_percent = Box::new([Weights::default(); 128]);
        for (percent, weights) in (0..=100).zip(by_percent.iter_mut()) {
            *weights = Weights::of_percent::<L>(percent);
        }
        let weights = Weights::of_percent::<L>(params.percentage);
        Ok(Self { method: params.method, weights, by_percent })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        match self.method {
            Method::Add => self.mix::<L>(inputs, out, |a, b, _| a + b),
            Method::Subtract => self.mix::<L>(inputs, out, |a, b, _| a - b),
            Method::Average => self.mix::<L>(inputs, out, |a, b, weights| {
                (a + b) / (weights.first.factor + weights.second.factor)
            }),
            Method::Multiply => self.mix::<L>(inputs, out, |a, b, weights| {
                (a + weights.first.missing::<L>()) * (b + weights.second.missing::<L>())
            }),
        }
    }
}

impl Mix {
    /// Writes `method` of the weighted values, which gets the weights too.
    #[inline(always)]
    fn mix<L: Levels>(
        &self,
        inputs: &InputRows<'_>,
        out: &mut OutputRow<'_>,
        method: impl Fn(f32, f32, Weights) -> f32,
    ) {
        let mixed = |first: f32, second: f32, weights: Weights| {
            let (a, b) = (weights.first.of::<L>(first), weights.second.of::<L>(second));
            method(a, b, weights)
        };
        for (channel, out) in out.iter_mut().enumerate() {
            let first = inputs.channel(FIRST, channel);
            let second = inputs.channel(SECOND, channel);
            let pixels = out.iter_mut().zip(first).zip(second);
            if inputs.is_connected(ALPHA) {
                for (((out, first), second), alpha) in pixels.zip(inputs.channel(ALPHA, 0)) {
                    *out = mixed(*first, *second, self.weights_of_alpha::<L>(*alpha));
                }
            } else {
                let weights = self.weights;
                for ((out, first), second) in pixels {
                    *out = mixed(*first, *second, weights);
                }
            }
        }
    }

    #[inline(always)]
    fn weights_of_alpha<L: Levels>(&self, alpha: f32) -> Weights {
        if L::EIGHT_BIT {
            // Levels k/255 miss whole percentages by rounding only, and others by 1/51 and more.
            self.by_percent[convert::truncate_masked(alpha * 100.0 + 0.001, 127)]
        } else {
            Weights {
                first: Weight { factor: (2.0 - 2.0 * alpha).min(1.0), lean: 0.0 },
                second: Weight { factor: (2.0 * alpha).min(1.0), lean: 0.0 },
            }
        }
    }
}

impl Weights {
    fn of_percent<L: Levels>(percent: i32) -> Self {
        let share = f64::from(percent) / 100.0;
        Self {
            first: Weight::new::<L>(2.0 * (1.0 - share), 200 - 2 * percent),
            second: Weight::new::<L>(2.0 * share, 2 * percent),
        }
    }
}

impl Weight {
    /// The weight `factor`, which stands for `percent` % but for rounding; never more than 100 %.
    fn new<L: Levels>(factor: f64, percent: i32) -> Self {
        let falls_short = L::EIGHT_BIT && percent < 100 && factor < f64::from(percent) / 100.0;
        let lean = if falls_short { -levels::from_level(1.0 / 256.0) } else { 0.0 };
        Self { factor: convert::single(factor.min(1.0)), lean }
    }

    #[inline(always)]
    fn of<L: Levels>(self, value: f32) -> f32 {
        if L::EIGHT_BIT { L::store(value * self.factor + self.lean) } else { value * self.factor }
    }

    /// What a product gets instead of the part of a value that the weight takes away.
    #[inline(always)]
    fn missing<L: Levels>(self) -> f32 {
        L::store(1.0 - self.factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    const METHODS: [u32; 4] = [0, 1, 2, 3];

    fn trial(first: &[u8], second: &[u8], percentage: i32, method: u32) -> Trial {
        let width = u32::try_from(first.len()).unwrap();
        Trial::of(&BLOCK)
            .size(width, 1)
            .input(FIRST, image_of_levels(width, &[first]))
            .input(SECOND, image_of_levels(width, &[second]))
            .int("percentage", percentage)
            .choice("method", method)
    }

    #[test]
    fn follows_the_vectors_of_the_specification() {
        let expected = [
            [[215, 160, 170], [230, 220, 255], [109, 159, 255]],
            [[185, 40, 0], [170, 0, 0], [49, 0, 0]],
            [[143, 106, 113], [115, 110, 145], [77, 113, 185]],
            [[111, 73, 48], [23, 47, 47], [27, 90, 161]],
        ];
        for (method, expected) in METHODS.into_iter().zip(expected) {
            for (percentage, expected) in [25, 50, 80].into_iter().zip(expected) {
                let trial = trial(&[200, 100, 50], &[30, 120, 240], percentage, method);
                assert_eq!(trial.levels(0), expected, "method {method}, {percentage} %");
                trial.assert_same_bits();
            }
        }
    }

    #[test]
    fn an_alpha_map_is_a_percentage_for_each_pixel() {
        let (first, second) = ([200; 256], [80; 256]);
        let alpha: Vec<u8> = (0..=255).collect();
        for method in METHODS {
            let mapped = trial(&first, &second, 50, method)
                .input(ALPHA, image_of_levels(256, &[&alpha, &[0; 256], &[0; 256]]));
            mapped.assert_same_bits();
            let mapped = mapped.levels(0);
            for (alpha, level) in alpha.iter().zip(&mapped) {
                let percentage = i32::from(*alpha) * 100 / 255;
                let expected = trial(&first, &second, percentage, method).levels(0)[0];
                assert_eq!(*level, expected, "alpha {alpha}, method {method}");
            }
        }
    }

    #[test]
    fn alpha_leads_from_one_picture_to_the_other_without_steps() {
        let alpha: Vec<u8> = (0..=255).collect();
        let trial = trial(&[255; 256], &[0; 256], 50, 2);
        let image = trial.input(ALPHA, image_of_levels(256, &[&alpha])).image();
        let values = image.channel(0);
        assert_eq!((values[0], values[255]), (1.0, 0.0));
        assert!(values.windows(2).all(|pair| pair[0] > pair[1] && pair[0] - pair[1] < 0.01));
    }

    #[test]
    fn grey_and_colour_make_colour() {
        let trial = Trial::of(&BLOCK)
            .size(1, 1)
            .input(FIRST, image_of_levels(1, &[&[10]]))
            .input(SECOND, image_of_levels(1, &[&[20], &[30], &[41]]));
        assert_eq!([0, 1, 2].map(|channel| trial.levels(channel)[0]), [15, 20, 25]);
    }
}
