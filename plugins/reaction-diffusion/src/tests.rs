//! The block through the engine.

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
