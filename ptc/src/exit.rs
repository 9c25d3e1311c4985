//! How the command ends: exit codes, and faults that end it.

use std::{io, path::Path, process::ExitCode};

use ptlib::{Error, ErrorKind};

use crate::{finding::Finding, terminal};

/// How the command ends. The numbers are documented in `--help` and never change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Done.
    Success = 0,
    /// A file or a computation failed, or a check found an error.
    Failed = 1,
    /// The command line makes no sense.
    Usage = 2,
    /// Some graphs of a batch failed, the others were rendered.
    SomeFailed = 3,
    /// Ctrl-C; the number that a shell gives a command which the interrupt signal ended.
    Cancelled = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Why the command ends early, in lines for standard error.
#[derive(Debug)]
pub(crate) struct Fault {
    pub(crate) exit: Exit,
    lines: Vec<String>,
}

impl Fault {
    /// The command line makes no sense.
    pub(crate) fn usage(message: impl AsRef<str>, hint: impl AsRef<str>) -> Self {
        let line = format!("{} (hint: {})", message.as_ref(), hint.as_ref());
        Self { exit: Exit::Usage, lines: vec![line] }
    }

    /// What the library says of a file, one line a fault.
    pub(crate) fn of_file(file: &Path, error: &Error) -> Self {
        let exit = match error.kind() {
            ErrorKind::Cancelled => Exit::Cancelled,
            _ => Exit::Failed,
        };
        let lines = error.faults().map(|fault| Finding::error(fault).line_of(file)).collect();
        Self { exit, lines }
    }

    /// Ctrl-C, which whoever pressed it knows.
    pub(crate) fn cancelled() -> Self {
        Self { exit: Exit::Cancelled, lines: vec![] }
    }

    /// Shows the fault.
    pub(crate) fn report(&self) {
        for line in &self.lines {
            terminal::error(line);
        }
    }
}

/// Standard output cannot be written. A reader that has seen enough, as in `ptc list | head -1`,
/// is no fault.
impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self { exit: Exit::Success, lines: vec![] },
            _ => Self {
                exit: Exit::Failed,
                lines: vec![format!("cannot write to standard output: {error}")],
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_that_has_seen_enough_is_no_fault() {
        let fault = Fault::from(io::Error::from(io::ErrorKind::BrokenPipe));
        assert_eq!((fault.exit, fault.lines.len()), (Exit::Success, 0));
        let fault = Fault::from(io::Error::from(io::ErrorKind::StorageFull));
        assert_eq!((fault.exit, fault.lines.len()), (Exit::Failed, 1));
    }

    #[test]
    fn cancelling_is_told_apart_from_failing() {
        let fault = |kind| Fault::of_file(Path::new("a.xml"), &Error::new(kind, "no")).exit;
        assert_eq!(fault(ErrorKind::Cancelled), Exit::Cancelled);
        assert_eq!(fault(ErrorKind::Parse), Exit::Failed);
    }
}
