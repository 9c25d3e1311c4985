//! A Rust source file, as far as the checks need to understand it.

use std::ops::Range;

/// A Rust source file.
pub(super) struct Source {
    /// Where it is, relative to the repository, with forward slashes.
    pub(super) path: String,
    /// Its text with the contents of comments, strings and characters replaced by blanks: every
    /// byte is where it was.
    pub(super) code: String,
    /// The parts of the text under `#[cfg(test)]`.
    tests: Vec<Range<usize>>,
}

impl Source {
    pub(super) fn new(path: &str, text: &str) -> Self {
        let code = blank(text);
        let tests = test_parts(&code);
        Self { path: path.to_owned(), code, tests }
    }

    /// The line, from 1, of a place in the text.
    pub(super) fn line(&self, at: usize) -> usize {
        self.code.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1
    }

    /// Whether a place in the text is under `#[cfg(test)]`, or the file is one of tests.
    pub(super) fn is_test(&self, at: usize) -> bool {
        let is_file_of_tests = self.path.split(['/', '.']).any(|part| part == "tests");
        is_file_of_tests || self.tests.iter().any(|part| part.contains(&at))
    }

    /// The number of lines that are not under `#[cfg(test)]`.
    pub(super) fn lines_without_tests(&self) -> usize {
        let tests = self.tests.iter().map(|part| self.code[part.clone()].lines().count());
        self.code.lines().count() - tests.sum::<usize>()
    }

    /// The places of a word in the code.
    pub(super) fn words(&self, word: &str) -> Vec<usize> {
        words(&self.code, word)
    }
}

/// The places of a whole word.
pub(super) fn words(text: &str, word: &str) -> Vec<usize> {
    let is_part = |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
    let bytes = text.as_bytes();
    text.match_indices(word)
        .map(|(at, _)| at)
        .filter(|&at| {
            !is_part(at.checked_sub(1).and_then(|before| bytes.get(before)))
                && !is_part(bytes.get(at + word.len()))
        })
        .collect()
}

/// The place of the bracket that closes the one at `open`; the end of the text if none does.
pub(super) fn closing(code: &str, open: usize) -> usize {
    let mut depth = 0_usize;
    for (at, byte) in code.bytes().enumerate().skip(open) {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return at;
                }
            }
            _ => {}
        }
    }
    code.len()
}

fn test_parts(code: &str) -> Vec<Range<usize>> {
    let mut parts: Vec<Range<usize>> = Vec::new();
    for (start, _) in code.match_indices("#[cfg(test)]") {
        if parts.last().is_some_and(|part| part.contains(&start)) {
            continue;
        }
        let Some(offset) = code[start..].find(['{', ';']) else { continue };
        let end = start + offset;
        let is_body = code.as_bytes()[end] == b'{';
        parts.push(start..if is_body { closing(code, end) + 1 } else { end + 1 });
    }
    parts
}

/// Replaces what comments, strings and characters contain.
fn blank(text: &str) -> String {
    let mut code = text.as_bytes().to_vec();
    let mut at = 0;
    while at < code.len() {
        let end = token_end(&text.as_bytes()[at..], at.checked_sub(1).map(|i| code[i])) + at;
        if end == at {
            at += 1;
            continue;
        }
        for byte in &mut code[at..end] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
        at = end;
    }
    String::from_utf8_lossy(&code).into_owned()
}

/// The length of the comment, string or character that starts here; 0 if none does.
fn token_end(rest: &[u8], before: Option<u8>) -> usize {
    let in_word = before.is_some_and(|b| b.is_ascii_alphanumeric() || b == b'_');
    match rest {
        [b'/', b'/', ..] => rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len()),
        [b'/', b'*', ..] => block_comment(rest),
        [b'"', ..] => quoted(rest, b'"'),
        [b'r', b'"' | b'#', ..] | [b'b' | b'c', b'r', b'"' | b'#', ..] if !in_word => raw(rest),
        [b'\'', b'\\', ..] => quoted(rest, b'\''),
        [b'\'', _, b'\'', ..] => 3,
        // A character of several bytes, unlike a lifetime, ends in a quote after them.
        [b'\'', first, ..] if *first >= 0x80 => quoted(rest, b'\''),
        _ => 0,
    }
}

fn block_comment(rest: &[u8]) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while at < rest.len() {
        match &rest[at..] {
            [b'/', b'*', ..] => {
                depth += 1;
                at += 2;
            }
            [b'*', b'/', ..] => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    break;
                }
            }
            _ => at += 1,
        }
    }
    at
}

fn quoted(rest: &[u8], quote: u8) -> usize {
    let mut at = 1;
    while at < rest.len() {
        match rest[at] {
            b'\\' => at += 2,
            byte if byte == quote => return at + 1,
            _ => at += 1,
        }
    }
    rest.len()
}

fn raw(rest: &[u8]) -> usize {
    let Some(quote) = rest.iter().position(|&b| b == b'"' || !b"rbc#".contains(&b)) else {
        return 0;
    };
    if rest[quote] != b'"' {
        return 0;
    }
    let hashes = rest[..quote].iter().filter(|&&b| b == b'#').count();
    let end: Vec<u8> = std::iter::once(b'"').chain(std::iter::repeat_n(b'#', hashes)).collect();
    let body = &rest[quote + 1..];
    let found = body.windows(end.len()).position(|window| window == end);
    found.map_or(rest.len(), |at| quote + 1 + at + end.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_literals_are_blanked_in_place() {
        let text = "a /* b /* c */ d */ \"e{\\\"\" 'f' '{' '\\'' 'ä' &'g x // h\nr#\"i\"{\"# j";
        let code = Source::new("x.rs", text).code;
        assert_eq!(code.len(), text.len());
        let kept: Vec<&str> = code.split_whitespace().collect();
        assert_eq!(kept, ["a", "&'g", "x", "j"]);
    }

    #[test]
    fn raw_identifiers_are_code() {
        assert_eq!(Source::new("x.rs", "r#type bar\"{\"").code, "r#type bar   ");
    }

    #[test]
    fn lines_of_tests_do_not_count() {
        let text = "fn a() {}\n#[cfg(test)]\nmod tests {\n    fn b() { '}' }\n}\nfn c() {}\n";
        let source = Source::new("x.rs", text);
        assert_eq!(source.lines_without_tests(), 2);
        let [a, b, c] = source.words("fn")[..] else { panic!("three functions") };
        assert_eq!([a, b, c].map(|at| source.is_test(at)), [false, true, false]);
        assert_eq!([a, b, c].map(|at| source.line(at)), [1, 4, 6]);
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(words("fn fns _fn fn", "fn"), [0, 11]);
    }
}
