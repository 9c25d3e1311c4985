//! `ptc check`.

mod support;

use serde_json::Value;
use support::{Folder, end, graph, noise, twice_broken};

#[test]
fn a_sound_graph_has_nothing_to_be_said() {
    let folder = Folder::new("check_sound");
    folder.write("a.xml", &noise());
    let run = folder.ptc(&["check", "a.xml"]).ends_with(0);
    assert_eq!(run.out, "");
    assert_eq!(run.err, "ptc: 1 file checked: 0 errors, 0 warnings\n");
}

#[test]
fn every_fault_has_its_line_and_column() {
    let folder = Folder::new("check_faults");
    folder.write("a.xml", &noise());
    folder.write("b.xml", &twice_broken());
    let run = folder.ptc(&["check", "a.xml", "b.xml", "missing.xml"]).ends_with(1);
    let lines: Vec<_> = run.out.lines().collect();
    assert_eq!(lines.len(), 3, "{run:#?}");
    for (line, (position, hint)) in
        lines.iter().zip([("3:", "\"simple noise\"?"), ("4:", "\"invert\"?"), (" error:", "")])
    {
        assert!(line.contains(".xml:") && line.contains(position), "{line}");
        assert!(line.contains(": error: ") && line.contains(hint), "{line}");
    }
    run.says("3 files checked: 3 errors, 0 warnings");
}

#[test]
fn what_cannot_be_computed_is_an_error() {
    let folder = Folder::new("check_unconnected");
    let blocks = format!("<block type=\"invert\" id=\"0\"/>{}{}", end("1", "0"), end("2", "0"));
    folder.write("a.xml", &graph(&blocks));
    let run = folder.ptc(&["check", "a.xml"]).ends_with(1);
    assert_eq!(run.out.lines().count(), 1, "{run:#?}");
    assert!(run.out.starts_with("a.xml: error: block 0 (invert): input 0 "), "{run:#?}");
}

#[test]
fn a_value_that_is_not_set_yet_is_worth_a_warning() {
    let folder = Folder::new("check_inputs");
    let blocks = format!("<block type=\"image input\" id=\"0\"/>{}", end("1", "0"));
    folder.write("a.xml", &graph(&blocks));
    let run = folder.ptc(&["check", "a.xml"]).ends_with(0);
    assert!(run.out.starts_with("a.xml: warning: block 0 (image input): "), "{run:#?}");
}

#[test]
fn a_graph_without_results_is_worth_a_warning() {
    let folder = Folder::new("check_empty");
    folder.write("a.xml", &graph(""));
    let run = folder.ptc(&["check", "a.xml"]).ends_with(0);
    assert!(run.out.starts_with("a.xml: warning: the graph has no block of type"), "{run:#?}");
}

#[test]
fn faults_as_json_have_the_documented_fields() {
    let folder = Folder::new("check_json");
    folder.write("a.xml", &noise());
    folder.write("b.xml", &twice_broken());
    let run = folder.ptc(&["check", "a.xml", "b.xml", "--json"]).ends_with(1);
    assert_eq!(run.err, "");
    let report: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!(report["files"][0]["file"], "a.xml");
    assert_eq!(report["files"][0]["is_sound"], true);
    assert_eq!(report["files"][0]["faults"], Value::Array(vec![]));
    assert_eq!(report["files"][1]["is_sound"], false);
    let faults = report["files"][1]["faults"].as_array().unwrap();
    assert_eq!(faults.len(), 2);
    assert_eq!(faults[0]["severity"], "error");
    assert_eq!(faults[0]["line"], 3);
    assert!(faults[0]["column"].is_number());
    assert!(faults[0]["kind"].is_number() && faults[0]["message"].is_string());
    assert_eq!(faults[0]["hint"], "did you mean \"simple noise\"?");
}
