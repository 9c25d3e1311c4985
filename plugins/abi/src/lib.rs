//! The contract between ptlib and its plug-ins, in plain C tables.
//!
//! This crate is `ptlib_plugin.h` and `ptlib_values.h` in Rust; a test compares sizes, offsets and
//! constants. It holds no code: the host's side is `ptlib::plugin`, the safe side for authors in
//! Rust is the crate `ptlib-plugin`.
//!
//! A plug-in exports one [`ptlp_entry`], which lists its [`ptlp_block`]s. Each names its ports and
//! parameters, and has four functions: `create`, `prepare`, `compute`, `destroy`. What flows over
//! the border are [`ptlp_wire`]s: images as [`ptlp_tile`]s, everything else as the structs of
//! [`values`]. What a plug-in may ask for, it finds by id at the [`ptlp_host`] ([`services`]).
//!
//! # How the contract grows
//! The tables are frozen per [`PTLP_ABI_MAJOR`]. News come as services or extensions of a new id
//! with a revision (`ptl.tile-hint/1`), never as further fields: `abi_stable` compares the tables
//! field by field, and a plug-in built with other tables is refused. (The ABI is a draft until
//! ptlib 1.0.)
//!
//! # Two envelopes
//! Plug-ins in C and C++ export the entry as the data symbol [`PTLP_ENTRY_SYMBOL`]. Plug-ins in
//! Rust export it so, and besides through the root module of [`envelope`], which proves at load
//! time that both sides mean the same tables.
#![allow(non_camel_case_types, reason = "the names of the C header")]
#![allow(unsafe_code, reason = "tables of pointers are shared between threads")]

mod block;
mod entry;
pub mod envelope;
mod host;
pub mod services;
pub mod values;

pub use block::*;
pub use entry::*;
pub use host::*;

/// The version of the tables. Plug-ins of another major version are refused.
pub const PTLP_ABI_MAJOR: u32 = 1;
/// Counts services and meanings that came since; plug-ins of any minor version are loaded.
pub const PTLP_ABI_MINOR: u32 = 0;

/// What a function of a plug-in, or a service of the host, returns: [`PTLP_OK`] or one of
/// `PTLP_E_…`. The numbers are those of `ptl_status`.
pub type ptlp_status = i32;

/// Done.
pub const PTLP_OK: ptlp_status = 0;
/// The host asked to stop, and the function did.
pub const PTLP_E_CANCELLED: ptlp_status = 2;
/// An argument makes no sense.
pub const PTLP_E_INVALID_ARGUMENT: ptlp_status = 3;
/// This host or plug-in cannot do that.
pub const PTLP_E_UNSUPPORTED: ptlp_status = 4;
/// The system has no memory left.
pub const PTLP_E_NO_MEMORY: ptlp_status = 5;
/// No file, input or stream of that name.
pub const PTLP_E_NOT_FOUND: ptlp_status = 7;
/// A required input is not connected.
pub const PTLP_E_UNCONNECTED: ptlp_status = 11;
/// A number outside its range.
pub const PTLP_E_OUT_OF_RANGE: ptlp_status = 12;
/// A text or a file that does not follow its grammar.
pub const PTLP_E_PARSE: ptlp_status = 13;
/// A file could not be read or written.
pub const PTLP_E_IO: ptlp_status = 14;
/// More than the limits of the engine allow.
pub const PTLP_E_LIMIT: ptlp_status = 15;
/// The file policy forbids it.
pub const PTLP_E_DENIED: ptlp_status = 17;
/// A panic or an exception was caught before it left the plug-in.
pub const PTLP_E_PANIC: ptlp_status = 23;
/// It failed; the text given to `set_error` says why.
pub const PTLP_E_FAILED: ptlp_status = 28;
