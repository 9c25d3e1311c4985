//! Blocks of plug-ins that take and make meshes, points and strands.

use std::sync::Arc;

use ptlib::{
    BlockId, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Graph, Limits,
    params::ParamValue,
    value::{Mesh, Stream, StreamShape, Value, Words},
};

use crate::plugins::build;

fn engine() -> Option<Engine> {
    let engine = Engine::new(EngineOptions::default());
    engine.load_plugin(&build("values")?).unwrap();
    Some(engine)
}

/// Two triangles of four corners.
fn mesh() -> Value {
    let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [3.0, 3.0, 6.0_f32]];
    let words: Vec<u32> = corners.iter().flatten().map(|number| number.to_bits()).collect();
    let shape = StreamShape::floats("position", 3);
    let position = Stream::packed(shape, Words::copy_of(&words).unwrap()).unwrap();
    let indices = Words::copy_of(&[0, 1, 2, 2, 1, 3]).unwrap();
    let mesh = Mesh::new(4, indices, vec![position], &Limits::default()).unwrap();
    Value::Mesh(Arc::new(mesh))
}

/// `mesh input` → centres → hairs.
fn graph(engine: &Engine) -> (Graph, BlockId) {
    let mut graph = engine.new_graph();
    let input = graph.add("mesh input").unwrap();
    let centres = graph.add("ptlib-test.centres").unwrap();
    let hairs = graph.add("ptlib-test.hairs").unwrap();
    graph.connect(input, 0, centres, 0).unwrap();
    graph.connect(centres, 0, hairs, 0).unwrap();
    graph.set_input(input, Some(mesh())).unwrap();
    (graph, hairs)
}

#[test]
fn a_mesh_becomes_points_and_points_become_strands() {
    let Some(engine) = engine() else { return };
    let (graph, hairs) = graph(&engine);
    let strands = engine.compute_value(&graph, hairs, 0, ComputeOptions::default()).unwrap();
    let Value::Strands(strands) = strands else { panic!("strands") };
    assert_eq!(&strands.first_point()[..], &[0, 2, 4]);
    let positions = strands.point_streams()[0].floats();
    let positions: Vec<_> = positions.all().map(<[f32]>::to_vec).collect();
    let expected = [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [2.0, 2.0, 3.0]];
    assert_eq!(positions, expected.map(|position| position.to_vec()));
    assert_eq!(strands.bounds().max, [2.0, 2.0, 3.0]);
    // The points that are passed on, and the roots, are those of the block before.
    let points = engine.compute_value(&graph, hairs, 1, ComputeOptions::default()).unwrap();
    let Value::Points(points) = points else { panic!("points") };
    let roots = &strands.strand_streams()[0];
    assert_eq!(roots.floats().at(1), points.streams()[0].floats().at(1));
}

fn wrong(engine: &Engine, fault: u32) -> Error {
    let mut graph = engine.new_graph();
    let block = graph.add("ptlib-test.wrong").unwrap();
    graph.set(block, "fault", ParamValue::Choice(fault)).unwrap();
    engine.compute_value(&graph, block, 0, ComputeOptions::default()).unwrap_err()
}

#[test]
fn what_a_block_makes_wrongly_is_refused() {
    let Some(engine) = engine() else { return };
    let cases = [
        (ErrorKind::PluginFailed, "made no value"),
        (ErrorKind::InvalidArgument, "of no stream of an input"),
        (ErrorKind::InvalidArgument, "struct_size 8"),
        (ErrorKind::Limit, "allowed"),
        (ErrorKind::InvalidArgument, "no output 7"),
        (ErrorKind::OutOfRange, "is 99, allowed below 3"),
        (ErrorKind::OutOfRange, "position"),
        (ErrorKind::PluginFailed, "did not finish"),
        (ErrorKind::TypeMismatch, "gives a mesh, not a text"),
        (ErrorKind::InvalidArgument, "of no stream of an input"),
    ];
    for (fault, (kind, said)) in (0..).zip(cases) {
        let error = wrong(&engine, fault);
        assert!(error.to_string().contains(said), "{fault}: {error}");
        assert!(error.to_string().contains("ptlib-test.wrong"), "{error}");
        assert_eq!(error.kind(), kind, "{error}");
    }
    let mut graph = engine.new_graph();
    let falling = graph.add("ptlib-test.falling").unwrap();
    let error = engine.compute_value(&graph, falling, 0, ComputeOptions::default()).unwrap_err();
    assert!(
        error.to_string().contains("first_point") || error.to_string().contains("fall"),
        "{error}"
    );
    // The host lives.
    let (graph, hairs) = self::graph(&engine);
    engine.compute_value(&graph, hairs, 0, ComputeOptions::default()).unwrap();
}
