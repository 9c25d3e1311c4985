//! One colour everywhere.
//!
//! Specification 2.2.

// Pictured: `red` `210`, `green` `80`, `blue` `40`.
// Pictured: `red` `40`, `green` `90`, `blue` `160`.

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Red, from 0 (none) to 255.
        red: int [hard 0..=255 soft 0..=255] = 255;
        /// Green, from 0 (none) to 255.
        green: int [hard 0..=255 soft 0..=255] = 255;
        /// Blue, from 0 (none) to 255. Equal red, green and blue give a grey image.
        blue: int [hard 0..=255 soft 0..=255] = 255;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<ColorFill>(About {
    id: "color fill",
    summary: "One colour everywhere.",
    outputs: &[output("image", Planes::ByParameters)],
    ..About::DEFAULT
});

/// Red, green, blue.
struct ColorFill([f32; 3]);

impl PointBlock for ColorFill {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self(
            [params.red, params.green, params.blue]
                .map(|level| levels::from_level(convert::level(level))),
        ))
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (plane, value) in out.iter_mut().zip(self.0) {
            plane.fill(value);
        }
    }

    fn is_grey(params: &Params) -> bool {
        params.red == params.green && params.green == params.blue
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    #[test]
    fn every_pixel_has_the_colour() {
        let trial = Trial::of(&BLOCK).size(3, 2).int("red", 200).int("green", 17).int("blue", 99);
        assert_eq!(trial.levels(0), [200; 6]);
        assert_eq!(trial.levels(1), [17; 6]);
        assert_eq!(trial.levels(2), [99; 6]);
        trial.assert_same_bits();
    }

    #[test]
    fn equal_channels_give_a_grey_image() {
        let trial = Trial::of(&BLOCK).int("red", 8).int("green", 8).int("blue", 8);
        assert!(trial.image().is_grey());
        assert!(!trial.int("blue", 9).image().is_grey());
    }
}
