//! Reading a grammar: specification 2.44, "File", "Lexis" and the syntax behind it.
//!
//! Line 1 is the axiom, every later one a rule. PT Designer ignored invalid rules and took 0 for
//! invalid expressions; both still hold, but users are warned. An invalid axiom is an error.

use super::{
    Grammar, KEYS, MAX_VALUES, Rule, Sentence, key,
    lex::{Line, Token, describe},
    program::{Operator, Step},
};
use crate::block::prelude::*;

/// Warnings of one file; further ones are only counted.
const MAX_WARNINGS: usize = 10;

/// A fault at the next token of a line.
fn fault(line: &Line<'_>, message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Parse, message).at_position(line.number, line.column())
}

/// The next token is not what has to come.
fn unexpected(line: &Line<'_>, wanted: &str) -> Error {
    fault(line, format!("{}, where {wanted} has to come", describe(line.peek())))
}

impl Grammar {
    /// The grammar of a file.
    ///
    /// # Errors
    /// [`ErrorKind::Parse`] for an axiom that is none; [`ErrorKind::Limit`] for a larger file than
    /// the symbols of a sentence allow.
    pub(in super::super) fn read(bytes: &[u8], cx: &Context<'_>) -> Result<Self, Error> {
        let limit = cx.max_text_symbols().min(u64::from(u32::MAX));
        if bytes.len() as u64 > limit {
            let message = format!("the grammar has {} bytes, allowed {limit}", bytes.len());
            return Err(Error::new(ErrorKind::Limit, message).with_hint(super::rewrite::HINT));
        }
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut lines = (1..).zip(bytes.split(|byte| *byte == b'\n'));
        let mut reader = Reader { steps: Vec::new(), cx, warnings: 0 };
        let first = lines.next().map_or(&b""[..], |(_, text)| text);
        let axiom = axiom(Line::new(1, first))?;
        let mut rules = Vec::new();
        for (number, text) in lines {
            if number % (1 << 12) == 0 {
                cx.check()?;
            }
            let line = Line::new(number, text);
            if line.peek().is_none() {
                continue;
            }
            let start = reader.steps.len();
            match reader.rule(line) {
                Ok(rule) => rules.push(rule),
                Err(error) if error.kind() == ErrorKind::Parse => {
                    reader.steps.truncate(start);
                    reader.warn(|| error.with_hint("the rule is ignored"));
                }
                Err(error) => return Err(error),
            }
        }
        reader.warn_of_others();
        // Stable: the rules of a key stay in the order of the file.
        rules.sort_by_key(|rule: &Rule| key(rule.symbol, rule.values));
        let place = |wanted| rules.partition_point(|rule| key(rule.symbol, rule.values) < wanted);
        let starts = (0..=KEYS).map(place).collect();
        Ok(Self { axiom, rules, starts, steps: reader.steps })
    }
}

/// `{ symbol [ "(" number { "," number } ")" ] }`. The original lost the values of the last symbol:
/// BUG → kept.
fn axiom(mut line: Line<'_>) -> Result<Sentence, Error> {
    let mut sentence = Sentence::default();
    while line.peek().is_some() {
        let symbol = symbol(&mut line)?;
        let mut values = Vec::new();
        if line.take(b'(') {
            loop {
                check_count(&line, values.len())?;
                let Some(Token::Number(number)) = line.peek() else {
                    return Err(unexpected(&line, "a number of the axiom"));
                };
                line.next();
                values.push(number);
                if ends_list(&mut line)? {
                    break;
                }
            }
        }
        sentence.push(symbol, &values);
    }
    Ok(sentence)
}

fn symbol(line: &mut Line<'_>) -> Result<u8, Error> {
    match line.peek() {
        Some(Token::Symbol(symbol)) => {
            line.next();
            Ok(symbol)
        }
        _ => Err(unexpected(line, "a symbol")),
    }
}

/// Takes the `,` or `)` behind an item of a list; whether the list ends there.
fn ends_list(line: &mut Line<'_>) -> Result<bool, Error> {
    if line.take(b',') {
        Ok(false)
    } else if line.take(b')') {
        Ok(true)
    } else {
        Err(unexpected(line, "',' or ')'"))
    }
}

/// Refuses one more value of a symbol that has `count` already. The original took them and
/// corrupted its memory.
fn check_count(line: &Line<'_>, count: usize) -> Result<(), Error> {
    if count < MAX_VALUES {
        return Ok(());
    }
    Err(fault(line, format!("a symbol has at most {MAX_VALUES} values")))
}

/// Reads rules. `'c` is the context, which takes the warnings.
struct Reader<'c> {
    steps: Vec<Step>,
    cx: &'c Context<'c>,
    warnings: usize,
}

/// What comes next in an expression, `operand [ operator operand ]`, on one level of brackets.
#[derive(Debug, Clone, Copy)]
enum Next {
    First,
    Operator,
    Second(Operator),
    End,
}

impl Reader<'_> {
    /// Warns of a fault. To find its column takes time, so that is left for the few that are told.
    fn warn(&mut self, fault: impl FnOnce() -> Error) {
        if self.warnings < MAX_WARNINGS {
            self.cx.warn(fault().at_parameter("path"));
        }
        self.warnings += 1;
    }

    fn warn_of_others(&self) {
        if self.warnings > MAX_WARNINGS {
            let message = format!("{} more faults like that", self.warnings - MAX_WARNINGS);
            self.cx.warn(Error::new(ErrorKind::Parse, message).at_parameter("path"));
        }
    }

    /// `symbol [ "(" names ")" [ "[" condition "]" ] ] [ ":" number ] "->" production`
    fn rule(&mut self, mut line: Line<'_>) -> Result<Rule, Error> {
        let symbol = symbol(&mut line)?;
        let condition = self.place();
        let mut names = Vec::new();
        if line.take(b'(') {
            loop {
                check_count(&line, names.len())?;
                match line.peek() {
                    Some(Token::Symbol(name)) if name.is_ascii_alphabetic() => names.push(name),
                    _ => return Err(unexpected(&line, "the name of a value")),
                }
                line.next();
                if ends_list(&mut line)? {
                    break;
                }
            }
            if line.take(b'[') {
                self.expression(&mut line, &names, b"]")?;
                line.next();
            }
        }
        let weight = if line.take(b':') { weight(&mut line)? } else { 1 };
        if line.peek() != Some(Token::Arrow) {
            return Err(unexpected(&line, "\"->\""));
        }
        line.next();
        let production = self.place();
        while line.peek().is_some() {
            self.product(&mut line, &names)?;
            if self.steps.len().is_multiple_of(1 << 12) {
                self.cx.check()?;
            }
        }
        let values = u8::try_from(names.len()).unwrap_or(u8::MAX);
        Ok(Rule { symbol, values, weight, condition, production, end: self.place() })
    }

    /// Where the next step goes. There are fewer of them than bytes in the file.
    fn place(&self) -> u32 {
        u32::try_from(self.steps.len()).unwrap_or(u32::MAX)
    }

    /// `symbol [ "(" expression { "," expression } ")" ]`
    fn product(&mut self, line: &mut Line<'_>, names: &[u8]) -> Result<(), Error> {
        let symbol = symbol(line)?;
        let mut count = 0;
        if line.take(b'(') {
            loop {
                check_count(line, usize::from(count))?;
                self.expression(line, names, b",)")?;
                count += 1;
                if ends_list(line)? {
                    break;
                }
            }
        }
        self.steps.push(Step::Produce(symbol, count));
        Ok(())
    }

    /// Reads an expression up to one of the symbols `ends`, which is left. What is no expression
    /// counts as 0, with a warning; only if there is no end, the rule is invalid.
    fn expression(&mut self, line: &mut Line<'_>, names: &[u8], ends: &[u8]) -> Result<(), Error> {
        let first_step = self.steps.len();
        // One entry for each open bracket and the expression itself, so that no nesting recurses.
        let mut levels = vec![Next::First];
        let mut wrong = None;
        loop {
            let Some(token) = line.peek() else {
                return Err(unexpected(line, &format!("'{}'", char::from(ends[0]))));
            };
            // A condition ends at the first ']', whatever is open.
            let may_end = levels.len() == 1 || ends == b"]";
            let is_end = matches!(token, Token::Symbol(symbol) if ends.contains(&symbol));
            let is_right = if is_end && may_end {
                levels.len() == 1 && matches!(levels[0], Next::Operator | Next::End)
            } else {
                self.token(token, names, &mut levels)
            };
            if !is_right && wrong.is_none() {
                wrong = Some((line.clone(), wanted(levels.last())));
            }
            if is_end && may_end {
                break;
            }
            line.next();
        }
        if let Some((line, wanted)) = wrong {
            self.steps.truncate(first_step);
            self.steps.push(Step::Number(0));
            self.warn(|| unexpected(&line, wanted).with_hint("the expression counts as 0"));
        }
        Ok(())
    }

    /// Takes a token of an expression that is not its end; whether it fits. Brackets are counted
    /// in any case.
    fn token(&mut self, token: Token, names: &[u8], levels: &mut Vec<Next>) -> bool {
        let next = levels.last().copied().unwrap_or(Next::End);
        let wants_operand = matches!(next, Next::First | Next::Second(_));
        match token {
            Token::Symbol(b'(') => levels.push(Next::First),
            Token::Symbol(b')') if levels.len() > 1 => {
                levels.pop();
                self.operand(levels);
                return matches!(next, Next::Operator | Next::End);
            }
            Token::Number(number) => {
                self.steps.push(Step::Number(number));
                self.operand(levels);
            }
            Token::Symbol(symbol) if wants_operand => {
                let place = names.iter().zip(0..).find(|(name, _)| **name == symbol);
                let Some((_, place)) = place else { return false };
                self.steps.push(Step::Value(place));
                self.operand(levels);
            }
            Token::Symbol(symbol) => {
                let operator = Operator::of(symbol).filter(|_| matches!(next, Next::Operator));
                let Some((operator, level)) = operator.zip(levels.last_mut()) else {
                    return false;
                };
                *level = Next::Second(operator);
                return true;
            }
            Token::Arrow | Token::Strange(_) => return false,
        }
        wants_operand
    }

    /// Goes on behind an operand.
    fn operand(&mut self, levels: &mut [Next]) {
        let Some(level) = levels.last_mut() else { return };
        *level = match *level {
            Next::Second(operator) => {
                self.steps.push(Step::Combine(operator));
                Next::End
            }
            Next::First => Next::Operator,
            other => other,
        };
    }
}

/// What has to come next in an expression, in words.
fn wanted(next: Option<&Next>) -> &'static str {
    match next {
        Some(Next::First | Next::Second(_)) => "a number, a value's name or '('",
        Some(Next::Operator) => "an operator or the end of the expression",
        _ => "the end of the expression (there is one operator for each pair of brackets)",
    }
}

/// The number behind `:`; reduced to 0..255 as the original does.
fn weight(line: &mut Line<'_>) -> Result<u8, Error> {
    let Some(Token::Number(weight)) = line.peek() else {
        return Err(unexpected(line, "a weight"));
    };
    line.next();
    Ok(weight.to_le_bytes()[0])
}
