//! What is read is written again.

use super::*;
use crate::{io::write_graph, math::levels::Precision};

/// Reads, writes, reads and writes; both writings are the same.
fn rewritten(xml: &str) -> String {
    let written = write_graph(&read(xml).0);
    assert_eq!(write_graph(&read(&written).0), written);
    written
}

const OLD: &str = "<!DOCTYPE ptgraph>
<texturegraph width=\"512\" height=\"256\" seed=\"-7\" supersampling=\"2\" author=\"A &amp; B\">
\t<block type=\"two\" id=\"34\" seed=\"-1\" color=\"red\">
\t\t<input id=\"k\" slot=\"0\"/>
\t\t<input id=\"9\" slot=\"1\"/>
\t</block>
\t<block type=\"knobs\" id=\"k\">
\t\t<parameter name=\"count\" type=\"int\" value=\"255\"/>
\t\t<parameter name=\"how much\" type=\"double\" value=\"3.39021e-206\"/>
\t\t<parameter name=\"really\" type=\"bool\" value=\"1\"/>
\t\t<parameter name=\"way\" type=\"int\" value=\"2\"/>
\t\t<parameter name=\"words\" type=\"string\" value=\"a&#10;&lt;&gt; &quot;&apos;&#9;&#13;\"/>
\t\t<parameter name=\"path\" type=\"string\" value=\"C:/ü.png\"/>
\t\t<parameter name=\"from the future\" type=\"colour\" value=\" &amp;lt; \"/>
\t</block>
\t<block type=\"of a plug-in\" id=\"9\" x:y=\"1\">
\t\t<input id=\"k\" slot=\"0\"/>
\t\t<input id=\"k\" slot=\"3\"/>
\t\t<parameter name=\"b\" type=\"int\" value=\"3.9\"/>
\t\t<parameter name=\"a\" type=\"\" value=\"\"/>
\t\t<parameter name=\"b\" type=\"int\" value=\"again\"/>
\t</block>
\t<block type=\"source\" id=\"0\"/>
</texturegraph>

";

#[test]
fn a_file_of_pt_designer_is_written_as_it_was() {
    assert_eq!(rewritten(OLD), OLD);
}

#[test]
fn a_file_of_ours_is_written_as_it_was() {
    let ours = OLD
        .replace("supersampling=\"2\"", "supersampling=\"2\" version=\"1\" precision=\"float\"")
        .replace("id=\"k\" slot=\"3\"", "id=\"0\" slot=\"200\" output=\"1\"");
    assert_eq!(rewritten(&ours), ours);
    let eight = ours.replace("float", "8");
    assert_eq!(rewritten(&eight), eight);
}

#[test]
fn a_new_graph_is_a_file_of_ours() {
    let mut graph = Graph::new(registry());
    graph.add("source").unwrap();
    graph.set_precision(Precision::EightBit);
    assert_eq!(
        graph.to_xml(),
        "<!DOCTYPE ptgraph>\n<texturegraph width=\"256\" height=\"256\" seed=\"0\" \
         supersampling=\"1\" version=\"1\" precision=\"8\">\n\t<block type=\"source\" id=\"0\"/>\n\
         </texturegraph>\n\n"
    );
    assert_eq!(rewritten(&graph.to_xml()), graph.to_xml());
}

#[test]
fn an_old_graph_becomes_ours_when_it_must() {
    let blocks = "<block type='source' id='1'/><block type='six' id='2'/>";
    let (mut graph, _) = read(&old(blocks));
    let (source, six) = (graph.find("1").unwrap(), graph.find("2").unwrap());
    graph.connect(source, 0, six, 4).unwrap();
    assert!(!graph.to_xml().contains("version"));

    let mut float = graph.clone();
    float.set_precision(Precision::Float);
    assert!(float.to_xml().contains("version=\"1\" precision=\"float\""));
    let mut output = graph.clone();
    output.connect(source, 1, six, 0).unwrap();
    assert!(output.to_xml().contains("version=\"1\" precision=\"8\""));
    graph.connect(source, 0, six, 5).unwrap();
    assert!(graph.to_xml().contains("version=\"1\" precision=\"8\""));
    for graph in [float, output, graph] {
        assert_eq!(rewritten(&graph.to_xml()), graph.to_xml());
    }
}

#[test]
fn what_was_tolerated_is_written_properly() {
    let (mut graph, _) =
        read(&old("<thing id='1' type='knobs'><parameter name='count' type='int' value='1e9'/>\
         <parameter name='way' type='string' value='1'/></thing>\
         <block type='one' id='1'><input id='1' slot='0'/><input id='1' slot='0'/></block>"));
    graph.set_precision(Precision::Float);
    let written = graph.to_xml();
    assert_eq!(read_clean(&written).to_xml(), written);
}

#[test]
fn texts_that_xml_cannot_hold_lose_only_those_characters() {
    let mut graph = Graph::new(registry());
    let knobs = graph.add("knobs").unwrap();
    graph.set_text(knobs, "words", "a\u{0}b\r\n\tc\u{1b}").unwrap();
    let graph = read_clean(&graph.to_xml());
    let words = graph.get(graph.find("0").unwrap(), "words").unwrap().clone();
    let expected = "a\u{fffd}b\r\n\tc\u{fffd}";
    assert_eq!(words, crate::params::ParamValue::Text(expected.into()));
}
