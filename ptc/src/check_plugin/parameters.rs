//! Random and extreme values of parameters.

use ptlib::params::{ParamKind, ParamSpec, ParamValue};

/// A value of a parameter: an end of its range, its default, or something between.
pub(super) fn drawn(param: &ParamSpec, trial: u64, number: u32) -> ParamValue {
    let unit = f64::from(ptlib::math::hash::uniform(trial, number, 0, 0));
    let way = ptlib::math::hash::hash(trial, number, 1, 0) % 5;
    let between = |min: f64, max: f64| match way {
        0 => min,
        1 => max,
        _ => min * (1.0 - unit) + max * unit,
    };
    match param.kind {
        ParamKind::Int { hard, soft } => {
            let range = if way == 2 { soft } else { hard };
            let number = between(range.min.into(), range.max.into());
            ParamValue::Int(ptlib::math::convert::truncate64_to_i32(number))
        }
        ParamKind::Float { hard, soft } => {
            let range = if way == 2 { soft } else { hard };
            ParamValue::Float(between(range.min, range.max))
        }
        ParamKind::Bool => ParamValue::Bool(way.is_multiple_of(2)),
        ParamKind::Choice(items) => {
            let count = u32::try_from(items.len()).unwrap_or(1).max(1);
            ParamValue::Choice(ptlib::math::hash::hash(trial, number, 2, 0) % count)
        }
        ParamKind::Text | ParamKind::Path(_) => match way {
            0 => ParamValue::Text("".into()),
            1 => ParamValue::Text("π < \"ü\" & \n%s%n".into()),
            2 => ParamValue::Text("x".repeat(5000).into()),
            _ => param.default_value(),
        },
    }
}

/// A value in a word.
pub(super) fn word(value: &ParamValue) -> String {
    match value {
        ParamValue::Int(value) => value.to_string(),
        ParamValue::Float(value) => value.to_string(),
        ParamValue::Bool(value) => value.to_string(),
        ParamValue::Choice(value) => value.to_string(),
        ParamValue::Text(text) if text.len() > 40 => format!("(a text of {} bytes)", text.len()),
        ParamValue::Text(text) => format!("{text:?}"),
    }
}
