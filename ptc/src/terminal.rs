//! What people see: colours, widths, and texts from files of strangers made harmless.

use std::{
    fmt,
    io::{self, IsTerminal as _, StdoutLock, Write},
};

use anstream::AutoStream;
use anstyle::{AnsiColor, Style};
use serde::Serialize;

use crate::finding::Severity;

const BOLD: Style = Style::new().bold();
const RED: Style = AnsiColor::Red.on_default().bold();
const YELLOW: Style = AnsiColor::Yellow.on_default().bold();

/// Where a text is not shown on a terminal, its lines have this many columns.
const COLUMNS_ELSEWHERE: usize = 80;
/// Longer lines are hard to read, however wide the terminal is.
const MOST_COLUMNS: usize = 100;

/// Standard output; colours reach it only if it is a terminal that wants them.
pub(crate) fn stdout() -> AutoStream<StdoutLock<'static>> {
    AutoStream::auto(io::stdout().lock())
}

/// Writes a value as JSON, and ends its line.
pub(crate) fn write_json(out: &mut impl Write, value: &impl Serialize) -> io::Result<()> {
    let text = serde_json::to_string_pretty(value)?;
    writeln!(out, "{text}")
}

/// Shows an error: one line on standard error.
pub(crate) fn error(text: &str) {
    label(RED, "error", text);
}

/// Shows a warning: one line on standard error.
pub(crate) fn warning(text: &str) {
    label(YELLOW, "warning", text);
}

/// Shows what was done: one line on standard error.
pub(crate) fn note(text: &str) {
    complain(format_args!("ptc: {}", Printable(text)));
}

fn label(style: Style, word: &str, text: &str) {
    complain(format_args!("{BOLD}ptc:{BOLD:#} {style}{word}:{style:#} {}", Printable(text)));
}

/// When standard error is closed there is nobody left to tell.
fn complain(line: fmt::Arguments<'_>) {
    let _ = writeln!(AutoStream::auto(io::stderr().lock()), "{line}");
}

/// The style of headings and ids.
pub(crate) fn heading() -> Style {
    BOLD
}

/// The style of a severity's word.
pub(crate) fn severity_style(severity: Severity) -> Style {
    match severity {
        Severity::Error => RED,
        Severity::Warning => YELLOW,
    }
}

/// The columns that a text on standard output may take.
pub(crate) fn columns() -> usize {
    let terminal = if io::stdout().is_terminal() { terminal_size::terminal_size() } else { None };
    terminal.map_or(COLUMNS_ELSEWHERE, |(width, _)| usize::from(width.0).min(MOST_COLUMNS))
}

/// Whether progress can be shown: on a terminal that can move its cursor.
pub(crate) fn shows_progress() -> bool {
    io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// A text in which control characters are written out. File names and graph files are not
/// trusted: printed as they are, they could move the cursor, start a line, or reverse the
/// direction of writing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Printable<'a>(pub(crate) &'a str);

impl fmt::Display for Printable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for character in self.0.chars() {
            if is_harmless(character) {
                write!(f, "{character}")?;
            } else {
                write!(f, "{}", character.escape_default())?;
            }
        }
        Ok(())
    }
}

fn is_harmless(character: char) -> bool {
    let reverses = matches!(character, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}');
    !character.is_control() && !reverses
}

/// `1 file`, `2 files`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// The lines of a text of at most `columns` columns. A longer word has a line of its own.
pub(crate) fn wrap(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut free = 0;
    for word in text.split_whitespace() {
        let width = word.chars().count();
        match lines.last_mut() {
            Some(line) if width < free => {
                line.push(' ');
                line.push_str(word);
                free -= width + 1;
            }
            _ => {
                lines.push(word.to_owned());
                free = columns.saturating_sub(width);
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out() {
        let text = Printable("a\u{1b}[2J\nb\u{202e}ß – 纹理").to_string();
        assert_eq!(text, "a\\u{1b}[2J\\nb\\u{202e}ß – 纹理");
    }

    #[test]
    fn lines_are_as_long_as_they_may_be_and_no_longer() {
        assert_eq!(wrap("ab cd ef", 5), ["ab cd", "ef"]);
        assert_eq!(wrap("ab cd ef", 8), ["ab cd ef"]);
        assert_eq!(wrap("ab  incomprehensible\ncd", 5), ["ab", "incomprehensible", "cd"]);
        assert_eq!(wrap(" ", 5), [""; 0]);
    }
}
