//! Why a block fails.

use std::ffi::CString;

use ptlib_plugin_abi::{
    PTLP_E_CANCELLED, PTLP_E_FAILED, PTLP_E_INVALID_ARGUMENT, PTLP_E_LIMIT, PTLP_E_NO_MEMORY,
    PTLP_E_PARSE, PTLP_E_UNCONNECTED, ptlp_status,
};

/// Why a block fails: a status and a sentence. Made from a text, or by a function that says which
/// kind it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BlockError {
    pub(crate) status: ptlp_status,
    pub(crate) message: Option<CString>,
}

impl BlockError {
    /// A status of the host, which knows why.
    pub(crate) fn of(status: ptlp_status) -> Self {
        Self { status, message: None }
    }

    pub(crate) fn new(status: ptlp_status, message: impl Into<String>) -> Self {
        let text = message.into().replace('\0', " ");
        Self { status, message: CString::new(text).ok() }
    }

    /// Something that the block got makes no sense.
    pub fn invalid(message: impl Into<String>) -> Self {
        Self::new(PTLP_E_INVALID_ARGUMENT, message)
    }

    /// A text or a file does not follow its grammar: say where, by line and column.
    pub fn parse(message: impl Into<String>) -> Self {
        Self::new(PTLP_E_PARSE, message)
    }

    /// More than is allowed.
    pub fn limit(message: impl Into<String>) -> Self {
        Self::new(PTLP_E_LIMIT, message)
    }

    /// There is no memory left.
    pub fn no_memory(message: impl Into<String>) -> Self {
        Self::new(PTLP_E_NO_MEMORY, message)
    }

    /// An input is needed and not connected.
    pub fn unconnected(message: impl Into<String>) -> Self {
        Self::new(PTLP_E_UNCONNECTED, message)
    }

    /// The host asked to stop.
    #[must_use]
    pub fn cancelled() -> Self {
        Self::of(PTLP_E_CANCELLED)
    }

    /// What it says.
    #[must_use]
    pub fn message(&self) -> String {
        self.message.as_ref().map(|text| text.to_string_lossy().into_owned()).unwrap_or_default()
    }
}

impl From<String> for BlockError {
    fn from(message: String) -> Self {
        Self::new(PTLP_E_FAILED, message)
    }
}

impl From<&str> for BlockError {
    fn from(message: &str) -> Self {
        Self::new(PTLP_E_FAILED, message)
    }
}
