//! Errors: what went wrong, where, and what is allowed instead.

use std::fmt;

/// What went wrong. The numbers are those of the C ABI (`PTL_E_…`) and never change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The caller asked for it.
    Cancelled = 2,
    /// An argument makes no sense.
    InvalidArgument = 3,
    /// This version or build cannot do that.
    Unsupported = 4,
    /// The system has no memory left.
    NoMemory = 5,
    /// The object is in use by another thread.
    Busy = 6,
    /// No block, parameter, port or type of that name.
    NotFound = 7,
    /// The block was removed from its graph.
    StaleHandle = 8,
    /// A value or a connection of the wrong kind.
    TypeMismatch = 9,
    /// The connection would make a block depend on itself.
    Cycle = 10,
    /// A required input is not connected.
    Unconnected = 11,
    /// A number outside its range.
    OutOfRange = 12,
    /// A text or file that does not follow its grammar.
    Parse = 13,
    /// A file could not be read or written.
    Io = 14,
    /// More than the limits allow.
    Limit = 15,
    /// A buffer of the caller is too small.
    BufferTooSmall = 16,
    /// The file policy forbids it.
    Denied = 17,
    /// The system cannot load the file of a plug-in: it is no library, or misses another one.
    PluginLoad = 20,
    /// The plug-in was built for another version of the plug-in contract.
    PluginAbi = 21,
    /// Another plug-in has block types of that id.
    PluginDuplicate = 22,
    /// A block of a plug-in panicked or threw an exception.
    PluginPanic = 23,
    /// The tables of a Rust plug-in are laid out in another way than here.
    PluginLayout = 24,
    /// The file is a library, but no plug-in.
    PluginSymbol = 25,
    /// The plug-in could not be initialised.
    PluginInit = 26,
    /// The plug-in describes itself wrongly; the message names the field.
    PluginDescriptor = 27,
    /// A block of a plug-in says that it failed.
    PluginFailed = 28,
    /// A defect of this library or of a block.
    Internal = 99,
}

/// Where it went wrong; each part is set where it is known.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Place {
    /// Id of the block in its graph file.
    pub block: Option<String>,
    /// Type of the block, such as `perlin noise`.
    pub block_type: Option<String>,
    /// Handle of the block in its graph, see [`BlockId`](crate::graph::BlockId).
    pub handle: Option<u64>,
    /// Id of the parameter.
    pub parameter: Option<String>,
    /// Line and column in the file, from 1; columns count characters.
    pub position: Option<(u32, u32)>,
}

/// What went wrong, where, and what is allowed instead.
///
/// `Display` gives one line per fault: `block 3 (perlin noise), parameter "frequency": is 0,
/// allowed 1..=65536`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error(Box<Inner>);

#[derive(Debug, Clone, PartialEq, Eq)]
struct Inner {
    kind: ErrorKind,
    place: Place,
    message: String,
    hint: Option<String>,
    more: Vec<Error>,
}

impl Error {
    /// An error without a place. `message` states the fact, the value and what is allowed.
    #[must_use]
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self(Box::new(Inner {
            kind,
            place: Place::default(),
            message: message.into(),
            hint: None,
            more: Vec::new(),
        }))
    }

    /// The error with a line that says what to do.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.0.hint = Some(hint.into());
        self
    }

    /// The error at a parameter.
    #[must_use]
    pub fn at_parameter(mut self, parameter: impl Into<String>) -> Self {
        self.0.place.parameter = Some(parameter.into());
        self
    }

    /// The error at a block, unless it names one already.
    #[must_use]
    pub fn at_block(mut self, id: &str, block_type: &str, handle: u64) -> Self {
        let place = &mut self.0.place;
        if place.block.is_none() {
            place.block = Some(id.to_owned());
            place.block_type = Some(block_type.to_owned());
            place.handle = Some(handle);
        }
        self
    }

    /// The error at a line and column of a file.
    #[must_use]
    pub fn at_position(mut self, line: u32, column: u32) -> Self {
        self.0.place.position = Some((line, column));
        self
    }

    /// Several faults as one error: the first, with the others behind it.
    ///
    /// Returns `None` for no faults.
    #[must_use]
    pub fn from_faults(faults: Vec<Self>) -> Option<Self> {
        let mut faults = faults.into_iter();
        let mut first = faults.next()?;
        first.0.more.extend(faults);
        Some(first)
    }

    /// What went wrong.
    #[must_use]
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// Where.
    #[must_use]
    pub fn place(&self) -> &Place {
        &self.0.place
    }

    /// The fact without its place.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// What to do about it, where that can be guessed.
    #[must_use]
    pub fn hint(&self) -> Option<&str> {
        self.0.hint.as_deref()
    }

    /// This fault and all others that came with it, each without further ones.
    pub fn faults(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.0.more)
    }

    fn fmt_one(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Inner { place, message, hint, .. } = &*self.0;
        if let Some((line, column)) = place.position {
            write!(f, "line {line}, column {column}: ")?;
        }
        match (&place.block, &place.block_type) {
            (Some(id), Some(block_type)) => write!(f, "block {id} ({block_type})")?,
            (Some(id), None) => write!(f, "block {id}")?,
            _ => {}
        }
        if let Some(parameter) = &place.parameter {
            let separator = if place.block.is_some() { ", " } else { "" };
            write!(f, "{separator}parameter \"{parameter}\"")?;
        }
        if place.block.is_some() || place.parameter.is_some() {
            f.write_str(": ")?;
        }
        f.write_str(message)?;
        if let Some(hint) = hint {
            write!(f, " ({hint})")?;
        }
        Ok(())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fmt_one(f)?;
        for other in &self.0.more {
            f.write_str("\n")?;
            other.fmt_one(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_says_where_what_and_what_to_do() {
        let error = Error::new(ErrorKind::OutOfRange, "is 0, allowed 1..=65536")
            .at_parameter("frequency")
            .at_block("3", "perlin noise", 7)
            .at_position(4, 9)
            .with_hint("try 6");
        assert_eq!(
            error.to_string(),
            "line 4, column 9: block 3 (perlin noise), parameter \"frequency\": is 0, allowed \
             1..=65536 (try 6)"
        );
        assert_eq!(error.clone().at_block("9", "mix", 1), error);
    }

    #[test]
    fn all_faults_are_told() {
        let faults = vec![Error::new(ErrorKind::Parse, "a"), Error::new(ErrorKind::Limit, "b")];
        let error = Error::from_faults(faults).unwrap();
        assert_eq!(error.to_string(), "a\nb");
        assert_eq!(error.faults().count(), 2);
        assert_eq!(Error::from_faults(vec![]), None);
    }
}
