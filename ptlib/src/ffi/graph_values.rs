//! Values that go into graphs and come out of them.

use std::ffi::c_char;

use super::{
    compute::Request,
    handle::{Handle, NewHandle, tagged},
    ptl_block, ptl_compute_options, ptl_error, ptl_graph, ptl_status, ptl_value,
    structs::In,
    value::ValueObject,
};
use crate::{error::Error, graph::BlockId};

/// A value that may be NULL.
struct MaybeValue<'a>(Option<Handle<'a, ptl_value>>);

impl super::argument::Argument<*const ptl_value> for MaybeValue<'_> {
    unsafe fn receive(raw: *const ptl_value, name: &'static str) -> Result<Self, Error> {
        if raw.is_null() {
            return Ok(Self(None));
        }
        // SAFETY: the same promise.
        unsafe { Handle::receive(raw, name) }.map(|value| Self(Some(value)))
    }
}

/// Sets the value of an input of the graph (a block type with PTL_BLOCK_IS_INPUT), or takes it back
/// with NULL: then its default counts. Computations that run already keep what they have. Values
/// are not saved with the graph.
///
/// Ownership: the graph keeps a reference of its own.
/// Threads:   one at a time changes a graph.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_TYPE_MISMATCH if the block is no
///            input or takes values of another kind, PTL_E_BUSY.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_input(
    graph: *mut ptl_graph,
    block: ptl_block,
    value: *const ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, value: MaybeValue => {
        let id = BlockId::from_raw(block);
        let mut edit = graph.edit()?;
        // The old value may tell its owner that it is free: not while the graph is locked.
        let old = edit.graph.input_value(id).cloned();
        let result = edit.graph.set_input(id, value.0.map(|value| value.value().clone()));
        drop(edit);
        drop(old);
        result
    })
}

/// The first input of the graph, in file order, whose parameter "name" is `name`; 0 if there is
/// none.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_find_input(
    graph: *const ptl_graph,
    name: *const c_char,
) -> ptl_block {
    pt_fn!(else 0; graph: Handle<ptl_graph>, name: &str =>
        graph.look()?.find_input(name).map_or(0, BlockId::to_raw))
}

/// Computes one output of a block, of any kind, and returns a new value. Otherwise as
/// ptl_graph_compute(); `format` of the options does not matter.
///
/// Ownership: `out` receives one reference; release it with ptl_value_release(). Nothing of
///            `options` is kept. What an input gave may come back as it was given, uncopied: then
///            memory that was lent for it is needed as long as this value.
/// Threads:   any; callbacks run on the calling thread only.
/// Cancel:    as ptl_graph_compute().
/// Errors:    as ptl_graph_compute(). On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_compute_value(
    graph: *const ptl_graph,
    block: ptl_block,
    out_port: u32,
    options: *const ptl_compute_options,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, options: In<ptl_compute_options>,
        out: NewHandle<ptl_value> => {
        let value = Request::new(&graph, block, out_port, &options.0)?.value()?;
        out.set(tagged::<ptl_value>(ValueObject::new(value)));
        Ok(())
    })
}
