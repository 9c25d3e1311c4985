//! Where there is hair at an age, from the ages at which it is lost.
//!
//! A place has hair while its age of loss T has not passed: T ≥ age. T = 0 never has any, T = 1
//! always. With a softness s, hair thins from 1 to 0 while T - age falls from s · age to
//! -s · (1 - age), so that at age 0 all hair is still there and at age 1 all is gone but that of
//! T = 1.

use ptlib_plugin::prelude::*;

const LOSS_AGE: usize = 0;

params! {
    /// Parameters of [`HairMask`].
    Params {
        /// The age: at 0 hair covers the whole outer region, at 1 only the inner one.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.5;
        /// How long a place takes to lose its hair, as a part of life: 0 makes a sharp edge, 1 lets
        /// hair thin out everywhere at once.
        softness: float [hard 0.0..=1.0 soft 0.0..=0.3] = 0.0;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct HairMask {
    age: f32,
    softness: f32,
}

impl Block for HairMask {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.hair mask",
        name: c"Hair mask",
        category: c"region",
        summary: c"Where there is hair at an age: the hair line recedes, and nothing fades.",
        inputs: &[&input(c"loss age", Kind::Image)
            .doc(c"The age at which hair is lost, as `hair transition` makes it.")],
        outputs: &[&output(c"mask", Planes::Grey).doc(c"1 where there is hair, 0 elsewhere.")],
        shape: Shape::Point,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        let [age, softness] = [params.age, params.softness].map(math::single);
        Ok(Self { age, softness })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let loss = call.image(LOSS_AGE)?;
        let mut out = call.output(0)?;
        for y in 0..out.height() {
            let pixels = out.row_mut(0, y).iter_mut().zip(loss.row(0, y));
            if self.softness == 0.0 {
                pixels.for_each(|(out, loss)| *out = self.sharp(*loss));
            } else {
                pixels.for_each(|(out, loss)| *out = self.soft(*loss));
            }
        }
        Ok(())
    }
}

impl HairMask {
    #[inline(always)]
    fn sharp(&self, loss: f32) -> f32 {
        f32::from((loss >= self.age) & (loss > 0.0))
    }

    #[inline(always)]
    fn soft(&self, loss: f32) -> f32 {
        // (T - age·(1 + s)) / s + 1, in the order that rounds to 1 at age 0 and to 0 at age 1.
        let thinned = (loss - self.age) / self.softness + (1.0 - self.age);
        let thinned = thinned.clamp(0.0, 1.0);
        let thinned = if loss >= 1.0 { 1.0 } else { thinned };
        if loss > 0.0 { thinned } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{Image, params::ParamValue};

    use crate::skin::trial;

    fn mask(loss: &Image, age: f64, softness: f64) -> Vec<f32> {
        let params = [("age", ParamValue::Float(age)), ("softness", ParamValue::Float(softness))];
        trial::made("aging.hair mask", &[Some(loss)], &params).channel(0).to_vec()
    }

    #[test]
    fn the_vector_with_softness() {
        let ages = [0.3, 0.5, 1.0, 0.0];
        let loss = trial::picture((4, 1), 1, |_, x, _| ages[x as usize]);
        for (age, expected) in [
            (0.2, [1.0, 1.0, 1.0, 0.0]),
            (0.4, [0.1, 1.0, 1.0, 0.0]),
            (0.5, [0.0, 0.5, 1.0, 0.0]),
            (1.0, [0.0, 0.0, 1.0, 0.0]),
        ] {
            let found = mask(&loss, age, 0.2);
            let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
            assert!(is_near, "{age}: {found:?}, expected {expected:?}");
        }
    }

    #[test]
    fn hair_is_whole_at_age_0_only_inner_at_1_and_never_comes_back() {
        let ages = |x: u32| match x {
            0 => 0.0,
            1 => f32::MIN_POSITIVE,
            199 => 1.0,
            198 => 1.0_f32.next_down(),
            x => x as f32 / 200.0,
        };
        let loss = trial::picture((200, 1), 1, |_, x, _| ages(x));
        for softness in [0.0, 1e-300, 1e-40, 0.01, 0.3, 1.0] {
            let mut last = mask(&loss, 0.0, softness);
            assert!(last[0] == 0.0 && last[1..].iter().all(|value| *value == 1.0));
            for step in 1..=100 {
                let next = mask(&loss, f64::from(step) / 100.0, softness);
                assert!(next.iter().zip(&last).all(|(next, last)| next <= last));
                last = next;
            }
            assert!(last[199] == 1.0 && last[..199].iter().all(|value| *value == 0.0));
        }
    }

    #[test]
    fn threads_and_strips_do_not_matter_at_any_size() {
        for size in trial::SIZES {
            let loss = trial::picture(size, 1, |_, x, y| trial::grain(x, y));
            let soft = [("softness", ParamValue::Float(0.3))];
            trial::same_on_all_threads("aging.hair mask", &[Some(&loss)], &soft);
        }
    }
}
