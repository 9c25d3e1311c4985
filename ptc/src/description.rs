//! A block type in plain words and numbers: what `--json` prints, field by field.
//!
//! The names are those of the library. They never change; new ones may come. A field that does not
//! apply (the range of a text, say) is left out.

use ptlib::{
    block::{Access, BlockSpec, InputPort, OutputPort, Planes, Role, Shape, Tiling},
    params::{ChoiceItem, DefaultValue, FileUse, ParamKind, ParamSpec, Range},
};
use serde::Serialize;
use serde_json::Value;

/// A block type.
#[derive(Debug, Serialize)]
pub(crate) struct BlockDescription {
    pub(crate) id: &'static str,
    pub(crate) family: &'static str,
    /// What it makes, in one sentence.
    pub(crate) summary: &'static str,
    /// `inner`, `result`, `writer` or `input`.
    pub(crate) role: &'static str,
    /// `point`, `gather` or `whole`.
    pub(crate) shape: &'static str,
    /// The version of ptlib that it came with.
    pub(crate) since: String,
    /// Whether another seed gives another picture.
    pub(crate) uses_seed: bool,
    /// Whether its output always tiles when its inputs do.
    pub(crate) tiles: bool,
    /// When and why it does not tile.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tiling_exception: Option<String>,
    /// Which lengths count pixels, so that the picture depends on the resolution.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) in_pixels: &'static str,
    pub(crate) inputs: Vec<InputDescription>,
    pub(crate) outputs: Vec<OutputDescription>,
    pub(crate) parameters: Vec<ParameterDescription>,
}

/// An input. Files name it by its place, from 0.
#[derive(Debug, Serialize)]
pub(crate) struct InputDescription {
    pub(crate) id: &'static str,
    /// `image`, `gradient` or `text`.
    pub(crate) kind: &'static str,
    /// Whether the block works without it.
    pub(crate) is_optional: bool,
    /// `same row` or `anywhere`.
    pub(crate) access: &'static str,
}

/// An output.
#[derive(Debug, Serialize)]
pub(crate) struct OutputDescription {
    pub(crate) id: &'static str,
    /// As an input's.
    pub(crate) kind: &'static str,
    /// Of an image: `grey`, `colour`, `as inputs`, or `by parameters`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) planes: Option<&'static str>,
    /// For `as inputs`: the inputs; the one with the most planes counts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) planes_of: Vec<&'static str>,
    /// Of an image: `unit` for values 0..1, `free` for any finite numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) range: Option<&'static str>,
}

/// A parameter.
#[derive(Debug, Serialize)]
pub(crate) struct ParameterDescription {
    pub(crate) id: &'static str,
    /// `int`, `float`, `bool`, `choice`, `text` or `path`.
    pub(crate) kind: &'static str,
    /// What it does.
    pub(crate) doc: String,
    /// Of a choice: the number of the alternative.
    pub(crate) default: Value,
    /// Allowed values, of a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hard: Option<RangeDescription>,
    /// Usual values, of a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) soft: Option<RangeDescription>,
    /// What a number counts.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) unit: &'static str,
    /// The alternatives of a choice.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) choices: Vec<ChoiceDescription>,
    /// Of a path: `read` or `write`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) file_use: Option<&'static str>,
}

/// Two ends, both included.
#[derive(Debug, PartialEq, Serialize)]
pub(crate) struct RangeDescription {
    pub(crate) min: Value,
    pub(crate) max: Value,
}

/// An alternative of a choice. Files name it by its number.
#[derive(Debug, Serialize)]
pub(crate) struct ChoiceDescription {
    pub(crate) number: usize,
    pub(crate) id: &'static str,
    pub(crate) doc: String,
}

impl BlockDescription {
    /// The description of a block type.
    pub(crate) fn of(spec: &BlockSpec, family: &'static str) -> Self {
        let about = &spec.about;
        let tiling_exception = match about.tiling {
            Tiling::Always => None,
            Tiling::ExceptInEightBit(exception) => Some(format!("in 8-bit precision {exception}")),
            Tiling::Except(exception) => Some(exception.to_owned()),
        };
        Self {
            id: about.id,
            family,
            summary: about.summary,
            role: role(about.role),
            shape: shape(spec.shape()),
            since: format!("{}.{}", about.since / 1000, about.since % 1000),
            uses_seed: about.uses_seed,
            tiles: tiling_exception.is_none(),
            tiling_exception,
            in_pixels: about.in_pixels,
            inputs: about.inputs.iter().map(InputDescription::of).collect(),
            outputs: about.outputs.iter().map(|port| output(port, about.inputs)).collect(),
            parameters: spec.params.iter().map(ParameterDescription::of).collect(),
        }
    }
}

impl InputDescription {
    fn of(port: &InputPort) -> Self {
        let access = match port.access {
            Access::SameRow => "same row",
            Access::Anywhere => "anywhere",
        };
        Self { id: port.id, kind: port.kind.name(), is_optional: port.is_optional, access }
    }
}

fn output(port: &OutputPort, inputs: &[InputPort]) -> OutputDescription {
    let is_image = port.kind == ptlib::value::Kind::Image;
    let (planes, of): (_, &[usize]) = match &port.planes {
        Planes::Grey => ("grey", &[]),
        Planes::Colour => ("colour", &[]),
        Planes::ColourAlpha => ("colour and alpha", &[]),
        Planes::As(input) => ("as inputs", std::slice::from_ref(input)),
        Planes::Most(inputs) => ("as inputs", inputs),
        Planes::ByParameters => ("by parameters", &[]),
    };
    let named = of.iter().filter_map(|&place| inputs.get(place)).map(|port| port.id);
    OutputDescription {
        id: port.id,
        kind: port.kind.name(),
        planes: is_image.then_some(planes),
        planes_of: if is_image { named.collect() } else { vec![] },
        range: is_image.then_some(if port.is_free { "free" } else { "unit" }),
    }
}

impl ParameterDescription {
    fn of(spec: &ParamSpec) -> Self {
        let (hard, soft) = match spec.kind {
            ParamKind::Int { hard, soft } => (Some(range(hard)), Some(range(soft))),
            ParamKind::Float { hard, soft } => (Some(range(hard)), Some(range(soft))),
            _ => (None, None),
        };
        let choices = match spec.kind {
            ParamKind::Choice(items) => items.iter().enumerate().map(choice).collect(),
            _ => vec![],
        };
        Self {
            id: spec.id,
            kind: spec.kind.name(),
            doc: reflowed(spec.doc),
            default: default(spec.default),
            hard,
            soft,
            unit: spec.unit,
            choices,
            file_use: match spec.kind {
                ParamKind::Path(FileUse::Read) => Some("read"),
                ParamKind::Path(FileUse::Write) => Some("write"),
                _ => None,
            },
        }
    }
}

fn range<T: Into<Value>>(range: Range<T>) -> RangeDescription {
    RangeDescription { min: range.min.into(), max: range.max.into() }
}

fn choice((number, item): (usize, &ChoiceItem)) -> ChoiceDescription {
    ChoiceDescription { number, id: item.id, doc: reflowed(item.doc) }
}

fn default(value: DefaultValue) -> Value {
    match value {
        DefaultValue::Int(value) => value.into(),
        DefaultValue::Float(value) => value.into(),
        DefaultValue::Bool(value) => value.into(),
        DefaultValue::Choice(value) => value.into(),
        DefaultValue::Text(value) => value.into(),
    }
}

fn role(role: Role) -> &'static str {
    match role {
        Role::Inner => "inner",
        Role::Result => "result",
        Role::Writer => "writer",
        Role::Input => "input",
    }
}

fn shape(shape: Shape) -> &'static str {
    match shape {
        Shape::Point => "point",
        Shape::Gather => "gather",
        Shape::Whole => "whole",
    }
}

/// A doc comment without the line breaks of the source: one line a paragraph, an empty line
/// between paragraphs.
fn reflowed(doc: &str) -> String {
    let mut paragraphs: Vec<Vec<&str>> = vec![vec![]];
    for line in doc.lines().map(str::trim) {
        match paragraphs.last_mut() {
            Some(paragraph) if !line.is_empty() => paragraph.push(line),
            _ => paragraphs.push(vec![]),
        }
    }
    let paragraphs = paragraphs.iter().filter(|lines| !lines.is_empty());
    paragraphs.map(|lines| lines.join(" ")).collect::<Vec<_>>().join("\n\n")
}

#[cfg(test)]
mod tests {
    use ptlib::block::Registry;

    use super::*;

    #[test]
    fn documentation_flows() {
        assert_eq!(reflowed(" One\n two.\n\n Three."), "One two.\n\nThree.");
        assert_eq!(reflowed(""), "");
    }

    #[test]
    fn every_block_type_is_described() {
        let registry = Registry::builtin();
        for spec in registry.blocks() {
            let family = registry.family_of(spec.about.id).unwrap();
            let description = BlockDescription::of(spec, family);
            assert_eq!(description.parameters.len(), spec.params.len());
            assert!(description.parameters.iter().all(|parameter| !parameter.doc.is_empty()));
            assert!(!description.since.is_empty());
        }
    }

    #[test]
    fn an_output_names_the_inputs_that_it_follows() {
        let registry = Registry::builtin();
        let end = BlockDescription::of(registry.find("end").unwrap(), "results");
        assert_eq!(end.role, "result");
        assert_eq!(end.outputs[0].planes, Some("as inputs"));
        assert_eq!(end.outputs[0].planes_of, ["image"]);
        assert_eq!(end.outputs[0].range, Some("unit"));
    }
}
