//! Faults and warnings of graph files, in the words that this command uses for them.

use std::{fmt::Write as _, path::Path};

use ptlib::Error;

/// Whether a finding keeps a graph from being computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Severity {
    /// It does.
    Error,
    /// It does not, but the picture may not be what the file's author meant.
    Warning,
}

impl Severity {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// One fault of a file. Only the fault itself counts, not those that came with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Finding {
    pub(crate) severity: Severity,
    pub(crate) error: Error,
}

impl Finding {
    pub(crate) fn error(error: &Error) -> Self {
        Self { severity: Severity::Error, error: error.clone() }
    }

    pub(crate) fn warning(error: &Error) -> Self {
        Self { severity: Severity::Warning, error: error.clone() }
    }

    /// Whether it says of the same block what `other` says.
    fn says(&self, other: &Error) -> bool {
        let (place, other_place) = (self.error.place(), other.place());
        self.error.kind() == other.kind()
            && place.block == other_place.block
            && place.parameter == other_place.parameter
            && self.error.message() == other.message()
    }

    /// `gold.xml:4:9`, or `gold.xml` where no position is known.
    pub(crate) fn location_in(&self, file: &Path) -> String {
        match self.error.place().position {
            Some((line, column)) => format!("{}:{line}:{column}", file.display()),
            None => file.display().to_string(),
        }
    }

    /// Its line and column, for sorting: what has none comes last.
    pub(crate) fn position_or_last(&self) -> (u32, u32) {
        self.error.place().position.unwrap_or((u32::MAX, u32::MAX))
    }

    /// What is wrong, apart from the location: `block 3 (mix), parameter "percentage": is 120,
    /// allowed 0..=100 (hint: try 50)`.
    pub(crate) fn fact_of(&self, file: &Path) -> String {
        let place = self.error.place();
        let mut fact = String::new();
        if let Some(block) = &place.block {
            fact = format!("block {block}");
        }
        if let Some(block_type) = &place.block_type {
            fact.extend([" (", block_type, ")"]);
        }
        if let Some(parameter) = &place.parameter {
            let separator = if fact.is_empty() { "" } else { ", " };
            fact.extend([separator, "parameter \"", parameter, "\""]);
        }
        if !fact.is_empty() {
            fact.push_str(": ");
        }
        // A fault of the file as such names it already.
        let own_name = format!("{}: ", file.display());
        let message = self.error.message();
        fact.push_str(message.strip_prefix(&own_name).unwrap_or(message));
        if let Some(hint) = self.hint() {
            write!(fact, " (hint: {hint})").expect("a string takes any text");
        }
        fact
    }

    /// What to do about it.
    pub(crate) fn hint(&self) -> Option<&str> {
        self.error.hint()
    }

    /// `gold.xml:4:9: block 3 …`.
    pub(crate) fn line_of(&self, file: &Path) -> String {
        format!("{}: {}", self.location_in(file), self.fact_of(file))
    }
}

/// All that is wrong with a graph: what reading its file warned of, and what keeps it from being
/// computed. Where both say the same, it is one error, at the position that only reading knows.
pub(crate) fn findings(warnings: &[Error], faults: &[Error]) -> Vec<Finding> {
    let mut findings: Vec<_> = warnings.iter().map(Finding::warning).collect();
    for fault in faults.iter().flat_map(Error::faults) {
        match findings.iter_mut().find(|finding| finding.says(fault)) {
            Some(finding) => finding.severity = Severity::Error,
            None => findings.push(Finding::error(fault)),
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use ptlib::ErrorKind;

    use super::*;

    fn line(error: &Error) -> String {
        Finding::error(error).line_of(Path::new("a.xml"))
    }

    #[test]
    fn a_line_says_where_what_and_what_to_do() {
        let error = Error::new(ErrorKind::OutOfRange, "is 0, allowed 1..=65536")
            .at_parameter("frequency")
            .at_block("3", "perlin noise", 7)
            .at_position(4, 9)
            .with_hint("try 6");
        let fact = "block 3 (perlin noise), parameter \"frequency\": is 0, allowed 1..=65536";
        assert_eq!(line(&error), format!("a.xml:4:9: {fact} (hint: try 6)"));
        let error = Error::new(ErrorKind::NotFound, "no").at_parameter("frequency");
        assert_eq!(line(&error), "a.xml: parameter \"frequency\": no");
    }

    #[test]
    fn a_file_is_named_once() {
        assert_eq!(line(&Error::new(ErrorKind::Io, "a.xml: not found")), "a.xml: not found");
        assert_eq!(line(&Error::new(ErrorKind::Io, "not found")), "a.xml: not found");
    }

    #[test]
    fn what_keeps_a_graph_from_being_computed_is_an_error_at_its_position() {
        let unknown =
            |block| Error::new(ErrorKind::NotFound, "no such type").at_block(block, "x", 1);
        let (first, second) = (unknown("0").at_position(3, 8), unknown("1").at_position(4, 8));
        let unconnected = Error::new(ErrorKind::Unconnected, "no input").at_block("2", "mix", 2);
        let faults = [unknown("1"), unconnected.clone(), unknown("1"), unconnected.clone()];
        let faults = Error::from_faults(faults.to_vec()).unwrap();
        let expected =
            [Finding::warning(&first), Finding::error(&second), Finding::error(&unconnected)];
        assert_eq!(findings(&[first, second], &[faults]), expected);
    }
}
