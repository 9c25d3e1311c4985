//! A picture without its colours.
//!
//! Specification 2.32: all channels become the luma, which makes white a light grey (Q).

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {}
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Grayscale>(About {
    id: "grayscale",
    summary: "Takes the colours away and leaves how light they are; white becomes a light grey.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});

struct Grayscale;

impl PointBlock for Grayscale {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let [red, green, blue] = inputs.rgb(IMAGE);
        for (((out, red), green), blue) in out.grey().iter_mut().zip(red).zip(green).zip(blue) {
            *out = levels::luma::<L>([*red, *green, *blue]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn greys_follow_the_vectors_of_the_specification() {
        let image = image_of_levels(5, &[&[64, 100, 128, 200, 255]]);
        let trial = Trial::of(&BLOCK).size(5, 1).input(IMAGE, image);
        assert_eq!(trial.levels(0), [59, 93, 119, 186, 237]);
        trial.assert_same_bits();
    }

    #[test]
    fn colours_become_their_luma() {
        let planes: [&[u8]; 3] = [&[255, 0, 0, 10], &[0, 255, 0, 20], &[0, 0, 255, 30]];
        let trial = Trial::of(&BLOCK).size(4, 1).input(IMAGE, image_of_levels(4, &planes));
        assert_eq!(trial.levels(0), [58, 149, 29, 17]);
        let grey = trial.image();
        assert!((grey.channel(0)[0] - 0.229).abs() < 1e-6);
        trial.clone().eight_bit().assert_same_bits();
        trial.assert_same_bits();
    }
}
