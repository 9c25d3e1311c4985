//! At which age hair is lost, from where it grows in youth and where it grows in old age.
//!
//! Fading the outer region out would thin all hair alike. Instead the inner region grows, and
//! swallows the outer one pixel by pixel; the later a pixel is swallowed, the earlier its hair is
//! lost, for time runs the other way. Hair of the inner region is never lost, T = 1; where there is
//! no outer region there is no hair, T = 0.
//!
//! - eight and octagon: a pixel of generation r of R gets T = (R + 1 - r) / (R + 1), so that the
//!   hair line moves at one speed everywhere. The fronts are those of [`Steps`].
//! - even: T = out / (in + out), of the Euclidean distances to the inner region and to the outside,
//!   so that every stretch of the hair line moves all the time, and all arrive together.
//!
//! Parts of the outer region that the inner one does not reach recede towards their middle:
//! T = e / (E + 1) for the e-th of E generations from the rim (with `even`, for a distance of e).
//! Distances are measured in the texture, which wraps around; seams of texture coordinates cut them.

use ptlib_plugin::{ImageMut, Work, prelude::*};

use super::{
    flood::{Grid, OPEN, OUTSIDE, Steps, inward},
    masks::Masks,
};

const OUTER: usize = 0;
const INNER: usize = 1;

/// The label of pixels that the fronts start from.
const SOURCE: u32 = 1;

choice! {
    /// How the hair line moves.
    Front {
        /// By one pixel in all 8 directions: corners stay corners.
        Eight = "eight",
        /// By one pixel in 4 and in 8 directions by turns: nearly round.
        Octagon = "octagon",
        /// By the share of the way from the outer border to the inner one: all stretches move from
        /// the first year to the last.
        Even = "even",
    }
}

choice! {
    /// What becomes of parts of the outer region without a part of the inner one.
    Islands {
        /// They shrink towards their middle.
        Recede = "recede",
        /// They never have hair.
        Drop = "drop",
    }
}

params! {
    /// Parameters of [`HairTransition`].
    Params {
        /// From which value of a mask on hair may grow. Pictures that were saved with loss need
        /// more than a little, or specks grow hair.
        threshold: float [hard 0.0..=1.0 soft 0.1..=0.9] = 0.5;
        /// How the hair line moves from the outer region to the inner one.
        front: choice [Front] = Front::Eight;
        /// What becomes of parts of the outer region that the inner one does not reach. The front
        /// "even" reaches all, if there is any inner region.
        islands: choice [Islands] = Islands::Recede;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct HairTransition {
    threshold: f32,
    front: Front,
    pub(super) islands: Islands,
    /// The least T of a place with hair: what is stored as 0 would have none.
    pub(super) least: f32,
}

impl Block for HairTransition {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.hair transition",
        name: c"Hair transition",
        category: c"region",
        summary: c"The age at which hair is lost at each place, from its regions in youth and age.",
        inputs: &[
            &input(c"outer", Kind::Image)
                .doc(c"Where hair grows in youth: white, in the red channel."),
            &input(c"inner", Kind::Image)
                .doc(c"Where hair still grows in old age, inside of the outer region."),
        ],
        outputs: &[&output(c"loss age", Planes::Grey)
            .doc(c"0 where hair never grows, 1 where it is never lost, else the age of its loss.")],
        shape: Shape::Whole,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self {
            threshold: math::single(params.threshold),
            front: params.front,
            islands: params.islands,
            least: if setup.is_eight_bit() { 1.0 / 255.0 } else { 0.0 },
        })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let masks = Masks {
            images: [call.image(OUTER)?, call.image(INNER)?],
            threshold: self.threshold,
            counts: Default::default(),
        };
        let (out, work) = call.output_and_work(0)?;
        match self.front {
            Front::Eight => self.by_flood(&masks, Steps::Eight, out, work)?,
            Front::Octagon => self.by_flood(&masks, Steps::Octagon, out, work)?,
            Front::Even => self.by_distance(&masks, out, work)?,
        }
        let [_, _, stray] = masks.counted();
        if stray > 0 {
            work.warn(&format!("{stray} pixels of `inner` lie outside of `outer`: no hair there"));
        }
        Ok(())
    }

    fn memory(_: &Params, width: u32, height: u32) -> u64 {
        Grid::bytes(width, height)
    }
}

impl HairTransition {
    fn by_flood(
        &self,
        masks: &Masks<'_>,
        steps: Steps,
        mut out: ImageMut<'_>,
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let mut grid = Grid::new(
            work,
            masks.size(),
            || Ok(()),
            |(), y, row| {
                masks.count(y);
                masks.write(y, row, |outer, inner| match (outer, inner) {
                    (false, _) => OUTSIDE,
                    (true, false) => OPEN,
                    (true, true) => SOURCE,
                });
            },
        )?;
        let last = grid.flood(SOURCE, steps)?;
        work.report(0.5);
        let all = math::single(f64::from(last) + 1.0);
        for y in 0..out.height() {
            for (pixel, label) in out.row_mut(0, y).iter_mut().zip(grid.row(y as usize)) {
                let loss = (all - label.wrapping_sub(SOURCE).cast_signed() as f32) / all;
                let is_reached = (*label != OUTSIDE) & (*label != OPEN);
                *pixel = if is_reached { loss.max(self.least) } else { 0.0 };
            }
        }
        if grid.open() == 0 || self.islands == Islands::Drop {
            return Ok(());
        }
        if !masks.has_outside() {
            return self.all_rim(out);
        }
        grid.leave_open();
        grid.flood(OUTSIDE, steps)?;
        grid.parts(inward, |x, y, loss| self.put(&mut out, [x, y], loss))
    }

    /// Writes a pixel that has hair.
    pub(super) fn put(&self, out: &mut ImageMut<'_>, [x, y]: [usize; 2], loss: f32) {
        out.row_mut(0, u32::try_from(y).unwrap_or(u32::MAX))[x] = loss.max(self.least);
    }

    /// An outer region without a rim or an inner region: one generation, which is rim and middle.
    pub(super) fn all_rim(&self, mut out: ImageMut<'_>) -> Result<(), BlockError> {
        (0..out.height()).for_each(|y| out.row_mut(0, y).fill(inward(1, 1)));
        Ok(())
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
