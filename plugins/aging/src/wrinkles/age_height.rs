//! Ages a height map: between a young one and an old one, where a mask lets it.
//!
//! Masks act on heights, before normals are made of them, so that slopes and parallax agree. Where
//! nothing ages the young map comes out bit for bit: the difference to the old one is not even
//! looked at, since it may be beyond all numbers.

use ptlib_plugin::prelude::*;

const OLD: usize = 0;
const MASK: usize = 1;
const YOUNG: usize = 2;

params! {
    /// Parameters of `age height`.
    Params {
        /// The age: 0 gives the young heights, 1 the old ones, and between them heights change
        /// evenly. Drive it with a slider: nothing else has to be computed anew.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct AgeHeight {
    age: f32,
}

impl Block for AgeHeight {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.age height",
        name: c"Age height",
        category: c"wrinkles",
        summary: c"Deepens wrinkles with age: between young heights and old ones, under a mask.",
        inputs: &[
            &input(c"old", Kind::Image).doc(c"The heights at age 1."),
            &input(c"mask", Kind::Image).optional().doc(
                c"Where and how much skin ages: 0 stays young, 1 ages in full. Without it, all does.",
            ),
            &input(c"young", Kind::Image)
                .optional()
                .doc(c"The heights at age 0. Without it, young skin is flat: 0."),
        ],
        outputs: &[&output(c"image", Planes::Grey).doc(c"The heights at that age.")],
        shape: Shape::Point,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { age: math::single(params.age) })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let old = call.image(OLD)?;
        let [mask, young] = [MASK, YOUNG].map(|input| call.optional_image(input));
        let mut out = call.output(0)?;
        for y in 0..out.height() {
            let [mask, young] = [mask, young].map(|image| image.map(|image| image.row(0, y)));
            self.age_row(out.row_mut(0, y), old.row(0, y), mask, young);
        }
        Ok(())
    }
}

impl AgeHeight {
    /// Writes a row. Each case has a loop of its own, and they vectorise: as long as this stays a
    /// function, the compiler knows that the output is none of the inputs.
    #[inline(never)]
    fn age_row(&self, out: &mut [f32], old: &[f32], mask: Option<&[f32]>, young: Option<&[f32]>) {
        let age = self.age;
        let out = out.iter_mut().zip(old);
        match (mask, young) {
            (None, None) => out.for_each(|(out, &old)| *out = aged(0.0, old, age)),
            (None, Some(young)) => {
                out.zip(young).for_each(|((out, &old), &young)| *out = aged(young, old, age));
            }
            (Some(mask), None) => {
                out.zip(mask).for_each(|((out, &old), &mask)| *out = aged(0.0, old, age * mask));
            }
            (Some(mask), Some(young)) => {
                let all = out.zip(mask).zip(young);
                all.for_each(|(((out, &old), &mask), &young)| *out = aged(young, old, age * mask));
            }
        }
    }
}

/// The height between a young and an old one.
#[inline(always)]
fn aged(young: f32, old: f32, weight: f32) -> f32 {
    let aged = young + (old - young) * weight;
    if weight == 0.0 { young } else { aged }
}

#[cfg(test)]
mod tests {
    use ptlib::{ComputeOptions, params::ParamValue};

    use super::*;
    use crate::testing;

    /// The height of a pixel of constant images, of which `None` is not connected.
    fn height(age: f64, levels: [Option<i32>; 3]) -> f32 {
        let engine = testing::engine();
        let mut graph = engine.new_graph();
        let block = graph.add("aging.age height").unwrap();
        graph.set(block, "age", ParamValue::Float(age)).unwrap();
        for (level, input) in levels.into_iter().zip(0..) {
            let Some(level) = level else { continue };
            let fill = graph.add("color fill").unwrap();
            graph.set(fill, "red", ParamValue::Int(level)).unwrap();
            graph.connect(fill, 0, block, input).unwrap();
        }
        let options = ComputeOptions { size: Some((4, 4)), ..Default::default() };
        let image = engine.compute(&graph, block, 0, options).unwrap();
        assert!(image.channel(0).iter().all(|value| *value == image.channel(0)[0]));
        image.channel(0)[0]
    }

    fn row(age: f32, old: f32, mask: Option<f32>, young: Option<f32>) -> f32 {
        let mut out = [f32::NAN; 5];
        let [mask, young] = [mask, young].map(|value| value.map(|value| [value; 5]));
        let [mask, young] = [&mask, &young].map(|value| value.as_ref().map(|row| &row[..]));
        AgeHeight { age }.age_row(&mut out, &[old; 5], mask, young);
        assert!(out.iter().all(|value| value.to_bits() == out[0].to_bits()));
        out[0]
    }

    #[test]
    fn the_example_of_the_specification() {
        assert!((row(0.25, 0.8, Some(0.5), Some(0.2)) - 0.275).abs() < 1e-7);
    }

    #[test]
    fn all_inputs_count_where_they_are_connected() {
        // Levels of 255: 51 is 0.2, 204 is 0.8, 102 is 0.4.
        let [young, old, mask] = [Some(51), Some(204), Some(102)];
        for (levels, expected) in [
            ([old, None, None], 0.2),
            ([old, mask, None], 0.08),
            ([old, None, young], 0.35),
            ([old, mask, young], 0.26),
        ] {
            let height = height(0.25, levels);
            assert!((height - expected).abs() < 1e-6, "{levels:?}: {height} for {expected}");
        }
        assert_eq!(height(0.0, [old, mask, young]).to_bits(), 0.2_f32.to_bits());
        assert_eq!(height(1.0, [old, None, None]).to_bits(), 0.8_f32.to_bits());
    }

    #[test]
    fn what_does_not_age_stays_young_bit_for_bit() {
        let numbers = [0.0, -0.0, 0.3, 1.0, 1e-45, -2.5, f32::MAX, f32::MIN];
        for young in numbers {
            for old in numbers {
                for (age, mask) in [(0.0, 1.0), (1.0, 0.0), (0.5, -0.0), (0.0, f32::MAX)] {
                    let aged = row(age, old, Some(mask), Some(young));
                    assert_eq!(aged.to_bits(), young.to_bits(), "{young} to {old}");
                }
                assert_eq!(row(0.0, old, None, Some(young)).to_bits(), young.to_bits());
            }
        }
        assert_eq!(row(0.0, f32::MAX, None, None).to_bits(), 0);
    }

    #[test]
    fn the_old_heights_come_out_at_the_end() {
        for old in [0.0, 0.3, 0.7, 1.0] {
            assert_eq!(row(1.0, old, None, None), old);
            assert_eq!(row(1.0, old, Some(1.0), Some(0.0)), old);
        }
    }
}
