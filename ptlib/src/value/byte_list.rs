//! Lists of bytes as PT Designer writes them into one text: `0,255,-1, 7`.
//!
//! Specification 2.0, "byte list". Whole numbers modulo 256, separated by exactly one character
//! that is no blank; blanks around it do not count. So `1 2 3` is 1 and 3.

use std::{iter::Peekable, str::Chars};

/// A list has at most this many bytes; further ones are ignored.
pub const MAX_BYTES: usize = 256;

/// The bytes of a list. What is no number ends it, and so does the end of the text, also behind a
/// separator: PT Designer made up further bytes there (BUG of the specification).
#[must_use]
pub fn parse(text: &str) -> Vec<u8> {
    let mut rest = text.chars().peekable();
    let mut bytes = Vec::new();
    while bytes.len() < MAX_BYTES {
        let Some(byte) = number(&mut rest) else { break };
        bytes.push(byte);
        skip_blanks(&mut rest);
        rest.next();
    }
    bytes
}

/// The number at the start of `rest`, after blanks, modulo 256.
fn number(rest: &mut Peekable<Chars<'_>>) -> Option<u8> {
    skip_blanks(rest);
    let is_negative = rest.next_if(|sign| matches!(sign, '+' | '-')) == Some('-');
    let mut value = None;
    while let Some(digit) = rest.next_if(char::is_ascii_digit) {
        let so_far = value.unwrap_or(0_u8).wrapping_mul(10);
        value = Some(so_far.wrapping_add(u8::try_from(digit).map_or(0, |digit| digit - b'0')));
    }
    value.map(|value| if is_negative { value.wrapping_neg() } else { value })
}

fn skip_blanks(rest: &mut Peekable<Chars<'_>>) {
    while rest
        .next_if(|character| character.is_ascii_whitespace() || *character == '\x0b')
        .is_some()
    {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_separated_by_one_character() {
        for (text, expected) in [
            ("1,2,3", &[1, 2, 3][..]),
            (" 10 ;\n20\t/ 30 ", &[10, 20, 30]),
            ("1 2 3", &[1, 3]),
            ("5x6€7", &[5, 6, 7]),
            ("1-1", &[1, 1]),
            ("1.5", &[1, 5]),
        ] {
            assert_eq!(parse(text), expected, "{text:?}");
        }
    }

    #[test]
    fn numbers_count_modulo_256() {
        assert_eq!(parse("-1,+7,256,300,-300,99999999999999999999999999"), {
            let huge = 99_999_999_999_999_999_999_999_999_u128.to_le_bytes()[0];
            [255, 7, 0, 44, 212, huge]
        });
    }

    #[test]
    fn what_is_no_number_ends_the_list() {
        for (text, expected) in [
            ("", &[][..]),
            (" \n", &[]),
            (",", &[]),
            ("x,1", &[]),
            ("4,", &[4]),
            ("4, ", &[4]),
            ("4,,5", &[4]),
            ("4,-,5", &[4]),
            ("4,- 5", &[4]),
            ("4,x,5", &[4]),
        ] {
            assert_eq!(parse(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_list_has_at_most_256_bytes() {
        let text: String = (0..300).map(|i| format!("{i},")).collect();
        assert_eq!(parse(&text), (0..=255).collect::<Vec<u8>>());
    }
}
