//! The root and what may stand around blocks: specification 1.1, 1.4, 1.5.

use super::*;
use crate::math::levels::Precision;

fn root(attributes: &str) -> String {
    format!("<texturegraph {attributes}></texturegraph>")
}

#[test]
fn the_root_is_texturegraph_and_comes_first() {
    assert_eq!(
        faults("<svg><block/></svg>"),
        ["line 1, column 1: the root element is <svg>, not <texturegraph> (is this a graph file?)"]
    );
    for xml in ["", "  \n", "<!-- nothing -->", "<?xml version=\"1.0\"?>"] {
        assert!(faults(xml)[0].contains("no root element"), "{xml:?}");
    }
    assert!(faults(&format!("x{}", old("")))[0].contains("text outside"));
    assert!(faults(&format!("{}\n<b/>", old("")))[0].starts_with("line 4, column 1: "));
}

#[test]
fn what_stands_around_the_root_is_ignored() {
    let graph = read_clean(&format!(
        "\u{feff}<?xml version=\"1.0\" encoding=\"UTF-8\"?><!DOCTYPE ptgraph [<!ENTITY a \"b\">]>\n\
         <!-- <svg> --><?pi data?>{}\n\n<!-- end -->",
        old("<!-- a --><block type=\"source\" id=\"1\"><!-- b --></block>")
    ));
    assert_eq!(graph.blocks().len(), 1);
}

#[test]
fn sizes_seed_and_supersampling_in_any_order() {
    let graph = read_clean(&root("supersampling='6' seed=\"-3\" width='640' height='1'"));
    let settings = graph.settings();
    assert_eq!((settings.width, settings.height, settings.supersampling), (640, 1, 6));
    assert_eq!(settings.seed.cast_signed(), -3);
    assert_eq!(settings.precision, Precision::EightBit);
}

#[test]
fn missing_attributes_have_defaults() {
    let (graph, warnings) = read("<texturegraph/>");
    let settings = graph.settings();
    assert_eq!((settings.width, settings.height), (256, 256));
    assert_eq!((settings.seed, settings.supersampling), (0, 1));
    assert_eq!(warnings.len(), 4);
    assert!(warnings[0].contains("<texturegraph> has no attribute \"width\" (taken as 256)"));
    assert_eq!(read("<texturegraph version='1'/>").1.len(), 4);
}

#[test]
fn old_numbers_are_decimal_prefixes() {
    let (graph, warnings) = read(&root("width='12px' height=' 9.9' seed='zero' supersampling='2'"));
    assert_eq!((graph.settings().width, graph.settings().height), (12, 9));
    assert_eq!(graph.settings().seed, 0);
    assert_eq!(warnings.len(), 3);
    assert!(warnings[0].ends_with("width is \"12px\", which is no whole number (taken as 12)"));
    let strict = root("width='12px' height=' 9.9' seed='zero' supersampling='2' version='1'");
    assert_eq!(faults(&strict).len(), 3);
}

#[test]
fn sizes_below_1_or_above_the_limit_are_refused() {
    for width in ["0", "-5", "wide"] {
        let xml = root(&format!("width='{width}' height='8' seed='0' supersampling='1'"));
        assert_eq!(fault_kind(&xml), ErrorKind::OutOfRange, "{width}");
    }
    let xml = root("width='8' height='70000' seed='0' supersampling='1'");
    assert_eq!(fault_kind(&xml), ErrorKind::Limit);
    assert!(faults(&xml)[0].starts_with("line 1, column 25: height is 70000, allowed 1..=65536"));
    assert!(faults(&xml)[0].contains("Limits::image_side"));
}

#[test]
fn supersampling_is_0_to_6() {
    let with =
        |level: &str| root(&format!("width='8' height='8' seed='0' supersampling='{level}'"));
    for (level, expected) in [("0", 1), ("7", 6), ("-1", 6), ("99999999999", 6)] {
        let (graph, warnings) = read(&with(level));
        assert_eq!(graph.settings().supersampling, expected);
        assert_eq!(warnings.len(), 1, "{level}");
    }
    let strict = with("7").replace("seed", "version='1' seed");
    assert_eq!(fault_kind(&strict), ErrorKind::OutOfRange);
}

#[test]
fn seeds_are_64_bits() {
    let with = |seed: &str| root(&format!("width='8' height='8' seed='{seed}' supersampling='1'"));
    assert_eq!(read_clean(&with("18446744073709551615")).settings().seed, u64::MAX);
    assert_eq!(read_clean(&with("-1")).settings().seed, u64::MAX);
    let (graph, warnings) = read(&with("18446744073709551616"));
    assert_eq!((graph.settings().seed, warnings.len()), (u64::MAX, 1));
}

#[test]
fn versions_beyond_ours_are_refused() {
    assert_eq!(
        fault_kind("<texturegraph version='2'><nonsense/></texturegraph>"),
        ErrorKind::Unsupported
    );
    assert_eq!(
        faults("<texturegraph version='2'><nonsense/></texturegraph>"),
        ["line 1, column 15: version 2 of the file format; this library reads up to 1 (a newer \
          ptlib wrote the file)"]
    );
    for version in ["0", "-1", "", "one", "1.0"] {
        let kind = fault_kind(&format!("<texturegraph version='{version}'/>"));
        assert_eq!(kind, ErrorKind::Parse, "{version}");
    }
}

#[test]
fn precision_is_8_or_float() {
    let with =
        |rest: &str| root(&format!("width='8' height='8' seed='0' supersampling='1' {rest}"));
    let precision = |rest: &str| read_clean(&with(rest)).settings().precision;
    assert_eq!(precision(""), Precision::EightBit);
    assert_eq!(precision("precision='8'"), Precision::EightBit);
    assert_eq!(precision("precision='float'"), Precision::Float);
    assert_eq!(precision("version='1'"), Precision::EightBit);
    assert_eq!(precision("version='1' precision='float'"), Precision::Float);
    assert_eq!(fault_kind(&with("precision='16'")), ErrorKind::OutOfRange);
}

#[test]
fn every_child_of_an_old_root_is_a_block() {
    let (graph, warnings) = read(&old("<node type='source' id='1'/>"));
    assert_eq!(block(&graph, "1").type_id(), "source");
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].contains("<node> where only <block> is allowed (taken as a block)"));
    assert_eq!(fault_kind(&ours("<node type='source' id='1'/>")), ErrorKind::Parse);
}

#[test]
fn stray_text_is_ignored() {
    let (graph, warnings) =
        read(&old("stray <block type='source' id='1'><![CDATA[x]]></block>&amp; &#65;"));
    assert_eq!(graph.blocks().len(), 1);
    assert_eq!(warnings.len(), 4);
    assert_eq!(warnings[0], "line 2, column 1: text \"stray\" is ignored");
}

#[test]
fn other_children_of_a_block_are_ignored() {
    let (graph, warnings) =
        read(&old("<block type='one' id='1'><deep><input id='1' slot='0'/></deep></block>"));
    assert_eq!(inputs(&graph, "1"), [None]);
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].contains("<deep> is ignored"));
}
