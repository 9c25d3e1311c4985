//! A result of the graph.
//!
//! Specification 1.3 and 2.28. A graph has any number of results, none of them special. The engine
//! reduces a supersampled image to the graph's size when it delivers a result, so there is nothing
//! left to compute here.

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {}
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<End>(About {
    id: "end",
    summary: "A result of the graph.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::As(IMAGE))],
    role: Role::Result,
    ..About::DEFAULT
});

struct End;

impl PointBlock for End {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        out.map(inputs, IMAGE, |value| value);
    }
}
