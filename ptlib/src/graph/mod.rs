//! Graphs: blocks, their parameters, and the connections between them.
//!
//! A [`Graph`] is a value: cloning one is a snapshot that costs nothing until one of the two is
//! edited. Its invariants hold after every edit: every parameter of a known block is one that its
//! declaration allows, no block depends on itself, and an input is connected to an output that
//! exists. A block of an unknown type (its plug-in is missing) is kept with everything its file
//! said, and fails only when it is computed.
//!
//! Start reading at [`Graph`]; [`Block`] is what it holds.

mod check;
mod connector;
mod edit;
mod input;
mod model;

pub(crate) use connector::Connector;
pub(crate) use input::Given;
pub use model::{Block, BlockId, Connection, Graph, Origin, RawParameter, Settings, Source};
