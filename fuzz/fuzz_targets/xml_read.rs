//! Reads any bytes as a graph file. Whatever is read must survive writing and reading again.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use ptlib::{Engine, EngineOptions, io::write_graph};

static ENGINE: LazyLock<Engine> =
    LazyLock::new(|| Engine::new(EngineOptions { threads: 1, ..EngineOptions::default() }));

fuzz_target!(|xml: &[u8]| {
    let Ok(reading) = ENGINE.read_graph(xml) else { return };
    let written = write_graph(&reading.graph);
    let again = ENGINE.read_graph(written.as_bytes()).expect("what was written is readable");
    assert_eq!(write_graph(&again.graph), written, "writing changed the graph");
    assert_eq!(again.graph.settings(), reading.graph.settings());
    assert_eq!(again.graph.blocks().len(), reading.graph.blocks().len());
    assert_eq!(again.graph.connections().count(), reading.graph.connections().count());
});
