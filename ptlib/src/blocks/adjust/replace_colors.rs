//! Up to four colours of a picture replaced, each by the same place of another picture.
//!
//! Specification 2.9. Colours are compared as levels of 255 in both precisions: a value between
//! two levels counts as the lower one, as it would be stored in 8-bit precision. A fifth colour,
//! which PT Designer compared without ever setting it (BUG), does not exist here.

// Pictured with `square mosaic`: `fill colors` `255,170,85,1`.
// Pictured: `color 2 red` `1`, `color 2 green` `1`, `color 2 blue` `1`.
// Pictured: `color 1 red` `1`, `color 1 green` `1`, `color 1 blue` `1`.

use crate::block::prelude::*;

const IMAGE: usize = 0;
const COLORS: usize = 4;

/// Pixels whose colours are compared together.
const PIECE: usize = 128;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Red of the first colour to replace. Where two colours are equal, the first one counts.
        red1 "color 1 red": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 255;
        /// Green of the first colour to replace.
        green1 "color 1 green": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 255;
        /// Blue of the first colour to replace.
        blue1 "color 1 blue": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 255;
        /// Red of the second colour to replace.
        red2 "color 2 red": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 0;
        /// Green of the second colour to replace.
        green2 "color 2 green": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 0;
        /// Blue of the second colour to replace.
        blue2 "color 2 blue": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 0;
        /// Red of the third colour to replace.
        red3 "color 3 red": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 170;
        /// Green of the third colour to replace.
        green3 "color 3 green": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 170;
        /// Blue of the third colour to replace.
        blue3 "color 3 blue": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 170;
        /// Red of the fourth colour to replace.
        red4 "color 4 red": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 85;
        /// Green of the fourth colour to replace.
        green4 "color 4 green": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 85;
        /// Blue of the fourth colour to replace.
        blue4 "color 4 blue": int [hard 0..=255 soft 0..=255 unit "level of 255"] = 85;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<ReplaceColors>(About {
    id: "replace colors",
    summary: "Shows other pictures wherever a picture has one of four colours.",
    inputs: &[
        input("image", Kind::Image),
        input("color 1", Kind::Image).optional(),
        input("color 2", Kind::Image).optional(),
        input("color 3", Kind::Image).optional(),
        input("color 4", Kind::Image).optional(),
    ],
    outputs: &[output("image", Planes::Most(&[0, 1, 2, 3, 4]))],
    ..About::DEFAULT
});

struct ReplaceColors {
    /// The colours, in levels.
    colors: [[f32; 3]; COLORS],
}

impl PointBlock for ReplaceColors {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let colors = [
            [params.red1, params.green1, params.blue1],
            [params.red2, params.green2, params.blue2],
            [params.red3, params.green3, params.blue3],
            [params.red4, params.green4, params.blue4],
        ];
        Ok(Self { colors: colors.map(|color| color.map(convert::level)) })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            out.copy_from_slice(inputs.channel(IMAGE, channel));
        }
        let rgb = inputs.rgb(IMAGE);
        for start in (0..rgb[0].len()).step_by(PIECE) {
            let piece = start..rgb[0].len().min(start + PIECE);
            let found = self.find(rgb.map(|plane| &plane[piece.clone()]));
            for (slot, color) in (1..=COLORS).zip(1..) {
                // Most colours are rare: then the other picture need not be read.
                let is_there = found.iter().fold(false, |any, found| any | (*found == color));
                if !is_there || !inputs.is_connected(slot) {
                    continue;
                }
                for (channel, out) in out.iter_mut().enumerate() {
                    let shown = &inputs.channel(slot, channel)[piece.clone()];
                    for ((out, shown), found) in out[piece.clone()].iter_mut().zip(shown).zip(found)
                    {
                        *out = if found == color { *shown } else { *out };
                    }
                }
            }
        }
    }
}

impl ReplaceColors {
    /// For each pixel the number of its colour, or 0.
    #[inline(always)]
    fn find(&self, rgb: [&[f32]; 3]) -> [i32; PIECE] {
        let mut levels = [[-1.0; PIECE]; 3];
        for (levels, plane) in levels.iter_mut().zip(rgb) {
            for (level, value) in levels.iter_mut().zip(plane) {
                *level = levels::to_level(*value);
            }
        }
        let [red, green, blue] = &levels;
        let mut found = [0; PIECE];
        // From the last colour to the first, which has the last word.
        for (number, color) in [1, 2, 3, 4].into_iter().zip(&self.colors).rev() {
            for (i, found) in found.iter_mut().enumerate() {
                let is_color =
                    (red[i] == color[0]) & (green[i] == color[1]) & (blue[i] == color[2]);
                *found = if is_color { number } else { *found };
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(image: &[&[u8]]) -> Trial {
        let width = u32::try_from(image[0].len()).unwrap();
        Trial::of(&BLOCK).size(width, 1).input(IMAGE, image_of_levels(width, image))
    }

    #[test]
    fn every_level_is_found() {
        let levels: Vec<u8> = (0..=255).collect();
        for level in 0..=255 {
            let trial = trial(&[&levels])
                .input(4, image_of_levels(256, &[&[7; 256], &[8; 256], &[9; 256]]))
                .int("color 4 red", level)
                .int("color 4 green", level)
                .int("color 4 blue", level);
            let mut expected = levels.clone();
            // Colours 1..3 come first and keep what they find.
            if ![0, 170, 255].contains(&level) {
                expected[convert::index(level.into())] = 8;
            }
            assert_eq!(trial.levels(1), expected);
        }
    }

    #[test]
    fn all_three_channels_must_match() {
        let trial = trial(&[&[255, 255, 255, 254], &[255, 254, 255, 255], &[255, 255, 0, 255]])
            .input(1, image_of_levels(4, &[&[1, 2, 3, 4]]));
        assert_eq!(trial.levels(0), [1, 255, 255, 254]);
        assert_eq!(trial.levels(2), [1, 255, 0, 255]);
        trial.assert_same_bits();
    }

    #[test]
    fn the_first_of_equal_colours_counts_connected_or_not() {
        let black = |trial: Trial, k: u32| {
            ["red", "green", "blue"]
                .into_iter()
                .fold(trial, |trial, channel| trial.int(&format!("color {k} {channel}"), 0))
        };
        let trial = black(trial(&[&[0, 255, 85]]), 1);
        let second = trial.clone().input(2, image_of_levels(3, &[&[20; 3]]));
        assert_eq!(second.levels(0), [0, 255, 85]);
        let both = second.input(1, image_of_levels(3, &[&[10; 3]]));
        assert_eq!(both.levels(0), [10, 255, 85]);
    }

    #[test]
    fn values_between_levels_count_as_the_lower_one() {
        let mut image = image_of_levels(3, &[&[0; 3]]);
        let values = [84.999, 85.5, 86.0].map(levels::from_level);
        image.planes_mut().for_each(|plane| plane.copy_from_slice(&values));
        let trial = trial(&[&[0; 3]]).input(IMAGE, image).input(4, image_of_levels(3, &[&[9; 3]]));
        let found = trial.image();
        assert_eq!(found.channel(0)[1], levels::from_level(9.0));
        assert_eq!((found.channel(0)[0], found.channel(0)[2]), (values[0], values[2]));
        trial.assert_same_bits();
    }
}
