//! A plug-in of the tests: blocks that work, and blocks that fail in each way.

mod hair;
mod values;

use ptlib_plugin::prelude::*;

use hair::{Grow, Roots};
use values::{Faulty, Head, Tint};

/// The negative of an image: the fastest that a block can be.
pub struct Invert;

impl Block for Invert {
    type Params = ();

    const ABOUT: About = About {
        id: c"ptlib-rust.invert",
        category: c"adjust",
        summary: c"The negative of an image.",
        inputs: &[&input(c"image", Kind::Image)],
        outputs: &[&output(c"image", Planes::AsInput(0))],
        ..About::DEFAULT
    };

    fn prepare((): &(), _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self)
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let image = call.image(0)?;
        let mut out = call.output(0)?;
        for channel in 0..out.channels() {
            for y in 0..out.height() {
                let row = out.row_mut(channel, y).iter_mut().zip(image.row(channel, y));
                row.for_each(|(out, value)| *out = 1.0 - value);
            }
        }
        Ok(())
    }
}

choice! {
    /// Where a block fails.
    Where {
        /// Nowhere.
        Nowhere = "nowhere",
        /// In `prepare`, with an error.
        Prepare = "prepare",
        /// In `prepare`, with a panic.
        PreparePanic = "prepare panic",
        /// In `compute`, with an error.
        Compute = "compute",
        /// In `compute`, with a panic.
        ComputePanic = "compute panic",
        /// In a task of `compute`, with a panic.
        TaskPanic = "task panic",
    }
}

params! {
    /// Parameters of the block that fails.
    FailParams {
        /// Where it fails.
        place "where": choice [Where] = Where::Nowhere;
        /// What it says then.
        words: text = "as it was asked to";
        /// The grey that it gives where it does not fail.
        grey: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.25;
        /// Something whole, which does nothing.
        count "number of things": int [hard -5..=100 soft 0..=50 unit "px"] = 5;
        /// Whether what it gives is not a number.
        strange: bool = false;
    }
}

/// A block that fails where it is asked to.
pub struct Fail(FailParams);

impl Block for Fail {
    type Params = FailParams;

    const ABOUT: About = About {
        id: c"ptlib-rust.fail",
        name: c"Failing",
        category: c"testing",
        summary: c"A grey image, or an error.",
        outputs: &[&output(c"image", Planes::Grey)],
        ..About::DEFAULT
    };

    fn prepare(params: &FailParams, _: &Setup<'_>) -> Result<Self, BlockError> {
        match params.place {
            Where::Prepare => Err(BlockError::invalid(&*params.words)),
            Where::PreparePanic => panic!("{}", params.words),
            _ => Ok(Self(params.clone())),
        }
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        match self.0.place {
            Where::Compute => return Err(BlockError::from(&*self.0.words)),
            Where::ComputePanic => panic!("{}", self.0.words),
            Where::TaskPanic => call.work().parallel(3, |_| panic!("{}", self.0.words))?,
            _ => {}
        }
        let value = if self.0.strange { f32::NAN } else { math::single(self.0.grey) };
        let mut out = call.output(0)?;
        (0..out.height()).for_each(|y| out.row_mut(0, y).fill(value));
        Ok(())
    }
}

export_plugin! {
    id: c"ptlib-rust",
    name: c"Rust blocks of the tests",
    vendor: c"The tests of ptlib",
    license: c"MIT OR Apache-2.0",
    blocks: [Invert, Fail, Roots, Grow, Faulty, Tint],
    inputs: [Head],
}
