//! Parameters: declared once, read by everybody.
//!
//! A block declares its parameters with [`params!`](crate::params!) and their alternatives with
//! [`choice!`](crate::choice!). From those lines come the typed struct that the block computes
//! with, and the table of [`ParamSpec`]s that the file reader and writer, the C ABI, the command
//! line, the documentation and the tests read. A default outside its range does not compile.

mod declare;
mod spec;

pub use spec::{
    ChoiceItem, DefaultValue, FileUse, ParamKind, ParamSet, ParamSpec, ParamType, ParamValue,
    Range, check_specs,
};
