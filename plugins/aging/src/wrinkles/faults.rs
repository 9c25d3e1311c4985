//! Faults of a file of muscles: where they are, and what would be right.

use std::fmt;

/// The most faults that are kept; others are counted.
const KEPT: usize = 1000;

/// The most faults that a message shows.
const SHOWN: usize = 20;

/// The longest piece of a file that a message quotes, in characters.
const QUOTED: usize = 24;

/// A fault of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The line, from 1.
    pub line: usize,
    /// The character in the line, from 1.
    pub column: usize,
    /// What is wrong, and what is allowed.
    pub what: String,
}

/// All faults of a file, in its order. Displayed, the first of them stand one behind the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faults {
    list: Vec<Fault>,
    count: usize,
    is_limit: bool,
}

impl Faults {
    /// The faults, the first thousand of them.
    #[must_use]
    pub fn list(&self) -> &[Fault] {
        &self.list
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether something is larger than allowed.
    #[must_use]
    pub fn is_limit(&self) -> bool {
        self.is_limit
    }

    pub(super) fn add(&mut self, [line, column]: [usize; 2], what: String) {
        self.count += 1;
        if self.list.len() < KEPT {
            self.list.push(Fault { line, column, what });
        }
    }

    pub(super) fn add_limit(&mut self, place: [usize; 2], what: String) {
        self.is_limit = true;
        self.add(place, what);
    }

    /// In the order of the file: what a muscle lacks is only known at its end.
    pub(super) fn sort(&mut self) {
        self.list.sort_by_key(|fault| [fault.line, fault.column]);
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.count > 1 {
            write!(f, "{} faults: ", self.count)?;
        }
        for (number, Fault { line, column, what }) in self.list.iter().take(SHOWN).enumerate() {
            let before = if number == 0 { "" } else { "; " };
            write!(f, "{before}{line}:{column}: {what}")?;
        }
        if self.count > SHOWN {
            write!(f, "; and {} more", self.count - SHOWN)?;
        }
        Ok(())
    }
}

/// A piece of a file as messages show it: shortened, and without characters that nobody sees.
pub(super) fn quoted(piece: &[u8]) -> String {
    // Enough bytes for all characters that are shown.
    let start = piece.get(..QUOTED * 4).unwrap_or(piece);
    let text = String::from_utf8_lossy(start);
    let mut shown: String = text.chars().take(QUOTED).flat_map(char::escape_debug).collect();
    if text.chars().count() > QUOTED || start.len() < piece.len() {
        shown.push('…');
    }
    format!("`{shown}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_faults_make_a_short_message() {
        let mut faults = Faults::default();
        for line in (1..=1_000_000).rev() {
            faults.add([line, 1], "bad".to_owned());
        }
        assert_eq!((faults.count(), faults.list().len()), (1_000_000, KEPT));
        faults.sort();
        let message = faults.to_string();
        assert!(message.starts_with("1000000 faults: 999001:1: bad; 999002:1: bad; "), "{message}");
        assert!(message.ends_with("; and 999980 more") && message.len() < 1000, "{message}");
    }

    #[test]
    fn pieces_are_shortened_and_made_visible() {
        assert_eq!(quoted(b"a\tb"), "`a\\tb`");
        assert_eq!(quoted(&[b'x'; 25]), format!("`{}…`", "x".repeat(24)));
        assert_eq!(quoted(&[b'x'; 24]), format!("`{}`", "x".repeat(24)));
        assert_eq!(quoted(b"\xff"), "`\u{fffd}`");
    }
}
