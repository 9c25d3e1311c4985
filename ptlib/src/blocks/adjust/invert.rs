//! Inverted values: white becomes black.
//!
//! Specification 2.26.

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {}
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Invert>(About {
    id: "invert",
    summary: "White becomes black and black white, in each channel.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::As(IMAGE))],
    ..About::DEFAULT
});

struct Invert;

impl PointBlock for Invert {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        out.map(inputs, IMAGE, |value| 1.0 - value);
    }
}
