//! Plug-ins: block types from shared libraries, loaded at run time.
//!
//! The contract is the plain C tables of the crate `ptlib-plugin-abi` (in C: `ptlib_plugin.h`).
//! They come in two envelopes: an `abi_stable` root module, which proves that a Rust plug-in means
//! the same tables, and a data symbol for C and C++. From `check` on there is one way: the tables
//! are read once, with every pointer and number checked, and become a
//! [`BlockSpec`](crate::block::BlockSpec) in `foreign`. Nothing above this module knows whether a
//! block is built in.
//!
//! Plug-ins are never unloaded (threads, thread-local destructors and texts of theirs may live on),
//! so their tables are `'static`, and what is made of them is made once in a process and leaked.
//!
//! Values of other kinds than images pass the border through `import` (C structs from outside become
//! checked values) and `view` (a value as C structs), which the C ABI uses too.
//!
//! Start reading at `load`, then `check`, then `foreign`. `call` is one call into a plug-in,
//! `host` and `services` are what it may ask back.
#![allow(unsafe_code, reason = "tables of plug-ins are pointers until they are checked")]

mod call;
mod check;
mod describe;
mod foreign;
mod host;
pub(crate) mod import;
mod library;
mod load;
mod making;
pub mod probe;
mod search;
mod services;
mod setup;
pub(crate) mod view;
mod wires;

pub use search::{FolderOrigin, Scanned, SearchFolder, search_folders};
