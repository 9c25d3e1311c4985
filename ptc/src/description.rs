//! A block type in plain words and numbers: what `--json` prints, field by field.
//!
//! The names are those of the library. They never change; new ones may come. A field that does not
//! apply (the range of a text, say) is left out.

use ptlib::{
    block::{
        Access, BlockSpec, InputPort, OutputPort, Planes, PluginInfo, Registry, Role, Shape, Tiling,
    },
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
    /// The version of ptlib that it came with, if it is built in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) since: Option<String>,
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
    /// The plug-in that it comes from, if it is not built in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) plugin: Option<PluginDescription>,
}

/// A plug-in. What it does not say is left out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct PluginDescription {
    pub(crate) id: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) name: &'static str,
    pub(crate) version: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) vendor: &'static str,
    /// An SPDX expression.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) license: &'static str,
    /// The compiler.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) built_with: &'static str,
    /// Its file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) file: Option<String>,
}

impl PluginDescription {
    pub(crate) fn of(plugin: &'static PluginInfo) -> Self {
        Self {
            id: &plugin.id,
            name: &plugin.name,
            version: &plugin.version,
            vendor: &plugin.vendor,
            license: &plugin.license,
            built_with: &plugin.built_with,
            file: plugin.path.as_ref().map(|path| path.display().to_string()),
        }
    }

    /// `gradient-noise 1.0.0 by its vendor, MIT`.
    pub(crate) fn in_words(&self) -> String {
        let mut words = format!("{} {}", self.id, self.version);
        if !self.vendor.is_empty() {
            words.extend([" by ", self.vendor]);
        }
        if !self.license.is_empty() {
            words.extend([", ", self.license]);
        }
        words
    }
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
    /// The description of a block type of `registry`.
    pub(crate) fn of(registry: &Registry, spec: &BlockSpec) -> Self {
        let about = &spec.about;
        let plugin = registry.plugin_of(about.id).map(PluginDescription::of);
        let tiling_exception = match about.tiling {
            Tiling::Always => None,
            Tiling::ExceptInEightBit(exception) => Some(format!("in 8-bit precision {exception}")),
            Tiling::Except(exception) => Some(exception.to_owned()),
        };
        Self {
            id: about.id,
            family: registry.family_of(about.id).unwrap_or_default(),
            summary: about.summary,
            role: role(about.role),
            shape: shape(spec.shape()),
            since: match plugin {
                None => Some(format!("{}.{}", about.since / 1000, about.since % 1000)),
                Some(_) => None,
            },
            uses_seed: about.uses_seed,
            tiles: tiling_exception.is_none(),
            tiling_exception,
            in_pixels: about.in_pixels,
            inputs: about.inputs.iter().map(InputDescription::of).collect(),
            outputs: about.outputs.iter().map(|port| output(port, about.inputs)).collect(),
            parameters: spec.params.iter().map(ParameterDescription::of).collect(),
            plugin,
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
            let description = BlockDescription::of(&registry, spec);
            assert_eq!(description.parameters.len(), spec.params.len());
            assert!(description.parameters.iter().all(|parameter| !parameter.doc.is_empty()));
            assert!(description.since.is_some() && description.plugin.is_none());
        }
    }

    #[test]
    fn an_output_names_the_inputs_that_it_follows() {
        let registry = Registry::builtin();
        let end = BlockDescription::of(&registry, registry.find("end").unwrap());
        assert_eq!(end.role, "result");
        assert_eq!(end.outputs[0].planes, Some("as inputs"));
        assert_eq!(end.outputs[0].planes_of, ["image"]);
        assert_eq!(end.outputs[0].range, Some("unit"));
    }
}
