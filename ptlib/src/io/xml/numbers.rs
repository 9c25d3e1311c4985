//! Numbers as PT Designer read them: as much of a text's start as is one, 0 if nothing is.

use crate::{
    math::convert::truncate64,
    params::{ParamKind, ParamSpec, ParamValue},
};

/// The whole number that a text starts with, after blanks.
pub(super) fn integer_prefix(text: &str) -> i128 {
    let text = text.trim_ascii_start();
    let (is_negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let digits = text.bytes().map_while(|byte| char::from(byte).to_digit(10));
    let value = digits
        .fold(0_i128, |value, digit| value.saturating_mul(10).saturating_add(i128::from(digit)));
    if is_negative { -value } else { value }
}

/// The decimal number that a text starts with, after blanks. Infinite if it is too large.
pub(super) fn number_prefix(text: &str) -> f64 {
    let text = text.trim_ascii_start();
    let digits_from = |start: usize| {
        let rest = text.get(start..).unwrap_or_default();
        start + rest.bytes().take_while(u8::is_ascii_digit).count()
    };
    let has_at = |place: usize, any: &[u8]| {
        text.as_bytes().get(place).is_some_and(|byte| any.contains(byte))
    };
    let mut end = digits_from(usize::from(has_at(0, b"+-")));
    if has_at(end, b".") {
        end = digits_from(end + 1);
    }
    if has_at(end, b"eE") {
        let sign = end + 1;
        let digits = sign + usize::from(has_at(sign, b"+-"));
        if digits_from(digits) > digits {
            end = digits_from(digits);
        }
    }
    text.get(..end).and_then(|number| number.parse().ok()).unwrap_or(0.0)
}

/// A seed: negative ones are two's complement.
pub(super) fn seed_from(number: i128) -> Option<u64> {
    let negative = || i64::try_from(number).ok().map(i64::cast_unsigned);
    u64::try_from(number).ok().or_else(negative)
}

/// The value of a parameter as PT Designer read it (specification 1.1). It may be one that the
/// parameter cannot hold.
pub(super) fn lenient_value(spec: &ParamSpec, text: &str) -> ParamValue {
    let integer = || truncate64(number_prefix(text));
    match spec.kind {
        ParamKind::Int { .. } => {
            let bounds = (i64::from(i32::MIN), i64::from(i32::MAX));
            let value = i32::try_from(integer().clamp(bounds.0, bounds.1));
            ParamValue::Int(value.unwrap_or_default())
        }
        ParamKind::Float { .. } => ParamValue::Float(number_prefix(text)),
        ParamKind::Bool => ParamValue::Bool(text.starts_with('1')),
        ParamKind::Choice(_) => ParamValue::Choice(u32::try_from(integer()).unwrap_or(u32::MAX)),
        ParamKind::Text | ParamKind::Path(_) => ParamValue::Text(text.into()),
    }
}

/// The value of a parameter, if the text is exactly one.
pub(super) fn strict_value(spec: &ParamSpec, text: &str) -> Option<ParamValue> {
    Some(match spec.kind {
        ParamKind::Int { .. } => ParamValue::Int(text.parse().ok()?),
        ParamKind::Float { .. } => {
            ParamValue::Float(text.parse().ok().filter(|value: &f64| value.is_finite())?)
        }
        ParamKind::Bool => ParamValue::Bool(match text {
            "1" => true,
            "0" => false,
            _ => return None,
        }),
        ParamKind::Choice(_) => ParamValue::Choice(text.parse().ok()?),
        ParamKind::Text | ParamKind::Path(_) => ParamValue::Text(text.into()),
    })
}

/// What [`strict_value`] takes.
pub(super) fn grammar(spec: &ParamSpec) -> &'static str {
    match spec.kind {
        ParamKind::Int { .. } | ParamKind::Choice(_) => "a whole number",
        ParamKind::Float { .. } => "a finite number",
        ParamKind::Bool => "0 or 1",
        ParamKind::Text | ParamKind::Path(_) => "a text",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_much_of_the_start_as_is_a_number() {
        for (text, expected) in [
            ("3.9", 3.9),
            ("1e2", 100.0),
            (" \n7x", 7.0),
            ("", 0.0),
            ("x", 0.0),
            ("-2.5e-1 and more", -0.25),
            ("+.5", 0.5),
            ("5.", 5.0),
            (".", 0.0),
            ("1e", 1.0),
            ("1e+", 1.0),
            ("0x10", 0.0),
            ("1,5", 1.0),
            ("inf", 0.0),
            ("nan", 0.0),
            ("3.39021e-206", 3.39021e-206),
            ("--1", 0.0),
        ] {
            assert_eq!(number_prefix(text), expected, "{text:?}");
        }
        assert_eq!(number_prefix("-1e999"), f64::NEG_INFINITY);
        assert_eq!(number_prefix("1é"), 1.0);
    }

    #[test]
    fn whole_numbers_stop_at_the_first_other_character() {
        for (text, expected) in
            [("512", 512), ("-7x", -7), ("+8.9", 8), (" 3", 3), ("abc", 0), ("", 0), ("- 1", 0)]
        {
            assert_eq!(integer_prefix(text), expected, "{text:?}");
        }
        assert_eq!(integer_prefix(&"9".repeat(100)), i128::MAX);
        assert_eq!(integer_prefix(&format!("-{}", "9".repeat(100))), -i128::MAX);
    }

    #[test]
    fn seeds_are_twos_complement() {
        assert_eq!(seed_from(7), Some(7));
        assert_eq!(seed_from(-1), Some(u64::MAX));
        assert_eq!(seed_from(i128::from(u64::MAX)), Some(u64::MAX));
        assert_eq!(seed_from(i128::from(u64::MAX) + 1), None);
        assert_eq!(seed_from(i128::from(i64::MIN) - 1), None);
    }
}
