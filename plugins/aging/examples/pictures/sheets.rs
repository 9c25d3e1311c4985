//! The pictures of this plug-in: one table for what tests compare, and how they are drawn.
//!
//! A sheet is a graph beside this file and one of its blocks; each of its tiles is what that block
//! gives with some parameters changed.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use ptlib::{
    BlockId, ComputeOptions, Engine, EngineOptions, Error, Graph, Image, Limits,
    math::elementary::{cos64, sin64},
    params::ParamValue,
    value::{BufferPool, Mesh, Stream, StreamShape, Value, Words},
};
use ptlib_plugin::math::single;

/// Tiles that belong together.
pub struct Sheet {
    /// The name of its file.
    pub name: &'static str,
    pub scene: Scene<'static>,
    /// How many tiles stand side by side.
    pub columns: usize,
    pub tiles: &'static [Tile],
}

/// A graph in this folder, and the block whose output is seen.
#[derive(Clone, Copy)]
pub struct Scene<'a>(pub &'a str, pub &'a str);

/// A picture: its name, and what is not as the graph says.
pub struct Tile(pub &'static str, pub &'static [Setting<'static>]);

/// A block, its parameter and the value. Without a block it is for each block that has such a
/// parameter. [`KEY`] and a key are no parameter: that key of all muscles.
pub type Setting<'a> = (&'a str, &'a str, &'a str);

/// See [`Setting`].
const KEY: &str = "muscles: ";

/// What pictures of a camera lie on.
const BACKGROUND: f32 = 0.25;

/// A muscle in the middle.
pub const MIDDLE: &str = "! ma=.35;.55 mb=.62;.46 n=3 relWidth=.7 maxAngle=1.6";

/// It, moved by half of the image along both axes: across all borders.
pub const CORNER: &str = "! ma=.85;1.05 mb=1.12;.96 n=3 relWidth=.7 maxAngle=1.6";

/// All sheets.
pub const SHEETS: &[Sheet] = &[
    Sheet {
        name: "profiles",
        scene: Scene("wrinkles.xml", "map"),
        columns: 4,
        tiles: &[
            Tile("bulge, gamma 0.4", &[]),
            Tile("bulge, gamma 1", &[("map", "gamma", "1")]),
            Tile("wave, gamma 0.4", &[("map", "profile", "wave")]),
            Tile("wave, gamma 1", &[("map", "profile", "wave"), ("map", "gamma", "1")]),
        ],
    },
    Sheet {
        name: "muscles",
        scene: Scene("wrinkles.xml", "map"),
        columns: 3,
        tiles: &[
            Tile("omegaLow 0", &[("map", "muscles: omegaLow", "0")]),
            Tile("omegaLow 0.5", &[("map", "muscles: omegaLow", "0.5")]),
            Tile("omegaLow 1", &[("map", "muscles: omegaLow", "1")]),
            Tile("maxAngle 1", &[("map", "muscles: maxAngle", "1")]),
            Tile("maxAngle 1.5", &[("map", "muscles: maxAngle", "1.5")]),
            Tile("maxAngle 2", &[("map", "muscles: maxAngle", "2")]),
        ],
    },
    Sheet {
        name: "border",
        scene: Scene("wrinkles.xml", "map"),
        columns: 2,
        tiles: &[
            Tile("in the middle", &[("map", "muscles", MIDDLE)]),
            Tile("across the corner", &[("map", "muscles", CORNER)]),
        ],
    },
    Sheet {
        name: "normals",
        scene: Scene("wrinkles.xml", "normals"),
        columns: 3,
        tiles: &[
            Tile("gamma 0.4", &[]),
            Tile("gamma 0.8", &[("map", "gamma", "0.8")]),
            Tile("across the corner", &[("map", "gamma", "0.8"), ("map", "muscles", CORNER)]),
        ],
    },
    Sheet {
        name: "fine",
        scene: Scene("wrinkles.xml", "skin"),
        columns: 3,
        tiles: &[
            Tile("age 0", &[("skin", "age", "0")]),
            Tile("age 0.5", &[("skin", "age", "0.5")]),
            Tile("age 1", &[("skin", "age", "1")]),
        ],
    },
    Sheet {
        name: "fronts",
        scene: Scene("hair.xml", "loss age"),
        columns: 3,
        tiles: &[
            Tile("eight", &[("loss age", "front", "eight")]),
            Tile("octagon", &[("loss age", "front", "octagon")]),
            Tile("even", &[("loss age", "front", "even")]),
        ],
    },
    Sheet {
        name: "mask",
        scene: Scene("hair.xml", "mask"),
        columns: 4,
        tiles: &[
            Tile("age 0", &[("mask", "age", "0")]),
            Tile("age 0.33", &[("mask", "age", "0.33")]),
            Tile("age 0.66", &[("mask", "age", "0.66")]),
            Tile("age 1", &[("mask", "age", "1")]),
        ],
    },
    Sheet {
        name: "parallax",
        scene: Scene("parallax.xml", "view"),
        columns: 3,
        tiles: &[
            Tile("linear 4", &[("view", "search", "linear"), ("view", "linear steps", "4")]),
            Tile("linear 6", &[("view", "search", "linear"), ("view", "linear steps", "6")]),
            Tile("linear 8", &[("view", "search", "linear"), ("view", "linear steps", "8")]),
            Tile("linear 10", &[("view", "search", "linear"), ("view", "linear steps", "10")]),
            Tile("binary 12", &[("view", "search", "binary"), ("view", "binary steps", "12")]),
            Tile("combined 8 and 4", &[("view", "search", "combined")]),
        ],
    },
    Sheet {
        name: "hair",
        scene: Scene("hair.xml", "view"),
        columns: 4,
        tiles: &[
            Tile("age 0", &[("", "age", "0")]),
            Tile("age 0.33", &[("", "age", "0.33")]),
            Tile("age 0.66", &[("", "age", "0.66")]),
            Tile("age 1", &[("", "age", "1")]),
        ],
    },
    Sheet {
        name: "highlight",
        scene: Scene("hair.xml", "view"),
        columns: 3,
        tiles: &[
            Tile("from the left", &[("", "age", "0"), SHINY, ("view", "light yaw", "-60")]),
            Tile("from the front", &[("", "age", "0"), SHINY, ("view", "light yaw", "0")]),
            Tile("from the right", &[("", "age", "0"), SHINY, ("view", "light yaw", "60")]),
        ],
    },
];

/// Hair that shines.
pub const SHINY: Setting<'_> = ("view", "k specular", "0.9");

/// A file of this package.
pub fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// An engine with this plug-in that may read the examples.
#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
pub fn engine(options: EngineOptions) -> Result<Engine, Error> {
    let engine = Engine::new(EngineOptions { read_folders: vec![path("examples")], ..options });
    // SAFETY: the entry is a static of that crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const ptlib_aging::ptl_plugin_entry_v1) }?;
    Ok(engine)
}

impl Scene<'_> {
    /// What the block gives at that size with these settings.
    pub fn render(
        self,
        engine: &Engine,
        settings: &[Setting<'_>],
        options: ComputeOptions<'_>,
    ) -> Result<Image, Error> {
        let (graph, block) = self.graph(engine, settings)?;
        engine.compute(&graph, block, 0, options)
    }

    /// The graph with these settings, and the block.
    pub fn graph(
        self,
        engine: &Engine,
        settings: &[Setting<'_>],
    ) -> Result<(Graph, BlockId), Error> {
        let reading = engine.open_graph(&path("examples/pictures").join(self.0))?;
        assert!(reading.warnings.is_empty(), "{}: {:?}", self.0, reading.warnings);
        let mut graph = reading.graph;
        let find = |graph: &Graph, id| graph.find(id).unwrap_or_else(|| panic!("no block {id}"));
        for (id, parameter, value) in settings {
            if id.is_empty() {
                let blocks: Vec<_> = graph.blocks().map(|(id, _)| id).collect();
                // Blocks without such a parameter refuse it.
                let set = |block| graph.set_text(block, parameter, value).is_ok();
                assert!(
                    blocks.into_iter().map(set).filter(|is_set| *is_set).count() > 0,
                    "no {parameter}"
                );
                continue;
            }
            let block = find(&graph, id);
            match parameter.strip_prefix(KEY) {
                Some(key) => set_key(&mut graph, block, key, value)?,
                None => graph.set_text(block, parameter, value)?,
            }
        }
        if let Some(input) = graph.find_input("sphere") {
            graph.set_input(input, Some(sphere(40)?))?;
        }
        let block = find(&graph, self.1);
        Ok((graph, block))
    }

    /// A picture for people: what a camera saw lies on grey, and heights do not hide normals.
    pub fn flat(self, image: &Image) -> Result<Image, Error> {
        let planes = image.planes().min(3);
        let mut flat = Image::new(&BufferPool::new(), image.width(), image.height(), planes)?;
        for (channel, plane) in flat.planes_mut().enumerate() {
            plane.copy_from_slice(image.channel(channel));
            if self.1 == "view" {
                for (value, alpha) in plane.iter_mut().zip(image.channel(3)) {
                    *value = *value * alpha + BACKGROUND * (1.0 - alpha);
                }
            }
        }
        Ok(flat)
    }
}

/// Sets a key of all muscles in a text.
fn set_key(graph: &mut Graph, block: BlockId, key: &str, value: &str) -> Result<(), Error> {
    let ParamValue::Text(text) = graph.get(block, "muscles")?.clone() else { return Ok(()) };
    let set = |word: &str| match word.split_once('=') {
        Some((found, _)) if found == key => format!("{key}={value}"),
        _ => word.to_owned(),
    };
    let words: Vec<_> = text.split_whitespace().map(set).collect();
    graph.set_text(block, "muscles", &words.join(" "))
}

/// One picture of many of one size: side by side, then below each other.
pub fn join(tiles: &[Image], columns: usize) -> Result<Image, Error> {
    let [width, height] = [tiles[0].width(), tiles[0].height()];
    let [across, down] = [columns, tiles.len().div_ceil(columns)]
        .map(|count| u32::try_from(count).unwrap_or(u32::MAX));
    let planes = tiles.iter().map(Image::planes).max().unwrap_or(1);
    let mut sheet = Image::new(&BufferPool::new(), width * across, height * down, planes)?;
    for (channel, plane) in sheet.planes_mut().enumerate() {
        let mut rows = plane.chunks_mut(width as usize * columns);
        for tiles in tiles.chunks(columns) {
            for (y, row) in (0..height).zip(&mut rows) {
                row.fill(0.0);
                for (part, tile) in row.chunks_mut(width as usize).zip(tiles) {
                    part.copy_from_slice(tile.row(channel, y));
                }
            }
        }
    }
    Ok(sheet)
}

/// A sphere of radius 1 with texture coordinates by longitude and latitude: so many rings.
fn sphere(rings: u16) -> Result<Value, Error> {
    let columns = 2 * rings;
    let (mut positions, mut texcoords, mut triangles) = (vec![], vec![], vec![]);
    for (ring, column) in (0..=rings).flat_map(|ring| (0..=columns).map(move |i| (ring, i))) {
        let [u, v] = [f64::from(column) / f64::from(columns), f64::from(ring) / f64::from(rings)];
        let (yaw, pitch) = ((u - 0.5) * std::f64::consts::TAU, (v - 0.5) * std::f64::consts::PI);
        let place = [sin64(yaw) * cos64(pitch), sin64(pitch), cos64(yaw) * cos64(pitch)];
        positions.extend(place.map(single));
        texcoords.extend([u, v].map(single));
        if ring < rings && column < columns {
            let at = u32::from(ring) * (u32::from(columns) + 1) + u32::from(column);
            let above = at + u32::from(columns) + 1;
            triangles.extend([at, at + 1, above + 1, at, above + 1, above]);
        }
    }
    let stream = |id, components, numbers: &[f32]| {
        let words: Vec<u32> = numbers.iter().map(|number| number.to_bits()).collect();
        Stream::packed(StreamShape::floats(id, components), Words::copy_of(&words)?)
    };
    let streams = vec![
        stream("position", 3, &positions)?,
        stream("normal", 3, &positions)?,
        stream("texcoord", 2, &texcoords)?,
    ];
    let count = (u32::from(rings) + 1) * (u32::from(columns) + 1);
    let mesh = Mesh::new(count, Words::copy_of(&triangles)?, streams, &Limits::default())?;
    Ok(Value::Mesh(Arc::new(mesh)))
}
