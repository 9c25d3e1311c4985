//! What a block's file says about its pictures, where those that are derived would say little.
//!
//! Comments below the essay declare it. Words in backticks count, by turns a name and a value:
//!
//! ```text
//! // Pictured with `simple noise`.
//! // Pictured: `iterations` `40`, `neighbourhood` `moore`.
//! // Pictured: `states` `12`.
//! ```
//!
//! The first line gives the block at slot 0 that the pictures are made with, and its parameters;
//! each of the others a setting, or two with `; or ` between them. A line that begins with `//  `
//! continues the one before.

use serde_json::Value;

use super::registry::{Block, Parameter, ParameterKind};
use crate::Result;

/// What a block's file declares.
#[derive(Debug, Default)]
pub(super) struct Examples {
    /// The block at slot 0, and its parameters as files have them.
    pub(super) source: Option<(String, Pairs)>,
    /// Settings: the parameters that they change.
    pub(super) settings: Vec<Pairs>,
}

type Pairs = Vec<(String, String)>;

/// Reads the declaration in a block's source.
pub(super) fn examples(source: &str) -> Examples {
    let mut found = Examples::default();
    for comment in comments(source) {
        if comment.starts_with("Pictured with ") {
            let mut words = words(&comment);
            found.source = words.next().map(|block| (block, pairs(words)));
        } else {
            found.settings.extend(comment.split("; or ").map(|setting| pairs(words(setting))));
        }
    }
    found
}

/// What stands in backticks.
fn words(text: &str) -> impl Iterator<Item = String> + '_ {
    text.split('`').skip(1).step_by(2).map(str::to_owned)
}

/// The comments that speak of pictures, each as one line.
fn comments(source: &str) -> Vec<String> {
    let mut comments: Vec<String> = Vec::new();
    let mut is_inside = false;
    for line in source.lines() {
        let begins = line.starts_with("// Pictured");
        match comments.last_mut() {
            Some(comment) if is_inside && line.starts_with("//  ") => {
                comment.push_str(line.trim_start_matches('/').trim());
                continue;
            }
            _ if begins => comments.push(line.trim_start_matches("// ").to_owned()),
            _ => {}
        }
        is_inside = begins;
    }
    comments
}

fn pairs(mut words: impl Iterator<Item = String>) -> Pairs {
    let mut pairs = Vec::new();
    while let (Some(name), Some(value)) = (words.next(), words.next()) {
        pairs.push((name, value));
    }
    pairs
}

/// Fails if a setting names what the block does not have.
pub(super) fn check(block: &Block) -> Result {
    for (name, text) in block.examples.settings.iter().flatten() {
        let mut parameters = block.parameters.iter();
        let parameter = parameters.find(|parameter| parameter.id == *name);
        if parameter.and_then(|parameter| value(parameter, text)).is_none() {
            return Err(format!("{}: no picture with `{name}` `{text}`", block.id).into());
        }
    }
    Ok(())
}

/// A value as an example writes it: alternatives by their names, `yes` and `no`.
pub(super) fn value(parameter: &Parameter, text: &str) -> Option<Value> {
    match parameter.kind {
        ParameterKind::Int => text.parse::<i64>().ok().map(Value::from),
        ParameterKind::Float => text.parse::<f64>().ok().map(Value::from),
        ParameterKind::Bool => {
            ["no", "yes"].iter().position(|&word| word == text).map(|is| (is == 1).into())
        }
        ParameterKind::Choice => {
            let mut choices = parameter.choices.iter();
            choices.find(|choice| choice.id == text).map(|choice| choice.number.into())
        }
        ParameterKind::Text | ParameterKind::Path => Some(text.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_values_take_turns() {
        let found = examples(
            "//! Essay.\n\n// Pictured with `noise`: `size` `3`.\n// Pictured: `a b` `1 2`,\n\
             //   `c` `x`.\n// Pictured: `d` `-0.5`; or `f` `g`.\n// Other: `e` `f`.\n",
        );
        let pair = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        assert_eq!(found.source, Some(("noise".to_owned(), vec![pair("size", "3")])));
        let settings = vec![
            vec![pair("a b", "1 2"), pair("c", "x")],
            vec![pair("d", "-0.5")],
            vec![pair("f", "g")],
        ];
        assert_eq!(found.settings, settings);
    }

    #[test]
    fn values_are_of_the_kind_of_the_parameter() {
        let json = r#"{"id": "a", "kind": "choice", "doc": "", "default": 1, "choices": [
            {"number": 0, "id": "x", "doc": ""}, {"number": 1, "id": "y z", "doc": ""}]}"#;
        let choice: Parameter = serde_json::from_str(json).unwrap();
        assert_eq!(value(&choice, "y z"), Some(1.into()));
        assert_eq!(value(&choice, "w"), None);
    }
}
