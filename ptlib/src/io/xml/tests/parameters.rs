//! Blocks and parameters: specification 1.1, 1.4, 1.6.

use super::*;
use crate::params::ParamValue;

fn knobs(parameters: &str) -> String {
    old(&format!("<block type='knobs' id='1'>{parameters}</block>"))
}

fn parameter(name: &str, kind: &str, value: &str) -> String {
    format!("<parameter name='{name}' type='{kind}' value='{value}'/>")
}

/// The value of a parameter in a file of PT Designer, and whether there was a warning.
fn value(name: &str, kind: &str, value: &str) -> (ParamValue, bool) {
    let (graph, warnings) = read(&knobs(&parameter(name, kind, value)));
    assert!(warnings.len() <= 1);
    (graph.get(graph.find("1").unwrap(), name).unwrap().clone(), !warnings.is_empty())
}

/// Whether a file of ours may say that.
fn is_strictly_fine(name: &str, kind: &str, value: &str) -> bool {
    let block = format!("<block type='knobs' id='1'>{}</block>", parameter(name, kind, value));
    try_read(&ours(&block)).is_ok()
}

#[test]
fn type_and_id_are_required_in_any_order() {
    let graph = read_clean(&old("<block id='7' seed='-2' type='source'/>"));
    assert_eq!(block(&graph, "7").seed().map(u64::cast_signed), Some(-2));
    assert_eq!(
        faults(&old("<block id='1'/>\n<block type='one'/>\n<block type='one' id=''/>")),
        [
            "line 2, column 1: <block> has no attribute \"type\"",
            "line 3, column 1: <block> has no attribute \"id\"",
            "line 4, column 19: the id of a block is empty",
        ]
    );
}

#[test]
fn a_block_of_unknown_type_is_kept() {
    let (graph, warnings) = read(&old("<block type='sourze' id='1'/>"));
    assert!(block(&graph, "1").spec().is_none());
    assert_eq!(
        warnings,
        ["line 2, column 8: block 1 (sourze): there is no block type \"sourze\" (did you mean \
          \"source\"?)"]
    );
    assert_eq!(read(&ours("<block type='sourze' id='1'/>")).1.len(), 1);
}

#[test]
fn a_repeated_id_means_the_first_block() {
    let (graph, warnings) = read(&old(
        "<block type='one' id='1'/><block type='two' id='1'/><block type='six' id='1'/>\
         <block type='source' id='0'/><block type='finish' id='3'><input id='1' slot='0'/></block>",
    ));
    let ids: Vec<_> = graph.blocks().map(|(_, block)| (block.id(), block.type_id())).collect();
    assert_eq!(ids, [("1", "one"), ("2", "two"), ("4", "six"), ("0", "source"), ("3", "finish")]);
    assert_eq!(block(&graph, "1").type_id(), "one");
    assert_eq!(inputs(&graph, "3"), [Some("1")]);
    assert_eq!(warnings.len(), 2);
    assert!(warnings[0].contains("an earlier block has that id (this one is block 2 from now on)"));
}

#[test]
fn whole_numbers_are_truncated_numbers() {
    for (text, expected, warns) in [
        ("7", 7, false),
        ("3.9", 3, true),
        ("1e2", 100, true),
        (" 7x", 7, true),
        ("", 0, true),
        ("many", 0, true),
    ] {
        assert_eq!(value("count", "int", text), (ParamValue::Int(expected), warns), "{text:?}");
        assert_eq!(is_strictly_fine("count", "int", text), !warns, "{text:?}");
    }
}

#[test]
fn numbers_are_decimal_prefixes() {
    for (text, expected, warns) in [
        ("0.25", 0.25, false),
        ("3.39021e-206", 3.39021e-206, false),
        ("1,5", 1.0, true),
        ("much", 0.0, true),
        ("nan", 0.0, true),
        ("inf", 0.0, true),
        ("1e999", 10.0, true),
        ("-1e999", -10.0, true),
    ] {
        let read = value("how much", "double", text);
        assert_eq!(read, (ParamValue::Float(expected), warns), "{text:?}");
        assert_eq!(is_strictly_fine("how much", "double", text), !warns, "{text:?}");
    }
}

#[test]
fn a_flag_is_true_if_it_starts_with_1() {
    for (text, expected, warns) in [
        ("1", true, false),
        ("0", false, false),
        ("true", false, true),
        ("10", true, true),
        ("", false, true),
    ] {
        assert_eq!(value("really", "bool", text), (ParamValue::Bool(expected), warns), "{text:?}");
        assert_eq!(is_strictly_fine("really", "bool", text), !warns, "{text:?}");
    }
}

#[test]
fn an_unlisted_choice_is_the_default() {
    for (text, expected, warns) in
        [("0", 0, false), ("2", 2, false), ("3", 1, true), ("-1", 1, true), ("2.9", 2, true)]
    {
        assert_eq!(value("way", "int", text), (ParamValue::Choice(expected), warns), "{text:?}");
        assert_eq!(is_strictly_fine("way", "int", text), !warns, "{text:?}");
    }
}

#[test]
fn texts_are_raw_with_references_resolved() {
    for (text, expected) in [
        ("two\nlines", "two\nlines"),
        ("a&#10;b&#x9;&lt;&gt;&amp;&quot;&apos;", "a\nb\t<>&\"'"),
        ("", ""),
        ("  kept  ", "  kept  "),
    ] {
        assert_eq!(value("words", "string", text), (ParamValue::Text(expected.into()), false));
        assert_eq!(value("path", "string", text), (ParamValue::Text(expected.into()), false));
    }
}

#[test]
fn numbers_outside_their_range_are_clamped() {
    for (text, expected) in [("256", 255), ("-1", 0), ("99999999999", 255), ("-1e300", 0)] {
        assert_eq!(value("count", "int", text), (ParamValue::Int(expected), true), "{text:?}");
        assert!(!is_strictly_fine("count", "int", text), "{text:?}");
    }
    assert_eq!(value("how much", "double", "11"), (ParamValue::Float(10.0), true));
    assert!(!is_strictly_fine("how much", "double", "11"));
}

#[test]
fn a_refused_value_says_where_and_what_is_allowed() {
    let xml = knobs(&parameter("count", "int", "256"));
    let (_, warnings) = read(&xml);
    assert_eq!(
        warnings,
        ["line 2, column 63: block 1 (knobs), parameter \"count\": is 256, allowed 0..=255 \
          (taken as 255)"]
    );
    let block = format!("<block type='knobs' id='1'>\n{}</block>", parameter("way", "int", "9"));
    assert_eq!(
        faults(&ours(&block)),
        ["line 3, column 34: block 1 (knobs), parameter \"way\": is 9, allowed 0 (first), 1 \
          (second), 2 (third)"]
    );
}

#[test]
fn a_parameter_of_another_type_is_ignored() {
    for kind in ["double", "string", "bool", "integer", ""] {
        assert_eq!(value("count", kind, "7"), (ParamValue::Int(5), true), "{kind}");
        assert!(!is_strictly_fine("count", kind, "7"), "{kind}");
    }
}

#[test]
fn an_unknown_parameter_is_kept() {
    for file in [old, ours] {
        let xml = file(&format!(
            "<block type='knobs' id='1'>{}{}</block>",
            parameter("cuont", "int", "7"),
            parameter("count", "int", "6")
        ));
        let (graph, warnings) = read(&xml);
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].contains("has no parameter \"cuont\" (did you mean \"count\"?)"));
        let [raw] = block(&graph, "1").extra_parameters() else { panic!("one is unknown") };
        assert_eq!((&*raw.name, &*raw.kind, &*raw.value), ("cuont", "int", "7"));
        assert_eq!(block(&graph, "1").values()[0], ParamValue::Int(6));
    }
}

#[test]
fn missing_parameters_keep_their_defaults() {
    let graph = read_clean(&knobs(""));
    let [count, amount, really, way, words, path] = block(&graph, "1").values() else {
        panic!("six parameters")
    };
    assert_eq!((count, amount), (&ParamValue::Int(5), &ParamValue::Float(0.5)));
    assert_eq!((really, way), (&ParamValue::Bool(false), &ParamValue::Choice(1)));
    assert_eq!(words, &ParamValue::Text("a b".into()));
    assert_eq!(path, &ParamValue::Text("".into()));
}

#[test]
fn of_a_repeated_parameter_the_last_counts() {
    let xml = knobs(&(parameter("count", "int", "1") + &parameter("count", "int", "2")));
    let (graph, warnings) = read(&xml);
    assert_eq!(block(&graph, "1").values()[0], ParamValue::Int(2));
    assert_eq!(warnings.len(), 1);
}

#[test]
fn a_parameter_needs_name_type_and_value() {
    for incomplete in ["name='count' type='int'", "name='count' value='1'", "type='int' value='1'"]
    {
        let block = format!("<block type='knobs' id='1'><parameter {incomplete}/></block>");
        let (graph, warnings) = read(&old(&block));
        assert_eq!(block_count(&graph), ParamValue::Int(5), "{incomplete}");
        assert_eq!(warnings.len(), 1, "{incomplete}");
        assert_eq!(fault_kind(&ours(&block)), ErrorKind::Parse, "{incomplete}");
    }
}

fn block_count(graph: &Graph) -> ParamValue {
    block(graph, "1").values()[0].clone()
}

#[test]
fn texts_have_a_limit() {
    let xml = knobs(&parameter("words", "string", "1234567"));
    let limits = Limits { text_bytes: 6, ..Limits::default() };
    let error = read_graph(xml.as_bytes(), &registry(), &limits).unwrap_err();
    let limit = error.faults().find(|fault| fault.kind() == ErrorKind::Limit).unwrap();
    assert!(limit.to_string().contains("a text has 7 bytes, allowed 6"), "{error}");
}
