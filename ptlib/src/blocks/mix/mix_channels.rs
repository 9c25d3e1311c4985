//! One picture made of channels of three.
//!
//! Specification 2.11.

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {}
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<MixChannels>(About {
    id: "mix channels",
    summary: "Takes red, green and blue from a picture each.",
    inputs: &[input("red", Kind::Image), input("green", Kind::Image), input("blue", Kind::Image)],
    outputs: &[output("image", Planes::Colour)],
    ..About::DEFAULT
});

struct MixChannels;

impl PointBlock for MixChannels {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            out.copy_from_slice(inputs.channel(channel, channel));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn each_channel_comes_from_the_picture_of_its_slot() {
        let trial = Trial::of(&BLOCK)
            .size(2, 1)
            .input(0, image_of_levels(2, &[&[10, 11], &[12, 13], &[14, 15]]))
            .input(1, image_of_levels(2, &[&[20, 21], &[22, 23], &[24, 25]]))
            .input(2, image_of_levels(2, &[&[30, 31]]));
        assert_eq!([0, 1, 2].map(|channel| trial.levels(channel)), [[10, 11], [22, 23], [30, 31]]);
        trial.assert_same_bits();
    }
}
