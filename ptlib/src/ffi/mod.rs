//! The C ABI: `ptlib.h` is generated from this module.
//!
//! Each exported function checks its arguments, calls the public interface of this crate, and
//! turns what comes back into a status. Nothing is computed or decided here, so that C, C++ and C#
//! programs get what Rust programs get.
//!
//! Start reading at `pt_fn!` below, the barrier around every export: no panic and no unchecked
//! pointer passes it. `handle` says what the opaque types are, `argument` how pointers become
//! references, `structs` how structs of other versions are read and written. The documentation
//! of the exported items is the documentation of the header: it speaks to C programmers.
#![allow(unsafe_code, reason = "pointers from C are unsafe until they are checked")]
#![allow(non_camel_case_types, reason = "the names of the header")]
#![allow(
    clippy::missing_safety_doc,
    reason = "the rules at the top of the header are the contract of every export"
)]

/// The barrier around every exported function.
///
/// `pt_fn!(error; graph: Handle<ptl_graph>, out: Out<u64> => …)` receives the named arguments
/// (a kind of argument that is made from several C values is written `data: &[u8] = (data, size)`),
/// runs the body, which gives a `Result`, and returns a status; `error` is the argument that takes
/// the error, or NULL. `pt_fn!(else 0; …)` is for functions that cannot fail: they give the value
/// after `else` when an argument is wrong. In both, a panic ends here.
///
/// All arguments are received before the first wrong one is reported, so that a new handle's place
/// is NULL after every error.
macro_rules! pt_fn {
    (else $default:expr; $($name:ident: $kind:ty $(= $raw:expr)?),* => $body:expr) => {
        $crate::ffi::call::infallible($default, || {
            $crate::ffi::pt_fn!(@receive $($name: $kind $(= $raw)?),*);
            Ok($body)
        })
    };
    (@receive $($name:ident: $kind:ty $(= $raw:expr)?),*) => {
        $(
            // SAFETY: what the header says about this argument is what its kind asks for, and
            // callers of the exported function promise to follow the header.
            let $name = unsafe {
                <$kind as $crate::ffi::argument::Argument<_>>::receive(
                    $crate::ffi::pt_fn!(@raw $name $($raw)?),
                    stringify!($name),
                )
            };
        )*
        $(let $name = $name?;)*
    };
    (@raw $name:ident) => { $name };
    (@raw $name:ident $raw:expr) => { $raw };
    ($error:expr; $($name:ident: $kind:ty $(= $raw:expr)?),* => $body:expr) => {{
        let (error, body) = ($error, || {
            $crate::ffi::pt_fn!(@receive $($name: $kind $(= $raw)?),*);
            $body
        });
        // SAFETY: callers promise that `error` is NULL or theirs to write.
        unsafe { $crate::ffi::call::fallible(error, body) }
    }};
}
use pt_fn;

mod argument;
mod block_type;
mod bytes;
mod call;
mod cancel;
mod catalogue;
mod compute;
mod engine;
mod error;
mod fault;
mod graph;
mod graph_edit;
mod graph_params;
mod graph_settings;
mod graph_values;
mod handle;
mod image;
mod job;
mod log;
mod plugin;
mod status;
mod structs;
mod types;
mod value;
mod value_view;
mod version;

pub use block_type::*;
pub use bytes::*;
pub use cancel::*;
pub use compute::*;
pub use engine::*;
pub use error::*;
pub use graph::*;
pub use graph_edit::*;
pub use graph_params::*;
pub use graph_settings::*;
pub use graph_values::*;
pub use image::*;
pub use job::*;
pub use log::*;
pub use plugin::*;
pub use status::*;
pub use types::*;
pub use value::*;
pub use value_view::*;
pub use version::*;
