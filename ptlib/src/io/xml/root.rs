//! The root element: what holds for a graph as a whole.

use super::{
    element::{Attribute, Element, shortened},
    numbers::{integer_prefix, seed_from},
    report::{Report, raisable},
};
use crate::{
    error::{Error, ErrorKind},
    graph::{Graph, Settings},
    limits::Limits,
    math::levels::Precision,
};

const NAME: &str = "texturegraph";
const KNOWN: [&str; 6] = ["width", "height", "seed", "supersampling", "version", "precision"];

/// Reads the root element into `graph`; `false` if the file is no graph file of a known version,
/// so that what follows makes no sense.
pub(super) fn read_root(
    root: &Element<'_>,
    graph: &mut Graph,
    limits: &Limits,
    report: &mut Report<'_>,
) -> bool {
    if root.name != NAME {
        let message = format!("the root element is <{}>, not <{NAME}>", shortened(root.name));
        let error = Error::new(ErrorKind::Parse, message);
        report.fault(root.offset, error.with_hint("is this a graph file?"));
        return false;
    }
    match version(root) {
        Ok(version) => {
            report.is_strict = version.is_some();
            graph.set_file_version(version);
        }
        Err((offset, error)) => {
            report.fault(offset, error);
            return false;
        }
    }
    read_settings(root, graph, limits, report);
    graph.set_extra_attributes(root.others(&KNOWN));
    true
}

/// The version of the file format; `None` for a file of PT Designer.
fn version(root: &Element<'_>) -> Result<Option<u32>, (usize, Error)> {
    let Some(attribute) = root.get("version") else { return Ok(None) };
    let newest = Settings::FILE_VERSION;
    let text = shortened(&attribute.value);
    match attribute.value.parse::<u32>() {
        Ok(version @ 1..) if version <= newest => Ok(Some(version)),
        Ok(1..) => {
            let message =
                format!("version {text} of the file format; this library reads up to {newest}");
            let error = Error::new(ErrorKind::Unsupported, message);
            Err((attribute.offset, error.with_hint("a newer ptlib wrote the file")))
        }
        _ => {
            let message = format!("version is \"{text}\", allowed 1..={newest}");
            Err((attribute.offset, Error::new(ErrorKind::Parse, message)))
        }
    }
}

fn read_settings(root: &Element<'_>, graph: &mut Graph, limits: &Limits, report: &mut Report<'_>) {
    let defaults = Settings::default();
    let mut side = |name, default| size(root, name, default, limits, report);
    let (width, height) = (side("width", defaults.width), side("height", defaults.height));
    if let Err(error) = graph.set_size(width, height) {
        report.fault(root.offset, error);
    }
    let seed = number(root, "seed", i128::from(defaults.seed), report);
    graph.set_seed(checked_seed(root, seed, report));
    let level = supersampling(root, report);
    if let Err(error) = graph.set_supersampling(level) {
        report.fault(root.offset, error);
    }
    graph.set_precision(precision(root, report));
}

/// A seed that fits, and a complaint about one that does not.
pub(super) fn checked_seed(element: &Element<'_>, seed: i128, report: &mut Report<'_>) -> u64 {
    seed_from(seed).unwrap_or_else(|| {
        let nearest = if seed < 0 { i64::MIN.cast_unsigned() } else { u64::MAX };
        let message = format!("seed is outside of {}..={}, taken as {nearest}", i64::MIN, u64::MAX);
        let offset = element.get("seed").map_or(element.offset, |attribute| attribute.offset);
        report.tolerate(offset, Error::new(ErrorKind::OutOfRange, message));
        nearest
    })
}

/// A whole number of the root; `default` with a warning if it is missing.
fn number(root: &Element<'_>, name: &str, default: i128, report: &mut Report<'_>) -> i128 {
    match root.get(name) {
        Some(attribute) => whole_number(attribute, report).unwrap_or(default),
        None => {
            let error = root.missing(name).with_hint(format!("taken as {default}"));
            report.warn(root.offset, error);
            default
        }
    }
}

/// A whole number in an attribute. Files of PT Designer may have anything behind it, or instead of
/// it; nothing is 0. `None` if that is a fault.
pub(super) fn whole_number(attribute: &Attribute<'_>, report: &mut Report<'_>) -> Option<i128> {
    let (name, text) = (attribute.name, &attribute.value);
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let message = format!("{name} is \"{}\", which is no whole number", shortened(text));
    let error = Error::new(ErrorKind::Parse, message);
    if report.is_strict {
        report.fault(attribute.offset, error);
        return None;
    }
    let value = integer_prefix(text);
    report.warn(attribute.offset, error.with_hint(format!("taken as {value}")));
    Some(value)
}

fn size(
    root: &Element<'_>,
    name: &str,
    default: u32,
    limits: &Limits,
    report: &mut Report<'_>,
) -> u32 {
    let value = number(root, name, i128::from(default), report);
    let offset = root.get(name).map_or(root.offset, |attribute| attribute.offset);
    let allowed = limits.image_side.max(1);
    if value < 1 {
        let message = format!("{name} is {value}, allowed 1..={allowed}");
        report.fault(offset, Error::new(ErrorKind::OutOfRange, message));
    } else if value > i128::from(allowed) {
        let message = format!("{name} is {value}, allowed 1..={allowed}");
        report.fault(offset, raisable(ErrorKind::Limit, message, "image_side"));
    }
    u32::try_from(value.clamp(1, i128::from(allowed))).unwrap_or(allowed)
}

fn supersampling(root: &Element<'_>, report: &mut Report<'_>) -> u32 {
    let max = Settings::MAX_SUPERSAMPLING;
    let value = number(root, "supersampling", 1, report);
    let level = match value {
        0 => 1,
        _ => u32::try_from(value).map_or(max, |value| value.min(max)),
    };
    if i128::from(level) != value {
        let message = format!("supersampling is {value}, allowed 1..={max}");
        let mut error = Error::new(ErrorKind::OutOfRange, message);
        if !report.is_strict {
            error = error.with_hint(format!("taken as {level}"));
        }
        let offset = root.get("supersampling").map_or(root.offset, |attribute| attribute.offset);
        report.tolerate(offset, error);
    }
    level
}

/// The precision. Files from before that attribute existed are computed in 8 bits.
fn precision(root: &Element<'_>, report: &mut Report<'_>) -> Precision {
    let Some(attribute) = root.get("precision") else { return Precision::EightBit };
    match &*attribute.value {
        "8" => Precision::EightBit,
        "float" => Precision::Float,
        other => {
            let message =
                format!("precision is \"{}\", allowed \"8\", \"float\"", shortened(other));
            report.fault(attribute.offset, Error::new(ErrorKind::OutOfRange, message));
            Precision::EightBit
        }
    }
}
