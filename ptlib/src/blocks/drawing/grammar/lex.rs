//! The tokens of one line of a grammar.

/// A token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Token {
    /// A letter or one of the signs that are symbols.
    Symbol(u8),
    /// A number; longer ones than 32 bits wrap.
    Number(i32),
    /// `->`.
    Arrow,
    /// A byte that no token has.
    Strange(u8),
}

/// A line that is being read from left to right.
#[derive(Debug, Clone)]
pub(super) struct Line<'a> {
    /// Its number in the file, from 1.
    pub(super) number: u32,
    text: &'a [u8],
    /// Where the next token starts, or blanks before it.
    at: usize,
}

impl<'a> Line<'a> {
    /// The line of that text. A carriage return at its end belongs to the line break (the original
    /// took no rule that had one).
    pub(super) fn new(number: u32, text: &'a [u8]) -> Self {
        Self { number, text: text.strip_suffix(b"\r").unwrap_or(text), at: 0 }
    }

    /// The next token, if there is one.
    pub(super) fn peek(&self) -> Option<Token> {
        self.clone().next()
    }

    /// Takes the next token.
    pub(super) fn next(&mut self) -> Option<Token> {
        self.skip_blanks();
        let rest = &self.text[self.at..];
        let (token, length) = match *rest.first()? {
            b'-' if rest.get(1) == Some(&b'>') => (Token::Arrow, 2),
            b'-' if rest.get(1).is_some_and(u8::is_ascii_digit) => number(rest, 1),
            byte if byte.is_ascii_digit() => number(rest, 0),
            byte if is_symbol(byte) => (Token::Symbol(byte), 1),
            byte => (Token::Strange(byte), 1),
        };
        self.at += length;
        Some(token)
    }

    /// Takes the next token if it is that symbol.
    pub(super) fn take(&mut self, symbol: u8) -> bool {
        let mut after = self.clone();
        let is_it = after.next() == Some(Token::Symbol(symbol));
        if is_it {
            *self = after;
        }
        is_it
    }

    /// The column of the next token, from 1, counted in characters.
    pub(super) fn column(&self) -> u32 {
        let mut line = self.clone();
        line.skip_blanks();
        let is_first_of_character = |byte: &&u8| **byte & 0xc0 != 0x80;
        let before = line.text[..line.at].iter().filter(is_first_of_character).count();
        u32::try_from(before + 1).unwrap_or(u32::MAX)
    }

    fn skip_blanks(&mut self) {
        self.at += self.text[self.at..].iter().take_while(|byte| **byte == b' ').count();
    }
}

/// The number that `text` starts with, behind `sign` bytes, and its length.
fn number(text: &[u8], sign: usize) -> (Token, usize) {
    let digits = text[sign..].iter().take_while(|byte| byte.is_ascii_digit());
    let (mut value, mut length) = (0_i32, sign);
    for digit in digits {
        value = value.wrapping_mul(10).wrapping_add(i32::from(digit - b'0'));
        length += 1;
    }
    (Token::Number(if sign == 0 { value } else { value.wrapping_neg() }), length)
}

/// Whether a byte is a symbol by itself.
fn is_symbol(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || b"&|!<>=+()[]{},:-*/".contains(&byte)
}

/// The next token in words.
pub(super) fn describe(token: Option<Token>) -> String {
    match token {
        None => "the line ends".to_owned(),
        Some(Token::Symbol(byte)) => format!("there is '{}'", char::from(byte)),
        Some(Token::Number(number)) => format!("there is the number {number}"),
        Some(Token::Arrow) => "there is \"->\"".to_owned(),
        Some(Token::Strange(b'\t')) => "there is a tab".to_owned(),
        Some(Token::Strange(byte)) if byte.is_ascii_graphic() => {
            format!("there is '{}'", char::from(byte))
        }
        Some(Token::Strange(_)) => "there is a character that no grammar has".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<Token> {
        let mut line = Line::new(1, text.as_bytes());
        std::iter::from_fn(|| line.next()).collect()
    }

    #[test]
    fn a_minus_before_a_digit_belongs_to_the_number() {
        use Token::{Arrow, Number, Symbol};
        assert_eq!(tokens("x -1"), [Symbol(b'x'), Number(-1)]);
        assert_eq!(tokens("x-1"), [Symbol(b'x'), Number(-1)]);
        assert_eq!(tokens("x - 1"), [Symbol(b'x'), Symbol(b'-'), Number(1)]);
        assert_eq!(tokens("x->-> - >"), [Symbol(b'x'), Arrow, Arrow, Symbol(b'-'), Symbol(b'>')]);
        assert_eq!(tokens("--12"), [Symbol(b'-'), Number(-12)]);
        assert_eq!(tokens("4294967297"), [Number(1)]);
    }

    #[test]
    fn everything_else_is_strange() {
        assert_eq!(tokens("\t.#"), [b'\t', b'.', b'#'].map(Token::Strange));
        assert_eq!(tokens("é").len(), 2);
        assert_eq!(tokens(" \r"), []);
        assert_eq!(tokens("\ra"), [Token::Strange(b'\r'), Token::Symbol(b'a')]);
    }

    #[test]
    fn columns_count_characters() {
        let mut line = Line::new(1, "é  a".as_bytes());
        assert_eq!(line.column(), 1);
        line.next();
        line.next();
        assert_eq!((line.column(), line.peek()), (4, Some(Token::Symbol(b'a'))));
        assert!(!line.take(b'b') && line.take(b'a') && !line.take(b'a'));
        assert_eq!(line.column(), 5);
    }
}
