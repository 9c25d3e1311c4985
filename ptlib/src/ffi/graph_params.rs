//! Parameters and seeds of a graph's blocks.

use std::ffi::c_char;

use super::{
    argument::Out,
    bytes::BytesObject,
    catalogue::{number_of, text_of},
    handle::{Handle, NewHandle, tagged},
    ptl_block, ptl_bytes, ptl_error, ptl_graph, ptl_status,
};
use crate::{
    error::{Error, ErrorKind},
    graph::{BlockId, Graph},
    params::ParamValue,
};

/// Sets a number. `count` is 1: every parameter holds one number so far.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH,
///          PTL_E_OUT_OF_RANGE, PTL_E_BUSY. On error the parameter keeps its value.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_float(
    graph: *mut ptl_graph,
    block: ptl_block,
    param: *const c_char,
    values: *const f64,
    count: u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str,
        values: &[f64] = (values, count as usize) => {
        let [value] = values else {
            let message = format!("`count` is {count}, but the parameter holds 1 number");
            return Err(Error::new(ErrorKind::InvalidArgument, message).at_parameter(param));
        };
        graph.edit()?.graph.set_float(BlockId::from_raw(block), param, *value)
    })
}

/// Sets a whole number, a flag (0 or not) or a choice (by number).
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH,
///          PTL_E_OUT_OF_RANGE, PTL_E_BUSY. On error the parameter keeps its value.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_int(
    graph: *mut ptl_graph,
    block: ptl_block,
    param: *const c_char,
    value: i64,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str => {
        graph.edit()?.graph.set_int(BlockId::from_raw(block), param, value)
    })
}

/// Sets a parameter of any type from a text: a number, "true" or "false", the id or the number of
/// an alternative, or the text itself.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_PARSE,
///          PTL_E_OUT_OF_RANGE, PTL_E_BUSY. On error the parameter keeps its value.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_text(
    graph: *mut ptl_graph,
    block: ptl_block,
    param: *const c_char,
    utf8: *const c_char,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str, utf8: &str => {
        graph.edit()?.graph.set_text(BlockId::from_raw(block), param, utf8)
    })
}

/// Sets a parameter to its default.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_reset_param(
    graph: *mut ptl_graph,
    block: ptl_block,
    param: *const c_char,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str => {
        graph.edit()?.graph.reset(BlockId::from_raw(block), param)
    })
}

/// The value of a parameter.
fn value(graph: &Graph, block: ptl_block, param: &str) -> Result<ParamValue, Error> {
    graph.get(BlockId::from_raw(block), param).cloned()
}

/// The error for asking a parameter for what it does not hold.
fn holds_other(graph: &Graph, block: ptl_block, param: &str, wanted: &str) -> Error {
    match graph.parameter(BlockId::from_raw(block), param) {
        Ok((_, spec)) => {
            let message = format!("holds a value of kind {}, not {wanted}", spec.kind.name());
            Error::new(ErrorKind::TypeMismatch, message).at_parameter(param)
        }
        Err(error) => error,
    }
}

/// The value of a parameter that is a number, a flag or a choice. `capacity` is the number of
/// `values` that there is room for; `*count` (may be NULL) becomes the number that it holds.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH,
///          PTL_E_BUFFER_TOO_SMALL. On error `values` and `count` are untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_get_float(
    graph: *const ptl_graph,
    block: ptl_block,
    param: *const c_char,
    values: *mut f64,
    capacity: u32,
    count: *mut u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str,
        values: &mut [f64] = (values, capacity as usize), count: Option<Out<u32>> => {
        let graph = graph.look()?;
        let number = number_of(&value(&graph, block, param)?)
            .ok_or_else(|| holds_other(&graph, block, param, "a number"))?;
        let [first, ..] = values else {
            let message = "`capacity` is 0, but the parameter holds 1 number";
            return Err(Error::new(ErrorKind::BufferTooSmall, message).at_parameter(param));
        };
        *first = number;
        if let Some(count) = count {
            count.set(1);
        }
        Ok(())
    })
}

/// The value of a parameter that is a whole number, a flag (0 or 1) or a choice (its number).
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH. On
///          error `out` is untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_get_int(
    graph: *const ptl_graph,
    block: ptl_block,
    param: *const c_char,
    out: *mut i64,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str, out: Out<i64> => {
        let graph = graph.look()?;
        out.set(match value(&graph, block, param)? {
            ParamValue::Int(value) => value.into(),
            ParamValue::Bool(value) => value.into(),
            ParamValue::Choice(value) => value.into(),
            _ => return Err(holds_other(&graph, block, param, "a whole number")),
        });
        Ok(())
    })
}

/// The value of a parameter of any type as a text: a choice as the id of its alternative. The text
/// is what ptl_graph_set_text() takes.
///
/// Ownership: `out` receives the text; release it with ptl_bytes_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND. On error `*out` is
///            NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_get_text(
    graph: *const ptl_graph,
    block: ptl_block,
    param: *const c_char,
    out: *mut *mut ptl_bytes,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, param: &str, out: NewHandle<ptl_bytes> => {
        let graph = graph.look()?;
        let (_, spec) = graph.parameter(BlockId::from_raw(block), param)?;
        let text = text_of(spec, &value(&graph, block, param)?);
        out.set(tagged::<ptl_bytes>(BytesObject::of(&text)));
        Ok(())
    })
}

/// Gives a block its own seed.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_block_seed(
    graph: *mut ptl_graph,
    block: ptl_block,
    seed: u64,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        graph.edit()?.graph.set_block_seed(BlockId::from_raw(block), Some(seed))
    })
}

/// Lets a block follow the seed of the graph again.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_reset_block_seed(
    graph: *mut ptl_graph,
    block: ptl_block,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        graph.edit()?.graph.set_block_seed(BlockId::from_raw(block), None)
    })
}

/// The seed of a block: `*seed` is its own, or the graph's; `*is_own` (may be NULL) is 1 if it has
/// its own, else 0.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE. On error both are untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_get_block_seed(
    graph: *const ptl_graph,
    block: ptl_block,
    seed: *mut u64,
    is_own: *mut i32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, seed: Out<u64>, is_own: Option<Out<i32>> => {
        let graph = graph.look()?;
        let own = graph.block(BlockId::from_raw(block))?.seed();
        seed.set(own.unwrap_or(graph.settings().seed));
        if let Some(is_own) = is_own {
            is_own.set(own.is_some().into());
        }
        Ok(())
    })
}
