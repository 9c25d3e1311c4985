//! Carrying out a grammar: specification 2.44, "Rewriting".

use std::ops::Range;

use super::{Grammar, Rule, Sentence, key, program::Machine};
use crate::block::prelude::*;

/// Steps of rewriting for each symbol that a sentence may have: a sentence that grows to its limit
/// takes a few, one that stays long for ever would take any number of them.
const STEPS_PER_SYMBOL: u64 = 64;

/// Steps between two questions whether to go on.
const STEPS_PER_CHECK: u64 = 1 << 14;

/// What to do about a limit.
pub(super) const HINT: &str =
    "the caller can raise the limit of the symbols of a text: `Limits` in `EngineOptions`";

#[expect(clippy::cast_precision_loss, reason = "sums of weights")]
fn as_number(weight: i64) -> f64 {
    weight as f64
}

/// One computation.
struct Rewriting<'a> {
    grammar: &'a Grammar,
    cx: &'a Context<'a>,
    draws: elias::Draws,
    is_eight_bit: bool,
    /// Whether the present iteration drew a number.
    has_drawn: bool,
    machine: Machine,
    /// The rules that may replace the present symbol.
    applicable: Vec<Rule>,
    steps: u64,
    next_check: u64,
}

impl Grammar {
    /// The text of the axiom after so many iterations, or after fewer if nothing changes any more.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`] for a sentence that grows too long or takes too many steps.
    pub(in super::super) fn rewrite<L: Levels>(
        &self,
        iterations: u32,
        cx: &Context<'_>,
    ) -> Result<String, Error> {
        let mut rewriting = Rewriting {
            grammar: self,
            cx,
            draws: elias::Draws::from_index(cx.seed32()),
            is_eight_bit: L::EIGHT_BIT,
            has_drawn: false,
            machine: Machine::default(),
            applicable: Vec::new(),
            steps: 0,
            next_check: 0,
        };
        let mut sentences = [Sentence::default(), Sentence::default()];
        let [next, spare] = &mut sentences;
        let mut present = &self.axiom;
        let (mut next, mut spare) = (next, spare);
        for i in 0..iterations {
            next.clear();
            let has_changed = rewriting.iterate(present, next).map_err(|error| {
                let message =
                    format!("in iteration {} of {iterations}, {}", i + 1, error.message());
                match error.kind() {
                    ErrorKind::Limit => Error::new(ErrorKind::Limit, message).with_hint(HINT),
                    _ => error,
                }
            })?;
            // Without a draw, equal sentences stay equal for ever.
            let is_settled = !rewriting.has_drawn && present == next;
            std::mem::swap(&mut next, &mut spare);
            present = spare;
            if !has_changed || is_settled {
                break;
            }
            cx.report(f64::from(i + 1) / f64::from(iterations));
        }
        present.text(cx)
    }
}

impl Rewriting<'_> {
    /// Replaces all symbols of a sentence; whether a rule did.
    fn iterate(&mut self, from: &Sentence, to: &mut Sentence) -> Result<bool, Error> {
        let mut has_changed = false;
        self.has_drawn = false;
        for (symbol, values) in from.iter() {
            self.spend(1)?;
            match self.rule_for(symbol, values)? {
                Some(rule) => {
                    has_changed = true;
                    self.produce(rule, values, to)?;
                }
                None => {
                    to.push(symbol, values);
                    self.check_length(to)?;
                }
            }
        }
        Ok(has_changed)
    }

    /// The rule that replaces a symbol, if any does.
    fn rule_for(&mut self, symbol: u8, values: &[i32]) -> Result<Option<Rule>, Error> {
        let key = key(symbol, u8::try_from(values.len()).unwrap_or(u8::MAX));
        let grammar = self.grammar;
        self.applicable.clear();
        for rule in &grammar.rules[grammar.starts[key]..grammar.starts[key + 1]] {
            let condition = rule.condition..rule.production;
            let applies = condition.is_empty() || {
                self.run(condition, values, None)?;
                self.machine.pop() != 0
            };
            self.spend(1)?;
            if applies {
                self.applicable.push(*rule);
            }
        }
        Ok(if self.applicable.len() > 1 { self.draw() } else { self.applicable.first().copied() })
    }

    /// One of the applicable rules, by weight.
    fn draw(&mut self) -> Option<Rule> {
        self.has_drawn = true;
        let total: i64 = self.applicable.iter().map(|rule| i64::from(rule.weight)).sum();
        // 0 < threshold ≤ total. The original draws one of 1..=total, whose ends have half the
        // weight: Q in 8-bit precision, where files look as their authors saw them. In float
        // precision → in proportion to the weights.
        let threshold = if self.is_eight_bit {
            as_number(self.draws.next_integer(1, total))
        } else {
            f64::midpoint(self.draws.next_noise(), 1.0) * as_number(total)
        };
        let mut sum = 0.0;
        let reached = |rule: &&Rule| {
            sum += f64::from(rule.weight);
            sum >= threshold
        };
        self.applicable.iter().find(reached).or(self.applicable.first()).copied()
    }

    fn produce(&mut self, rule: Rule, values: &[i32], to: &mut Sentence) -> Result<(), Error> {
        self.run(rule.production..rule.end, values, Some(to))
    }

    /// Takes steps of the grammar's. Symbols go to the sentence `to`; conditions have none.
    fn run(
        &mut self,
        range: Range<u32>,
        values: &[i32],
        mut to: Option<&mut Sentence>,
    ) -> Result<(), Error> {
        let grammar = self.grammar;
        let steps = &grammar.steps[range.start as usize..range.end as usize];
        for piece in steps.chunks(1024) {
            self.spend(piece.len() as u64)?;
            for step in piece {
                self.machine.take(*step, values, |symbol, values| {
                    if let Some(to) = &mut to {
                        to.push(symbol, values);
                    }
                });
            }
            if let Some(to) = &to {
                self.check_length(to)?;
            }
        }
        Ok(())
    }

    fn check_length(&self, sentence: &Sentence) -> Result<(), Error> {
        let limit = self.cx.max_text_symbols();
        if sentence.len() <= limit {
            return Ok(());
        }
        let message = format!("the text grows beyond {limit} symbols and values");
        Err(Error::new(ErrorKind::Limit, message))
    }

    /// Counts steps.
    fn spend(&mut self, steps: u64) -> Result<(), Error> {
        self.steps += steps;
        if self.steps < self.next_check {
            return Ok(());
        }
        self.next_check = self.steps + STEPS_PER_CHECK;
        self.cx.check()?;
        let limit = self.cx.max_text_symbols().saturating_mul(STEPS_PER_SYMBOL);
        if self.steps <= limit {
            return Ok(());
        }
        let message = format!("rewriting has taken {limit} steps and is not done");
        Err(Error::new(ErrorKind::Limit, message))
    }
}
