//! Plug-ins in C++: what they throw, and what `ptlib_plugin.hpp` makes of wires and parameters.

use std::{process::Command, sync::Arc};

use ptlib::{
    BlockId, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Image, Limits, Precision,
    params::ParamValue,
    value::{Gradient, GradientStop, Mesh, Stream, StreamShape, Value, Words},
};

use crate::{
    abi::{root, run, tool},
    plugins::build_with,
};

fn engine(name: &str) -> Option<Engine> {
    let source = format!("tests/plugins/{name}.cpp");
    let engine = Engine::new(EngineOptions::default());
    engine.load_plugin(&build_with(&source, name, &[])?).unwrap();
    Some(engine)
}

#[test]
fn the_header_is_clean_under_both_compilers_and_standards() {
    let sources = [
        "tests/plugins/throwing.cpp",
        "tests/plugins/wires.cpp",
        "plugins/templates/cpp/threshold.cpp",
        "plugins/cpp-kuwahara/kuwahara.cpp",
    ];
    for compiler in ["g++", "clang++"] {
        let Some(compiler) = tool(compiler) else { continue };
        for standard in ["c++17", "c++20"] {
            for source in sources {
                let mut command = Command::new(&compiler);
                command.arg(format!("-std={standard}")).args(["-fsyntax-only", "-Werror"]);
                command.args(["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow"]);
                run(command.arg("-I").arg(root().join("include")).arg(root().join(source)));
            }
        }
    }
}

fn block(engine: &Engine, id: &str, choices: &[(&str, u32)]) -> Result<Image, Error> {
    let mut graph = engine.new_graph();
    graph.set_precision(Precision::Float);
    let block = graph.add(id).unwrap();
    for (param, choice) in choices {
        graph.set(block, param, ParamValue::Choice(*choice)).unwrap();
    }
    engine.compute(&graph, block, 0, ComputeOptions::default())
}

/// What is thrown, in the order of `enum class what` in throwing.cpp.
const THROWN: [(ErrorKind, &str); 5] = [
    (ErrorKind::PluginFailed, "the paint is dry"),
    (ErrorKind::PluginPanic, "threw something that is no std::exception"),
    (ErrorKind::NoMemory, "there is no memory left"),
    (ErrorKind::Limit, "seven of nine"),
    (ErrorKind::PluginFailed, "although nobody asked it to stop"),
];

#[test]
fn exceptions_become_errors_with_the_name_of_the_block() {
    let Some(engine) = engine("throwing") else { return };
    for place in 1..=3 {
        for (what, (kind, said)) in (0..).zip(THROWN) {
            let choices = [("where", place), ("what", what)];
            let error = block(&engine, "ptlib-cpp.throw", &choices).unwrap_err();
            assert_eq!(error.kind(), kind, "{place}, {what}: {error}");
            assert!(error.to_string().contains(said), "{place}, {what}: {error}");
            assert_eq!(error.place().block_type.as_deref(), Some("ptlib-cpp.throw"));
        }
        // The host lives, and the same block goes on.
        assert_eq!(block(&engine, "ptlib-cpp.throw", &[]).unwrap().row(0, 9)[9], 0.25);
    }
}

#[test]
fn exceptions_of_constructors_are_told_and_those_of_destructors_do_no_harm() {
    let Some(engine) = engine("throwing") else { return };
    let cases = [
        ("ptlib-cpp.unmade", ErrorKind::PluginFailed, "no brush"),
        ("ptlib-cpp.unmade by number", ErrorKind::PluginPanic, "no std::exception"),
        ("ptlib-cpp.unmade for memory", ErrorKind::NoMemory, "no memory left"),
    ];
    for (id, kind, said) in cases {
        let error = block(&engine, id, &[]).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().contains(said), "{error}");
        assert_eq!(error.place().block_type.as_deref(), Some(id));
    }
    for _ in 0..3 {
        assert_eq!(block(&engine, "ptlib-cpp.undead", &[]).unwrap().row(0, 5)[5], 0.5);
    }
}

#[test]
fn parameters_that_are_read_wrongly_are_named() {
    let Some(engine) = engine("throwing") else { return };
    for (what, said) in [(5, "parameter 0 is of type 4, but was read as type 1"), (6, "number 99")]
    {
        let choices = [("where", 1), ("what", what)];
        let error = block(&engine, "ptlib-cpp.throw", &choices).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::PluginFailed);
        assert!(error.to_string().contains(said), "{error}");
    }
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

/// What a block makes of values at its inputs.
fn made(engine: &Engine, id: &str, inputs: &[(&str, Value)], output: u32) -> Value {
    let mut graph = engine.new_graph();
    graph.set_precision(Precision::Float);
    let block = graph.add(id).unwrap();
    for (slot, (source, value)) in (0..).zip(inputs) {
        let input: BlockId = graph.add(source).unwrap();
        graph.set_input(input, Some(value.clone())).unwrap();
        graph.connect(input, 0, block, slot).unwrap();
    }
    engine.compute_value(&graph, block, output, ComputeOptions::default()).unwrap()
}

#[test]
fn meshes_points_and_strands_go_in_and_out() {
    let Some(engine) = engine("wires") else { return };
    let shapes = |output| made(&engine, "ptlib-wires.shapes", &[("mesh input", mesh())], output);
    let Value::Points(points) = shapes(0) else { panic!("points") };
    let centres: Vec<_> = points.streams()[0].floats().all().map(<[f32]>::to_vec).collect();
    assert_eq!(centres, [[1.0, 1.0, 0.0], [2.0, 2.0, 2.0]].map(|centre| centre.to_vec()));
    let Value::Strands(strands) = shapes(1) else { panic!("strands") };
    assert_eq!(&strands.first_point()[..], &[0, 2, 4]);
    assert_eq!(strands.point_streams()[0].floats().at(3), [2.0, 2.0, 3.0]);
    let Value::Mesh(turned) = shapes(2) else { panic!("a mesh") };
    assert_eq!(&turned.indices()[..], &[3, 1, 2, 2, 1, 0]);
    assert_eq!(turned.streams()[0].floats().at(3), [3.0, 3.0, 6.0]);
    let Value::Mesh(same) = shapes(3) else { panic!("a mesh") };
    assert_eq!(&same.indices()[..], &[0, 1, 2, 2, 1, 3]);
}

#[test]
fn texts_and_colour_transitions_go_in_and_out() {
    let Some(engine) = engine("wires") else { return };
    let stop = |position, color| GradientStop { position, color };
    let colours = Gradient::new(vec![stop(0.25, [0.0, 0.5, 1.0]), stop(0.75, [1.0, 0.5, 0.5])]);
    let inputs = [("text input", Value::Text("so".into())), ("gradient input", colours.into())];
    let Value::Text(text) = made(&engine, "ptlib-wires.words", &inputs, 0) else { panic!("text") };
    assert_eq!(&*text, "so!");
    let colours = made(&engine, "ptlib-wires.words", &inputs, 1);
    let Value::Gradient(colours) = colours else { panic!("a colour transition") };
    let expected =
        [stop(0.0, [1.0, 0.5, 0.0]), stop(0.5, [0.75, 0.5, 0.5]), stop(1.0, [0.5, 0.5, 1.0])];
    assert_eq!(colours.stops(), expected);
}

#[test]
fn descriptions_parameters_and_services_arrive() {
    let Some(engine) = engine("wires") else { return };
    let [info] = engine.registry().plugins()[..] else { panic!("one plug-in") };
    assert_eq!((info.id.as_str(), info.version.as_str()), ("ptlib-wires", "1.2.3"));
    assert!(info.built_with.contains("++"), "{}", info.built_with);
    let spec = engine.registry().get("ptlib-wires.numbers").unwrap();
    assert_eq!(spec.name(), "Numbers");
    assert_eq!(spec.params[0].unit, "px");
    assert_eq!(spec.params[1].default_value(), ParamValue::Float(0.25));
    assert_eq!(spec.params[3].default_value(), ParamValue::Text("two words".into()));

    let mut graph = engine.new_graph();
    graph.set_precision(Precision::Float);
    let numbers = graph.add("ptlib-wires.numbers").unwrap();
    graph.set(numbers, "length", ParamValue::Int(7)).unwrap();
    let options = || ComputeOptions { seed: Some(1), ..Default::default() };
    let image = engine.compute(&graph, numbers, 0, options()).unwrap();
    assert_eq!(image.row(0, 3)[3], 7.0 + 0.25 + 100.0 + 9.0);
    let expected = 0.141_120_008_059_867 + 2.0_f64.sqrt(); // sin 3
    assert!((f64::from(image.row(1, 3)[3]) - expected).abs() < 1e-6);
    let random = image.channel(2);
    assert!(random.iter().all(|value| (0.0..1.0).contains(value)));
    let mean = random.iter().sum::<f32>() / random.len() as f32;
    assert!((mean - 0.5).abs() < 0.02, "{mean}");
    let other = ComputeOptions { seed: Some(2), ..Default::default() };
    let other = engine.compute(&graph, numbers, 0, other).unwrap();
    assert_ne!(other.channel(2), random);
}
