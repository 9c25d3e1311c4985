//! The plug-in `c-hexagons`: hexagonal tiles.

use std::collections::BTreeSet;

use ptlib::{ComputeOptions, Engine, EngineOptions, Image, params::ParamValue};

use crate::{abi::root, plugins::hexagons};

const HEIGHT: u32 = 0;
const TILE: u32 = 1;
const DISTANCE: u32 = 2;

fn engine() -> Option<Engine> {
    let plugin = hexagons()?;
    let engine = Engine::new(EngineOptions::default());
    engine.load_plugin(&plugin).unwrap();
    Some(engine)
}

fn image(engine: &Engine, output: u32, size: (u32, u32), set: &[(&str, ParamValue)]) -> Image {
    let mut graph = engine.new_graph();
    graph.set_precision(ptlib::Precision::Float);
    let tiles = graph.add("hexagons.tiles").unwrap();
    for (parameter, value) in set {
        graph.set(tiles, parameter, value.clone()).unwrap();
    }
    let options = ComputeOptions { size: Some(size), ..Default::default() };
    engine.compute(&graph, tiles, output, options).unwrap()
}

fn shades(image: &Image) -> BTreeSet<u32> {
    image.channel(0).iter().map(|value| value.to_bits()).collect()
}

#[test]
fn there_are_as_many_tiles_as_fit_and_each_has_one_shade() {
    let Some(engine) = engine() else { return };
    // Columns, orientation, size, tiles.
    let cases = [
        (10, 0, (300, 300), 10 * 12),
        (1, 0, (64, 64), 2),
        (6, 0, (300, 150), 6 * 4),
        (6, 0, (100, 300), 6 * 20),
        (10, 1, (300, 300), 10 * 9),
        (9, 1, (300, 300), 10 * 9),
        (2, 1, (64, 64), 4),
    ];
    for (columns, orientation, size, tiles) in cases {
        let set = [
            ("columns", ParamValue::Int(columns)),
            ("orientation", ParamValue::Choice(orientation)),
        ];
        let found = shades(&image(&engine, TILE, size, &set)).len();
        assert_eq!(found, tiles, "{columns} {orientation} {size:?}");
    }
}

#[test]
fn the_pattern_goes_on_at_the_other_side() {
    let Some(engine) = engine() else { return };
    for orientation in 0..2 {
        let set =
            [("orientation", ParamValue::Choice(orientation)), ("columns", ParamValue::Int(7))];
        let distance = image(&engine, DISTANCE, (256, 200), &set);
        let at = |x: u32, y: u32| distance.row(0, y % 200)[(x % 256) as usize];
        // It changes evenly: no step over an edge is larger than those inside.
        let across = |x: u32| most((0..200).map(|y| (at(x, y) - at(x + 1, y)).abs()));
        let down = |y: u32| most((0..256).map(|x| (at(x, y) - at(x, y + 1)).abs()));
        let inside = [most((0..255).map(across)), most((0..199).map(down))];
        let edges = [across(255), down(199)];
        for (edge, inside) in edges.into_iter().zip(inside) {
            assert!(edge <= inside * 1.01, "{orientation}: {edge} after {inside}");
        }
    }
}

fn most(steps: impl Iterator<Item = f32>) -> f32 {
    steps.fold(0.0, f32::max)
}

#[test]
fn joints_and_bevels_are_as_wide_as_they_say() {
    let Some(engine) = engine() else { return };
    let flat = [
        ("height variation", ParamValue::Float(0.0)),
        ("tilt", ParamValue::Float(0.0)),
        ("bevel", ParamValue::Float(0.0)),
    ];
    for gap in [0.0, 0.1, 0.5, 1.0] {
        let set = [&flat[..], &[("gap", ParamValue::Float(gap))]].concat();
        let height = image(&engine, HEIGHT, (512, 512), &set);
        let black = height.channel(0).iter().filter(|value| **value == 0.0).count();
        let share = black as f64 / f64::from(512 * 512);
        // What is left of a tile is a smaller one of the same form.
        let expected = 1.0 - (1.0 - gap) * (1.0 - gap);
        assert!((share - expected).abs() < 0.01, "{gap}: {share}, not {expected}");
        assert!(height.channel(0).iter().all(|value| *value == 0.0 || *value == 1.0));
    }
    // Each profile starts in the joint, ends at the top, and rises between.
    for profile in 0..4 {
        let set = [
            ("height variation", ParamValue::Float(0.0)),
            ("tilt", ParamValue::Float(0.0)),
            ("columns", ParamValue::Int(1)),
            ("bevel", ParamValue::Float(1.0)),
            ("profile", ParamValue::Choice(profile)),
        ];
        // From the side of a tile, at the left edge, to its middle.
        let height = image(&engine, HEIGHT, (512, 512), &set);
        let distance = image(&engine, DISTANCE, (512, 512), &set);
        let mut pairs: Vec<_> = distance.channel(0).iter().zip(height.channel(0)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(b.0));
        assert!(pairs.is_sorted_by(|a, b| a.1 <= b.1), "{profile}");
        assert!(*pairs[0].1 == 0.0 && *pairs[pairs.len() - 1].1 > 0.9, "{profile}");
    }
}

#[test]
fn a_larger_picture_shows_the_same() {
    let Some(engine) = engine() else { return };
    // So few that joints are wider than a pixel of the small picture.
    let set = [("columns", ParamValue::Int(3)), ("gap", ParamValue::Float(0.1))];
    for output in [HEIGHT, TILE, DISTANCE] {
        let small = image(&engine, output, (128, 128), &set);
        let large = image(&engine, output, (512, 512), &set);
        let mean = |x: usize, y: u32| {
            let rows = (4 * y..4 * y + 4).map(|y| &large.row(0, y)[4 * x..4 * x + 4]);
            rows.flatten().sum::<f32>() / 16.0
        };
        let pixels = (0..128_u32).flat_map(|y| (0..128_usize).map(move |x| (x, y)));
        let sum: f32 = pixels.map(|(x, y)| (small.row(0, y)[x] - mean(x, y)).abs()).sum();
        assert!(sum / 16384.0 < 0.02, "{output}: {}", sum / 16384.0);
    }
}

#[test]
fn another_seed_gives_other_tiles_in_the_same_places() {
    let Some(engine) = engine() else { return };
    let of = |seed| {
        let mut graph = engine.new_graph();
        let tiles = graph.add("hexagons.tiles").unwrap();
        let options = |seed| ComputeOptions { seed: Some(seed), ..Default::default() };
        let tile = engine.compute(&graph, tiles, TILE, options(seed)).unwrap();
        (tile, engine.compute(&graph, tiles, DISTANCE, options(seed)).unwrap())
    };
    let (one, other) = (of(1), of(2));
    assert_eq!(one.1.channel(0), other.1.channel(0));
    assert_ne!(one.0.channel(0), other.0.channel(0));
}

#[test]
fn the_example_renders_without_a_warning() {
    let Some(engine) = engine() else { return };
    let reading =
        engine.open_graph(&root().join("plugins/c-hexagons/examples/courtyard.xml")).unwrap();
    assert_eq!(reading.warnings, []);
    let end = reading.graph.main_result().unwrap();
    let options = ComputeOptions { size: Some((64, 64)), ..Default::default() };
    assert_eq!(engine.compute(&reading.graph, end, 0, options).unwrap().planes(), 3);
}
