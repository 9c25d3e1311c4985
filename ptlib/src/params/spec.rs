//! What a parameter is, and the values it may hold.

use std::sync::Arc;

use crate::error::{Error, ErrorKind};

/// A parameter's value as a graph stores it.
#[derive(Debug, Clone, PartialEq)]
pub enum ParamValue {
    /// A whole number.
    Int(i32),
    /// A finite number.
    Float(f64),
    /// Yes or no.
    Bool(bool),
    /// One of a [`ParamKind::Choice`]'s alternatives, by number.
    Choice(u32),
    /// A text or a path.
    Text(Arc<str>),
}

/// Two ends, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range<T> {
    /// The smallest value.
    pub min: T,
    /// The largest value.
    pub max: T,
}

impl<T: PartialOrd + Copy> Range<T> {
    /// `value`, or the end of the range that is nearer to it.
    pub fn clamp(&self, value: T) -> T {
        if value < self.min {
            self.min
        } else if value > self.max {
            self.max
        } else {
            value
        }
    }
}

/// One alternative of a choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ChoiceItem {
    /// Its id, for ever.
    pub id: &'static str,
    /// What it means, one line.
    pub doc: &'static str,
}

/// What a block does with the file that a path names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileUse {
    /// Reads it: the engine's file policy fetches its bytes.
    Read,
    /// Writes it: only where the caller allowed that.
    Write,
}

/// What a parameter may hold. The *hard* range is what the block computes with; the *soft* range is
/// what an editor's slider offers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParamKind {
    /// A whole number.
    Int {
        /// Allowed values.
        hard: Range<i32>,
        /// Usual values.
        soft: Range<i32>,
    },
    /// A finite number.
    Float {
        /// Allowed values.
        hard: Range<f64>,
        /// Usual values.
        soft: Range<f64>,
    },
    /// Yes or no.
    Bool,
    /// One of several alternatives; files name it by its number.
    Choice(&'static [ChoiceItem]),
    /// A text.
    Text,
    /// A path, relative to the folder of the graph file.
    Path(FileUse),
}

impl ParamKind {
    /// The kind's name in messages and in the documentation.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Int { .. } => "int",
            Self::Float { .. } => "float",
            Self::Bool => "bool",
            Self::Choice(_) => "choice",
            Self::Text => "text",
            Self::Path(_) => "path",
        }
    }
}

/// One declared parameter.
#[derive(Debug, Clone, Copy)]
pub struct ParamSpec {
    /// Its id in files and interfaces: lower-case words separated by single blanks, for ever.
    pub id: &'static str,
    /// What it does, in sentences.
    pub doc: &'static str,
    /// What it may hold.
    pub kind: ParamKind,
    /// What its number counts, such as `px` or `% of the width`; empty for a plain number.
    pub unit: &'static str,
    /// What it holds unless somebody says otherwise.
    pub default: DefaultValue,
}

/// A default value, in a form that exists at compile time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DefaultValue {
    /// A whole number.
    Int(i32),
    /// A number.
    Float(f64),
    /// Yes or no.
    Bool(bool),
    /// The number of an alternative.
    Choice(u32),
    /// A text or a path.
    Text(&'static str),
}

impl ParamSpec {
    /// The default as a value.
    #[must_use]
    pub fn default_value(&self) -> ParamValue {
        match self.default {
            DefaultValue::Int(value) => ParamValue::Int(value),
            DefaultValue::Float(value) => ParamValue::Float(value),
            DefaultValue::Bool(value) => ParamValue::Bool(value),
            DefaultValue::Choice(value) => ParamValue::Choice(value),
            DefaultValue::Text(value) => ParamValue::Text(value.into()),
        }
    }

    /// Whether `value` is one that this parameter may hold.
    ///
    /// # Errors
    /// [`ErrorKind::TypeMismatch`] or [`ErrorKind::OutOfRange`], saying what is allowed.
    pub fn check(&self, value: &ParamValue) -> Result<(), Error> {
        let out_of_range = |is: String, allowed: String| {
            let message = format!("is {is}, allowed {allowed}");
            Err(Error::new(ErrorKind::OutOfRange, message).at_parameter(self.id))
        };
        match (&self.kind, value) {
            (ParamKind::Int { hard, .. }, ParamValue::Int(value)) => {
                if hard.clamp(*value) == *value {
                    return Ok(());
                }
                out_of_range(value.to_string(), format!("{}..={}", hard.min, hard.max))
            }
            (ParamKind::Float { hard, .. }, ParamValue::Float(value)) => {
                if value.is_finite() && hard.clamp(*value) == *value {
                    return Ok(());
                }
                out_of_range(value.to_string(), format!("{}..={}", hard.min, hard.max))
            }
            (ParamKind::Choice(items), ParamValue::Choice(value)) => {
                if (*value as usize) < items.len() {
                    return Ok(());
                }
                out_of_range(value.to_string(), self.choices())
            }
            (ParamKind::Bool, ParamValue::Bool(_))
            | (ParamKind::Text | ParamKind::Path(_), ParamValue::Text(_)) => Ok(()),
            (kind, _) => {
                let message = format!("takes a value of kind {}", kind.name());
                Err(Error::new(ErrorKind::TypeMismatch, message).at_parameter(self.id))
            }
        }
    }

    /// The value nearest to `value` that this parameter may hold: numbers are clamped, unknown
    /// alternatives and values of another kind become the default.
    #[must_use]
    pub fn nearest(&self, value: ParamValue) -> ParamValue {
        match (&self.kind, value) {
            (ParamKind::Int { hard, .. }, ParamValue::Int(value)) => {
                ParamValue::Int(hard.clamp(value))
            }
            (ParamKind::Float { hard, .. }, ParamValue::Float(value)) if !value.is_nan() => {
                ParamValue::Float(hard.clamp(value))
            }
            (_, value) => match self.check(&value) {
                Ok(()) => value,
                Err(_) => self.default_value(),
            },
        }
    }

    /// The alternatives of a choice as a text: `0 (random), 1 (square)`.
    fn choices(&self) -> String {
        let ParamKind::Choice(items) = self.kind else { return String::new() };
        let items = items.iter().enumerate().map(|(i, item)| format!("{i} ({})", item.id));
        items.collect::<Vec<_>>().join(", ")
    }
}

/// A Rust type that a parameter's field can have.
pub trait ParamType: Sized {
    /// The field's value; `None` if the value is of another kind.
    fn unpack(value: &ParamValue) -> Option<Self>;
}

impl ParamType for i32 {
    fn unpack(value: &ParamValue) -> Option<Self> {
        if let ParamValue::Int(value) = value { Some(*value) } else { None }
    }
}

impl ParamType for f64 {
    fn unpack(value: &ParamValue) -> Option<Self> {
        if let ParamValue::Float(value) = value { Some(*value) } else { None }
    }
}

impl ParamType for bool {
    fn unpack(value: &ParamValue) -> Option<Self> {
        if let ParamValue::Bool(value) = value { Some(*value) } else { None }
    }
}

impl ParamType for Arc<str> {
    fn unpack(value: &ParamValue) -> Option<Self> {
        if let ParamValue::Text(value) = value { Some(Self::clone(value)) } else { None }
    }
}

/// All parameters of one block, typed. Made by [`params!`](crate::params!).
pub trait ParamSet: Sized + Clone + Send + Sync + 'static {
    /// The declared parameters, in order.
    const SPECS: &'static [ParamSpec];

    /// The typed parameters of `values`, which are in the order of [`SPECS`](Self::SPECS); `None`
    /// if one is of another kind than declared.
    fn read(values: &[ParamValue]) -> Option<Self>;
}

/// Fails the build when a default or a soft range leaves the hard range, or an id is used twice.
pub const fn check_specs(specs: &[ParamSpec]) {
    let mut i = 0;
    while i < specs.len() {
        match (specs[i].kind, specs[i].default) {
            (ParamKind::Int { hard, soft }, DefaultValue::Int(default)) => assert!(
                hard.min <= default
                    && default <= hard.max
                    && hard.min <= soft.min
                    && soft.max <= hard.max,
                "int parameter leaves its range"
            ),
            (ParamKind::Float { hard, soft }, DefaultValue::Float(default)) => assert!(
                hard.min <= default
                    && default <= hard.max
                    && hard.min <= soft.min
                    && soft.max <= hard.max,
                "float parameter leaves its range"
            ),
            (ParamKind::Choice(items), DefaultValue::Choice(default)) => {
                assert!((default as usize) < items.len(), "choice default is not listed");
            }
            (ParamKind::Bool, DefaultValue::Bool(_))
            | (ParamKind::Text | ParamKind::Path(_), DefaultValue::Text(_)) => {}
            _ => panic!("default has another kind than its parameter"),
        }
        let mut j = 0;
        while j < i {
            assert!(!same(specs[i].id, specs[j].id), "two parameters have the same id");
            j += 1;
        }
        i += 1;
    }
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::choice! {
        /// How to do it.
        Way {
            /// Quickly.
            Fast = "fast",
            /// Thoroughly.
            Slow = "slow",
        }
    }

    crate::params! {
        /// Test parameters.
        Params {
            /// How many.
            count "number of things": int [hard 1..=10 soft 2..=5 unit "px"] = 3;
            /// How much.
            amount: float [hard 0.0..=1.0 soft 0.0..=0.5] = 0.25;
            /// Whether.
            really: bool = true;
            /// How.
            way: choice [Way] = Way::Slow;
            /// What.
            words: text = "a b";
        }
    }

    fn defaults() -> Vec<ParamValue> {
        Params::SPECS.iter().map(ParamSpec::default_value).collect()
    }

    #[test]
    fn one_declaration_gives_table_and_struct() {
        let [count, .., way, words] = Params::SPECS else { panic!("five parameters") };
        assert_eq!((count.id, count.unit, count.doc), ("number of things", "px", "How many."));
        assert_eq!(words.id, "words");
        assert!(matches!(way.kind, ParamKind::Choice([_, ChoiceItem { id: "slow", .. }])));
        let params = Params::read(&defaults()).unwrap();
        assert_eq!((params.count, params.amount, params.really), (3, 0.25, true));
        assert_eq!((params.way, &*params.words), (Way::Slow, "a b"));
    }

    #[test]
    fn values_of_another_kind_are_not_read() {
        let mut values = defaults();
        values[0] = ParamValue::Bool(true);
        assert!(Params::read(&values).is_none());
        assert!(Params::read(&values[1..]).is_none());
    }

    #[test]
    fn a_refused_value_names_what_is_allowed() {
        let error = Params::SPECS[0].check(&ParamValue::Int(11)).unwrap_err();
        assert_eq!(error.to_string(), "parameter \"number of things\": is 11, allowed 1..=10");
        let error = Params::SPECS[1].check(&ParamValue::Float(f64::NAN)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::OutOfRange);
        let error = Params::SPECS[3].check(&ParamValue::Choice(2)).unwrap_err();
        assert!(error.to_string().contains("0 (fast), 1 (slow)"));
        let error = Params::SPECS[2].check(&ParamValue::Int(1)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TypeMismatch);
    }

    #[test]
    fn nearest_value_is_always_allowed() {
        let specs = Params::SPECS;
        assert_eq!(specs[0].nearest(ParamValue::Int(-4)), ParamValue::Int(1));
        assert_eq!(specs[1].nearest(ParamValue::Float(7.0)), ParamValue::Float(1.0));
        assert_eq!(specs[1].nearest(ParamValue::Float(f64::NAN)), ParamValue::Float(0.25));
        assert_eq!(specs[3].nearest(ParamValue::Choice(9)), ParamValue::Choice(1));
        assert_eq!(specs[4].nearest(ParamValue::Int(9)), ParamValue::Text("a b".into()));
    }
}
