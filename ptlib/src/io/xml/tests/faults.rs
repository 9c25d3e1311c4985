//! Files that are refused, and how.

use super::*;

#[test]
fn all_faults_of_a_file_are_reported_in_order() {
    let xml = ours(
        "<block type='knobs' id='1'>\n\
         \t<parameter name='count' type='int' value='x'/>\n\
         \t<parameter name='way' type='int' value='7'/>\n\
         </block>\n\
         <block type='one' id='ü'><input id='1' slot='3'/></block>\n\
         <block id='3'/>\n\
         <block type='one' id='4'><input id='3' slot='0'/></block>",
    );
    assert_eq!(
        faults(&xml),
        [
            "line 3, column 37: block 1 (knobs), parameter \"count\": is \"x\", which is not a \
             whole number",
            "line 4, column 35: block 1 (knobs), parameter \"way\": is 7, allowed 0 (first), 1 \
             (second), 2 (third)",
            "line 6, column 26: block ü (one): slot is 3, allowed 0..=0",
            "line 7, column 1: <block> has no attribute \"type\"",
        ]
    );
    let error = try_read(&xml).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Parse);
    assert_eq!(error.place().parameter.as_deref(), Some("count"));
}

#[test]
fn reading_stops_at_the_limit_of_faults() {
    let limits = Limits { faults: 3, ..Limits::default() };
    let error =
        read_graph(old(&"<block/>".repeat(9)).as_bytes(), &registry(), &limits).unwrap_err();
    assert_eq!(error.faults().count(), 4);
    assert!(error.to_string().contains("reading stopped after 3 faults"));
}

#[test]
fn warnings_beyond_the_limit_are_counted() {
    let limits = Limits { faults: 3, ..Limits::default() };
    let xml = old(&"stray <block type='one' id='1'/>".repeat(4));
    let reading = read_graph(xml.as_bytes(), &registry(), &limits).unwrap();
    let warnings: Vec<_> = reading.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 4);
    assert!(warnings[3].contains("4 more warnings are not listed"), "{warnings:?}");
}

#[test]
fn malformed_xml_is_refused() {
    for (body, expected) in [
        ("<block type='one' id='1>\n", "line 2, column 1: attribute value not closed"),
        ("<block type='one' id='1'>", "line 3, column 1: </texturegraph> where </block> should be"),
        ("<!-- ", "line 2, column 1: comment not closed"),
        (
            "<block type='one' id=1/>",
            "line 2, column 22: the value of an attribute is not in quotes",
        ),
        ("<block type='one' id/>", "an attribute without \"=\""),
        ("<block type='one' id='1' id='2'/>", "line 2, column 26: attribute \"id\" is there twice"),
        ("<block type='one' id='1' 7='2'/>", "line 2, column 26: \"7\" is no name of an attribute"),
        ("<block type='&one;' id='1'/>", "line 2, column 8: entity &one; is none of the five"),
        ("<block type='&#xD800;' id='1'/>", "line 2, column 8: a reference to no character"),
        ("<block type='&#27;' id='1'/>", "refers to character 27, which XML forbids"),
        ("<block type='a & b' id='1'/>", "an & without its ;"),
        ("&lol;", "line 2, column 1: entity &lol; is none of the five of XML"),
        ("a & b", "line 2, column 3: an & without its ;"),
    ] {
        let faults = faults(&old(body));
        assert!(faults[0].contains(expected), "{body}: {faults:?}");
        assert_eq!(fault_kind(&old(body)), ErrorKind::Parse, "{body}");
    }
}

#[test]
fn a_file_that_ends_too_early_names_the_open_element() {
    let xml = old("<block type='one' id='1'>");
    let cut = xml.strip_suffix("</texturegraph>").unwrap();
    assert_eq!(faults(cut), ["line 2, column 1: the file ends before the end of this element"]);
    let cut = cut.strip_suffix(">\n").unwrap();
    assert!(faults(cut)[0].starts_with("line 2, column 1: tag not closed"));
}

#[test]
fn only_utf_8_is_read() {
    let read = |xml: &[u8]| read_graph(xml, &registry(), &Limits::default()).unwrap_err();
    for bom in [[0xff, 0xfe], [0xfe, 0xff]] {
        assert_eq!(read(&bom).kind(), ErrorKind::Unsupported);
    }
    let error = read(b"<texturegraph>\n<\xc3\xa4 \xff");
    assert_eq!(error.kind(), ErrorKind::Parse);
    assert_eq!(error.place().position, Some((2, 4)));
    let latin1 = format!("<?xml version='1.0' encoding='ISO-8859-1'?>{}", old(""));
    assert_eq!(read(latin1.as_bytes()).kind(), ErrorKind::Unsupported);
    let error = read(b"<texturegraph a='\0'/>");
    assert!(error.to_string().contains("column 18: character 0, which XML forbids"), "{error}");
}

#[test]
fn limits_say_the_number_and_how_to_raise_it() {
    let xml = old("<block type='one' id='1'><a><b/></a><input id='1' slot='9'/></block>");
    let fault = |limits: Limits| {
        let error = read_graph(xml.as_bytes(), &registry(), &limits).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
        error.to_string()
    };
    let none = Limits::default();
    let file_bytes = fault(Limits { file_bytes: 9, ..none });
    assert!(
        file_bytes.contains("bytes, allowed 9 (the caller can raise that: `Limits::file_bytes`")
    );
    assert!(fault(Limits { blocks: 0, ..none }).contains("more than 0 blocks"));
    assert!(fault(Limits { connections: 0, ..none }).contains("more than 0 connections"));
    assert!(fault(Limits { nesting: 3, ..none }).contains("nested deeper than 3"));
    let fine = Limits { blocks: 1, connections: 1, nesting: 4, ..none };
    read_graph(xml.as_bytes(), &registry(), &fine).unwrap();
}

#[test]
fn a_million_attributes_are_read_in_linear_time() {
    let attributes: String = (0..1_000_000).map(|i| format!(" a{i}=''")).collect();
    let xml = old(&format!("<block type='one' id='1'{attributes}/>"));
    let graph = read_clean(&xml);
    assert_eq!(block(&graph, "1").extra_attributes().len(), 1_000_000);
}

#[test]
fn many_blocks_and_cycles_have_limits() {
    let blocks: String = (0..10_000)
        .map(|i| {
            let inputs: String = (0..5)
                .map(|slot| {
                    format!("<input id='{}' slot='{slot}'/>", (i * 7919 + slot * 31 + 1) % 10_000)
                })
                .collect();
            format!("<block type='?' id='{i}'>{inputs}</block>")
        })
        .collect();
    assert_eq!(
        faults(&old(&blocks)).last().unwrap().split(": ").nth(1),
        Some("more than 100 connections would close cycles (the caller can raise that")
    );
    let blocks = blocks + "<block type='one' id='last'/>";
    assert_eq!(fault_kind(&old(&blocks)), ErrorKind::Limit);
}
