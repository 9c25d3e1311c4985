//! L-systems: a sentence of symbols with numbers, and rules that replace its symbols again and
//! again.
//!
//! Specification 2.44. [`read`](mod@read) turns the text of a file into a [`Grammar`];
//! [`rewrite`](mod@rewrite) applies its rules. The expressions of a grammar are compiled to
//! [`Step`]s on the way, so nothing here recurses and no nesting can overflow the stack.
//!
//! Grammars are files of strangers. Their bytes, the symbols of a sentence and the steps of
//! rewriting have limits; memory is at most some tens of bytes for each of the first two.

mod lex;
mod program;
mod read;
mod rewrite;

use program::Step;

use crate::block::prelude::*;

/// The most numbers that a symbol may have.
const MAX_VALUES: usize = 5;

/// An L-system, ready to be carried out.
#[derive(Debug)]
pub(super) struct Grammar {
    axiom: Sentence,
    /// The rules, ordered by [`key`]; those of one key as in the file.
    rules: Vec<Rule>,
    /// For each key, where its rules start; then the number of rules.
    starts: Vec<usize>,
    /// The steps of all rules.
    steps: Vec<Step>,
}

/// What a symbol with some number of values may be replaced by.
#[derive(Debug, Clone, Copy)]
struct Rule {
    symbol: u8,
    values: u8,
    weight: u8,
    /// Where its condition starts among all steps; it ends where the production starts.
    condition: u32,
    production: u32,
    end: u32,
}

/// The number of keys of rules.
const KEYS: usize = 128 * (MAX_VALUES + 1);

/// A number for the rules that look alike from the left: same symbol, same number of values.
fn key(symbol: u8, values: u8) -> usize {
    usize::from(symbol) * (MAX_VALUES + 1) + usize::from(values)
}

/// Symbols, each with some values.
#[derive(Debug, Default, PartialEq)]
struct Sentence {
    /// Each symbol and how many values it has; at most [`MAX_VALUES`].
    symbols: Vec<(u8, u8)>,
    /// The values of all symbols.
    values: Vec<i32>,
}

impl Sentence {
    /// Symbols and values together: what the limit counts.
    fn len(&self) -> u64 {
        self.symbols.len() as u64 + self.values.len() as u64
    }

    fn clear(&mut self) {
        self.symbols.clear();
        self.values.clear();
    }

    fn push(&mut self, symbol: u8, values: &[i32]) {
        self.symbols.push((symbol, u8::try_from(values.len()).unwrap_or(u8::MAX)));
        self.values.extend_from_slice(values);
    }

    /// Each symbol with its values.
    fn iter(&self) -> impl Iterator<Item = (u8, &[i32])> {
        let mut rest = &self.values[..];
        self.symbols.iter().map(move |(symbol, count)| {
            let (values, others) = rest.split_at(usize::from(*count));
            rest = others;
            (*symbol, values)
        })
    }

    /// The sentence as text: `a(1,-2)b`.
    fn text(&self, cx: &Context<'_>) -> Result<String, Error> {
        let mut text = String::with_capacity(self.symbols.len() + 4 * self.values.len());
        for (i, (symbol, values)) in self.iter().enumerate() {
            if i % (1 << 14) == 0 {
                cx.check()?;
            }
            text.push(char::from(symbol));
            for (i, value) in values.iter().enumerate() {
                text.push(if i == 0 { '(' } else { ',' });
                text += &value.to_string();
            }
            if !values.is_empty() {
                text.push(')');
            }
        }
        Ok(text)
    }
}
