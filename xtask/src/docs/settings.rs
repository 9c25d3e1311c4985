//! The settings that a block is shown at, derived from its declaration.
//!
//! Nobody has to list them, so that a new block has them too; where what is derived says little,
//! the block's file declares better ones ([`examples`]). There are three: the defaults, and
//! one on either side of them. *Lower* moves every number from its default towards the lower end of
//! its usual range and takes the next alternative of every choice; *higher* moves numbers towards
//! the upper end, takes the alternative after that, and turns every switch. Both take the example
//! that the help of an empty text gives with the words "as in". Choices of one block with the same
//! alternatives go together: they are of one kind, and a block may want them to agree.
//!
//! Towards an end means halfway, so that a picture stays one that somebody could want. Where the
//! end is a multiple of the default the middle is the geometric one, as for sizes and frequencies;
//! from 0, or across it, a quarter of the way is far enough.

use serde_json::Value;

use super::{
    examples,
    registry::{Block, Parameter, ParameterKind, Range, Role},
};

/// One of the settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Setting {
    Default,
    Lower,
    Higher,
}

impl Setting {
    /// The word for it in the names of pictures.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Lower => "lower",
            Self::Higher => "higher",
        }
    }
}

/// The settings that differ: a block whose parameters cannot be moved has its defaults alone, and
/// so has an input of a graph, which gives what it is given.
pub(super) fn settings(block: &Block) -> Vec<Setting> {
    if block.role == Role::Input {
        return vec![Setting::Default];
    }
    let all = [Setting::Default, Setting::Lower, Setting::Higher].into_iter();
    all.filter(|&setting| setting == Setting::Default || !changes(block, setting).is_empty())
        .collect()
}

/// The parameters that a setting changes, and their values.
pub(super) fn changes(block: &Block, setting: Setting) -> Vec<(&Parameter, Value)> {
    let given = given(block, setting);
    let values = block.parameters.iter().map(|parameter| {
        let value = match given {
            Some(pairs) => example_value(parameter, pairs),
            None => value(parameter, block, setting),
        };
        (parameter, value)
    });
    values.filter(|(parameter, value)| *value != parameter.default).collect()
}

/// What the block's file declares for a setting, if it declares any: nothing for one that it omits.
fn given(block: &Block, setting: Setting) -> Option<&[(String, String)]> {
    let settings = &block.examples.settings;
    let place = match setting {
        Setting::Lower => 0,
        Setting::Higher => 1,
        Setting::Default => return None,
    };
    (!settings.is_empty()).then(|| settings.get(place).map_or(&[][..], Vec::as_slice))
}

/// The value of a parameter in an example.
fn example_value(parameter: &Parameter, pairs: &[(String, String)]) -> Value {
    let text = pairs.iter().find(|(name, _)| *name == parameter.id);
    let value = text.and_then(|(_, text)| examples::value(parameter, text));
    value.unwrap_or_else(|| parameter.default.clone())
}

/// The derived value of a parameter at a setting.
fn value(parameter: &Parameter, block: &Block, setting: Setting) -> Value {
    let default = &parameter.default;
    let moved = match (parameter.kind, setting) {
        (_, Setting::Default) => None,
        (ParameterKind::Int, _) => {
            let value = parameter
                .soft
                .zip(default.as_f64())
                .map(|(soft, default)| rounded(towards(default, soft, setting)));
            value.map(Value::from)
        }
        (ParameterKind::Float, _) => {
            let value = parameter.soft.zip(default.as_f64());
            value.map(|(soft, default)| Value::from(short(towards(default, soft, setting))))
        }
        (ParameterKind::Bool, Setting::Higher) => default.as_bool().map(|is_set| (!is_set).into()),
        (ParameterKind::Text, _) if default == "" => example(&parameter.doc).map(Value::from),
        (ParameterKind::Choice, Setting::Lower) => alternative(like(parameter, block), 0),
        (ParameterKind::Choice, Setting::Higher) => alternative(like(parameter, block), 1),
        _ => None,
    };
    moved.unwrap_or_else(|| default.clone())
}

/// The example in a help text: what stands in backticks behind "as in".
fn example(doc: &str) -> Option<&str> {
    let (_, example) = doc.split_once("as in `")?;
    example.split_once('`').map(|(example, _)| example)
}

/// The first choice of the block with the same alternatives.
fn like<'a>(parameter: &'a Parameter, block: &'a Block) -> &'a Parameter {
    let ids = |of: &'a Parameter| of.choices.iter().map(|choice| &choice.id);
    let mut all = block.parameters.iter();
    all.find(|other| ids(other).eq(ids(parameter))).unwrap_or(parameter)
}

/// An alternative that is not the default: of those, the one at `place`, in a circle.
fn alternative(parameter: &Parameter, place: usize) -> Option<Value> {
    let numbers: Vec<i64> = parameter.choices.iter().map(|choice| choice.number).collect();
    let default = numbers.iter().position(|&number| parameter.default == number)?;
    let others = numbers.len().checked_sub(1).filter(|&others| others > 0)?;
    numbers.get((default + 1 + place % others) % numbers.len()).map(|&number| number.into())
}

/// From how many times as much on the geometric middle is taken.
const MULTIPLE: f64 = 4.0;

/// Part of the way from a default to an end of the usual range.
fn towards(default: f64, soft: Range, setting: Setting) -> f64 {
    let end = if setting == Setting::Lower { soft.min } else { soft.max };
    let (small, large) = (default.abs().min(end.abs()), default.abs().max(end.abs()));
    if default == 0.0 || default * end < 0.0 {
        default + (end - default) / 4.0
    } else if small > 0.0 && large >= small * MULTIPLE {
        (default * end).sqrt() * default.signum()
    } else {
        f64::midpoint(default, end)
    }
}

/// Two significant digits: a setting that somebody would write.
fn short(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

#[expect(clippy::cast_possible_truncation, reason = "within a range of whole numbers")]
fn rounded(value: f64) -> i64 {
    value.round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(default: f64, min: f64, max: f64) -> (f64, f64) {
        let soft = Range { min, max };
        let at = |setting| short(towards(default, soft, setting));
        (at(Setting::Lower), at(Setting::Higher))
    }

    #[test]
    fn numbers_move_part_of_the_way() {
        assert_eq!(between(0.0, -1.0, 1.0), (-0.25, 0.25));
        assert_eq!(between(0.5, 0.0, 1.0), (0.25, 0.75));
        assert_eq!(between(4.0, 1.0, 64.0), (2.0, 16.0));
        assert_eq!(between(2.0, -10.0, 10.0), (-1.0, 4.5));
        assert_eq!(between(0.001, 0.001, 0.1), (0.001, 0.01));
    }

    #[test]
    fn a_text_takes_the_example_of_its_help() {
        assert_eq!(example("Colours, as in `0 1; 2 3`, or `none`."), Some("0 1; 2 3"));
        assert_eq!(example("Colours."), None);
    }

    #[test]
    fn choices_take_each_alternative_in_turn() {
        let json = r#"{"id": "a", "kind": "choice", "doc": "", "default": 1, "choices": [
            {"number": 0, "id": "x", "doc": ""}, {"number": 1, "id": "y", "doc": ""},
            {"number": 2, "id": "z", "doc": ""}]}"#;
        let choice: Parameter = serde_json::from_str(json).unwrap();
        assert_eq!(alternative(&choice, 0).unwrap(), 2);
        assert_eq!(alternative(&choice, 1).unwrap(), 0);
    }
}
