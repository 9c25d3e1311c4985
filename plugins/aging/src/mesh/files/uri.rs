//! Where a glTF's buffers are: behind a `data:` URI, or in a file beside it.

use super::FileError;

/// Where something is.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Here.
    Here(Vec<u8>),
    /// In a file, named relative to the one that names it.
    Beside(String),
}

/// What a URI leads to (RFC 2397 for `data:`, RFC 3986 for paths).
pub(super) fn place(uri: &str) -> Result<Place, FileError> {
    let wrong = |what: &str| {
        let start: String = uri.chars().take(40).collect();
        FileError::Parse(format!("the URI \"{start}\" {what}"))
    };
    if let Some(rest) = uri.strip_prefix("data:") {
        let (kind, text) = rest.split_once(',').ok_or_else(|| wrong("has no comma"))?;
        if !kind.ends_with(";base64") {
            return Err(wrong("is not in base64, which is all that is allowed in data"));
        }
        return base64(text.as_bytes()).map(Place::Here).ok_or_else(|| wrong("is not base64"));
    }
    let is_relative = !uri.starts_with(['/', '\\']) && !uri.contains(':') && !uri.is_empty();
    if !is_relative {
        return Err(wrong("is neither data nor a path relative to the file"));
    }
    percent(uri).map(Place::Beside).ok_or_else(|| wrong("has a wrong %-escape"))
}

/// The bytes of a text in base64 (RFC 4648), with or without padding.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let padding = text.iter().rev().take_while(|byte| **byte == b'=').count();
    let digits = text.get(..text.len() - padding)?;
    if padding > 2 || digits.len() % 4 == 1 {
        return None;
    }
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 3);
    for group in digits.chunks(4) {
        let mut bits = 0_u32;
        for place in 0..4 {
            bits = bits << 6 | group.get(place).map_or(Some(0), |digit| value(*digit))?;
        }
        let [_, a, b, c] = bits.to_be_bytes();
        bytes.extend([a, b, c].into_iter().take(group.len() - 1));
    }
    Some(bytes)
}

/// What a digit of base64 stands for.
fn value(digit: u8) -> Option<u32> {
    Some(match digit {
        b'A'..=b'Z' => u32::from(digit - b'A'),
        b'a'..=b'z' => u32::from(digit - b'a') + 26,
        b'0'..=b'9' => u32::from(digit - b'0') + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    })
}

/// The path without %-escapes.
fn percent(uri: &str) -> Option<String> {
    let mut path = Vec::with_capacity(uri.len());
    let mut bytes = uri.bytes();
    while let Some(byte) = bytes.next() {
        path.push(if byte == b'%' {
            let mut digit = || char::from(bytes.next()?).to_digit(16);
            let (high, low) = (digit()?, digit()?);
            u8::try_from(high * 16 + low).ok()?
        } else {
            byte
        });
    }
    String::from_utf8(path).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_is_decoded() {
        // The vectors of RFC 4648.
        let vectors = [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYg", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
        ];
        for (text, bytes) in vectors {
            let uri = format!("data:application/octet-stream;base64,{text}");
            assert_eq!(place(&uri), Ok(Place::Here(bytes.into())), "{text}");
        }
        assert_eq!(base64(b"+/A="), Some(vec![0xFB, 0xF0]));
        for wrong in ["data:;base64,Z", "data:;base64,Zm9v====", "data:;base64,Zm-v", "data:,x"] {
            assert!(place(wrong).is_err(), "{wrong}");
        }
        assert!(place("data:;base64").is_err());
    }

    #[test]
    fn paths_are_relative() {
        assert_eq!(place("a%20b/c.bin"), Ok(Place::Beside("a b/c.bin".into())));
        for wrong in
            ["/etc/passwd", "file:///x", "http://x/y", "C:\\x", "\\\\host", "", "a%2", "%zz"]
        {
            assert!(place(wrong).is_err(), "{wrong}");
        }
    }
}
