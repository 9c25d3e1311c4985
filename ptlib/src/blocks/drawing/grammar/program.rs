//! Expressions and productions as steps of a stack machine.

/// An operator between two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    And,
    Or,
    Equal,
    Less,
    Greater,
}

impl Operator {
    /// The operator of that sign.
    pub(super) fn of(sign: u8) -> Option<Self> {
        Some(match sign {
            b'+' => Self::Add,
            b'-' => Self::Subtract,
            b'*' => Self::Multiply,
            b'/' => Self::Divide,
            b'&' => Self::And,
            b'|' => Self::Or,
            b'=' => Self::Equal,
            b'<' => Self::Less,
            b'>' => Self::Greater,
            _ => return None,
        })
    }

    fn apply(self, a: i32, b: i32) -> i32 {
        match self {
            Self::Add => a.wrapping_add(b),
            Self::Subtract => a.wrapping_sub(b),
            Self::Multiply => a.wrapping_mul(b),
            // The original crashes: BUG → 0.
            Self::Divide if b == 0 => 0,
            Self::Divide => a.wrapping_div(b),
            Self::And => i32::from(a != 0 && b != 0),
            Self::Or => i32::from(a != 0 || b != 0),
            Self::Equal => i32::from(a == b),
            Self::Less => i32::from(a < b),
            Self::Greater => i32::from(a > b),
        }
    }
}

/// One step. Operands come before what takes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// A number.
    Number(i32),
    /// A value of the symbol that is replaced, by its place.
    Value(u8),
    /// Two operands become one.
    Combine(Operator),
    /// A symbol of the production, with that many operands as its values.
    Produce(u8, u8),
}

/// The operands that wait. The reader of grammars makes sure that there are enough for each step.
#[derive(Debug, Default)]
pub(super) struct Machine {
    stack: Vec<i32>,
}

impl Machine {
    /// Takes one step of a rule that replaces a symbol with those values; `produce` takes symbols.
    #[inline]
    pub(super) fn take(&mut self, step: Step, values: &[i32], produce: impl FnOnce(u8, &[i32])) {
        match step {
            Step::Number(number) => self.stack.push(number),
            Step::Value(place) => {
                self.stack.push(values.get(usize::from(place)).copied().unwrap_or(0));
            }
            Step::Combine(operator) => {
                let (b, a) = (self.pop(), self.pop());
                self.stack.push(operator.apply(a, b));
            }
            Step::Produce(symbol, count) => {
                let first = self.stack.len().saturating_sub(usize::from(count));
                produce(symbol, &self.stack[first..]);
                self.stack.truncate(first);
            }
        }
    }

    /// The last operand.
    #[inline]
    pub(super) fn pop(&mut self) -> i32 {
        self.stack.pop().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_wraps_and_truncates() {
        let apply = |a, sign, b| Operator::of(sign).unwrap().apply(a, b);
        assert_eq!(apply(i32::MAX, b'+', 1), i32::MIN);
        assert_eq!(apply(i32::MIN, b'-', 1), i32::MAX);
        assert_eq!(apply(1 << 20, b'*', 1 << 12), 0);
        assert_eq!((apply(-7, b'/', 2), apply(7, b'/', 0)), (-3, 0));
        assert_eq!(apply(i32::MIN, b'/', -1), i32::MIN);
        assert_eq!((apply(2, b'&', -1), apply(2, b'&', 0)), (1, 0));
        assert_eq!((apply(0, b'|', -1), apply(0, b'|', 0)), (1, 0));
        assert_eq!((apply(3, b'=', 3), apply(3, b'=', 4)), (1, 0));
        assert_eq!((apply(3, b'<', 3), apply(3, b'<', 4)), (0, 1));
        assert_eq!((apply(3, b'>', 3), apply(4, b'>', 3)), (0, 1));
        assert!(b"!,:()[]{}x".iter().all(|sign| Operator::of(*sign).is_none()));
    }
}
