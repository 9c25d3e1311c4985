//! Values of files that the caller names.

use std::path::Path;

use super::{picture, policy::read_limited};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    value::{BufferPool, Kind, Value},
};

/// A value of that kind from a file that the caller, not a graph, names: an image from a picture,
/// without alpha, or a text in UTF-8.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for other kinds, [`ErrorKind::Io`], [`ErrorKind::Limit`],
/// [`ErrorKind::Parse`].
pub fn read_value(path: &Path, kind: Kind, limits: &Limits) -> Result<Value, Error> {
    match kind {
        Kind::Image => {
            let bytes = read_limited(path, limits.read_bytes)?;
            let image = picture::decode(&bytes, path, limits, &BufferPool::new());
            image.map(Value::from).map_err(|error| named(path, &error))
        }
        Kind::Text => {
            let bytes = read_limited(path, limits.text_symbols.into())?;
            let text = String::from_utf8(bytes).map_err(|error| {
                let byte = error.utf8_error().valid_up_to();
                let what = format!("is not UTF-8 from byte {byte}");
                named(path, &Error::new(ErrorKind::Parse, what))
            })?;
            Ok(text.into())
        }
        Kind::Gradient | Kind::Points | Kind::Mesh | Kind::Strands => {
            let message = format!("a value of kind {} cannot be read from a file", kind.name());
            Err(Error::new(ErrorKind::Unsupported, message))
        }
    }
}

fn named(path: &Path, error: &Error) -> Error {
    let named = Error::new(error.kind(), format!("{}: {}", path.display(), error.message()));
    match error.hint() {
        Some(hint) => named.with_hint(hint),
        None => named,
    }
}

#[cfg(test)]
mod tests {
    use super::{super::tests::Folder, *};

    #[test]
    fn a_text_is_read_as_it_is() {
        let folder = Folder::new();
        folder.write("good.txt", "D(10)\nR(90)".as_bytes());
        folder.write("bad.txt", b"D\xff");
        let read = |name: &str, kind| read_value(&folder.path(name), kind, &Limits::default());
        let value = read("good.txt", Kind::Text).unwrap();
        assert!(matches!(value, Value::Text(text) if &*text == "D(10)\nR(90)"));
        let error = read("bad.txt", Kind::Text).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Parse);
        assert!(error.message().ends_with("bad.txt: is not UTF-8 from byte 1"), "{error}");
        assert_eq!(read("none.txt", Kind::Text).unwrap_err().kind(), ErrorKind::Io);
        assert_eq!(read("good.txt", Kind::Mesh).unwrap_err().kind(), ErrorKind::Unsupported);
        let limits = Limits { text_symbols: 4, ..Limits::default() };
        let error = read_value(&folder.path("good.txt"), Kind::Text, &limits).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
    }

    #[test]
    fn what_is_no_picture_is_named() {
        let folder = Folder::new();
        folder.write("not.png", b"no picture");
        let error = read_value(&folder.path("not.png"), Kind::Image, &Limits::default());
        assert!(error.unwrap_err().message().contains("not.png"));
    }
}
