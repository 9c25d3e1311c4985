//! The block through the engine.

use std::{fs, path::Path};

use ptlib::{
    Cancel, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Image, params::ParamValue,
};

#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
fn engine() -> Engine {
    let engine = Engine::new(EngineOptions { cache_bytes: 0, ..Default::default() });
    // SAFETY: the entry is a static of this crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const super::ptl_plugin_entry_v1) }.unwrap();
    engine
}

/// The pattern with few cells and steps, so that it is there soon.
fn pattern(params: &[(&str, ParamValue)], options: ComputeOptions<'_>) -> Result<Image, Error> {
    let engine = engine();
    let mut graph = engine.new_graph();
    let block = graph.add("reaction-diffusion.gray-scott").unwrap();
    graph.set(block, "cells", ParamValue::Int(64)).unwrap();
    graph.set(block, "steps", ParamValue::Int(600)).unwrap();
    for (id, value) in params {
        graph.set(block, id, value.clone()).unwrap();
    }
    engine.compute(&graph, block, 0, options)
}

fn sized(size: (u32, u32)) -> ComputeOptions<'static> {
    ComputeOptions { size: Some(size), ..Default::default() }
}

#[test]
fn a_pattern_grows_and_tiles() {
    let image = pattern(&[], sized((160, 120))).unwrap();
    let (mut across, mut inside, mut bright) = (0.0_f32, 0.0_f32, 0);
    for y in 0..120 {
        let row = image.row(0, y);
        across = across.max((row[0] - row[159]).abs());
        bright += row.iter().filter(|value| **value > 0.5).count();
        inside = row.windows(2).fold(inside, |most, pair| most.max((pair[0] - pair[1]).abs()));
    }
    assert!(across <= inside, "{across} against {inside}");
    assert!((1500..18_000).contains(&bright), "{bright}");
}

#[test]
fn a_larger_picture_shows_the_same() {
    let [small, large] = [50, 250].map(|side| pattern(&[], sized((side, side))).unwrap());
    for y in 0..50_u32 {
        for x in 0..50_usize {
            let [a, b] = [small.row(0, y)[x], large.row(0, 5 * y + 2)[5 * x + 2]];
            assert!((a - b).abs() < 1e-4, "{x}, {y}: {a} and {b}");
        }
    }
}

#[test]
fn threads_do_not_matter() {
    let on = |threads| {
        let options = ComputeOptions { threads, ..sized((64, 64)) };
        pattern(&[("cells", ParamValue::Int(300))], options).unwrap()
    };
    let first = on(1);
    for threads in [2, 3, 8] {
        assert_eq!(first.channel(0), on(threads).channel(0), "{threads}");
    }
}

#[test]
fn maps_say_where_it_grows() {
    let engine = engine();
    let mut graph = engine.new_graph();
    let black = graph.add("color fill").unwrap();
    let block = graph.add("reaction-diffusion.gray-scott").unwrap();
    for channel in ["red", "green", "blue"] {
        graph.set(black, channel, ParamValue::Int(0)).unwrap();
    }
    for (id, value) in [("cells", 64), ("steps", 600)] {
        graph.set(block, id, ParamValue::Int(value)).unwrap();
    }
    // Nothing is fed, so all that there was is used up or decays.
    graph.connect(black, 0, block, 0).unwrap();
    let image = engine.compute(&graph, block, 0, sized((64, 64))).unwrap();
    assert!(image.channel(0).iter().all(|value| *value < 0.05));
    let fed = pattern(&[], sized((64, 64))).unwrap();
    assert!(fed.channel(0).iter().any(|value| *value > 0.5));
}

#[test]
fn a_long_computation_can_be_stopped() {
    let cancel = Cancel::new();
    cancel.request();
    let options = ComputeOptions { cancel: Some(cancel), ..sized((64, 64)) };
    let error = pattern(&[("steps", ParamValue::Int(100_000))], options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}

/// How much of a picture is darker than a third, and brighter than two thirds of what is brightest.
fn shares(image: &Image) -> [f32; 2] {
    let values = image.channel(0);
    let most = values.iter().fold(0.0_f32, |most, value| most.max(*value));
    assert!(most > 0.5, "it is black");
    let share = |is: &dyn Fn(f32) -> bool| {
        values.iter().filter(|value| is(**value / most)).count() as f32 / values.len() as f32
    };
    [share(&|value| value < 0.33), share(&|value| value > 0.67)]
}

#[test]
fn every_preset_gives_a_pattern_that_lasts() {
    // Coral, spots, maze, holes, loops, worms: the least and the most that is dark, and bright.
    let expected = [
        [0.25..0.65, 0.2..0.6],
        [0.4..0.85, 0.05..0.35],
        [0.15..0.6, 0.15..0.6],
        [0.02..0.25, 0.5..0.95],
        [0.25..0.95, 0.02..0.5],
        [0.3..0.75, 0.1..0.5],
    ];
    for (preset, [dark, bright]) in (1..).zip(expected) {
        for steps in [4000, 12_000] {
            let params = [
                ("preset", ParamValue::Choice(preset)),
                ("cells", ParamValue::Int(96)),
                ("drops", ParamValue::Int(12)),
                ("steps", ParamValue::Int(steps)),
            ];
            let shares = shares(&pattern(&params, sized((96, 96))).unwrap());
            let is_right = dark.contains(&shares[0]) && bright.contains(&shares[1]);
            assert!(is_right, "preset {preset} after {steps} steps: {shares:?}");
        }
    }
}

#[test]
fn what_dies_out_ends_at_0_and_not_slowly() {
    let params = [
        ("preset", ParamValue::Choice(0)),
        ("feed", ParamValue::Float(0.014)),
        ("kill", ParamValue::Float(0.07)),
        ("steps", ParamValue::Int(3000)),
    ];
    let image = pattern(&params, sized((64, 64))).unwrap();
    assert!(image.channel(0).iter().all(|value| *value == 0.0));
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
