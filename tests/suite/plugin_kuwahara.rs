//! The anisotropic Kuwahara filter of `plugins/cpp-kuwahara`, through the engine.

use std::{fs, sync::OnceLock};

use ptlib::{
    Cancel, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Image, Precision,
    params::ParamValue,
    value::{BufferPool, Value},
};

use crate::{abi::root, plugins::kuwahara};

const KUWAHARA: &str = "kuwahara.anisotropic";

fn engine() -> Option<&'static Engine> {
    static ENGINE: OnceLock<Option<Engine>> = OnceLock::new();
    let make = || {
        let plugin = kuwahara()?;
        let engine = Engine::new(EngineOptions { cache_bytes: 0, ..Default::default() });
        engine.load_plugin(&plugin).unwrap();
        Some(engine)
    };
    ENGINE.get_or_init(make).as_ref()
}

/// A picture of `planes` planes, each number from its plane and place.
fn picture(
    (width, height): (u32, u32),
    planes: usize,
    value: impl Fn(usize, u32, u32) -> f32,
) -> Image {
    let mut image = Image::new(&BufferPool::new(), width, height, planes).unwrap();
    for (plane, numbers) in image.planes_mut().enumerate() {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        for (number, (x, y)) in numbers.iter_mut().zip(places) {
            *number = value(plane, x, y);
        }
    }
    image
}

fn paint(
    engine: &Engine,
    image: &Image,
    params: &[(&str, f64)],
    options: ComputeOptions<'_>,
) -> Result<Image, Error> {
    let mut graph = engine.new_graph();
    graph.set_precision(Precision::Float);
    let (input, block) = (graph.add("image input").unwrap(), graph.add(KUWAHARA).unwrap());
    graph.set_input(input, Some(Value::Image(image.clone()))).unwrap();
    graph.connect(input, 0, block, 0).unwrap();
    for (id, value) in params {
        graph.set(block, id, ParamValue::Float(*value)).unwrap();
    }
    let size = Some((image.width(), image.height()));
    engine.compute(&graph, block, 0, ComputeOptions { size, ..options })
}

fn painted(engine: &Engine, image: &Image, params: &[(&str, f64)]) -> Image {
    paint(engine, image, params, ComputeOptions::default()).unwrap()
}

/// Noise of a place: the same for every width that is a multiple of 64.
fn grain(x: u32, y: u32) -> f32 {
    let mixed = (x % 64).wrapping_mul(0x9e37_79b1) ^ (y % 64).wrapping_mul(0x85eb_ca77);
    ((mixed ^ (mixed >> 15)).wrapping_mul(0x2c1b_3c6d) >> 16) as f32 / 65_535.0
}

#[test]
fn a_constant_image_stays_as_it_is() {
    let Some(engine) = engine() else { return };
    for planes in [1, 3, 4] {
        let image = picture((96, 64), planes, |plane, _, _| [0.3, 0.7, 0.1, 1.0][plane]);
        // Small and large: read in full, and through means.
        for radius in [0.0, 3.0, 10.0] {
            let result = painted(engine, &image, &[("radius", radius)]);
            assert_eq!(result.planes(), planes);
            for plane in 0..planes {
                assert_eq!(result.channel(plane), image.channel(plane), "{planes}, {radius}");
            }
        }
    }
}

#[test]
fn edges_stay_and_what_is_between_becomes_flat() {
    let Some(engine) = engine() else { return };
    let image = picture((128, 128), 1, |_, x, y| {
        let side = if (32..96).contains(&x) { 0.75 } else { 0.25 };
        side + 0.1 * (grain(x, y) - 0.5)
    });
    let result = painted(engine, &image, &[("radius", 4.0)]);
    let spread = |image: &Image, columns: std::ops::Range<usize>| {
        let values = || (0..128).flat_map(|y| image.row(0, y)[columns.clone()].iter().copied());
        let mean = values().sum::<f32>() / values().count() as f32;
        values().map(|value| (value - mean) * (value - mean)).sum::<f32>() / values().count() as f32
    };
    for columns in [4..28, 40..88, 100..124] {
        let [before, after] = [&image, &result].map(|image| spread(image, columns.clone()));
        assert!(after < before / 10.0, "{columns:?}: {before} becomes {after}");
    }
    for y in 0..128 {
        let row = result.row(0, y);
        // One step as high as before, and each side keeps its level right up to it.
        assert!(row[33] - row[30] > 0.4, "{y}: {:?}", &row[28..36]);
        assert!(row[94] - row[97] > 0.4, "{y}: {:?}", &row[92..100]);
    }
    // A mean over as much would leave a ramp.
    let blurred = painted(engine, &image, &[("radius", 4.0), ("sharpness", 0.0)]);
    assert!(blurred.row(0, 64)[33] - blurred.row(0, 64)[30] < 0.3);
}

#[test]
fn a_shifted_picture_gives_the_shifted_result() {
    let Some(engine) = engine() else { return };
    let value = |plane: usize, x: u32, y: u32| grain(x / 3, y / 5) * [1.0, 0.6, 0.8][plane];
    for (width, height) in [(64, 64), (51, 80)] {
        // On a torus no place is special, so nothing happens at the edges alone.
        let shifted = |plane, x, y| value(plane, (x + 29) % width, (y + 37) % height);
        let [image, moved] =
            [picture((width, height), 3, value), picture((width, height), 3, shifted)]
                .map(|image| painted(engine, &image, &[("radius", 7.0)]));
        for plane in 0..3 {
            for y in 0..height {
                for x in 0..width {
                    let there = image.row(plane, (y + 37) % height)[((x + 29) % width) as usize];
                    let here = moved.row(plane, y)[x as usize];
                    assert!((there - here).abs() < 1e-5, "{x}, {y}: {there} and {here}");
                }
            }
        }
    }
}

#[test]
fn three_equal_planes_are_filtered_like_a_grey_one_without_noise_between() {
    let Some(engine) = engine() else { return };
    // Sharpness 0 weighs all sectors alike, so the variance of three planes does not matter.
    let params = [("radius", 5.0), ("sharpness", 0.0)];
    let value = |_: usize, x: u32, y: u32| grain(x / 2, y / 3);
    let [grey, colour, opaque] = [1, 3, 4].map(|planes| {
        let value = |plane, x, y| if plane == 3 { 1.0 } else { value(plane, x, y) };
        painted(engine, &picture((64, 64), planes, value), &params)
    });
    for plane in 0..3 {
        for (place, value) in colour.channel(plane).iter().enumerate() {
            let [a, b] = [grey.channel(0)[place], opaque.channel(plane)[place]];
            assert!((a - value).abs() < 1e-5 && (b - value).abs() < 1e-5, "{place}");
        }
        assert_eq!(colour.channel(plane), colour.channel(0));
    }
    assert!(opaque.channel(3).iter().all(|alpha| *alpha == 1.0));
}

#[test]
fn colours_that_cannot_be_seen_do_not_bleed() {
    let Some(engine) = engine() else { return };
    // A red disc on green that is transparent.
    let image = picture((64, 64), 4, |plane, x, y| {
        let (x, y) = (f64::from(x) - 32.0, f64::from(y) - 32.0);
        let inside = x * x + y * y < 400.0;
        f32::from(u8::from(if plane == 0 || plane == 3 { inside } else { plane == 1 && !inside }))
    });
    let result = painted(engine, &image, &[("radius", 8.0), ("sharpness", 1.0)]);
    let mut between = 0;
    for place in 0..64 * 64 {
        let [red, green, alpha] = [0, 1, 3].map(|plane| result.channel(plane)[place]);
        assert!(green < 1e-4, "{place}: green is {green}");
        assert!(alpha < 1e-3 || red > 0.999, "{place}: {red} at alpha {alpha}");
        between += usize::from((0.05..0.95).contains(&alpha));
    }
    assert!(between > 50, "the edge of alpha is smoothed: {between}");
}

#[test]
fn a_larger_picture_shows_the_same() {
    let Some(engine) = engine() else { return };
    // A disc and rings without a grain.
    let convert = |place: u32| f32::from(u16::try_from(place).unwrap());
    let at = |side: u32| {
        let value = move |plane: usize, x: u32, y: u32| {
            let at = |place: u32| (convert(place) + 0.5) / convert(side) - 0.5;
            let distance = (at(x) * at(x) + at(y) * at(y)).sqrt();
            let ring = 0.3 + 0.8 * ((distance * 6.0).fract() - 0.5).abs();
            if distance < 0.2 { 0.9 } else { ring * [1.0, 0.8, 0.6][plane] }
        };
        painted(engine, &picture((side, side), 3, value), &[("radius", 3.0)])
    };
    let [small, large] = [at(160), at(480)];
    let mut sum = 0.0;
    for y in 0..160_u32 {
        for x in 0..160_usize {
            sum += (small.row(0, y)[x] - large.row(0, 3 * y + 1)[3 * x + 1]).abs();
        }
    }
    let mean = sum / (160.0 * 160.0);
    assert!(mean < 0.02, "{mean}");
}

#[test]
fn no_parameters_and_sizes_do_harm() {
    let Some(engine) = engine() else { return };
    let extremes = [[0.0, 10.0], [0.0, 64.0], [0.0, 3.0], [0.0, 5.0]];
    let ids = ["radius", "sharpness", "eccentricity", "smoothing"];
    for size in [(1, 1), (1, 40), (40, 1), (7, 3), (130, 20)] {
        let image = picture(size, 4, |plane, x, y| grain(x + [0, 7, 14, 21][plane], y));
        for corner in 0..16_usize {
            let params: Vec<_> = (0..4).map(|i| (ids[i], extremes[i][corner >> i & 1])).collect();
            let result = painted(engine, &image, &params);
            for plane in 0..4 {
                let mut values = result.channel(plane).iter();
                assert!(values.all(|value| (0.0..=1.0).contains(value)), "{size:?} {params:?}");
            }
        }
    }
    let mut graph = engine.new_graph();
    let block = graph.add(KUWAHARA).unwrap();
    for (id, value) in [("radius", -1.0), ("sharpness", f64::NAN), ("eccentricity", 1e9)] {
        assert!(graph.set(block, id, ParamValue::Float(value)).is_err(), "{id}");
    }
    let error = engine.compute(&graph, block, 0, ComputeOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unconnected, "{error}");
}

#[test]
fn threads_do_not_matter_and_work_can_be_stopped() {
    let Some(engine) = engine() else { return };
    let image = picture((150, 90), 3, |plane, x, y| grain(x / 2 + [0, 1, 2][plane], y / 2));
    let on = |threads| {
        let options = ComputeOptions { threads, ..Default::default() };
        paint(engine, &image, &[("radius", 9.0)], options).unwrap()
    };
    let first = on(1);
    for threads in [2, 3, 8] {
        let other = on(threads);
        for plane in 0..3 {
            assert_eq!(first.channel(plane), other.channel(plane), "{threads}");
        }
    }
    let cancel = Cancel::new();
    cancel.request();
    let options = ComputeOptions { cancel: Some(cancel), ..Default::default() };
    let error = paint(engine, &image, &[], options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}

#[test]
fn the_example_computes() {
    let Some(engine) = engine() else { return };
    let folder = root().join("plugins/cpp-kuwahara/examples");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let reading = engine.read_graph(&fs::read(&path).unwrap()).unwrap();
        assert!(reading.warnings.is_empty(), "{}", path.display());
        let end = reading.graph.main_result().unwrap();
        let options = ComputeOptions { size: Some((128, 128)), ..Default::default() };
        let image = engine.compute(&reading.graph, end, 0, options).unwrap();
        let levels = image.channel(0);
        let mean = levels.iter().sum::<f32>() / levels.len() as f32;
        assert!(levels.iter().any(|level| (level - mean).abs() > 0.2), "{}", path.display());
    }
}
