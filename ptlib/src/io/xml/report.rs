//! What is wrong with a file.

use super::{Reading, position::position};
use crate::{
    error::{Error, ErrorKind},
    graph::Graph,
    limits::Limits,
};

/// Collects the faults and the warnings of one file.
pub(super) struct Report<'a> {
    text: &'a str,
    /// How many faults and how many warnings are listed.
    pub(super) limit: usize,
    /// Whether the file is one of ours: nothing in it is tolerated.
    pub(super) is_strict: bool,
    faults: Vec<Error>,
    warnings: Vec<Error>,
    unlisted_warnings: usize,
}

impl<'a> Report<'a> {
    pub(super) fn new(text: &'a str, limits: &Limits) -> Self {
        Self {
            text,
            limit: (limits.faults as usize).max(1),
            is_strict: false,
            faults: Vec::new(),
            warnings: Vec::new(),
            unlisted_warnings: 0,
        }
    }

    /// Something for which the file is refused.
    pub(super) fn fault(&mut self, offset: usize, error: Error) {
        if !self.is_full() {
            self.faults.push(self.placed(offset, error));
        }
    }

    /// Something that the graph does not follow.
    pub(super) fn warn(&mut self, offset: usize, error: Error) {
        self.warn_with(offset, || error);
    }

    /// As [`warn`](Self::warn), for an error that takes time to make, such as one with a hint.
    pub(super) fn warn_with(&mut self, offset: usize, error: impl FnOnce() -> Error) {
        if self.warnings.len() < self.limit {
            self.warnings.push(self.placed(offset, error()));
        } else {
            self.unlisted_warnings += 1;
        }
    }

    /// Something that is tolerated in files of PT Designer only.
    pub(super) fn tolerate(&mut self, offset: usize, error: Error) {
        if self.is_strict { self.fault(offset, error) } else { self.warn(offset, error) }
    }

    /// Whether there are as many faults as are collected: reading on is of no use.
    pub(super) fn is_full(&self) -> bool {
        self.faults.len() >= self.limit
    }

    /// The graph, if the file has no faults.
    pub(super) fn finish(mut self, graph: Graph) -> Result<Reading, Error> {
        let is_full = self.is_full();
        self.faults.sort_by_key(|error| error.place().position);
        if is_full {
            let message = format!("reading stopped after {} faults", self.limit);
            self.faults.push(raisable(ErrorKind::Limit, message, "faults"));
        }
        if let Some(error) = Error::from_faults(self.faults) {
            return Err(error);
        }
        self.warnings.sort_by_key(|error| error.place().position);
        if self.unlisted_warnings > 0 {
            let message = format!("{} more warnings are not listed", self.unlisted_warnings);
            self.warnings.push(raisable(ErrorKind::Limit, message, "faults"));
        }
        Ok(Reading { graph, warnings: self.warnings })
    }

    fn placed(&self, offset: usize, error: Error) -> Error {
        let (line, column) = position(self.text, offset);
        error.at_position(line, column)
    }
}

/// An error about a limit, with a hint how to raise it.
pub(super) fn raisable(kind: ErrorKind, message: String, limit: &str) -> Error {
    Error::new(kind, message)
        .with_hint(format!("the caller can raise that: `Limits::{limit}` in `EngineOptions`"))
}
