//! A block with many kinds of parameters and outputs of two kinds.

use crate::block::prelude::*;

choice! {
    /// What the picture looks like.
    Look {
        /// One plane of the level.
        Grey = "grey",
        /// Red has the level, green none, blue half of it.
        Colour = "colour",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Changes nothing.
        count: int [hard -5..=1000 soft 0..=10 unit "things"] = 3;
        /// The level of the picture.
        level: float [hard 0.0..=1.0 soft 0.25..=0.75] = 0.5;
        /// Makes it black.
        off "is off": bool = false;
        /// What it looks like.
        look: choice [Look] = Look::Grey;
        /// What the second output gives.
        note: text = "nothing";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<Parameters>(About {
    id: "test parameters",
    summary: "One level everywhere, and a text.",
    inputs: &[input("text", Kind::Text).optional()],
    outputs: &[
        output("image", Planes::ByParameters),
        output("note", Planes::Grey).of_kind(Kind::Text),
    ],
    ..About::DEFAULT
});

struct Parameters;

impl WholeBlock for Parameters {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let level = if params.off { 0.0 } else { convert::single(params.level) };
        let mut image = cx.new_image(if Self::is_grey(params) { 1 } else { 3 })?;
        for (plane, level) in image.planes_mut().zip([level, 0.0, level / 2.0]) {
            plane.fill(level);
        }
        Ok(vec![image.into(), params.note.to_string().into()])
    }

    fn is_grey(params: &Params) -> bool {
        params.look == Look::Grey
    }
}
