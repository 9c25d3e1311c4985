//! Decimal numbers at the start of a text, as the text parameters of PT Designer have them.

/// The decimal number that `text` begins with, after blanks, and what follows it. Infinite if it
/// is too large.
#[must_use]
pub fn prefix(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_start();
    let digits = |from: usize| from + text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let sign = usize::from(text.starts_with(['+', '-']));
    let mut end = digits(sign);
    if text[end..].starts_with('.') {
        end = digits(end + 1);
    }
    if let Some(rest) = text[end..].strip_prefix(['e', 'E']) {
        let start = end + 1 + usize::from(rest.starts_with(['+', '-']));
        if digits(start) > start {
            end = digits(start);
        }
    }
    Some((text[..end].parse().ok()?, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_much_as_is_a_number() {
        for (text, number, rest) in [
            ("12 3", 12.0, " 3"),
            (" \t-2.5e-1x", -0.25, "x"),
            (".5.5", 0.5, ".5"),
            ("1e+", 1.0, "e+"),
            ("1-2", 1.0, "-2"),
            ("7é", 7.0, "é"),
        ] {
            assert_eq!(prefix(text), Some((number, rest)), "{text:?}");
        }
        assert_eq!(prefix("1e999"), Some((f64::INFINITY, "")));
        for text in ["", " ", "x1", ".", "-", "e5", "inf", "nan"] {
            assert_eq!(prefix(text), None, "{text:?}");
        }
    }
}
