//! A line of a file of muscles, read from left to right.

/// A line, and how far it is read. The comment at its end is cut off.
#[derive(Debug)]
pub(super) struct Line<'a> {
    bytes: &'a [u8],
    at: usize,
    number: usize,
}

impl<'a> Line<'a> {
    /// The line of that number, without its end.
    pub(super) fn new(bytes: &'a [u8], number: usize) -> Self {
        let end = bytes.iter().position(|byte| *byte == b'#').unwrap_or(bytes.len());
        Self { bytes: bytes.get(..end).unwrap_or_default(), at: 0, number }
    }

    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// The next byte.
    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// The line and the column of what comes next. Columns count characters, so that editors find
    /// them.
    pub(super) fn place(&self) -> [usize; 2] {
        let read = self.bytes.get(..self.at).unwrap_or_default();
        let is_start = |byte: &&u8| **byte & 0xc0 != 0x80;
        [self.number, 1 + read.iter().filter(is_start).count()]
    }

    /// Reads bytes as long as `is_wanted` says so.
    pub(super) fn take_while(&mut self, is_wanted: impl Fn(u8) -> bool) -> &'a [u8] {
        let rest = self.rest();
        let end = rest.iter().position(|byte| !is_wanted(*byte)).unwrap_or(rest.len());
        self.at += end;
        rest.get(..end).unwrap_or_default()
    }

    /// Reads blanks and tabs.
    pub(super) fn skip_blanks(&mut self) {
        self.take_while(is_blank);
    }

    /// Reads that byte and blanks before it, if it comes next.
    pub(super) fn take(&mut self, byte: u8) -> bool {
        let before = self.at;
        self.skip_blanks();
        let is_next = self.peek() == Some(byte);
        self.at = if is_next { self.at + 1 } else { before };
        is_next
    }

    /// Takes back the last `count` bytes.
    pub(super) fn step_back(&mut self, count: usize) {
        self.at = self.at.saturating_sub(count);
    }
}

/// Whether it separates words.
pub(super) fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte == b'\t'
}

/// How many bytes at the start of `piece` are a number: a sign, digits with a point among, before
/// or behind them, and an exponent; 0 if none.
pub(super) fn number_length(piece: &[u8]) -> usize {
    let byte = |at: usize| piece.get(at).copied().unwrap_or(b' ');
    let digits = |from: usize| {
        let rest = piece.get(from..).unwrap_or_default();
        rest.iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    let sign = usize::from(matches!(byte(0), b'+' | b'-'));
    let whole = digits(sign);
    let mut end = sign + whole;
    let point = if byte(end) == b'.' { 1 + digits(end + 1) } else { 0 };
    if whole == 0 && point < 2 {
        return 0;
    }
    end += point;
    if matches!(byte(end), b'e' | b'E') {
        let sign = usize::from(matches!(byte(end + 1), b'+' | b'-'));
        let exponent = digits(end + 1 + sign);
        end += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    end
}

/// The lines of a file, whose ends are LF, CR LF or CR.
pub(super) fn lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
            rest = None;
            return Some(text);
        };
        let (line, end) = text.split_at(end);
        let end_length = if end.starts_with(b"\r\n") { 2 } else { 1 };
        rest = end.get(end_length..);
        Some(line)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_long_as_the_grammar_says() {
        let numbers = ["1", "+1", "-1.", ".5", "-.5e3", "1E-2", "0012.50", "1e+10"];
        for number in numbers {
            assert_eq!(number_length(number.as_bytes()), number.len(), "{number}");
        }
        let others = [("", 0), (".", 0), ("+", 0), ("-.", 0), ("e5", 0), ("inf", 0), ("1e", 1)];
        for (piece, length) in others.into_iter().chain([("1e+", 1), ("1.2.3", 3), ("0,5", 1)]) {
            assert_eq!(number_length(piece.as_bytes()), length, "{piece}");
        }
    }

    #[test]
    fn lines_end_in_three_ways() {
        let read: Vec<&[u8]> = lines(b"a\nb\r\nc\rd\n\r").collect();
        assert_eq!(read, [b"a", b"b", b"c", b"d", &b""[..], b""]);
        assert_eq!(lines(b"").count(), 1);
    }

    #[test]
    fn columns_count_characters() {
        let mut line = Line::new("ěš x # y".as_bytes(), 7);
        line.take_while(|byte| byte != b' ');
        assert!(line.take(b'x') && !line.take(b'#'));
        assert_eq!(line.place(), [7, 5]);
    }
}
