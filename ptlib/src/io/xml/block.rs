//! One block: its type, id, seed and parameters.

use super::{
    connect::Target,
    element::{Attribute, Element, shortened},
    numbers::{grammar, lenient_value, strict_value},
    report::Report,
    root::{checked_seed, whole_number},
    type_word,
    write::value_text,
};
use crate::{
    block::Registry,
    error::{Error, ErrorKind},
    graph::{Block, BlockId, Graph, Origin, RawParameter},
    params::{ParamSpec, ParamValue},
};

const KNOWN: [&str; 5] = ["type", "id", "seed", "plugin", "plugin-version"];

/// A block's element with the children that matter.
pub(super) struct Draft<'a> {
    pub(super) element: Element<'a>,
    pub(super) parameters: Vec<Element<'a>>,
    pub(super) inputs: Vec<Element<'a>>,
}

/// A `parameter` element that has all it needs.
struct Parameter<'e> {
    name: &'e Attribute<'e>,
    kind: &'e Attribute<'e>,
    value: &'e Attribute<'e>,
}

impl<'a> Draft<'a> {
    pub(super) fn new(element: Element<'a>) -> Self {
        Self { element, parameters: Vec::new(), inputs: Vec::new() }
    }

    /// The block's id in the file, if it has one.
    pub(super) fn id(&self) -> Option<&Attribute<'a>> {
        self.element.get("id").filter(|id| !id.value.is_empty())
    }

    /// Puts the block into `graph`. Its inputs follow when all blocks are there.
    pub(super) fn insert(
        self,
        graph: &mut Graph,
        registry: &Registry,
        report: &mut Report<'_>,
    ) -> Option<Target<'a>> {
        let element = &self.element;
        let (type_id, id) = self.type_and_id(report)?;
        let spec = registry.find(&type_id.value);
        let parameters = complete(&self.parameters, report);
        let (known, unknown): (Vec<_>, Vec<_>) = parameters.into_iter().partition(|parameter| {
            spec.is_some_and(|spec| spec.param(&parameter.name.value).is_some())
        });
        let handle = graph.insert(Block {
            id: id.value.clone().into_owned(),
            type_id: spec.map_or_else(|| (*type_id.value).into(), |spec| spec.about.id.into()),
            spec,
            origin: origin(element),
            seed: seed(element, report),
            values: spec.map_or_else(Vec::new, |spec| {
                spec.params.iter().map(ParamSpec::default_value).collect()
            }),
            inputs: vec![None; spec.map_or(0, |spec| spec.about.inputs.len())],
            extra_attributes: element.others(&KNOWN),
            extra_parameters: unknown.iter().map(Parameter::to_raw).collect(),
        });
        if spec.is_some() {
            for Parameter { name, .. } in unknown {
                report.warn_with(name.offset, || stranger(graph.parameter(handle, &name.value)));
            }
        } else {
            report.warn_with(type_id.offset, || stranger(graph.known(handle)));
        }
        if let (Some(newer), Some(attribute)) =
            (newer_origin(graph, handle), element.get("plugin-version"))
        {
            report.warn(attribute.offset, graph.at(handle, newer));
        }
        set_parameters(graph, handle, &known, report);
        Some(Target { handle, inputs: self.inputs })
    }

    /// What every block needs.
    fn type_and_id(&self, report: &mut Report<'_>) -> Option<(&Attribute<'a>, &Attribute<'a>)> {
        let element = &self.element;
        if element.is_damaged {
            return None;
        }
        let mut need = |name| {
            let attribute = element.get(name);
            if attribute.is_none() {
                report.fault(element.offset, element.missing(name));
            }
            attribute
        };
        let (type_id, id) = (need("type"), need("id"));
        let (type_id, id) = (type_id?, id?);
        if id.value.is_empty() {
            report.fault(id.offset, Error::new(ErrorKind::Parse, "the id of a block is empty"));
            return None;
        }
        Some((type_id, id))
    }
}

/// The error of something that was looked for and is known to be missing.
fn stranger<T>(missing: Result<T, Error>) -> Error {
    let known = || Error::new(ErrorKind::Internal, "is known after all");
    missing.err().unwrap_or_else(known)
}

impl Parameter<'_> {
    fn to_raw(&self) -> RawParameter {
        let own = |attribute: &Attribute<'_>| attribute.value.clone().into_owned();
        RawParameter { name: own(self.name), kind: own(self.kind), value: own(self.value) }
    }
}

/// The plug-in that the block's type comes from, if it names one.
fn origin(element: &Element<'_>) -> Option<Origin> {
    let text = |name| element.get(name).map(|attribute| attribute.value.clone().into_owned());
    let (plugin, version) = (text("plugin"), text("plugin-version"));
    let is_named = plugin.is_some() || version.is_some();
    is_named.then(|| Origin {
        plugin: plugin.unwrap_or_default(),
        version: version.unwrap_or_default(),
    })
}

/// The warning that the file was written with a newer version of the plug-in than is loaded.
fn newer_origin(graph: &Graph, handle: BlockId) -> Option<Error> {
    let block = graph.block(handle).ok()?;
    let origin = block.origin()?;
    let loaded = graph.registry().plugin_of(block.type_id())?;
    if numbers_of(&origin.version) <= numbers_of(&loaded.version) {
        return None;
    }
    let message = format!(
        "was written with version {} of plug-in \"{}\", loaded is {}",
        origin.version, loaded.id, loaded.version
    );
    Some(Error::new(ErrorKind::Unsupported, message).with_hint("it may look different"))
}

/// The numbers of a version, for comparing.
fn numbers_of(version: &str) -> Vec<u64> {
    version.split(['.', '-', '+']).map_while(|part| part.parse().ok()).collect()
}

/// The seed of the block alone, if it has one.
fn seed(element: &Element<'_>, report: &mut Report<'_>) -> Option<u64> {
    let number = whole_number(element.get("seed")?, report)?;
    Some(checked_seed(element, number, report))
}

/// The parameters that have a name, a type and a value.
fn complete<'e>(elements: &'e [Element<'e>], report: &mut Report<'_>) -> Vec<Parameter<'e>> {
    let mut parameters = Vec::with_capacity(elements.len());
    for element in elements.iter().filter(|element| !element.is_damaged) {
        match (element.get("name"), element.get("type"), element.get("value")) {
            (Some(name), Some(kind), Some(value)) => {
                parameters.push(Parameter { name, kind, value });
            }
            _ => {
                let missing = ["name", "type", "value"].into_iter();
                let missing = missing.filter(|name| element.get(name).is_none());
                for name in missing {
                    report.tolerate(element.offset, element.missing(name));
                }
            }
        }
    }
    parameters
}

/// Sets the parameters that the block's type declares. Of one that is there twice, the last counts.
fn set_parameters(
    graph: &mut Graph,
    handle: BlockId,
    parameters: &[Parameter<'_>],
    report: &mut Report<'_>,
) {
    let mut is_set = Vec::new();
    for parameter in parameters {
        let Ok((place, spec)) = graph.parameter(handle, &parameter.name.value) else { continue };
        if is_set.contains(&place) {
            let message = "is there more than once: the last one counts";
            let error = Error::new(ErrorKind::Parse, message).at_parameter(spec.id);
            report.warn(parameter.name.offset, graph.at(handle, error));
        } else {
            is_set.push(place);
        }
        let value = match parse(spec, parameter, report.is_strict) {
            Ok(value) => value,
            Err(fault) => {
                let error = fault.error.at_parameter(spec.id);
                report.tolerate(fault.offset, graph.at(handle, error));
                let Some(value) = fault.instead else { continue };
                value
            }
        };
        if let Err(error) = graph.set(handle, spec.id, value) {
            report.fault(parameter.value.offset, error);
        }
    }
}

/// A value that is not what the file says.
struct Unfit {
    offset: usize,
    error: Error,
    /// What PT Designer took instead; nothing if it left the parameter alone.
    instead: Option<ParamValue>,
}

/// The value of a parameter.
fn parse(
    spec: &ParamSpec,
    parameter: &Parameter<'_>,
    is_strict: bool,
) -> Result<ParamValue, Box<Unfit>> {
    let declared = type_word(spec);
    if parameter.kind.value != declared {
        let found = shortened(&parameter.kind.value);
        let message = format!("is of type \"{found}\", takes \"{declared}\"");
        let error = Error::new(ErrorKind::TypeMismatch, message);
        let offset = parameter.kind.offset;
        return Err(Box::new(Unfit { offset, error, instead: None }));
    }
    let text = &parameter.value.value;
    let exact = strict_value(spec, text);
    let (value, error) = match exact {
        Some(value) => match spec.check(&value) {
            Ok(()) => return Ok(value),
            Err(error) => (value, error),
        },
        None => {
            let message = format!("is \"{}\", which is not {}", shortened(text), grammar(spec));
            (lenient_value(spec, text), Error::new(ErrorKind::Parse, message))
        }
    };
    let nearest = spec.nearest(value);
    let error = if is_strict {
        error
    } else {
        error.with_hint(format!("taken as {}", value_text(&nearest)))
    };
    Err(Box::new(Unfit { offset: parameter.value.offset, error, instead: Some(nearest) }))
}
