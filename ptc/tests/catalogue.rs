//! `ptc list` and `ptc describe`.

mod support;

use std::{
    io::{BufRead as _, BufReader},
    process::Stdio,
};

use serde_json::Value;
use support::{Run, ptc};

fn run(arguments: &[&str]) -> Run {
    ptc().args(arguments).output().expect("the program starts").into()
}

#[test]
fn the_list_has_every_block_type_under_its_family() {
    let run = run(&["list"]).ends_with(0);
    assert_eq!(run.err, "");
    for spec in ptlib::block::Registry::builtin().blocks() {
        assert!(run.out.contains(&format!("\n  {}", spec.about.id)), "{}", spec.about.id);
    }
    assert!(run.out.contains("results\n  end"), "{}", run.out);
    assert!(!run.out.contains('\u{1b}'), "colours in a pipe");
}

#[test]
fn one_family_can_be_listed() {
    let run = run(&["list", "--family", "results"]).ends_with(0);
    assert!(run.out.starts_with("results\n"), "{}", run.out);
    assert!(!run.out.contains("invert"), "{}", run.out);
}

#[test]
fn an_unknown_family_gets_all_names() {
    let run = run(&["list", "--family", "result"]).ends_with(2).says_one_error();
    run.says("no family \"result\"").says("(hint: families are ").says("results");
}

#[test]
fn the_list_as_json_describes_every_block_type() {
    let run = run(&["list", "--json"]).ends_with(0);
    let list: Value = serde_json::from_str(&run.out).unwrap();
    let blocks = list["blocks"].as_array().unwrap();
    let registry = ptlib::block::Registry::builtin();
    assert_eq!(blocks.len(), registry.blocks().len());
    for (block, spec) in blocks.iter().zip(registry.blocks()) {
        assert_eq!(block["id"], spec.about.id);
        assert_eq!(block["family"], registry.family_of(spec.about.id).unwrap());
        assert_eq!(block["parameters"].as_array().unwrap().len(), spec.params.len());
    }
}

#[test]
fn a_description_names_ranges_defaults_and_alternatives() {
    let run = run(&["describe", "blur"]).ends_with(0);
    assert!(run.out.starts_with("blur ("), "{}", run.out);
    for part in ["Inputs\n", "Outputs\n", "Parameters\n", "intensity: int", "default 10"] {
        assert!(run.out.contains(part), "no {part:?} in {}", run.out);
    }
}

#[test]
fn a_description_as_json_has_the_documented_fields() {
    let quoted = run(&["describe", "perlin noise", "--json"]).ends_with(0);
    let unquoted = run(&["describe", "--json", "perlin", "noise"]).ends_with(0);
    assert_eq!(quoted.out, unquoted.out);
    let block: Value = serde_json::from_str(&quoted.out).unwrap();
    assert_eq!(block["id"], "perlin noise");
    assert_eq!(block["role"], "inner");
    assert_eq!(block["uses_seed"], true);
    assert_eq!(block["inputs"], Value::Array(vec![]));
    assert_eq!(block["outputs"][0]["kind"], "image");
    assert_eq!(block["outputs"][0]["planes"], "grey");
    let parameters = block["parameters"].as_array().unwrap();
    let find = |id: &str| parameters.iter().find(|parameter| parameter["id"] == id).unwrap();
    let frequency = find("frequency");
    assert_eq!(frequency["kind"], "int");
    assert_eq!(frequency["default"], 6);
    assert_eq!(frequency["hard"]["min"], 1);
    assert!(frequency["soft"]["max"].is_number());
    let interpolation = find("interpolation");
    assert_eq!(interpolation["default"], 1);
    assert_eq!(interpolation["choices"][1]["number"], 1);
    assert!(interpolation["choices"][1]["id"].is_string());
    assert!(interpolation.get("hard").is_none());
}

#[test]
fn a_misspelt_block_type_gets_a_hint() {
    let run = run(&["describe", "perlin", "nose"]).ends_with(2).says_one_error();
    run.says("no block type \"perlin nose\"").says("(hint: did you mean \"perlin noise\"?)");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_fault() {
    for arguments in [&["list"][..], &["list", "--json"], &["describe", "end"], &["--help"]] {
        let mut child = ptc()
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut first = String::new();
        let mut out = BufReader::with_capacity(1, child.stdout.take().unwrap());
        out.read_line(&mut first).unwrap();
        drop(out);
        let run = Run::from(child.wait_with_output().unwrap()).ends_with(0);
        assert!(!first.is_empty() && run.err.is_empty(), "{run:#?}");
    }
}
