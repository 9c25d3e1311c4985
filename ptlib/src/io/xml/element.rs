//! One element of a file: its name and its attributes.

use std::{borrow::Cow, collections::BTreeSet};

use quick_xml::{
    escape::{EscapeError, unescape},
    events::{
        BytesStart,
        attributes::{AttrError, Attributes},
    },
};

use super::{
    is_xml_char,
    position::offset_of,
    report::{Report, raisable},
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
};

/// The start of an element.
pub(super) struct Element<'a> {
    pub(super) name: &'a str,
    /// Where its `<` is.
    pub(super) offset: usize,
    pub(super) attributes: Vec<Attribute<'a>>,
    /// Whether some of its attributes could not be read, so that none can be called missing.
    pub(super) is_damaged: bool,
}

/// An attribute, with references in its value resolved.
pub(super) struct Attribute<'a> {
    pub(super) name: &'a str,
    pub(super) value: Cow<'a, str>,
    /// Where its name is.
    pub(super) offset: usize,
}

impl<'a> Element<'a> {
    /// Reads the element whose `<` is at `offset`. Attributes that are no XML become faults.
    pub(super) fn read(
        text: &'a str,
        offset: usize,
        tag: &BytesStart<'_>,
        limits: &Limits,
        report: &mut Report<'_>,
    ) -> Self {
        // The event borrows its content from the reader; this is the same slice of the file.
        let start = offset + 1;
        let content = text.get(start..start + tag.len()).unwrap_or_default();
        let name_len = tag.name().as_ref().len();
        let name = content.get(..name_len).unwrap_or_default();
        let mut element = Self { name, offset, attributes: Vec::new(), is_damaged: false };
        let mut names = BTreeSet::new();
        let mut attributes = Attributes::new(content, name_len);
        // Duplicates are found here: the iterator compares hashes that can be made to collide.
        attributes.with_checks(false);
        for attribute in attributes {
            if report.is_full() {
                break;
            }
            let (name, raw) = match attribute {
                Ok(attribute) => (attribute.key.into_inner(), attribute.value),
                Err(error) => {
                    let (at, message) = explain(&error);
                    report.fault(start + at, Error::new(ErrorKind::Parse, message));
                    element.is_damaged = true;
                    continue;
                }
            };
            let offset = offset_of(text, name);
            let value = check_name(name, &mut names).and_then(|()| value(raw, limits));
            match value {
                Ok(value) => element.attributes.push(Attribute { name, value, offset }),
                Err(error) => {
                    report.fault(offset, error);
                    element.is_damaged = true;
                }
            }
        }
        element
    }

    /// The attribute of that name.
    pub(super) fn get(&self, name: &str) -> Option<&Attribute<'a>> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }

    /// The error of a missing attribute.
    pub(super) fn missing(&self, attribute: &str) -> Error {
        let message = format!("<{}> has no attribute \"{attribute}\"", self.name);
        Error::new(ErrorKind::Parse, message)
    }

    /// The attributes other than `known`, to be kept.
    pub(super) fn others(&self, known: &[&str]) -> Vec<(String, String)> {
        let others = self.attributes.iter().filter(|attribute| !known.contains(&attribute.name));
        others.map(|other| (other.name.to_owned(), other.value.clone().into_owned())).collect()
    }
}

fn check_name<'a>(name: &'a str, names: &mut BTreeSet<&'a str>) -> Result<(), Error> {
    let message = if !is_name(name) {
        format!("\"{}\" is no name of an attribute", shortened(name))
    } else if !names.insert(name) {
        format!("attribute \"{}\" is there twice", shortened(name))
    } else {
        return Ok(());
    };
    Err(Error::new(ErrorKind::Parse, message))
}

/// The value of an attribute: the text as it stands there, with the five entities of XML and
/// references to characters resolved. Other entities are never expanded.
fn value<'a>(raw: Cow<'a, str>, limits: &Limits) -> Result<Cow<'a, str>, Error> {
    if raw.len() > limits.text_bytes as usize {
        let message = format!("a text has {} bytes, allowed {}", raw.len(), limits.text_bytes);
        return Err(raisable(ErrorKind::Limit, message, "text_bytes"));
    }
    let resolved =
        unescape(&raw).map_err(|error| Error::new(ErrorKind::Parse, reference(&error)))?;
    let Cow::Owned(resolved) = resolved else { return Ok(raw) };
    match resolved.chars().find(|&character| !is_xml_char(character)) {
        Some(character) => {
            let message =
                format!("refers to character {}, which XML forbids", u32::from(character));
            Err(Error::new(ErrorKind::Parse, message))
        }
        None => Ok(resolved.into()),
    }
}

/// Whether a text can be the name of an attribute.
fn is_name(text: &str) -> bool {
    let starts = |first: char| first.is_alphabetic() || "_:".contains(first);
    let goes_on = |other: char| starts(other) || other.is_alphanumeric() || "-.·".contains(other);
    let mut characters = text.chars();
    characters.next().is_some_and(starts) && characters.all(goes_on)
}

/// The start of a text from a file, short enough for a message.
pub(super) fn shortened(text: &str) -> Cow<'_, str> {
    const LONGEST: usize = 80;
    if text.len() <= LONGEST {
        return text.into();
    }
    let end = text.floor_char_boundary(LONGEST);
    format!("{}…", text.get(..end).unwrap_or_default()).into()
}

/// What is wrong with a reference such as `&amp;`.
pub(super) fn reference(error: &EscapeError) -> String {
    match error {
        EscapeError::UnrecognizedEntity(_, name) => format!(
            "entity &{}; is none of the five of XML, and others are never expanded",
            shortened(name)
        ),
        EscapeError::UnterminatedEntity(_) => "an & without its ; (write &amp;)".to_owned(),
        EscapeError::InvalidCharRef(error) => format!("a reference to no character: {error}"),
        EscapeError::TooManyNestedEntities => "entities are nested too deeply".to_owned(),
    }
}

/// Where in the tag, and what.
fn explain(error: &AttrError) -> (usize, &'static str) {
    match error {
        AttrError::ExpectedEq(at) => (*at, "an attribute without \"=\""),
        AttrError::ExpectedValue(at) => (*at, "an attribute without a value"),
        AttrError::UnquotedValue(at) => (*at, "the value of an attribute is not in quotes"),
        AttrError::ExpectedQuote(at, _) => (*at, "the value of an attribute has no closing quote"),
        AttrError::Duplicated(at, _) => (*at, "an attribute is there twice"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_xml() {
        for name in ["a", "_x", "ns:attr", "größe", "a-b.c1"] {
            assert!(is_name(name), "{name}");
        }
        for name in ["", "1a", "-a", "a\"b", "a<", "a&b", "a/", "a>"] {
            assert!(!is_name(name), "{name}");
        }
    }

    #[test]
    fn long_texts_are_shortened_between_characters() {
        assert_eq!(shortened("short"), "short");
        assert_eq!(shortened(&"é".repeat(100)), format!("{}…", "é".repeat(40)));
    }
}
