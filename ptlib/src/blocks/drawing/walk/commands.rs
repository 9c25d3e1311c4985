//! The commands of a text: symbols with numbers in brackets.

/// The most values that a command takes; further ones are ignored.
const MAX_VALUES: usize = 3;

/// A symbol of the text and its first values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Command {
    /// The symbol; a byte of it if it is a character of several.
    pub(super) letter: u8,
    values: [i64; MAX_VALUES],
    count: usize,
}

impl Command {
    /// Its values, each in 32 bits.
    pub(super) fn values(&self) -> &[i64] {
        &self.values[..self.count]
    }
}

/// A text that is being read.
#[derive(Debug, Clone)]
pub(super) struct Commands<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Commands<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text: text.as_bytes(), at: 0 }
    }

    /// Bytes read.
    pub(super) fn place(&self) -> usize {
        self.at
    }

    /// How much has been read, 0..1.
    #[expect(clippy::cast_precision_loss, reason = "for people who watch it")]
    pub(super) fn fraction_done(&self) -> f64 {
        self.at as f64 / self.text.len().max(1) as f64
    }

    /// The next command. A list of values that is none counts as further symbols: they do nothing.
    pub(super) fn next(&mut self) -> Option<Command> {
        let letter = *self.text.get(self.at)?;
        self.at += 1;
        let mut command = Command { letter, values: [0; MAX_VALUES], count: 0 };
        if self.text.get(self.at) == Some(&b'(') {
            let (mut values, mut count, mut at) = ([0; MAX_VALUES], 0, self.at);
            loop {
                let Some((value, end)) = self.number(at + 1) else { return Some(command) };
                if count < MAX_VALUES {
                    values[count] = value;
                    count += 1;
                }
                at = end;
                match self.text.get(at) {
                    Some(b',') => {}
                    Some(b')') => break,
                    _ => return Some(command),
                }
            }
            (command.values, command.count, self.at) = (values, count, at + 1);
        }
        Some(command)
    }

    /// The number at a place and where it ends. Longer ones than 32 bits wrap.
    fn number(&self, at: usize) -> Option<(i64, usize)> {
        let is_negative = self.text.get(at) == Some(&b'-');
        let start = at + usize::from(is_negative);
        let digits = self.text.get(start..)?.iter().take_while(|byte| byte.is_ascii_digit());
        let (mut value, mut end) = (0_i32, start);
        for digit in digits {
            value = value.wrapping_mul(10).wrapping_add(i32::from(digit - b'0'));
            end += 1;
        }
        let value = if is_negative { value.wrapping_neg() } else { value };
        (end > start).then_some((i64::from(value), end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<(char, Vec<i64>)> {
        let mut commands = Commands::new(text);
        let next = || commands.next().map(|c| (char::from(c.letter), c.values().to_vec()));
        std::iter::from_fn(next).collect()
    }

    #[test]
    fn symbols_have_values() {
        assert_eq!(
            all("DA(-7)C(1,2,3,4,5)["),
            [('D', vec![]), ('A', vec![-7]), ('C', vec![1, 2, 3]), ('[', vec![])]
        );
        assert_eq!(all("M(2147483648)"), [('M', vec![-2_147_483_648])]);
    }

    #[test]
    fn what_is_no_list_is_ignored() {
        for text in ["D(", "D()", "D(1", "D(1,", "D(1,)", "D(x)", "D(-)", "D( 1)", "D(1.5)", "D(1("]
        {
            let commands = all(text);
            assert_eq!(commands[0], ('D', vec![]), "{text}");
            assert!(commands[1..].iter().all(|(letter, _)| *letter != 'D'), "{text}");
        }
        assert_eq!(all("é").len(), 2);
    }

    #[test]
    fn long_lists_are_read_once() {
        let text = "D(1".repeat(200_000);
        assert_eq!(all(&text).iter().filter(|(letter, _)| *letter == 'D').count(), 200_000);
        let text = format!("D{}", "(1,1".repeat(200_000));
        assert_eq!(all(&text)[0], ('D', vec![]));
    }
}
