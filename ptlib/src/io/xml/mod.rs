//! Graph files: specification 1.1 and 1.2.

use std::sync::Arc;

use crate::{
    block::Registry,
    error::{Error, ErrorKind},
    graph::Graph,
    limits::Limits,
};

/// A graph read from a file.
#[derive(Debug, Clone)]
pub struct Reading {
    /// The graph.
    pub graph: Graph,
    /// What the file says and the graph does not follow, each with its line and column.
    pub warnings: Vec<Error>,
}

/// Reads a graph file's contents.
pub(crate) fn read_graph(
    _xml: &[u8],
    _registry: &Arc<Registry>,
    _limits: &Limits,
) -> Result<Reading, Error> {
    Err(Error::new(ErrorKind::Unsupported, "not yet"))
}

/// The graph as a file's contents.
#[must_use]
pub fn write_graph(_graph: &Graph) -> String {
    String::new()
}
