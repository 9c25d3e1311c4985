//! The example, whole.

use std::path::Path;

use ptlib::{
    ComputeOptions, Engine, EngineOptions, Graph,
    params::ParamValue,
    value::{Image, Value},
};

use crate::testing;

/// The example graph at an age, in an engine that may read what lies beside it.
fn example(age: f64) -> (Engine, Graph) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/head");
    let engine = Engine::new(EngineOptions {
        read_folders: vec![folder.clone()],
        ..EngineOptions::default()
    });
    testing::register(&engine);
    let reading = engine.open_graph(&folder.join("head.xml")).unwrap();
    assert!(reading.warnings.is_empty(), "{:?}", reading.warnings);
    let mut graph = reading.graph;
    let blocks: Vec<_> = graph.blocks().map(|(id, _)| id).collect();
    for block in blocks {
        // Blocks without an age refuse it.
        let _ = graph.set(block, "age", ParamValue::Float(age));
    }
    (engine, graph)
}

fn sized(side: u32) -> ComputeOptions<'static> {
    ComputeOptions { size: Some((side, side)), supersampling: Some(1), ..Default::default() }
}

/// The picture of the example, and its number of hairs.
fn seen(age: f64) -> (Image, usize) {
    let (engine, graph) = example(age);
    let hair = graph.find("hair").unwrap();
    let Value::Strands(strands) = engine.compute_value(&graph, hair, 0, sized(96)).unwrap() else {
        panic!("no strands");
    };
    let picture = engine.compute(&graph, graph.find("view").unwrap(), 0, sized(96)).unwrap();
    (picture, strands.count() as usize)
}

#[test]
fn the_head_of_the_example_ages() {
    let ages = [0.0, 0.25, 0.5, 0.75, 1.0].map(seen);
    for pair in ages.windows(2) {
        assert!(pair[0].1 > pair[1].1, "{} hairs, then {}", pair[0].1, pair[1].1);
        assert_ne!(pair[0].0.channel(0), pair[1].0.channel(0));
    }
    assert!(ages[0].1 > 40_000 && ages[4].1 > 1000, "{} and {}", ages[0].1, ages[4].1);
    // Something is drawn, and not everywhere.
    let covered = ages[4].0.channel(3).iter().filter(|alpha| **alpha > 0.5).count();
    assert!((2000..7000).contains(&covered), "{covered} of 9216");
}

#[test]
fn no_hair_of_the_example_grows_on_the_neck() {
    // At 768 pixels the lower edge of the masks, which have 512, mixes with the upper one.
    let (engine, graph) = example(0.0);
    let roots = graph.find("roots").unwrap();
    for side in [512, 768, 1024] {
        let Value::Points(roots) = engine.compute_value(&graph, roots, 0, sized(side)).unwrap()
        else {
            panic!("no points");
        };
        let heights = roots.stream("position").unwrap().floats();
        assert!(heights.all().all(|place| place[1] > -0.5), "{side}");
    }
}
