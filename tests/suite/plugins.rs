//! Plug-ins in C and in Rust, built here and loaded as a program would.

use std::{
    collections::BTreeSet,
    env, fs,
    path::{Path, PathBuf},
    process::Command,
    sync::{Arc, Mutex, PoisonError},
};

use ptlib::{
    Cancel, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Image, params::ParamValue,
    run::LogLevel,
};

use crate::abi::{root, run, scratch, tool};

/// Only one test at a time builds.
static BUILDING: Mutex<()> = Mutex::new(());

/// What was built in this run.
static BUILT: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

pub(crate) fn folder() -> PathBuf {
    let folder = scratch().join("plugins");
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Builds `tests/plugins/NAME.c` as a plug-in; `None` if there is no compiler.
pub(crate) fn build(name: &str) -> Option<PathBuf> {
    build_with(name, name, &[])
}

/// The same under another name, with further flags; `source` may be a path in the repository, of a
/// file in C or in C++.
pub(crate) fn build_with(source: &str, name: &str, flags: &[&str]) -> Option<PathBuf> {
    let _one = BUILDING.lock().unwrap_or_else(PoisonError::into_inner);
    let plugin = folder().join(format!("{name}.ptplugin.so"));
    let is_cpp = source.ends_with(".cpp");
    let compiler = tool(if is_cpp { "c++" } else { "cc" })?;
    // A library that is loaded must not change under the feet of other tests.
    if BUILT.lock().unwrap_or_else(PoisonError::into_inner).insert(name.to_owned()) {
        let source = match is_cpp || source.ends_with(".c") {
            true => source.to_owned(),
            false => format!("tests/plugins/{source}.c"),
        };
        let mut command = Command::new(compiler);
        command.arg(if is_cpp { "-std=c++17" } else { "-std=c99" });
        command.args(["-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-pedantic-errors"]);
        command.args(["-Wconversion", "-Werror", "-shared", "-fPIC", "-fvisibility=hidden"]);
        command.arg("-I").arg(root().join("include"));
        // Libraries count only behind what needs them.
        command.arg(root().join(source)).arg("-o").arg(&plugin).args(flags);
        run(&mut command);
    }
    Some(plugin)
}

/// The plug-in in `plugins/c-hexagons`.
pub(crate) fn hexagons() -> Option<PathBuf> {
    let source = "plugins/c-hexagons/hexagons.c";
    build_with(source, "hexagons", &["-lm"])
}

/// The plug-in in `plugins/cpp-kuwahara`.
pub(crate) fn kuwahara() -> Option<PathBuf> {
    build_with("plugins/cpp-kuwahara/kuwahara.cpp", "kuwahara", &[])
}

/// The plug-in in Rust, which cargo built with these tests, under the name of a plug-in.
pub(crate) fn rust_plugin() -> PathBuf {
    rust_library("libptlib_test_plugin.so", "rust")
}

/// A library that cargo built with these tests, under the name of a plug-in.
pub(crate) fn rust_library(library: &str, name: &str) -> PathBuf {
    let _one = BUILDING.lock().unwrap_or_else(PoisonError::into_inner);
    let plugin = folder().join(format!("{name}.ptplugin.so"));
    let own = env::current_exe().unwrap();
    let library = own.parent().unwrap().join(library);
    let is_new = fs::read(&plugin).ok() != Some(fs::read(&library).unwrap());
    if is_new {
        let _ = fs::remove_file(&plugin);
        fs::copy(library, &plugin).unwrap();
    }
    plugin
}

fn engine(plugin: &Path) -> Engine {
    let engine = Engine::new(EngineOptions::default());
    engine.load_plugin(plugin).unwrap();
    engine
}

/// What `block` makes of a picture of several segments a row.
fn through(engine: &Engine, block: &str) -> Image {
    let mut graph = engine.new_graph();
    let (source, block) = (graph.add("fault formation noise").unwrap(), graph.add(block).unwrap());
    graph.connect(source, 0, block, 0).unwrap();
    let options = ComputeOptions { size: Some((2000, 100)), ..Default::default() };
    engine.compute(&graph, block, 0, options).unwrap()
}

fn assert_inverts(engine: &Engine, block: &str) {
    let (foreign, builtin) = (through(engine, block), through(engine, "invert"));
    assert_eq!(foreign.planes(), builtin.planes());
    assert_eq!(foreign.channel(0), builtin.channel(0));
}

#[test]
fn a_block_in_c_is_like_a_built_in_one() {
    let Some(plugin) = build("points") else { return };
    let engine = engine(&plugin);
    let [info] = engine.registry().plugins()[..] else { panic!("one plug-in") };
    assert_eq!((info.id.as_str(), info.version.as_str()), ("ptlib-test.points", "1.0.0"));
    assert_inverts(&engine, "ptlib-test.invert");
}

#[test]
fn a_block_in_rust_is_like_a_built_in_one() {
    let engine = engine(&rust_plugin());
    let info = engine.registry().plugin_of("ptlib-rust.invert").unwrap();
    assert!(info.built_with.starts_with("rustc"), "{}", info.built_with);
    assert_inverts(&engine, "ptlib-rust.invert");
    let spec = engine.registry().get("ptlib-rust.fail").unwrap();
    assert_eq!(spec.name(), "Failing");
    let ids: Vec<_> = spec.params.iter().map(|param| param.id).collect();
    assert_eq!(ids, ["where", "words", "grey", "number of things", "strange"]);
    assert_eq!(spec.params[3].unit, "px");
    assert_eq!(spec.params[2].default_value(), ParamValue::Float(0.25));
}

#[test]
fn two_plugins_and_linked_ones_live_in_one_engine() {
    let Some(plugin) = build("points") else { return };
    let engine = engine(&plugin);
    engine.load_plugin(&rust_plugin()).unwrap();
    // Again: nothing happens.
    engine.load_plugin(&plugin).unwrap();
    assert_eq!(engine.registry().plugins().len(), 2);
    assert_inverts(&engine, "ptlib-test.invert");
    assert_inverts(&engine, "ptlib-rust.invert");

    let other = Engine::new(EngineOptions::default());
    let entry = &raw const ptlib_test_plugin::ptl_plugin_entry_v1;
    register(&other, entry).unwrap();
    assert_inverts(&other, "ptlib-rust.invert");
    // The same blocks from another place are refused, naming both.
    let error = other.load_plugin(&rust_plugin()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::PluginDuplicate);
    assert!(error.to_string().contains("linked into the program"), "{error}");
    assert!(error.to_string().contains("rust.ptplugin.so"), "{error}");
}

#[expect(unsafe_code, reason = "tables of a plug-in are given as a pointer")]
fn register(engine: &Engine, entry: *const ptlib_plugin_abi::ptlp_entry) -> Result<(), Error> {
    // SAFETY: the static of a plug-in made by the SDK.
    unsafe { engine.register_plugin(entry) }.map(drop)
}

/// The error of a block that fails where it is told to.
fn failure(engine: &Engine, place: u32, options: ComputeOptions<'_>) -> Result<Image, Error> {
    let mut graph = engine.new_graph();
    let fail = graph.add("ptlib-rust.fail").unwrap();
    graph.set(fail, "where", ParamValue::Choice(place)).unwrap();
    graph.set(fail, "words", ParamValue::Text("seven of nine".into())).unwrap();
    engine.compute(&graph, fail, 0, options)
}

#[test]
fn failures_and_panics_become_errors_with_the_name_of_the_block() {
    let engine = engine(&rust_plugin());
    let image = failure(&engine, 0, ComputeOptions::default()).unwrap();
    assert_eq!(image.row(0, 9)[9], 0.25);
    let kinds = [
        ErrorKind::InvalidArgument,
        ErrorKind::PluginPanic,
        ErrorKind::PluginFailed,
        ErrorKind::PluginPanic,
        ErrorKind::PluginPanic,
    ];
    for (place, kind) in (1..).zip(kinds) {
        let error = failure(&engine, place, ComputeOptions::default()).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert_eq!(error.place().block_type.as_deref(), Some("ptlib-rust.fail"));
        assert!(place == 5 || error.to_string().contains("seven of nine"), "{error}");
    }
    // The host lives, and goes on with white where it is asked to.
    for place in 1..=5 {
        let mut failures = Vec::new();
        let options = ComputeOptions {
            keep_going: true,
            failures: Some(&mut failures),
            ..ComputeOptions::default()
        };
        let image = failure(&engine, place, options).unwrap();
        assert_eq!((image.row(0, 0)[0], image.row(0, 255)[255]), (1.0, 1.0));
        assert_eq!(failures.len(), 1);
    }
}

#[test]
fn a_block_that_never_asks_whether_to_stop_is_reported() {
    let Some(plugin) = build("deaf") else { return };
    let engine = engine(&plugin);
    let (cancel, said) = (Cancel::new(), Arc::new(Mutex::new(Vec::<String>::new())));
    let (heard, stop) = (Arc::clone(&said), cancel.clone());
    let log = move |_, message: &str| {
        if message.contains("started") {
            stop.request();
        }
        heard.lock().unwrap().push(message.to_owned());
    };
    engine.set_log(Some((LogLevel::Info, Arc::new(log))));
    let mut graph = engine.new_graph();
    let deaf = graph.add("ptlib-test.deaf").unwrap();
    let compute = |cancel| {
        let options = ComputeOptions { cancel: Some(cancel), ..ComputeOptions::default() };
        engine.compute(&graph, deaf, 0, options)
    };
    assert_eq!(compute(cancel).unwrap_err().kind(), ErrorKind::Cancelled);
    let said = said.lock().unwrap();
    let report = said.iter().find(|message| message.contains("never asked whether to stop"));
    assert!(report.is_some_and(|report| report.contains("ptlib-test.deaf")), "{said:?}");
}

#[test]
fn numbers_that_are_not_finite_become_0_and_are_counted() {
    let engine = engine(&rust_plugin());
    let said = Arc::new(Mutex::new(Vec::<String>::new()));
    let heard = Arc::clone(&said);
    let log = move |_, message: &str| heard.lock().unwrap().push(message.to_owned());
    engine.set_log(Some((LogLevel::Warning, Arc::new(log))));
    let mut graph = engine.new_graph();
    let fail = graph.add("ptlib-rust.fail").unwrap();
    graph.set(fail, "strange", ParamValue::Bool(true)).unwrap();
    let options = ComputeOptions { size: Some((30, 20)), ..ComputeOptions::default() };
    let image = engine.compute(&graph, fail, 0, options).unwrap();
    assert!(image.channel(0).iter().all(|value| *value == 0.0));
    let said = said.lock().unwrap();
    let [report] = &said[..] else { panic!("{said:?}") };
    assert!(report.contains("gave 600 numbers that are not finite"), "{report}");
    assert!(report.contains("ptlib-rust.fail"), "{report}");
}

#[test]
fn a_graph_file_names_the_plugin_of_a_block_and_is_kept_without_it() {
    let with = engine(&rust_plugin());
    let mut graph = with.new_graph();
    let fail = graph.add("ptlib-rust.fail").unwrap();
    let end = graph.add("end").unwrap();
    graph.connect(fail, 0, end, 0).unwrap();
    graph.set(fail, "words", ParamValue::Text("kept".into())).unwrap();
    let xml = graph.to_xml();
    assert!(xml.contains("plugin=\"ptlib-rust\" plugin-version=\"0.1.0\""), "{xml}");

    let without = Engine::new(EngineOptions::default());
    let reading = without.read_graph(xml.as_bytes()).unwrap();
    assert_eq!(reading.graph.to_xml(), xml);
    let end = reading.graph.main_result().unwrap();
    let error = without.compute(&reading.graph, end, 0, ComputeOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotFound);
    assert!(error.to_string().contains("plug-in \"ptlib-rust\" (version 0.1.0)"), "{error}");

    let newer = xml.replace("plugin-version=\"0.1.0\"", "plugin-version=\"0.12.0\"");
    let reading = with.read_graph(newer.as_bytes()).unwrap();
    let [warning] = &reading.warnings[..] else { panic!("{:?}", reading.warnings) };
    assert!(warning.to_string().contains("version 0.12.0 of plug-in"), "{warning}");
    let end = reading.graph.main_result().unwrap();
    with.compute(&reading.graph, end, 0, ComputeOptions::default()).unwrap();
    assert_eq!(reading.graph.to_xml(), xml);
}

/// What newcomers copy works. (The template in Rust has a test of its own.)
#[test]
fn the_templates_in_c_and_cpp_make_images_black_and_white() {
    let templates = [
        ("plugins/templates/c/threshold.c", "threshold"),
        ("plugins/templates/cpp/threshold.cpp", "threshold-cpp"),
    ];
    for (source, name) in templates {
        let Some(plugin) = build_with(source, name, &[]) else { continue };
        let engine = engine(&plugin);
        let negative = through(&engine, "invert");
        let image = through(&engine, "my-vendor.threshold");
        let values = negative.channel(0).iter().map(|value| 1.0 - value);
        let expected: Vec<f32> = values.map(|value| if value >= 0.5 { 1.0 } else { 0.0 }).collect();
        assert_eq!(image.channel(0), expected, "{name}");
        assert!(expected.contains(&0.0) && expected.contains(&1.0));
    }
}
