//! Graph files: specification 1.1 and 1.2.
//!
//! There are two dialects. A file whose root has no `version` attribute was written by PT Designer,
//! and is read as it read them: what that program clamped, ignored or refused silently is clamped,
//! ignored or refused here too, but with a warning. A file with a `version` is ours: what it says
//! is followed to the letter or the file is refused.
//!
//! Faults in both dialects: no XML, not UTF-8, another root, a block without `type` or `id`, a size
//! below 1, more than the limits.
//!
//! Warnings in both: a missing `width`, `height`, `seed` or `supersampling` (taken as 256, 256, 0,
//! 1), stray text (ignored), a block of unknown type and a parameter of unknown name (kept), a
//! repeated parameter or slot (the last counts), the id of an earlier block (replaced by an unused
//! one), a connection of ports of different kinds (made; it counts as unconnected).
//!
//! Warnings in files of PT Designer, faults in ours: a number outside its range (clamped), an
//! unlisted choice (the default), a text that is not quite a number (read as far as it is one), a
//! parameter of another type or without name, type or value (ignored), a child of the root that is
//! no `block` (taken as one), a connection against the rules of specification 1.2 (not made).
//!
//! Every fault and warning has a line and a column. A file is untrusted: reading takes time and
//! memory in proportion to its bytes, whose number is limited.
//!
//! What is read is written again: attributes of the root and of blocks, parameters and blocks that
//! this version does not know are kept. [`write_graph`] writes a graph that came from PT Designer
//! as a file of PT Designer, as long as it can; see there.
//!
//! Start reading at [`read_graph`].

mod block;
mod connect;
mod element;
mod numbers;
mod position;
mod read;
mod report;
mod root;
mod write;

#[cfg(test)]
mod tests;

use crate::{
    error::Error,
    graph::Graph,
    params::{ParamKind, ParamSpec},
};

pub(crate) use read::read_graph;
pub use write::write_graph;

/// Inputs of a block in files of PT Designer.
const OLD_SLOTS: u32 = 5;

/// Inputs that a block of unknown type may have: its slots are not declared, but must not make the
/// reader allocate whatever number a file says.
const UNKNOWN_SLOTS: u32 = 256;

/// A graph read from a file.
#[derive(Debug, Clone)]
pub struct Reading {
    /// The graph.
    pub graph: Graph,
    /// What the file says and the graph does not follow, each with its line and column.
    pub warnings: Vec<Error>,
}

/// The word in the `type` attribute of a parameter.
fn type_word(spec: &ParamSpec) -> &'static str {
    match spec.kind {
        ParamKind::Int { .. } | ParamKind::Choice(_) => "int",
        ParamKind::Float { .. } => "double",
        ParamKind::Bool => "bool",
        ParamKind::Text | ParamKind::Path(_) => "string",
    }
}

/// Whether XML can express a character.
fn is_xml_char(character: char) -> bool {
    match character {
        '\t' | '\n' | '\r' => true,
        '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => false,
        _ => true,
    }
}
