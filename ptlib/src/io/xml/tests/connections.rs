//! Connections: specification 1.2.

use super::*;

/// Blocks 1 and 2 of type `source`, and one of `type_id` with the id 9 and these inputs.
fn consumer(type_id: &str, inputs: &[(&str, &str)]) -> String {
    let inputs: String =
        inputs.iter().map(|(id, slot)| format!("\n<input id='{id}' slot='{slot}'/>")).collect();
    format!(
        "<block type='source' id='1'/><block type='source' id='2'/>\
         <block type='{type_id}' id='9'>{inputs}</block>"
    )
}

/// What becomes of connections in a file of PT Designer; in one of ours, each refusal is a fault.
fn check(type_id: &str, wanted: &[(&str, &str)], made: &[Option<&str>], refused: &[&str]) {
    let blocks = consumer(type_id, wanted);
    let (graph, warnings) = read(&old(&blocks));
    assert_eq!(inputs(&graph, "9"), made);
    assert_eq!(warnings.len(), refused.len(), "{warnings:?}");
    for (warning, refused) in warnings.iter().zip(refused) {
        assert!(warning.contains(refused), "{warning}");
    }
    if !refused.is_empty() {
        assert_eq!(faults(&ours(&blocks)).len(), refused.len());
    }
}

#[test]
fn a_slot_beyond_the_inputs_is_refused() {
    check("one", &[("1", "0")], &[Some("1")], &[]);
    check("one", &[("1", "1")], &[None], &["slot is 1, allowed 0..=0"]);
    check("one", &[("1", "-1")], &[None], &["slot is -1, allowed 0..=0"]);
    check("source", &[("1", "0")], &[], &["takes no inputs, slot is 0"]);
}

#[test]
fn old_files_have_five_slots() {
    let blocks = consumer("six", &[("1", "4"), ("2", "5")]);
    let (graph, warnings) = read(&old(&blocks));
    assert_eq!(inputs(&graph, "9")[4..], [Some("1"), None]);
    assert!(warnings[0].contains("slot is 5, allowed 0..=4"));
    assert_eq!(inputs(&read_clean(&ours(&blocks)), "9")[4..], [Some("1"), Some("2")]);
}

#[test]
fn nobody_reads_what_ends_a_graph() {
    let blocks = "<block type='source' id='1'/>\
        <block type='finish' id='2'><input id='1' slot='0'/></block>\
        <block type='one' id='3'>\n<input id='2' slot='0'/></block>";
    let (graph, warnings) = read(&old(blocks));
    assert_eq!(inputs(&graph, "3"), [None]);
    assert_eq!(
        warnings,
        ["line 3, column 1: block 2 (finish): ends the graph: block 3 (one) cannot read it"]
    );
    assert_eq!(faults(&ours(blocks)), warnings);
}

#[test]
fn a_full_block_refuses_before_it_replaces() {
    let full = "all 1 inputs are";
    check("one", &[("1", "0"), ("2", "0")], &[Some("1")], &[full]);
    let all = "all 2 inputs are";
    check("two", &[("1", "0"), ("2", "1"), ("2", "0")], &[Some("1"), Some("2")], &[all]);
}

#[test]
fn with_spare_capacity_the_last_of_a_slot_counts() {
    let blocks = consumer("two", &[("1", "0"), ("2", "0")]);
    for file in [old, ours] {
        let (graph, warnings) = read(&file(&blocks));
        assert_eq!(inputs(&graph, "9"), [Some("2"), None]);
        assert!(warnings[0].contains("slot 0 is there more than once: the last one counts"));
    }
}

#[test]
fn a_cycle_is_refused_where_file_order_closes_it() {
    let blocks = "<block type='two' id='1'>\n<input id='3' slot='0'/>\n<input id='1' slot='1'/>\
        </block><block type='one' id='2'>\n<input id='1' slot='0'/></block>\
        <block type='one' id='3'>\n<input id='2' slot='0'/></block>";
    let (graph, warnings) = read(&old(blocks));
    assert_eq!(inputs(&graph, "1"), [Some("3"), None]);
    assert_eq!(inputs(&graph, "2"), [Some("1")]);
    assert_eq!(inputs(&graph, "3"), [None]);
    assert_eq!(
        warnings,
        [
            "line 4, column 1: block 1 (two): connecting block 1 (two) to input 1 of block 1 (two) \
             would close a cycle",
            "line 6, column 1: block 3 (one): connecting block 2 (one) to input 0 of block 3 (one) \
             would close a cycle",
        ]
    );
    assert_eq!(faults(&ours(blocks)), warnings);
    assert_eq!(fault_kind(&ours(blocks)), ErrorKind::Cycle);
}

#[test]
fn inputs_may_name_later_blocks_but_no_missing_ones() {
    let blocks = "<block type='two' id='1'>\n<input id='2' slot='0'/>\n<input id='7' slot='1'/>\
        </block><block type='source' id='2'/>";
    let (graph, warnings) = read(&old(blocks));
    assert_eq!(inputs(&graph, "1"), [Some("2"), None]);
    assert_eq!(
        warnings,
        ["line 4, column 1: block 1 (two): input 1 names block 7 (there is no block of that id \
          in the file)"]
    );
    assert_eq!(fault_kind(&ours(blocks)), ErrorKind::NotFound);
}

#[test]
fn an_input_needs_an_id_and_a_slot() {
    for input in ["<input id='1'/>", "<input slot='0'/>"] {
        let blocks =
            format!("<block type='source' id='1'/><block type='one' id='2'>{input}</block>");
        let (graph, warnings) = read(&old(&blocks));
        assert_eq!(inputs(&graph, "2"), [None]);
        assert_eq!(warnings.len(), 1);
        assert_eq!(fault_kind(&ours(&blocks)), ErrorKind::Parse);
    }
}

#[test]
fn kinds_are_not_checked_but_told() {
    let blocks = "<block type='colors' id='1'/>\
        <block type='one' id='2'>\n<input id='1' slot='0'/></block>";
    for file in [old, ours] {
        let (graph, warnings) = read(&file(blocks));
        assert_eq!(inputs(&graph, "2"), [Some("1")]);
        assert_eq!(
            warnings,
            ["line 3, column 1: block 2 (one): input 0 (\"image\") takes a value of kind image, \
              but block 1 (colors) gives one of kind gradient"]
        );
    }
}

#[test]
fn an_input_may_name_another_output() {
    let one = |output: &str| {
        format!(
            "<block type='source' id='1'/>\
             <block type='one' id='2'><input id='1' slot='0' output='{output}'/></block>"
        )
    };
    let output = |graph: &Graph| block(graph, "2").inputs()[0].map(|source| source.output);
    for file in [old, ours] {
        assert_eq!(output(&read_clean(&file(&one("1")))), Some(1));
    }
    let (graph, warnings) = read(&old(&one("2")));
    assert_eq!((output(&graph), warnings.len()), (None, 1));
    assert!(warnings[0].contains("block 1 has no output 2"));
    assert_eq!(fault_kind(&ours(&one("2"))), ErrorKind::NotFound);
    assert_eq!(fault_kind(&ours(&one("-1"))), ErrorKind::NotFound);
}

#[test]
fn one_output_feeds_any_number_of_slots() {
    check("two", &[("1", "0"), ("1", "1")], &[Some("1"), Some("1")], &[]);
}

#[test]
fn a_block_of_unknown_type_has_any_connections() {
    let blocks = "<block type='?' id='1'>\n<input id='2' slot='4'/>\n<input id='2' slot='5'/>\
        </block><block type='?' id='2'/>\
        <block type='one' id='3'><input id='1' slot='0' output='9'/></block>";
    let (graph, _) = read(&old(blocks));
    assert_eq!(inputs(&graph, "1"), [None, None, None, None, Some("2")]);
    let (graph, _) = read(&ours(blocks));
    assert_eq!(inputs(&graph, "1")[4..], [Some("2"), Some("2")]);
    assert_eq!(inputs(&graph, "3"), [Some("1")]);
    let huge = blocks.replace("slot='5'", "slot='4294967295'");
    assert!(faults(&ours(&huge))[0].contains("slot is 4294967295, allowed 0..=255"));
}
