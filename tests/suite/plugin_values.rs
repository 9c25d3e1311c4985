//! Blocks of plug-ins that take and make meshes, points and strands.

use std::sync::Arc;

use ptlib::{
    BlockId, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Graph, Limits,
    params::ParamValue,
    value::{Mesh, Strands, Stream, StreamShape, Value, Words},
};

use crate::plugins::{build, rust_plugin};

fn rust_engine() -> Engine {
    let engine = Engine::new(EngineOptions::default());
    engine.load_plugin(&rust_plugin()).unwrap();
    engine
}

fn engine() -> Option<Engine> {
    let engine = Engine::new(EngineOptions::default());
    engine.load_plugin(&build("values")?).unwrap();
    Some(engine)
}

/// Two triangles of four corners.
fn mesh() -> Value {
    let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [3.0, 3.0, 6.0_f32]];
    mesh_of(&corners, &[0, 1, 2, 2, 1, 3])
}

/// A mesh whose positions lie apart in memory: one unused number after each.
fn mesh_of(corners: &[[f32; 3]], indices: &[u32]) -> Value {
    let words: Vec<u32> =
        corners.iter().flat_map(|[x, y, z]| [*x, *y, *z, f32::NAN]).map(f32::to_bits).collect();
    let shape = StreamShape::floats("position", 3);
    let words = Words::copy_of(&words).unwrap();
    let position = Stream::new(shape, words, 16, corners.len()).unwrap();
    let indices = Words::copy_of(indices).unwrap();
    let count = u32::try_from(corners.len()).unwrap();
    let mesh = Mesh::new(count, indices, vec![position], &Limits::default()).unwrap();
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
        (ErrorKind::InvalidArgument, "`streams[0].stride` is 3, allowed are 0 and 12"),
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
    let said = "entry 2 of 3 is 4, allowed no less than the entry before";
    assert_eq!(error.kind(), ErrorKind::OutOfRange, "{error}");
    assert!(error.message().contains(said), "{error}");
    // The host lives.
    let (graph, hairs) = self::graph(&engine);
    engine.compute_value(&graph, hairs, 0, ComputeOptions::default()).unwrap();
}

/// Graph input → roots → hair, all of the plug-in in Rust.
fn hair_of(engine: &Engine, mesh: Value) -> (Graph, BlockId) {
    let mut graph = engine.new_graph();
    let head = graph.add("ptlib-rust.head").unwrap();
    let roots = graph.add("ptlib-rust.roots").unwrap();
    let grow = graph.add("ptlib-rust.grow").unwrap();
    graph.connect(head, 0, roots, 0).unwrap();
    graph.connect(roots, 0, grow, 0).unwrap();
    graph.set_input(head, Some(mesh)).unwrap();
    (graph, grow)
}

fn strands_of(engine: &Engine, mesh: Value, threads: u32) -> Arc<Strands> {
    let (graph, grow) = hair_of(engine, mesh);
    let options = ComputeOptions { threads, ..ComputeOptions::default() };
    let value = engine.compute_value(&graph, grow, 0, options).unwrap();
    let Value::Strands(strands) = value else { panic!("strands") };
    strands
}

#[test]
fn hair_in_rust_grows_from_triangles() {
    let strands = strands_of(&rust_engine(), mesh(), 0);
    assert_eq!(&strands.first_point()[..], &[0, 5, 10]);
    let positions = strands.point_streams()[0].floats();
    assert_eq!(positions.at(0), [1.0, 1.0, 0.0]);
    assert_eq!(positions.at(4), [1.0, 1.0, 1.0]);
    assert_eq!(positions.at(5), [2.0, 2.0, 2.0]);
    // What the roots have, the strands have, too.
    let ids: Vec<_> = strands.strand_streams().iter().map(Stream::id).collect();
    assert_eq!(ids, ["position", "direction", "random", "id"]);
}

#[test]
fn an_empty_mesh_has_no_hair_and_no_mesh_is_an_error() {
    let engine = rust_engine();
    let strands = strands_of(&engine, mesh_of(&[], &[]), 0);
    assert_eq!((strands.count(), strands.point_count()), (0, 0));
    // Triangles without an area.
    let strands = strands_of(&engine, mesh_of(&[[1.0; 3]], &[0, 0, 0]), 0);
    assert_eq!(strands.point_streams()[0].floats().at(4), [1.0, 2.0, 1.0]);
    let mut graph = engine.new_graph();
    let roots = graph.add("ptlib-rust.roots").unwrap();
    let error = engine.compute_value(&graph, roots, 0, ComputeOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unconnected, "{error}");
}

#[test]
fn many_hairs_are_the_same_on_every_number_of_threads() {
    let engine = Engine::new(EngineOptions { cache_bytes: 0, ..EngineOptions::default() });
    engine.load_plugin(&rust_plugin()).unwrap();
    let corners: Vec<_> = (0..20_000_u16).map(|i| [f32::from(i), f32::from(i % 7), 1.0]).collect();
    let indices: Vec<u32> = (0..19_998).flat_map(|i| [i, i + 1, i + 2]).collect();
    let on = |threads| strands_of(&engine, mesh_of(&corners, &indices), threads);
    let first = on(1);
    assert_eq!(first.count(), 19_998);
    let last = first.point_streams()[0].floats().at(5 * 19_997);
    assert_eq!(last[0], 19_998.0);
    for threads in [2, 3, 8] {
        assert_eq!(*first.content(), *on(threads).content(), "{threads}");
    }
}

#[test]
fn what_the_kit_is_used_for_wrongly_is_refused() {
    let engine = rust_engine();
    let cases = [
        None,
        Some((ErrorKind::Limit, "allowed")),
        Some((ErrorKind::Limit, "allowed 4294967295")),
        Some((ErrorKind::OutOfRange, "position")),
        Some((ErrorKind::PluginFailed, "did not finish")),
        Some((ErrorKind::InvalidArgument, "output 0 is begun already")),
        None,
        Some((ErrorKind::PluginPanic, "a task panicked")),
        Some((ErrorKind::TypeMismatch, "not a text")),
        Some((ErrorKind::InvalidArgument, "no output 1")),
        Some((ErrorKind::Limit, "scratch memory")),
    ];
    for (fault, case) in (0..).zip(cases) {
        let mut graph = engine.new_graph();
        let block = graph.add("ptlib-rust.faulty").unwrap();
        graph.set(block, "fault", ParamValue::Choice(fault)).unwrap();
        let made = engine.compute_value(&graph, block, 0, ComputeOptions::default());
        match (made, case) {
            (Ok(Value::Points(points)), None) => {
                assert_eq!(points.count(), 10);
                assert_eq!(points.streams()[0].floats().at(7), [8.0; 3]);
                assert_eq!(points.streams()[1].floats().at(7), [0.5]);
            }
            (Err(error), Some((kind, said))) => {
                assert!(error.to_string().contains(said), "{fault}: {error}");
                assert_eq!(error.kind(), kind, "{error}");
            }
            (made, case) => panic!("{fault}: {made:?} in place of {case:?}"),
        }
    }
}

#[test]
fn streams_are_shared_copied_and_passed_on() {
    let engine = rust_engine();
    let mut graph = engine.new_graph();
    let head = graph.add("ptlib-rust.head").unwrap();
    let colors = graph.add("color transition").unwrap();
    let tint = graph.add("ptlib-rust.tint").unwrap();
    let value = |graph: &Graph, output| {
        engine.compute_value(graph, tint, output, ComputeOptions::default()).unwrap()
    };
    let Value::Mesh(nothing) = value(&graph, 0) else { panic!("a mesh") };
    assert_eq!(nothing.vertex_count(), 0);
    let Value::Gradient(none) = value(&graph, 1) else { panic!("a colour transition") };
    assert!(none.stops().is_empty());

    graph.connect(head, 0, tint, 0).unwrap();
    graph.connect(colors, 0, tint, 1).unwrap();
    let stops = ParamValue::Text("0 0 0 0;255 255 0 0".into());
    graph.set(colors, "data", stops).unwrap();
    let given = mesh();
    graph.set_input(head, Some(given.clone())).unwrap();
    let Value::Mesh(given) = given else { panic!("a mesh") };
    let Value::Mesh(tinted) = value(&graph, 0) else { panic!("a mesh") };
    assert_eq!(tinted.streams()[1].floats().at(3), [1.0, 0.0, 0.0]);
    assert_eq!(tinted.streams()[0].data().as_ptr(), given.streams()[0].data().as_ptr());
    assert_eq!(tinted.indices().as_ptr(), given.indices().as_ptr());
    let Value::Mesh(copy) = value(&graph, 3) else { panic!("a mesh") };
    assert_eq!(copy.streams()[0].floats().at(3), given.streams()[0].floats().at(3));
    assert_eq!(&copy.indices()[..], &[2, 1, 0, 3, 1, 2]);
    let Value::Text(words) = value(&graph, 2) else { panic!("a text") };
    assert_eq!(&*words, "no words: 4 vertices");
}
