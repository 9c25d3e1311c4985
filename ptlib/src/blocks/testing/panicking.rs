//! A block with a defect: it panics.

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Panic before the first row instead of in each row.
        early: bool = false;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Panicking>(About {
    id: "test panic",
    summary: "Panics.",
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});

struct Panicking;

impl PointBlock for Panicking {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        assert!(!params.early, "test panic before the first row");
        Ok(Self)
    }

    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, _: &mut OutputRow<'_>) {
        panic!("test panic in row {}", cx.y);
    }
}
