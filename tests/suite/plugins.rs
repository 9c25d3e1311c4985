//! Plug-ins in C, built here and loaded as a program would.

use std::{path::PathBuf, process::Command, sync::Mutex};

use ptlib::{ComputeOptions, Engine, EngineOptions, Image};

use crate::abi::{root, run, scratch, tool};

/// Builds `tests/plugins/NAME.c` as a plug-in; `None` if there is no compiler.
fn build(name: &str) -> Option<PathBuf> {
    static BUILDING: Mutex<()> = Mutex::new(());
    let _one_at_a_time = BUILDING.lock().unwrap();
    let folder = scratch().join("plugins");
    std::fs::create_dir_all(&folder).unwrap();
    let plugin = folder.join(format!("{name}.ptplugin.so"));
    let mut command = Command::new(tool("cc")?);
    command.args(["-std=c99", "-O2", "-Wall", "-Wextra", "-pedantic-errors", "-Werror"]);
    command.args(["-shared", "-fPIC", "-fvisibility=hidden"]);
    command.arg("-I").arg(root().join("include"));
    command.arg(root().join(format!("tests/plugins/{name}.c"))).arg("-o").arg(&plugin);
    run(&mut command);
    Some(plugin)
}

/// What `block` makes of a picture, at 200 × 100 pixels.
fn through(engine: &Engine, block: &str) -> Image {
    let mut graph = engine.new_graph();
    let (source, block) = (graph.add("fault formation noise").unwrap(), graph.add(block).unwrap());
    graph.connect(source, 0, block, 0).unwrap();
    let options = ComputeOptions { size: Some((2000, 100)), ..Default::default() };
    engine.compute(&graph, block, 0, options).unwrap()
}

#[test]
fn a_block_of_a_plugin_is_like_a_built_in_one() {
    let Some(plugin) = build("points") else { return };
    let engine = Engine::new(EngineOptions::default());
    let info = engine.load_plugin(&plugin).unwrap();
    assert_eq!((info.id.as_str(), info.version.as_str()), ("ptlib-test.points", "1.0.0"));
    let (foreign, builtin) = (through(&engine, "ptlib-test.invert"), through(&engine, "invert"));
    assert_eq!(foreign.planes(), builtin.planes());
    assert_eq!(foreign.channel(0), builtin.channel(0));
}
