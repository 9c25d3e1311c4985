//! Writing: specification 1.1.

use std::fmt::{Display, Write};

use super::{OLD_SLOTS, is_xml_char, type_word};
use crate::{
    graph::{Block, Graph, Settings},
    math::levels::Precision,
    params::ParamValue,
};

/// The graph as a file's contents.
///
/// A new graph becomes a file of ours, with `version` and `precision`. A graph that was read from a
/// file of PT Designer becomes one that PT Designer reads, without them, unless it has become
/// something that PT Designer cannot express: float precision, a connection to an output other than
/// the first, or to an input beyond the fifth.
///
/// Reading the result and writing it again gives the same bytes. Numbers are written in the
/// shortest form that reads as the same number. Seeds are written as signed numbers, which is what
/// old files have. Characters that XML does not have (0 to 31 except tab and line ends) become
/// U+FFFD.
#[must_use]
pub fn write_graph(graph: &Graph) -> String {
    let mut out = String::from("<!DOCTYPE ptgraph>\n<texturegraph");
    let settings = graph.settings();
    attribute(&mut out, "width", &settings.width);
    attribute(&mut out, "height", &settings.height);
    attribute(&mut out, "seed", &settings.seed.cast_signed());
    attribute(&mut out, "supersampling", &settings.supersampling);
    if let Some(version) = version(graph) {
        attribute(&mut out, "version", &version);
        let precision = match settings.precision {
            Precision::EightBit => "8",
            Precision::Float => "float",
        };
        attribute(&mut out, "precision", &precision);
    }
    extra_attributes(&mut out, graph.extra_attributes());
    out.push_str(">\n");
    for (_, block) in graph.blocks() {
        write_block(&mut out, graph, block);
    }
    out.push_str("</texturegraph>\n\n");
    out
}

impl Graph {
    /// The graph as a file's contents: see [`write_graph`].
    #[must_use]
    pub fn to_xml(&self) -> String {
        write_graph(self)
    }
}

/// The version of the file format to write; `None` for one that PT Designer reads.
fn version(graph: &Graph) -> Option<u32> {
    let needs_version = graph.settings().precision != Precision::EightBit
        || graph
            .connections()
            .any(|connection| connection.source.output > 0 || connection.input >= OLD_SLOTS);
    graph.file_version().or(needs_version.then_some(Settings::FILE_VERSION))
}

fn write_block(out: &mut String, graph: &Graph, block: &Block) {
    out.push_str("\t<block");
    attribute(out, "type", &block.type_id());
    attribute(out, "id", &block.id());
    let plugin = block.spec().and_then(|_| graph.registry().plugin_of(block.type_id()));
    let loaded = plugin.map(|plugin| (&plugin.id, &plugin.version));
    let named = || block.origin().map(|origin| (&origin.plugin, &origin.version));
    if let Some((plugin, version)) = loaded.or_else(named) {
        attribute(out, "plugin", plugin);
        attribute(out, "plugin-version", version);
    }
    if let Some(seed) = block.seed() {
        attribute(out, "seed", &seed.cast_signed());
    }
    extra_attributes(out, block.extra_attributes());
    let start = out.len();
    out.push_str(">\n");
    let children = out.len();
    for (slot, source) in block.inputs().iter().enumerate() {
        let Some(source) = source else { continue };
        let Ok(from) = graph.block(source.block) else { continue };
        out.push_str("\t\t<input");
        attribute(out, "id", &from.id());
        attribute(out, "slot", &slot);
        if source.output > 0 {
            attribute(out, "output", &source.output);
        }
        out.push_str("/>\n");
    }
    let declared = block.spec().map(|spec| spec.params).unwrap_or_default();
    for (spec, value) in declared.iter().zip(block.values()) {
        parameter(out, spec.id, type_word(spec), &value_text(value));
    }
    for raw in block.extra_parameters() {
        parameter(out, &raw.name, &raw.kind, &raw.value);
    }
    if out.len() == children {
        out.truncate(start);
        out.push_str("/>\n");
    } else {
        out.push_str("\t</block>\n");
    }
}

fn parameter(out: &mut String, name: &str, kind: &str, value: &str) {
    out.push_str("\t\t<parameter");
    attribute(out, "name", &name);
    attribute(out, "type", &kind);
    attribute(out, "value", &value);
    out.push_str("/>\n");
}

fn extra_attributes(out: &mut String, attributes: &[(String, String)]) {
    for (name, value) in attributes {
        attribute(out, name, &value);
    }
}

fn attribute(out: &mut String, name: &str, value: &dyn Display) {
    out.push(' ');
    out.push_str(name);
    out.push_str("=\"");
    escape(out, &value.to_string());
    out.push('"');
}

/// Line ends and tabs are written as references: a parser turns them into blanks otherwise.
fn escape(out: &mut String, text: &str) {
    for character in text.chars() {
        match character {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            '\t' | '\n' | '\r' => {
                let _ = write!(out, "&#{};", u32::from(character));
            }
            _ if is_xml_char(character) => out.push(character),
            _ => out.push(char::REPLACEMENT_CHARACTER),
        }
    }
}

/// A parameter's value as files have it.
pub(super) fn value_text(value: &ParamValue) -> String {
    match value {
        ParamValue::Int(value) => value.to_string(),
        ParamValue::Float(value) => float_text(*value),
        ParamValue::Bool(value) => u8::from(*value).to_string(),
        ParamValue::Choice(value) => value.to_string(),
        ParamValue::Text(value) => value.to_string(),
    }
}

/// The shortest text that reads as the same number: `0.25`, `3.39021e-206`.
fn float_text(value: f64) -> String {
    let is_short = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    if is_short { value.to_string() } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        for (value, text) in [
            (0.25, "0.25"),
            (1.0, "1"),
            (-0.0, "-0"),
            (3.39021e-206, "3.39021e-206"),
            (1e300, "1e300"),
            (0.1 + 0.2, "0.30000000000000004"),
            (-1e-5, "-0.00001"),
            (9e-6, "9e-6"),
            (f64::MAX, "1.7976931348623157e308"),
            (5e-324, "5e-324"),
        ] {
            assert_eq!(float_text(value), text);
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn what_a_parser_would_change_is_escaped() {
        let mut out = String::new();
        escape(&mut out, "a<b>&\"'\t\r\n\u{1}é");
        assert_eq!(out, "a&lt;b&gt;&amp;&quot;&apos;&#9;&#13;&#10;\u{fffd}é");
    }
}
