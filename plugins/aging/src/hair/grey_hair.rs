//! Colours hairs by age: each begins to turn grey at an age of its own, and is grey when it is
//! lost.
//!
//! The onset of a hair that is lost at age a is a·lerp(from, to, random), so no hair falls out
//! before it has turned grey, unless that is asked for. At age 0 every hair has the base colour,
//! bit for bit.

use ptlib_plugin::{
    AnyStream,
    prelude::*,
    stream::{COLOR, LOSS_AGE, RANDOM},
};

choice! {
    /// When a hair is all grey.
    Completes {
        /// When it is lost: every hair turns grey before it falls out.
        AtLoss = "at loss",
        /// At age 1: hairs that are lost early were not all grey.
        AtOne = "at age 1",
    }
}

choice! {
    /// How a hair turns grey between the onset and the end.
    Curve {
        /// Evenly.
        Linear = "linear",
        /// Slowly at first and at last.
        Smooth = "smooth",
    }
}

params! {
    /// Parameters of `grey hair`.
    Params {
        /// The age: 0 gives every hair the base colour.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.5;
        /// Red of young hair.
        base_red "base color red": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.3;
        /// Green of young hair.
        base_green "base color green": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.2;
        /// Blue of young hair.
        base_blue "base color blue": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.1;
        /// Red of grey hair.
        grey_red "grey color red": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.75;
        /// Green of grey hair.
        grey_green "grey color green": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.75;
        /// Blue of grey hair.
        grey_blue "grey color blue": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.78;
        /// When the first hairs begin to turn grey, as a part of the age at which they are lost. 0
        /// is from birth, 1 never. If it is above `onset to`, the two change places.
        onset_from "onset from": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.25;
        /// When the last hairs begin to turn grey, as a part of the age at which they are lost.
        onset_to "onset to": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.75;
        /// When a hair is all grey.
        completes: choice [Completes] = Completes::AtLoss;
        /// How a hair turns grey between the onset and the end.
        curve: choice [Curve] = Curve::Linear;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct GreyHair {
    age: f32,
    base: [f32; 3],
    grey: [f32; 3],
    onset: [f32; 2],
    completes: Completes,
    curve: Curve,
}

impl Block for GreyHair {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.grey hair",
        name: c"Grey hair",
        category: c"hair",
        summary: c"Colours hairs by age: they turn grey before they are lost.",
        inputs: &[&input(c"points", Kind::Points)
            .doc(c"Roots of hairs, with the age at which each is lost and a random number.")],
        outputs: &[&output(c"points", Planes::Grey)
            .of_kind(Kind::Points)
            .doc(c"The same, with a colour.")],
        shape: Shape::Whole,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        let [from, to] = [params.onset_from, params.onset_to].map(math::single);
        Ok(Self {
            age: math::single(params.age),
            base: [params.base_red, params.base_green, params.base_blue].map(math::single),
            grey: [params.grey_red, params.grey_green, params.grey_blue].map(math::single),
            onset: [from.min(to), from.max(to)],
            completes: params.completes,
            curve: params.curve,
        })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let points = call.points(0)?;
        let streams = points.streams();
        let (ages, randoms) = (streams.need(LOSS_AGE)?, streams.need(RANDOM)?);
        // All that the input has is shared, but a colour, which is replaced.
        let others: Vec<AnyStream<'_>> =
            streams.iter().filter(|stream| stream.id() != c"color").collect();
        let mut colored = call.new_points(0, points.count(), (others, COLOR))?;
        colored.fill(|first, (_, colors)| {
            let last = first + colors.len();
            match (ages.as_slice(), randoms.as_slice()) {
                (Some(ages), Some(randoms)) => {
                    let hairs = ages[first..last].iter().zip(&randoms[first..last]);
                    for (color, (age, random)) in colors.iter_mut().zip(hairs) {
                        *color = self.color(*age, *random);
                    }
                }
                _ => {
                    for (color, i) in colors.iter_mut().zip(first..) {
                        *color = self.color(ages.get(i), randoms.get(i));
                    }
                }
            }
            Ok(())
        })?;
        colored.finish()
    }
}

impl GreyHair {
    /// The colour of a hair.
    #[inline(always)]
    fn color(&self, loss: f32, random: f32) -> [f32; 3] {
        let y = self.greyness(loss, random);
        std::array::from_fn(|c| (self.base[c] * (1.0 - y) + self.grey[c] * y).min(1.0))
    }

    /// How grey it is, 0 to 1.
    #[inline(always)]
    fn greyness(&self, loss: f32, random: f32) -> f32 {
        let [from, to] = self.onset;
        let onset = loss * (from * (1.0 - random) + to * random);
        let end = if self.completes == Completes::AtLoss { loss } else { 1.0 };
        let part = ((self.age - onset) / (end - onset)).clamp(0.0, 1.0);
        let step = if self.age >= end && self.age > 0.0 { 1.0 } else { 0.0 };
        let y = if end > onset { part } else { step };
        if self.curve == Curve::Smooth { y * y * (3.0 - 2.0 * y) } else { y }
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{ErrorKind, params::ParamValue, value::Value};

    use super::*;
    use crate::hair::testing::{self, Scene, floats};

    const YOUNG: [f32; 3] = [0.3, 0.2, 0.1];

    fn block(age: f32, onset: f32, completes: Completes) -> GreyHair {
        let grey = [0.75, 0.75, 0.78];
        let onset = [onset; 2];
        GreyHair { age, base: YOUNG, grey, onset, completes, curve: Curve::Linear }
    }

    fn near<const N: usize>(found: [f32; N], expected: [f32; N]) {
        let is_near =
            found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-5);
        assert!(is_near, "{found:?}, {expected:?}");
    }

    #[test]
    fn hair_of_the_thesis_turns_grey_until_age_1() {
        let times = [0.3, 0.5, 0.6, 0.75, 1.0];
        let at = |onset| times.map(|age| block(age, onset, Completes::AtOne).greyness(1.0, 0.5));
        near(at(0.25), [0.066_667, 0.333_333, 0.466_667, 0.666_667, 1.0]);
        near(at(0.5), [0.0, 0.0, 0.2, 0.5, 1.0]);
        near(at(0.75), [0.0, 0.0, 0.0, 0.0, 1.0]);
        // Onset .3 of a hair that is lost at .6: not all grey when it is lost.
        near([block(0.6, 0.5, Completes::AtOne).greyness(0.6, 0.0)], [0.428_571]);
    }

    #[test]
    fn hair_turns_grey_until_it_is_lost() {
        let at =
            [0.2, 0.45, 0.5, 0.6].map(|age| block(age, 0.5, Completes::AtLoss).greyness(0.6, 0.0));
        near(at, [0.0, 0.5, 0.666_667, 1.0]);
        let mut block = block(0.5, 0.5, Completes::AtLoss);
        near(block.color(0.6, 0.0), [0.6, 0.566_667, 0.553_333]);
        block.curve = Curve::Smooth;
        near([block.greyness(0.6, 0.0)], [0.740_741]);
        near(block.color(0.6, 0.0), [0.633_333, 0.607_407, 0.603_704]);
    }

    #[test]
    fn an_onset_at_the_end_is_a_step_and_age_0_is_young() {
        let step = |age| block(age, 1.0, Completes::AtLoss).greyness(0.5, 0.3);
        assert_eq!([0.49, 0.5, 0.6].map(step), [0.0, 1.0, 1.0]);
        for loss in [0.0, 1e-30, 0.5, 1.0] {
            for onset in [0.0, 0.5, 1.0] {
                for completes in [Completes::AtLoss, Completes::AtOne] {
                    let color = block(0.0, onset, completes).color(loss, 0.7);
                    assert_eq!(color.map(f32::to_bits), YOUNG.map(f32::to_bits));
                }
            }
        }
    }

    fn grey(points: Value, set: &[(&str, f64)]) -> Result<Value, ptlib::Error> {
        let mut scene = Scene::of_points(points);
        let block = scene.behind("aging.grey hair", scene.source);
        for (name, value) in set {
            scene.graph.set(block, name, ParamValue::Float(*value)).unwrap();
        }
        scene.value(block)
    }

    #[test]
    fn all_streams_stay_and_the_onset_may_be_given_backwards() {
        let points = testing::points(&[1.0, 0.8, 0.3]);
        let once = grey(points.clone(), &[("age", 0.6)]).unwrap();
        let swapped = [("age", 0.6), ("onset from", 0.75), ("onset to", 0.25)];
        assert_eq!(grey(points.clone(), &swapped).unwrap().content(), once.content());
        let (Value::Points(before), Value::Points(after)) = (&points, &once) else {
            panic!("points")
        };
        assert_eq!(after.streams().len(), before.streams().len() + 1);
        for stream in before.streams() {
            // The same memory.
            let found = after.stream(stream.id()).unwrap();
            assert_eq!(found.data().as_ptr(), stream.data().as_ptr(), "{}", stream.id());
        }
        // A colour that is there is replaced.
        let young = grey(once, &[("age", 0.0)]).unwrap();
        assert!(floats(&young, "color").iter().all(|color| color[..] == YOUNG));
    }

    #[test]
    fn one_age_serves_all_and_threads_do_not_matter() {
        let points = testing::equal_points(10_000, 0.5);
        let mut scene = Scene::of_points(points);
        let block = scene.behind("aging.grey hair", scene.source);
        scene.graph.set(block, "age", ParamValue::Float(0.25)).unwrap();
        let first = scene.value_on(block, 1).unwrap();
        let colors = floats(&first, "color");
        let mut expected = super::tests::block(0.25, 0.0, Completes::AtLoss);
        expected.onset = [0.25, 0.75];
        for (i, color) in [(0, &colors[0]), (8192, &colors[8192])] {
            let random = f32::from(u16::try_from(i).unwrap()) / 65_536.0;
            assert_eq!(color[..], expected.color(0.5, random));
        }
        for threads in [2, 3, 8] {
            assert_eq!(scene.value_on(block, threads).unwrap().content(), first.content());
        }
    }

    #[test]
    fn what_is_missing_is_named_and_none_is_no_fault() {
        let error = grey(testing::bare_points(2), &[]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().contains("\"loss age\""), "{error}");
        assert!(floats(&grey(testing::points(&[]), &[]).unwrap(), "color").is_empty());
    }
}
