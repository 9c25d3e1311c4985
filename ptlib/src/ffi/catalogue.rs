//! The catalogue: every block type with its parameters and ports, as texts and numbers that C can
//! read. Made from the declarations that everything else reads too, once an engine; the block types
//! of plug-ins join later.

use std::{
    ffi::{CString, c_char},
    sync::{Arc, PoisonError, RwLock},
};

use super::{
    PTL_BLOCK_IS_INPUT, PTL_BLOCK_IS_RESULT, PTL_BLOCK_TILES, PTL_BLOCK_USES_SEED,
    PTL_BLOCK_WRITES_FILE, PTL_PARAM_CHOICE, PTL_PARAM_FLAG, PTL_PARAM_FLOAT, PTL_PARAM_INT,
    PTL_PARAM_PATH, PTL_PARAM_READS_FILE, PTL_PARAM_TEXT, PTL_PARAM_WRITES_FILE,
    PTL_PORT_FREE_RANGE, PTL_PORT_OPTIONAL,
    fault::c_string,
    handle::{Tagged, tagged},
    ptl_block_type, ptl_param_info, ptl_port_info,
};
use crate::{
    block::{BlockSpec, InputPort, OutputPort, Planes, Registry, Role, Tiling},
    params::{ChoiceItem, FileUse, ParamKind, ParamSpec, ParamValue},
};

/// Every block type of an engine. None is ever removed: callers hold borrowed handles.
#[derive(Debug, Default)]
pub(super) struct Catalogue(RwLock<Vec<Arc<Tagged<BlockTypeObject>>>>);

#[derive(Debug)]
pub(super) struct BlockTypeObject {
    spec: &'static BlockSpec,
    pub(super) id: CString,
    pub(super) name: CString,
    pub(super) category: CString,
    pub(super) doc: CString,
    pub(super) plugin: CString,
    pub(super) params: Vec<ParamTexts>,
    pub(super) inputs: Vec<PortTexts>,
    pub(super) outputs: Vec<PortTexts>,
}

#[derive(Debug)]
pub(super) struct ParamTexts {
    spec: &'static ParamSpec,
    id: CString,
    name: CString,
    doc: CString,
    unit: CString,
    default: CString,
    choice_ids: TextList,
    choice_docs: TextList,
}

#[derive(Debug)]
pub(super) struct PortTexts {
    kind: u32,
    flags: u32,
    channels: u32,
    id: CString,
    name: CString,
}

/// Texts, and the array of pointers to them that C wants.
#[derive(Debug)]
struct TextList {
    pointers: Box<[*const c_char]>,
    _texts: Box<[CString]>,
}

// SAFETY: the pointers lead to the texts beside them, which nobody changes.
unsafe impl Send for TextList {}
// SAFETY: as above.
unsafe impl Sync for TextList {}

impl<'a> FromIterator<&'a str> for TextList {
    fn from_iter<I: IntoIterator<Item = &'a str>>(texts: I) -> Self {
        let texts: Box<[_]> = texts.into_iter().map(c_string).collect();
        Self { pointers: texts.iter().map(|text| text.as_ptr()).collect(), _texts: texts }
    }
}

impl Catalogue {
    pub(super) fn of(registry: &Registry) -> Self {
        let catalogue = Self::default();
        catalogue.extend(registry);
        catalogue
    }

    /// Adds the block types that have come to the registry.
    pub(super) fn extend(&self, registry: &Registry) {
        let mut types = self.0.write().unwrap_or_else(PoisonError::into_inner);
        for spec in registry.blocks().into_iter().skip(types.len()) {
            types.push(tagged::<ptl_block_type>(BlockTypeObject::of(spec, registry)));
        }
    }

    pub(super) fn len(&self) -> usize {
        self.0.read().unwrap_or_else(PoisonError::into_inner).len()
    }

    pub(super) fn at(&self, index: usize) -> Option<Arc<Tagged<BlockTypeObject>>> {
        self.0.read().unwrap_or_else(PoisonError::into_inner).get(index).cloned()
    }

    pub(super) fn find(&self, id: &str) -> Option<Arc<Tagged<BlockTypeObject>>> {
        let types = self.0.read().unwrap_or_else(PoisonError::into_inner);
        types.iter().find(|block_type| block_type.spec.about.id == id).cloned()
    }
}

impl BlockTypeObject {
    fn of(spec: &'static BlockSpec, registry: &Registry) -> Self {
        let category = registry.family_of(spec.about.id).unwrap_or_default();
        let plugin = registry.plugin_of(spec.about.id).map(|plugin| plugin.id.as_str());
        Self {
            plugin: c_string(plugin.unwrap_or_default()),
            spec,
            id: c_string(spec.about.id),
            name: c_string(&spec.name()),
            category: c_string(category),
            doc: c_string(spec.about.summary),
            params: spec.params.iter().map(ParamTexts::of).collect(),
            inputs: spec.about.inputs.iter().map(PortTexts::of_input).collect(),
            outputs: spec.about.outputs.iter().map(PortTexts::of_output).collect(),
        }
    }

    pub(super) fn flags(&self) -> u32 {
        let about = &self.spec.about;
        let flags = [
            (about.role == Role::Result, PTL_BLOCK_IS_RESULT),
            (about.role == Role::Writer, PTL_BLOCK_WRITES_FILE),
            (about.role == Role::Input, PTL_BLOCK_IS_INPUT),
            (about.uses_seed, PTL_BLOCK_USES_SEED),
            (about.tiling == Tiling::Always, PTL_BLOCK_TILES),
        ];
        flags.iter().filter(|(is_set, _)| *is_set).map(|(_, flag)| flag).sum()
    }
}

impl ParamTexts {
    fn of(spec: &'static ParamSpec) -> Self {
        let choices = if let ParamKind::Choice(items) = spec.kind { items } else { &[] };
        Self {
            spec,
            id: c_string(spec.id),
            name: c_string(&capitalised(spec.id)),
            doc: c_string(spec.doc),
            unit: c_string(spec.unit),
            default: c_string(&text_of(spec, &spec.default_value())),
            choice_ids: choices.iter().map(|item: &ChoiceItem| item.id).collect(),
            choice_docs: choices.iter().map(|item| item.doc).collect(),
        }
    }

    pub(super) fn to_c(&self) -> ptl_param_info {
        let numbers = Numbers::of(&self.spec.kind);
        let default = number_of(&self.spec.default_value());
        ptl_param_info {
            struct_size: 0,
            r#type: numbers.kind,
            flags: numbers.flags,
            components: u32::from(default.is_some()),
            id: self.id.as_ptr(),
            name: self.name.as_ptr(),
            doc: self.doc.as_ptr(),
            unit: self.unit.as_ptr(),
            min: numbers.hard.0,
            max: numbers.hard.1,
            soft_min: numbers.soft.0,
            soft_max: numbers.soft.1,
            step: numbers.step,
            default_value: [default.unwrap_or_default(), 0.0, 0.0, 0.0],
            default_text: self.default.as_ptr(),
            enum_ids: self.choice_ids.pointers.as_ptr(),
            enum_docs: self.choice_docs.pointers.as_ptr(),
            enum_count: u32::try_from(self.choice_ids.pointers.len()).unwrap_or_default(),
            reserved0: 0,
        }
    }
}

/// A kind of parameter as numbers.
#[derive(Default)]
struct Numbers {
    kind: u32,
    flags: u32,
    hard: (f64, f64),
    soft: (f64, f64),
    step: f64,
}

impl Numbers {
    fn of(kind: &ParamKind) -> Self {
        match kind {
            ParamKind::Int { hard, soft } => Self {
                kind: PTL_PARAM_INT,
                hard: (hard.min.into(), hard.max.into()),
                soft: (soft.min.into(), soft.max.into()),
                step: 1.0,
                ..Self::default()
            },
            ParamKind::Float { hard, soft } => Self {
                kind: PTL_PARAM_FLOAT,
                hard: (hard.min, hard.max),
                soft: (soft.min, soft.max),
                ..Self::default()
            },
            ParamKind::Bool => Self::steps(PTL_PARAM_FLAG, 1),
            ParamKind::Choice(items) => {
                Self::steps(PTL_PARAM_CHOICE, items.len().saturating_sub(1))
            }
            ParamKind::Text => Self { kind: PTL_PARAM_TEXT, ..Self::default() },
            ParamKind::Path(FileUse::Read) => {
                Self { kind: PTL_PARAM_PATH, flags: PTL_PARAM_READS_FILE, ..Self::default() }
            }
            ParamKind::Path(FileUse::Write) => {
                Self { kind: PTL_PARAM_PATH, flags: PTL_PARAM_WRITES_FILE, ..Self::default() }
            }
        }
    }

    fn steps(kind: u32, last: usize) -> Self {
        let range = (0.0, u32::try_from(last).unwrap_or_default().into());
        Self { kind, hard: range, soft: range, step: 1.0, flags: 0 }
    }
}

impl PortTexts {
    fn of_input(port: &InputPort) -> Self {
        Self {
            kind: port.kind as u32,
            flags: if port.is_optional { PTL_PORT_OPTIONAL } else { 0 },
            channels: 0,
            id: c_string(port.id),
            name: c_string(&capitalised(port.id)),
        }
    }

    fn of_output(port: &OutputPort) -> Self {
        Self {
            kind: port.kind as u32,
            flags: if port.is_free { PTL_PORT_FREE_RANGE } else { 0 },
            channels: match port.planes {
                Planes::Grey => 1,
                Planes::Colour => 3,
                Planes::ColourAlpha => 4,
                Planes::As(_) | Planes::Most(_) | Planes::ByParameters => 0,
            },
            id: c_string(port.id),
            name: c_string(&capitalised(port.id)),
        }
    }

    pub(super) fn to_c(&self) -> ptl_port_info {
        ptl_port_info {
            struct_size: 0,
            kind: self.kind,
            flags: self.flags,
            channels: self.channels,
            id: self.id.as_ptr(),
            name: self.name.as_ptr(),
        }
    }
}

/// An id as a user interface shows it.
fn capitalised(id: &str) -> String {
    let mut letters = id.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// The text that sets a parameter to `value`.
pub(super) fn text_of(spec: &ParamSpec, value: &ParamValue) -> String {
    match (value, spec.kind) {
        (ParamValue::Int(value), _) => value.to_string(),
        (ParamValue::Float(value), _) => value.to_string(),
        (ParamValue::Bool(value), _) => value.to_string(),
        (ParamValue::Choice(value), ParamKind::Choice(items)) => {
            let item = items.get(*value as usize);
            item.map_or_else(|| value.to_string(), |item| item.id.to_owned())
        }
        (ParamValue::Choice(value), _) => value.to_string(),
        (ParamValue::Text(value), _) => value.to_string(),
    }
}

/// A value as a number, if it is one.
pub(super) fn number_of(value: &ParamValue) -> Option<f64> {
    match value {
        ParamValue::Int(value) => Some((*value).into()),
        ParamValue::Float(value) => Some(*value),
        ParamValue::Bool(value) => Some(u8::from(*value).into()),
        ParamValue::Choice(value) => Some((*value).into()),
        ParamValue::Text(_) => None,
    }
}
