//! Inputs of graphs: values that the caller sets.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use ptlib::{
    ComputeOptions, Engine, EngineOptions, ErrorKind, Format, Graph, Image, Limits, Precision,
    value::{BufferPool, Memory, Mesh, Points, Stream, StreamShape, Value, Words},
};

fn picture(bytes: [u8; 16]) -> Value {
    let pixels = (&bytes[..], 8);
    let image = Image::from_pixels(&BufferPool::new(), (2, 2), Format::Rgba8, pixels);
    image.expect("right pixels").into()
}

fn graph(engine: &Engine, side: u32) -> (Graph, ptlib::BlockId) {
    let mut graph = engine.new_graph();
    graph.set_size(side, side).unwrap();
    let input = graph.add("image input").unwrap();
    (graph, input)
}

fn pixels(engine: &Engine, graph: &Graph, block: ptlib::BlockId) -> Vec<u8> {
    let image = engine.compute(graph, block, 0, ComputeOptions::default()).unwrap();
    assert_eq!(image.planes(), 4);
    image.to_pixels(Format::Rgba8).data
}

#[test]
fn a_picture_of_the_graphs_size_comes_through_untouched_in_both_precisions() {
    let engine = Engine::new(EngineOptions::default());
    let (mut graph, input) = graph(&engine, 2);
    let end = graph.add("end").unwrap();
    graph.connect(input, 0, end, 0).unwrap();
    let [one, other] = [3_u8, 5].map(|step| {
        let mut bytes = [0; 16];
        bytes.iter_mut().zip(0..).for_each(|(byte, i)| *byte = i * step * 3);
        bytes
    });
    for precision in [Precision::EightBit, Precision::Float] {
        graph.set_precision(precision);
        // The cache is on: another value is another result.
        for bytes in [one, other, one] {
            graph.set_input(input, Some(picture(bytes))).unwrap();
            assert_eq!(pixels(&engine, &graph, end), bytes, "{precision:?}");
        }
    }
}

#[test]
fn a_default_counts_until_there_is_a_value_and_is_not_computed_then() {
    let engine = Engine::new(EngineOptions::default());
    let (mut graph, input) = graph(&engine, 4);
    // It names no file, so it cannot be computed.
    let default = graph.add("load file").unwrap();
    graph.connect(default, 0, input, 0).unwrap();
    let compute = |graph: &Graph| engine.compute(graph, input, 0, ComputeOptions::default());
    assert!(compute(&graph).is_err());
    graph.set_input(input, Some(picture([9; 16]))).unwrap();
    assert_eq!(compute(&graph).unwrap().planes(), 4);
    graph.set_input(input, None).unwrap();
    let fill = graph.add("color fill").unwrap();
    graph.connect(fill, 0, input, 0).unwrap();
    assert_ne!(compute(&graph).unwrap().planes(), 4);
    graph.disconnect(input, 0).unwrap();
    let error = compute(&graph).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unconnected);
    assert!(error.hint().is_some_and(|hint| hint.contains("--input")), "{error}");
    let options = ComputeOptions { keep_going: true, ..ComputeOptions::default() };
    let white = engine.compute(&graph, input, 0, options).unwrap();
    assert_eq!(white.channel(0)[0], 1.0);
}

#[test]
fn nothing_stands_for_a_mesh_that_is_missing() {
    let engine = Engine::new(EngineOptions::default());
    let mut graph = engine.new_graph();
    let input = graph.add("mesh input").unwrap();
    let options = ComputeOptions { keep_going: true, ..ComputeOptions::default() };
    let error = engine.compute_value(&graph, input, 0, options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unconnected);
}

/// Words that tell when nobody needs them any more.
struct Lent(Vec<u32>, Arc<AtomicBool>);

impl Memory for Lent {
    fn words(&self) -> &[u32] {
        &self.0
    }

    fn is_borrowed(&self) -> bool {
        true
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        self.1.store(true, Ordering::SeqCst);
    }
}

#[test]
fn lent_memory_is_not_copied_and_given_back_although_the_engine_has_a_cache() {
    let engine = Engine::new(EngineOptions::default());
    let is_back = Arc::new(AtomicBool::new(false));
    let words = Words::new(Arc::new(Lent(vec![0; 9], Arc::clone(&is_back))));
    let address = words.as_ptr();
    let position = Stream::packed(StreamShape::floats("position", 3), words).unwrap();
    let indices = Words::copy_of(&[0, 1, 2]).unwrap();
    let mesh = Mesh::new(3, indices, vec![position], &Limits::default()).unwrap();
    let mut graph = engine.new_graph();
    let (first, second) = (graph.add("mesh input").unwrap(), graph.add("mesh input").unwrap());
    graph.connect(first, 0, second, 0).unwrap();
    graph.set_input(first, Some(mesh.into())).unwrap();
    let value = engine.compute_value(&graph, second, 0, ComputeOptions::default()).unwrap();
    let Value::Mesh(mesh) = value else { panic!("gives a {}", value.kind().name()) };
    assert_eq!(mesh.stream("position").unwrap().data().as_ptr(), address);
    drop(graph);
    assert!(!is_back.load(Ordering::SeqCst));
    drop(mesh);
    assert!(is_back.load(Ordering::SeqCst));
}

#[test]
fn values_on_wires_count_in_the_limit_of_memory() {
    let engine = Engine::new(EngineOptions { cache_bytes: 0, ..EngineOptions::default() });
    let words = Words::copy_of(&vec![0; 3 << 18]).unwrap();
    let position = Stream::packed(StreamShape::floats("position", 3), words).unwrap();
    let points = Points::new(1 << 18, vec![position], &Limits::default()).unwrap();
    let mut graph = engine.new_graph();
    let (given, other) = (graph.add("points input").unwrap(), graph.add("points input").unwrap());
    graph.connect(given, 0, other, 0).unwrap();
    graph.set_input(given, Some(points.into())).unwrap();
    let compute = |block, memory_bytes| {
        let options = ComputeOptions { memory_bytes: Some(memory_bytes), ..Default::default() };
        engine.compute_value(&graph, block, 0, options)
    };
    // What the caller gave is the caller's.
    compute(given, 0).unwrap();
    compute(other, 3 << 20).unwrap();
    let error = compute(other, 3 << 19).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    assert!(error.message().contains("3 MiB, allowed 1 MiB"), "{error}");
}
