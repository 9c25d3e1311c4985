//! Words and tables in Markdown.

/// What is on top of each file that is written here.
pub(super) const NOTICE: &str =
    "<!-- Written by `cargo xtask docs`: change the block, not this. -->\n";

/// Words that Markdown shall show as they are; what stands in backticks stays code.
pub(super) fn escaped(words: &str) -> String {
    let mut text = String::new();
    let mut is_code = false;
    for character in words.chars() {
        is_code ^= character == '`';
        let is_mark = matches!(character, '<' | '>' | '[' | ']' | '*' | '_' | '\\');
        if character == '|' || (is_mark && !is_code) {
            text.push('\\');
        }
        text.push(character);
    }
    text
}

/// Text as code; an empty one as a dash.
pub(super) fn code(text: &str) -> String {
    if text.is_empty() { "–".to_owned() } else { format!("`{}`", text.replace('|', "\\|")) }
}

/// A table with a row of titles. Cells are Markdown already.
pub(super) fn table<const COLUMNS: usize>(
    titles: [&str; COLUMNS],
    rows: impl IntoIterator<Item = [String; COLUMNS]>,
) -> String {
    let mut text = format!("| {} |\n|{}\n", titles.join(" | "), "---|".repeat(COLUMNS));
    for row in rows {
        text.push_str(&format!("| {} |\n", row.join(" | ")));
    }
    text
}

/// A number: short, and exact for the numbers that people write.
pub(super) fn number(value: f64) -> String {
    format!("{value}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_escaped_outside_of_code() {
        assert_eq!(escaped("[x < 6] | `a_b` c_d"), r"\[x \< 6\] \| `a_b` c\_d");
        assert_eq!(code("a|b"), r"`a\|b`");
    }

    #[test]
    fn a_table_has_titles_and_rows() {
        let rows = [["1".to_owned(), "2".to_owned()]];
        assert_eq!(table(["a", "b"], rows), "| a | b |\n|---|---|\n| 1 | 2 |\n");
    }
}
