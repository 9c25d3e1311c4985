//! Draws the pictures of this plug-in in the book, `docs/src/pictures/`.
//!
//! ```sh
//! cargo run --release -p ptlib-aging --example pictures
//! ```
//!
//! With a folder, draws the golden pictures of the tests there instead, 512 × 512 pixels each: for
//! looking at them.

mod sheets;

use std::{env, error::Error, path::Path};

use ptlib::{
    ComputeOptions, Engine, EngineOptions, Image,
    io::{BitDepth, save_image},
    value::BufferPool,
};
use sheets::{Scene, Setting, Tile};

/// The side of a tile.
const SIDE: u32 = 512;

/// A picture of the book.
struct Page {
    name: &'static str,
    rows: &'static [Row],
    /// Width and height of a tile, which is the middle of the upper edge of a larger picture.
    tile: [u32; 2],
    /// Width and height of that.
    of: [u32; 2],
}

/// Tiles side by side.
struct Row(Scene<'static>, &'static [Tile]);

const MANY: Setting<'_> = ("roots", "hairs", "60000");
const THIN: Setting<'_> = ("view", "hair width", "0.0012");
const NEAR: Setting<'_> = ("view", "field of view", "33");

/// One large muscle.
const MUSCLE: Setting<'_> =
    ("map", "muscles", "! ma=.5;.92 mb=.5;.44 n=4 relWidth=.8 maxAngle=1.25 omegaLow=.5");

const PAGES: &[Page] = &[
    Page {
        name: "ages",
        tile: [290, 370],
        of: [370, 370],
        rows: &[Row(
            Scene("../head/head.xml", "view"),
            &[
                Tile("0", &[("", "age", "0")]),
                Tile("¼", &[("", "age", "0.25")]),
                Tile("½", &[("", "age", "0.5")]),
                Tile("¾", &[("", "age", "0.75")]),
                Tile("1", &[("", "age", "1")]),
            ],
        )],
    },
    Page {
        name: "wrinkles",
        tile: [SIDE, SIDE],
        of: [SIDE, SIDE],
        rows: &[
            Row(
                Scene("wrinkles.xml", "map"),
                &[
                    Tile("as it is", &[MUSCLE]),
                    Tile("omegaLow 0", &[MUSCLE, ("map", "muscles: omegaLow", "0")]),
                    Tile("omegaLow 1", &[MUSCLE, ("map", "muscles: omegaLow", "1")]),
                    Tile("maxAngle 2", &[MUSCLE, ("map", "muscles: maxAngle", "2")]),
                ],
            ),
            Row(
                Scene("wrinkles.xml", "map"),
                &[
                    Tile("gamma 0.8", &[MUSCLE, ("map", "gamma", "0.8")]),
                    Tile("gamma 1.5", &[MUSCLE, ("map", "gamma", "1.5")]),
                    Tile("wave", &[MUSCLE, ("map", "profile", "wave"), ("map", "gamma", "0.8")]),
                    Tile("relWidth 0.4", &[MUSCLE, ("map", "muscles: relWidth", "0.4")]),
                ],
            ),
        ],
    },
    Page {
        name: "parallax",
        tile: [SIDE, 320],
        of: [2 * SIDE, 2 * SIDE],
        rows: &[Row(
            Scene("parallax.xml", "view"),
            &[
                Tile("off", &[("view", "search", "off")]),
                Tile("linear 4", &[("view", "search", "linear"), ("view", "linear steps", "4")]),
                Tile("binary 12", &[("view", "search", "binary"), ("view", "binary steps", "12")]),
                Tile("combined 8 and 4", &[("view", "search", "combined")]),
            ],
        )],
    },
    Page {
        name: "fronts",
        tile: [480, 290],
        of: [480, 480],
        rows: &[
            Row(
                Scene("hair.xml", "loss age"),
                &[
                    Tile("eight", &[("loss age", "front", "eight")]),
                    Tile("octagon", &[("loss age", "front", "octagon")]),
                    Tile("even", &[("loss age", "front", "even")]),
                ],
            ),
            Row(
                Scene("hair.xml", "view"),
                &[
                    Tile("eight", &[("loss age", "front", "eight"), MANY, THIN, NEAR]),
                    Tile("octagon", &[("loss age", "front", "octagon"), MANY, THIN, NEAR]),
                    Tile("even", &[("loss age", "front", "even"), MANY, THIN, NEAR]),
                ],
            ),
        ],
    },
];

fn main() -> Result<(), Box<dyn Error>> {
    let engine = sheets::engine(EngineOptions::default())?;
    let Some(folder) = env::args_os().nth(1) else {
        let folder = sheets::path("../../docs/src/pictures");
        return PAGES.iter().try_for_each(|page| page.draw(&engine, &folder));
    };
    for sheet in sheets::SHEETS {
        let options = || ComputeOptions { size: Some((SIDE, SIDE)), ..Default::default() };
        let tile = |tile: &Tile| {
            let image = sheet.scene.render(&engine, tile.1, options());
            image.and_then(|image| sheet.scene.flat(&image)).map_err(|error| named(tile, &error))
        };
        let tiles = sheet.tiles.iter().map(tile).collect::<Result<Vec<_>, _>>()?;
        let path = Path::new(&folder).join(sheet.name).with_extension("png");
        save_image(&sheets::join(&tiles, sheet.columns)?, &path, BitDepth::Eight)?;
    }
    Ok(())
}

/// What went wrong, with the tile that it belongs to.
fn named(tile: &Tile, error: &ptlib::Error) -> String {
    format!("{}: {error}", tile.0)
}

impl Page {
    fn draw(&self, engine: &Engine, folder: &Path) -> Result<(), Box<dyn Error>> {
        let mut tiles = vec![];
        for Row(scene, row) in self.rows {
            for tile in *row {
                let options = ComputeOptions {
                    size: Some((self.of[0], self.of[1])),
                    supersampling: Some(2),
                    ..Default::default()
                };
                let image = scene.render(engine, tile.1, options);
                let image = image.map_err(|error| named(tile, &error))?;
                tiles.push(self.cut(&scene.flat(&image)?)?);
            }
        }
        let columns = self.rows[0].1.len();
        let path = folder.join(self.name).with_extension("jpg");
        Ok(save_image(&sheets::join(&tiles, columns)?, &path, BitDepth::Eight)?)
    }

    /// The tile of a larger picture.
    fn cut(&self, image: &Image) -> Result<Image, ptlib::Error> {
        let [width, height] = self.tile;
        let from = ((self.of[0] - width) / 2) as usize;
        let mut tile = Image::new(&BufferPool::new(), width, height, image.planes())?;
        for (channel, plane) in tile.planes_mut().enumerate() {
            for (y, row) in (0..).zip(plane.chunks_mut(width as usize)) {
                row.copy_from_slice(&image.row(channel, y)[from..from + width as usize]);
            }
        }
        Ok(tile)
    }
}
