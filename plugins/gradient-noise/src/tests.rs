//! Both noises through the engine: they tile, fill their range, and look alike at every size.

use std::{fs, path::Path};

use ptlib::{ComputeOptions, Engine, EngineOptions, Image, params::ParamValue};

const BLOCKS: [&str; 2] = ["gradient-noise.perlin", "gradient-noise.simplex"];

#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
fn engine() -> Engine {
    let engine = Engine::new(EngineOptions { cache_bytes: 0, ..Default::default() });
    // SAFETY: the entry is a static of this crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const super::ptl_plugin_entry_v1) }.unwrap();
    engine
}

fn image(block: &str, size: (u32, u32), params: &[(&str, ParamValue)], seed: u64) -> Image {
    let engine = engine();
    let mut graph = engine.new_graph();
    let block = graph.add(block).unwrap();
    for (id, value) in params {
        graph.set(block, id, value.clone()).unwrap();
    }
    let options = ComputeOptions { size: Some(size), seed: Some(seed), ..Default::default() };
    engine.compute(&graph, block, 0, options).unwrap()
}

/// The greatest difference between neighbours, across the edges and inside.
fn steps(image: &Image) -> [f32; 2] {
    let (width, height) = (image.width(), image.height());
    let at = |x: u32, y: u32| image.row(0, y % height)[(x % width) as usize];
    let mut steps = [0.0_f32; 2];
    for y in 0..height {
        for x in 0..width {
            let down = usize::from(y + 1 < height);
            let right = usize::from(x + 1 < width);
            steps[down] = steps[down].max((at(x, y + 1) - at(x, y)).abs());
            steps[right] = steps[right].max((at(x + 1, y) - at(x, y)).abs());
        }
    }
    steps
}

#[test]
fn both_tile_at_every_size() {
    for block in BLOCKS {
        for size in [(256, 256), (300, 170), (97, 411)] {
            for seed in 0..4 {
                let one = [("octaves", ParamValue::Int(2)), ("frequency", ParamValue::Int(5))];
                let [across, inside] = steps(&image(block, size, &one, seed));
                assert!(across <= inside * 1.05, "{block} {size:?}: {across} against {inside}");
            }
        }
    }
}

#[test]
fn both_fill_their_range_and_no_more() {
    for block in BLOCKS {
        for fractal in 0..3 {
            let params = [
                ("fractal", ParamValue::Choice(fractal)),
                ("octaves", ParamValue::Int(1)),
                ("frequency", ParamValue::Int(60)),
            ];
            let image = image(block, (512, 512), &params, 1);
            let (mut least, mut most) = (1.0_f32, 0.0_f32);
            for value in image.channel(0) {
                assert!((0.0..=1.0).contains(value));
                (least, most) = (least.min(*value), most.max(*value));
            }
            assert!(least < 0.12 && most > 0.88, "{block} {fractal}: {least} to {most}");
        }
    }
}

#[test]
fn a_larger_picture_shows_the_same() {
    for block in BLOCKS {
        let few = [("octaves", ParamValue::Int(3))];
        let (small, large) = (image(block, (64, 64), &few, 3), image(block, (320, 320), &few, 3));
        for y in 0..64_u32 {
            for x in 0..64_u32 {
                // The middle pixel of five lies where the one of the small picture does.
                let pair = (small.row(0, y), large.row(0, 5 * y + 2));
                let [a, b] = [pair.0[x as usize], pair.1[5 * x as usize + 2]];
                assert!((a - b).abs() < 1e-5, "{block} at {x}, {y}: {a} and {b}");
            }
        }
    }
}

#[test]
fn another_seed_gives_another_picture_and_octaves_differ() {
    for block in BLOCKS {
        let [first, second] = [1, 2].map(|seed| image(block, (64, 64), &[], seed));
        assert_ne!(first.channel(0), second.channel(0));
        let same = [("octaves", ParamValue::Int(2)), ("lacunarity", ParamValue::Int(1))];
        let one = [("octaves", ParamValue::Int(1))];
        assert_ne!(
            image(block, (64, 64), &same, 1).channel(0),
            image(block, (64, 64), &one, 1).channel(0)
        );
    }
}

#[test]
fn examples_are_read_without_a_warning_and_give_pictures() {
    let engine = engine();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty());
    for file in files {
        let reading = engine.read_graph(&fs::read(&file).unwrap()).unwrap();
        assert!(reading.warnings.is_empty(), "{}: {:?}", file.display(), reading.warnings);
        let result = reading.graph.main_result().unwrap();
        let options = ComputeOptions { size: Some((48, 32)), ..Default::default() };
        let image = engine.compute(&reading.graph, result, 0, options).unwrap();
        let first = image.channel(0)[0];
        assert!(image.channel(0).iter().any(|value| *value != first), "{}", file.display());
    }
}
