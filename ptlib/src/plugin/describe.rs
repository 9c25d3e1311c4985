//! From what a plug-in says of a block type to a [`BlockSpec`]. The tables are sound by now
//! ([`check`](super::check)); here it is decided whether what they say makes sense.

use ptlib_plugin_abi::*;

use super::{
    check::{Block, Param, Port},
    foreign::{Factory, Foreign, GraphInput, ThreadMode},
};
use crate::{
    block::{
        About, Access, BlockSpec, Implementation, InputPort, MAX_OUTPUT_PLANES, OutputPort, Planes,
        Role, Tiling,
    },
    error::Error,
    math::convert::{round64, truncate64_to_i32},
    params::{ChoiceItem, DefaultValue, FileUse, ParamKind, ParamSpec, Range},
    value::Kind,
};

/// A block type as the registry wants it.
pub(super) struct Described {
    pub(super) family: &'static str,
    pub(super) spec: &'static BlockSpec,
    /// What computes it; `None` for an input of graphs, whose value the caller gives.
    pub(super) foreign: Option<&'static Foreign>,
}

const KNOWN_FLAGS: u32 =
    PTLP_BLOCK_USES_SEED | PTLP_BLOCK_GRAPH_INPUT | PTLP_BLOCK_NOT_DETERMINISTIC;

/// The family and the description of a block type. What it points to is leaked: it is made once in
/// a process.
///
/// # Errors
/// [`PluginDescriptor`](crate::ErrorKind::PluginDescriptor), naming block and field.
pub(super) fn describe(block: &Block) -> Result<Described, Error> {
    let table = block.table;
    block.reader.flags(table.flags, KNOWN_FLAGS, "flags")?;
    let is_input = table.flags & PTLP_BLOCK_GRAPH_INPUT != 0;
    let params = block.params.iter().map(param).collect::<Result<Vec<_>, _>>()?;
    let inputs = block.inputs.iter().map(input).collect::<Result<Vec<_>, _>>()?;
    let outputs = block.outputs.iter().map(|port| output(block, port));
    let outputs = outputs.collect::<Result<Vec<_>, _>>()?;
    let about = About {
        id: block.id,
        name: block.text(table.name, "name")?,
        since: 0,
        summary: block.text(table.doc, "doc")?,
        inputs: leak(inputs),
        outputs: leak(outputs),
        role: if is_input { Role::Input } else { Role::Inner },
        uses_seed: table.flags & PTLP_BLOCK_USES_SEED != 0,
        is_deterministic: table.flags & PTLP_BLOCK_NOT_DETERMINISTIC == 0,
        tiling: match block.text(table.tiling_exception, "tiling_exception")? {
            "" => Tiling::Always,
            reason => Tiling::Except(reason),
        },
        in_pixels: block.text(table.in_pixels, "in_pixels")?,
    };
    if about.summary.is_empty() {
        return Err(block.reader.fault("doc", "says nothing"));
    }
    let (implementation, foreign) = if is_input {
        (graph_input(block, &about)?, None)
    } else {
        let (implementation, foreign) = implementation(block, &about)?;
        (implementation, Some(foreign))
    };
    let family = match block.text(table.category, "category")? {
        "" => "plug-ins",
        family => family,
    };
    let spec = BlockSpec { about, params: leak(params), implementation };
    Ok(Described { family, spec: Box::leak(Box::new(spec)), foreign })
}

fn leak<T>(values: Vec<T>) -> &'static [T] {
    Vec::leak(values)
}

fn implementation(
    block: &Block,
    about: &About,
) -> Result<(Implementation, &'static Foreign), Error> {
    let (reader, table) = (&block.reader, block.table);
    if about.outputs.is_empty() {
        return Err(reader.fault("output_count", "is 0, allowed from 1 on"));
    }
    if table.compute.is_none() {
        return Err(reader.fault("compute", "is NULL"));
    }
    if table.prepare.is_none() && table.param_count > 0 {
        return Err(reader.fault("prepare", "is NULL, but there are parameters, which come there"));
    }
    let kinds: Vec<_> = about.outputs.iter().map(|port| port.kind).collect();
    let threads = match table.thread_mode {
        PTLP_THREADS_TILES => ThreadMode::Tiles,
        PTLP_THREADS_INSTANCE => ThreadMode::Instance,
        PTLP_THREADS_GLOBAL => ThreadMode::Global,
        other => return Err(reader.fault("thread_mode", format!("is {other}, allowed 1..=3"))),
    };
    let reads_anywhere = about.inputs.iter().any(|port| port.access == Access::Anywhere);
    match table.shape {
        PTLP_SHAPE_WHOLE => {
            let factory = Factory::leaked(table, threads, kinds);
            return Ok((Implementation::Whole(factory), factory.foreign()));
        }
        PTLP_SHAPE_POINT if reads_anywhere => {
            let message = "is POINT, but an input has PTLP_PORT_ANYWHERE: make it GATHER";
            return Err(reader.fault("shape", message));
        }
        PTLP_SHAPE_GATHER if !reads_anywhere => {
            let message = "is GATHER, but no input has PTLP_PORT_ANYWHERE: make it POINT";
            return Err(reader.fault("shape", message));
        }
        PTLP_SHAPE_POINT | PTLP_SHAPE_GATHER => {}
        other => return Err(reader.fault("shape", format!("is {other}, allowed 1..=3"))),
    }
    if about.outputs.iter().any(|port| port.kind != Kind::Image) {
        return Err(reader.fault("outputs", "other than images need the shape WHOLE"));
    }
    let planes: usize = about.outputs.iter().map(|port| port.planes.at_most()).sum();
    if planes > MAX_OUTPUT_PLANES {
        let message = format!(
            "may have {planes} planes, allowed {MAX_OUTPUT_PLANES}, or any number with the shape \
             WHOLE"
        );
        return Err(reader.fault("outputs", message));
    }
    let factory = Factory::leaked(table, threads, kinds);
    Ok((Implementation::Rows(factory), factory.foreign()))
}

/// A block that gives what the caller of the graph set, or what is at its one input.
fn graph_input(block: &Block, about: &About) -> Result<Implementation, Error> {
    let [output] = about.outputs else {
        let count = about.outputs.len();
        return Err(block.reader.fault("output_count", format!("is {count}, allowed 1 here")));
    };
    let is_default = |port: &InputPort| port.is_optional && port.kind == output.kind;
    if about.inputs.len() > 1 || !about.inputs.iter().all(is_default) {
        let message = "of an input of graphs may have one optional entry of the output's kind";
        return Err(block.reader.fault("inputs", message));
    }
    Ok(Implementation::Whole(&GraphInput))
}

fn input(port: &Port) -> Result<InputPort, Error> {
    let (reader, table) = (&port.reader, port.table);
    reader.flags(table.flags, PTLP_PORT_OPTIONAL | PTLP_PORT_ANYWHERE, "flags")?;
    if table.planes != 0 || table.planes_input != 0 {
        return Err(reader.fault("planes", "is for outputs"));
    }
    let is_anywhere = table.flags & PTLP_PORT_ANYWHERE != 0;
    if is_anywhere && port.kind != Kind::Image {
        return Err(reader.fault("flags", "has PTLP_PORT_ANYWHERE, which is for images"));
    }
    Ok(InputPort {
        id: port.id,
        kind: port.kind,
        is_optional: table.flags & PTLP_PORT_OPTIONAL != 0,
        access: if is_anywhere { Access::Anywhere } else { Access::SameRow },
    })
}

fn output(block: &Block, port: &Port) -> Result<OutputPort, Error> {
    let (reader, table) = (&port.reader, port.table);
    reader.flags(table.flags, PTLP_PORT_FREE_RANGE, "flags")?;
    let is_image =
        |port: usize| block.inputs.get(port).is_some_and(|port| port.kind == Kind::Image);
    let images = (0..block.inputs.len()).filter(|port| is_image(*port));
    let as_input = table.planes_input as usize;
    let planes = match (port.kind, table.planes) {
        (Kind::Image, PTLP_PLANES_GREY) => Planes::Grey,
        (Kind::Image, PTLP_PLANES_COLOUR) => Planes::Colour,
        (Kind::Image, PTLP_PLANES_COLOUR_ALPHA) => Planes::ColourAlpha,
        (Kind::Image, PTLP_PLANES_AS_INPUT) if is_image(as_input) => Planes::As(as_input),
        (Kind::Image, PTLP_PLANES_AS_INPUT) => {
            let message = format!("is {as_input}, but there is no image input of that number");
            return Err(reader.fault("planes_input", message));
        }
        (Kind::Image, PTLP_PLANES_MOST) => Planes::Most(leak(images.collect())),
        (Kind::Image, other) => {
            return Err(reader.fault("planes", format!("is {other}, allowed PTLP_PLANES_...")));
        }
        (_, 0) => Planes::Grey,
        (_, other) => return Err(reader.fault("planes", format!("is {other}, but for images"))),
    };
    let is_free = table.flags & PTLP_PORT_FREE_RANGE != 0;
    Ok(OutputPort { id: port.id, kind: port.kind, planes, is_free })
}

fn param(param: &Param) -> Result<ParamSpec, Error> {
    let (reader, table) = (&param.reader, param.table);
    let is_path = table.r#type == PTLP_PARAM_PATH;
    reader.flags(table.flags, if is_path { PTLP_PARAM_READS_FILE } else { 0 }, "flags")?;
    let doc = param.text(table.doc, "doc")?;
    if doc.is_empty() {
        return Err(reader.fault("doc", "says nothing"));
    }
    if (table.r#type == PTLP_PARAM_CHOICE) == param.choices.is_empty() {
        let message = format!("is {} for a parameter of type {}", table.choice_count, table.r#type);
        return Err(reader.fault("choice_count", message));
    }
    let (kind, default) = kind(param)?;
    Ok(ParamSpec { id: param.id, doc, kind, unit: param.text(table.unit, "unit")?, default })
}

fn kind(param: &Param) -> Result<(ParamKind, DefaultValue), Error> {
    let (reader, table) = (&param.reader, param.table);
    let text = || param.text(table.default_text, "default_text").map(DefaultValue::Text);
    Ok(match table.r#type {
        PTLP_PARAM_INT => {
            let (hard, soft) = ranges(param)?;
            let whole = |range: Range<f64>, field| -> Result<Range<i32>, Error> {
                Ok(Range {
                    min: whole(param, range.min, field)?,
                    max: whole(param, range.max, field)?,
                })
            };
            let kind = ParamKind::Int { hard: whole(hard, "min")?, soft: whole(soft, "soft_min")? };
            let default = whole_default(param, hard)?;
            (kind, DefaultValue::Int(default))
        }
        PTLP_PARAM_FLOAT => {
            let (hard, soft) = ranges(param)?;
            in_range(param, hard)?;
            (ParamKind::Float { hard, soft }, DefaultValue::Float(table.default_value))
        }
        PTLP_PARAM_FLAG => {
            let default = whole_default(param, Range { min: 0.0, max: 1.0 })?;
            (ParamKind::Bool, DefaultValue::Bool(default == 1))
        }
        PTLP_PARAM_CHOICE => {
            let last = f64::from(table.choice_count.saturating_sub(1));
            let default = whole_default(param, Range { min: 0.0, max: last })?;
            let items = param.choices.iter().map(|(id, doc)| ChoiceItem { id, doc }).collect();
            (ParamKind::Choice(leak(items)), DefaultValue::Choice(default.unsigned_abs()))
        }
        PTLP_PARAM_TEXT => (ParamKind::Text, text()?),
        PTLP_PARAM_PATH if table.flags & PTLP_PARAM_READS_FILE != 0 => {
            (ParamKind::Path(FileUse::Read), text()?)
        }
        PTLP_PARAM_PATH => (ParamKind::Path(FileUse::Write), text()?),
        other => return Err(reader.fault("type", format!("is {other}, allowed 1..=6"))),
    })
}

/// The hard and the soft range of a number.
fn ranges(param: &Param) -> Result<(Range<f64>, Range<f64>), Error> {
    let (reader, table) = (&param.reader, param.table);
    let hard = Range { min: table.min, max: table.max };
    let soft = Range { min: table.soft_min, max: table.soft_max };
    let numbers = [hard.min, soft.min, soft.max, hard.max];
    if numbers.iter().all(|number| number.is_finite()) && numbers.is_sorted() {
        return Ok((hard, soft));
    }
    let message = format!(
        "to `max` is {} to {}, `soft_min` to `soft_max` is {} to {}: allowed are finite numbers, \
         the soft range inside of the other",
        hard.min, hard.max, soft.min, soft.max
    );
    Err(reader.fault("min", message))
}

fn in_range(param: &Param, range: Range<f64>) -> Result<f64, Error> {
    let default = param.table.default_value;
    if default.is_finite() && range.clamp(default) == default {
        return Ok(default);
    }
    let message = format!("is {default}, allowed {}..={}", range.min, range.max);
    Err(param.reader.fault("default_value", message))
}

fn whole_default(param: &Param, range: Range<f64>) -> Result<i32, Error> {
    whole(param, in_range(param, range)?, "default_value")
}

fn whole(param: &Param, number: f64, field: &str) -> Result<i32, Error> {
    let is_whole = f64::from(truncate64_to_i32(number)) == number;
    if is_whole {
        return Ok(truncate64_to_i32(number));
    }
    let message =
        format!("is {number}, allowed whole numbers of 32 bits (near {})", round64(number));
    Err(param.reader.fault(field, message))
}
