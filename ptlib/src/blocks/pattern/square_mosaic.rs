//! Square mosaic: tiles that interlock, as in the pictures of M. C. Escher.
//!
//! Specification 2.34. [`outline`] makes the four sides of a tile fit each other,
//! [`stamps`](super::stamps) puts copies of it side by side. The mosaic is made as a square of the
//! width of the image, which is then stretched to its height.
//!
//! A transformation that does not fit that of another side is an error that names both: PT Designer
//! gave a white image.

use super::{
    outline::{self, Transformation},
    stamps::{Covers, Stamp, TILE, Turn},
};
use crate::block::prelude::*;

choice! {
    /// How the tiles are coloured.
    Fill {
        /// They are white.
        None = "none",
        /// They have colours, and the borders between them are left.
        KeepBorders = "keep borders",
        /// They have colours, and cover the borders.
        NoBorders = "no borders",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// The upper side: pairs of numbers, separated by blanks, each a point of the side, as in
        /// `0.2 0 0.35 0.3 0.5 0`. The first is how far along the side it is, clockwise (0 to 1),
        /// the second how far outside (-0.5 to 0.5).
        side_1 "side 1": text = "";
        /// The right side, as the upper one; as in `0.3 0.2 0.6 -0.2`.
        side_2 "side 2": text = "";
        /// The lower side, as the upper one. Not used if its transformation says what it is.
        side_3 "side 3": text = "";
        /// The left side, as the upper one. Not used if its transformation says what it is.
        side_4 "side 4": text = "";
        /// How the tile above comes from this one.
        transformation_1 "transformation 1": choice [Transformation] = Transformation::HalfTurn;
        /// How the tile on the right comes from this one.
        transformation_2 "transformation 2": choice [Transformation] = Transformation::Shift;
        /// How the tile below comes from this one.
        transformation_3 "transformation 3": choice [Transformation] = Transformation::HalfTurn;
        /// How the tile on the left comes from this one.
        transformation_4 "transformation 4": choice [Transformation] = Transformation::Shift;
        /// How many tiles there are across the image. Even, unless all tiles are only shifted.
        tiles_x "tiles x": int [hard 1..=255 soft 1..=20] = 2;
        /// How many tiles there are down the image: as many as across it.
        tiles_y "tiles y": int [hard 1..=255 soft 1..=20] = 2;
        /// How the tiles are coloured.
        fill "fill type": choice [Fill] = Fill::NoBorders;
        /// The grey levels of the tiles (0 to 255), separated by commas, row by row from the upper
        /// left corner. They are repeated as often as needed.
        colors "fill colors": text = "255,0,0,255";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<SquareMosaic>(About {
    id: "square mosaic",
    summary: "Tiles whose sides interlock.",
    outputs: &[output("image", Planes::Grey)],
    in_pixels: "the width of borders",
    ..About::DEFAULT
});

struct SquareMosaic {
    stamp: Stamp,
    covers: Covers,
    tiles: u32,
    /// How tiles are turned, by odd rows and odd columns.
    turns: [[Turn; 2]; 2],
    fill: Fill,
    colors: Vec<u8>,
}

impl WholeBlock for SquareMosaic {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let transformations = params.transformations();
        outline::check(transformations, params.tiles_x, params.tiles_y)?;
        let texts = [&params.side_1, &params.side_2, &params.side_3, &params.side_4];
        let outline = outline::outline(texts.map(|text| &**text), transformations);
        let side = cx.width;
        let tiles = params.tiles_x.unsigned_abs();
        let mut square = cx.new_image_sized(side, side, 1)?;
        // Tiles without pixels are not stamped.
        let tile = side / tiles;
        let stamp = Stamp::new(&outline, tile.max(1), cx)?;
        let [up, right, ..] = transformations;
        let turn = |odd_row: bool, odd_column: bool| {
            let across = if odd_column { right } else { Transformation::Shift };
            Turn::of(across, if odd_row { up } else { Transformation::Shift })
        };
        let mosaic = Self {
            covers: stamp.covers(side, if tile == 0 { 0 } else { tiles }),
            stamp,
            tiles,
            turns: [false, true].map(|row| [false, true].map(|column| turn(row, column))),
            fill: params.fill,
            colors: params.levels(),
        };
        for plane in square.planes_mut() {
            cx.parallel_pieces(plane, side as usize, |y, out| {
                mosaic.row(y, out);
                cx.check()
            })?;
        }
        if cx.height == side {
            return Ok(vec![square.into()]);
        }
        let linear = Interpolation::Linear.into();
        let resampling = Resampling::new((side, side), (cx.width, cx.height), linear);
        let mut image = cx.new_image(1)?;
        for plane in image.planes_mut() {
            cx.parallel_pieces(plane, side as usize, |y, out| {
                let y = u32::try_from(y).unwrap_or_default();
                resampling.row::<L>(square.channel(0), 0, y, out);
                cx.check()
            })?;
        }
        Ok(vec![image.into()])
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        let stamp = Stamp::bytes_of(width / params.tiles_x.unsigned_abs());
        let covers = u64::from(width) * 64;
        let square = if height == width { 0 } else { Image::bytes_of(width, width, 1) };
        stamp + covers + square + Resampling::bytes_of((width, height))
    }
}

impl Params {
    fn transformations(&self) -> [Transformation; 4] {
        [self.transformation_1, self.transformation_2, self.transformation_3, self.transformation_4]
    }

    /// The levels of the tiles. Q: 0 is the colour of borders, so it becomes 1.
    fn levels(&self) -> Vec<u8> {
        let mut colors = byte_list::parse(&self.colors);
        if colors.is_empty() || self.fill == Fill::None {
            colors = vec![255];
        }
        colors.into_iter().map(|level| level.max(1)).collect()
    }
}

impl SquareMosaic {
    /// Writes row `y` of the square.
    fn row(&self, y: usize, out: &mut [f32]) {
        let mut left = self.colors[0];
        for (x, out) in out.iter_mut().enumerate() {
            let level = self.level(x, y);
            // The borders, and gaps that rounding leaves.
            let level = if level == 0 && self.fill == Fill::NoBorders { left } else { level };
            left = level;
            *out = levels::from_level(f32::from(level));
        }
    }

    /// The level of a pixel before borders are covered.
    fn level(&self, x: usize, y: usize) -> u8 {
        for (row, v) in self.covers.over(y) {
            for (column, u) in self.covers.over(x) {
                let turn = self.turns[(row % 2) as usize][(column % 2) as usize];
                let Some(pixel) = self.stamp.pixel(turn, *u, *v) else { continue };
                if pixel == TILE || self.fill == Fill::NoBorders {
                    let number = (row * self.tiles + column) as usize;
                    return self.colors[number % self.colors.len()];
                }
                return 0;
            }
        }
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    const SIDES: [&str; 4] = ["0.3 0.2 0.6 -0.1", "0.5 0.15 0.8 -0.2", "0.2 0.15", "0.1 0.2"];

    fn trial(transformations: [u32; 4], tiles: i32) -> Trial {
        let mut trial = Trial::of(&BLOCK).size(96, 96).int("tiles x", tiles).int("tiles y", tiles);
        for (i, (side, transformation)) in SIDES.iter().zip(transformations).enumerate() {
            trial = trial.text(&format!("side {}", i + 1), side);
            trial = trial.choice(&format!("transformation {}", i + 1), transformation);
        }
        trial
    }

    const VALID: [[u32; 4]; 8] = [
        [0, 0, 0, 0],
        [1, 0, 1, 0],
        [0, 1, 0, 1],
        [1, 1, 1, 1],
        [2, 2, 2, 2],
        [3, 0, 3, 0],
        [0, 3, 0, 3],
        [3, 3, 3, 3],
    ];

    #[test]
    fn tiles_fill_the_plane_in_equal_parts() {
        for transformations in VALID.into_iter().chain([[1, 3, 1, 3], [3, 1, 3, 1]]) {
            for (tiles, side) in [(2, 48), (4, 24)] {
                let count = usize::try_from(tiles * tiles).unwrap();
                let colors: Vec<_> = (1..=count).map(|color| (color * 9).to_string()).collect();
                let image = trial(transformations, tiles).text("fill colors", &colors.join(","));
                let levels = image.levels(0);
                for color in 1..=count {
                    let area =
                        levels.iter().filter(|level| usize::from(**level) == color * 9).count();
                    // Where tiles meet, whole pixels go to the later one.
                    let expected = side * side;
                    assert!(
                        area.abs_diff(expected) < 6 * side,
                        "{transformations:?}: tile {color} has {area} of {expected} pixels"
                    );
                }
            }
        }
    }

    #[test]
    fn without_colours_only_borders_are_not_white() {
        for fill in [0, 1] {
            let trial =
                trial([1, 0, 1, 0], 4).choice("fill type", fill).text("fill colors", "0,255");
            let mut levels = trial.levels(0);
            levels.sort_unstable();
            levels.dedup();
            assert_eq!(levels, if fill == 0 { vec![0, 255] } else { vec![0, 1, 255] });
        }
        assert_eq!(trial([0; 4], 1).text("fill colors", "").levels(0), [255; 96 * 96]);
    }

    #[test]
    fn what_does_not_fit_is_named() {
        let message = |transformations, tiles| {
            trial(transformations, tiles).compute().unwrap_err().to_string()
        };
        let told = message([0, 0, 1, 0], 4);
        assert!(told.contains("side 1 has \"shift\", so side 3 must have \"shift\" too"), "{told}");
        let told = message([2, 2, 2, 1], 4);
        assert!(told.contains("side 3 has \"quarter turn\", so side 4"), "{told}");
        let told = message([1, 0, 1, 0], 3);
        assert!(told.contains("3 tiles across the image, but turned"), "{told}");
        let uneven = trial([0; 4], 3).int("tiles y", 4).compute().unwrap_err().to_string();
        assert!(uneven.contains("3 tiles across and 4 down the image"), "{uneven}");
        assert!(trial([0; 4], 3).compute().is_ok());
    }

    #[test]
    fn more_tiles_than_pixels_and_other_heights_are_harmless() {
        for transformations in VALID {
            for (width, height) in [(1, 1), (7, 5), (40, 24), (24, 40), (300, 3)] {
                for tiles in [2, 8, 254] {
                    trial(transformations, tiles).size(width, height).levels(0);
                }
            }
        }
        trial([0; 4], 255).size(3, 9).image();
    }
}
