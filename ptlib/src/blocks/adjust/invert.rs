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
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        out.map(inputs, IMAGE, |value| 1.0 - value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn levels_are_mirrored() {
        let image = image_of_levels(2, &[&[0, 255, 200, 1]]);
        let trial = Trial::of(&BLOCK).size(2, 2).input(IMAGE, image);
        assert_eq!(trial.levels(0), [255, 0, 55, 254]);
        trial.assert_same_bits();
    }
}
