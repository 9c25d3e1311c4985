//! Blocks of a graph and their connections.

use std::ffi::c_char;

use super::{
    argument::Out,
    bytes::BytesObject,
    handle::{Handle, NewHandle, NewLoan, tagged},
    ptl_block, ptl_block_type, ptl_bytes, ptl_error, ptl_graph, ptl_status,
};
use crate::{
    error::{Error, ErrorKind},
    graph::BlockId,
};

/// Adds a block of type `type_id`, such as "perlin noise", with default parameters.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND, PTL_E_BUSY. On error `out` is untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_add_block(
    graph: *mut ptl_graph,
    type_id: *const c_char,
    out: *mut ptl_block,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, type_id: &str, out: Out<ptl_block> => {
        out.set(graph.edit()?.graph.add(type_id)?.to_raw());
        Ok(())
    })
}

/// Removes a block and all its connections.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_remove_block(
    graph: *mut ptl_graph,
    block: ptl_block,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        let id = BlockId::from_raw(block);
        let mut edit = graph.edit()?;
        // Its value may tell its owner that it is free: not while the graph is locked.
        let old = edit.graph.input_value(id).cloned();
        let result = edit.graph.remove(id);
        drop(edit);
        drop(old);
        result
    })
}

/// The number of blocks. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_block_count(graph: *const ptl_graph) -> u32 {
    pt_fn!(else 0; graph: Handle<ptl_graph> =>
        u32::try_from(graph.look()?.blocks().len()).unwrap_or(u32::MAX))
}

/// Block number `index`, in file order; 0 if there is none.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_block_at(graph: *const ptl_graph, index: u32) -> ptl_block {
    pt_fn!(else 0; graph: Handle<ptl_graph> =>
        graph.look()?.blocks().nth(index as usize).map_or(0, |(id, _)| id.to_raw()))
}

/// The first block, in file order, whose id in the graph's file is `file_id`; 0 if there is none.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_find_block(
    graph: *const ptl_graph,
    file_id: *const c_char,
) -> ptl_block {
    pt_fn!(else 0; graph: Handle<ptl_graph>, file_id: &str =>
        graph.look()?.find(file_id).map_or(0, BlockId::to_raw))
}

/// The result to take when one is wanted: the last block of type "end" in file order; 0 if there
/// is none.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_main_result(graph: *const ptl_graph) -> ptl_block {
    pt_fn!(else 0; graph: Handle<ptl_graph> =>
        graph.look()?.main_result().map_or(0, BlockId::to_raw))
}

/// The type of a block.
///
/// Ownership: `*out` lives as long as the graph and its engine.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if its type is unknown
///            (its plug-in is missing). On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_block_type(
    graph: *const ptl_graph,
    block: ptl_block,
    out: *mut *const ptl_block_type,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, out: NewLoan<ptl_block_type> => {
        let spec = graph.look()?.known(BlockId::from_raw(block))?;
        let found = graph.engine.catalogue.find(spec.about.id).ok_or_else(|| {
            let message = format!("the engine does not list block type \"{}\"", spec.about.id);
            Error::new(ErrorKind::Internal, message)
        })?;
        out.set(&found);
        Ok(())
    })
}

/// The id of a block in the graph's file.
///
/// Ownership: `out` receives the text; release it with ptl_bytes_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_block_id(
    graph: *const ptl_graph,
    block: ptl_block,
    out: *mut *mut ptl_bytes,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, out: NewHandle<ptl_bytes> => {
        let graph = graph.look()?;
        out.set(tagged::<ptl_bytes>(BytesObject::of(graph.block(BlockId::from_raw(block))?.id())));
        Ok(())
    })
}

/// The id of a block's type, also of an unknown type.
///
/// Ownership: `out` receives the text; release it with ptl_bytes_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_block_type_id(
    graph: *const ptl_graph,
    block: ptl_block,
    out: *mut *mut ptl_bytes,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, out: NewHandle<ptl_bytes> => {
        let graph = graph.look()?;
        let type_id = graph.block(BlockId::from_raw(block))?.type_id();
        out.set(tagged::<ptl_bytes>(BytesObject::of(type_id)));
        Ok(())
    })
}

/// Connects output `out_port` of `src` with input `in_port` of `dst`; ports count from 0. What was
/// connected there before is replaced.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if there is no such port,
///          PTL_E_TYPE_MISMATCH if the ports are of different kinds, PTL_E_CYCLE if `dst` would
///          depend on itself, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_connect(
    graph: *mut ptl_graph,
    src: ptl_block,
    out_port: u32,
    dst: ptl_block,
    in_port: u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        let (source, target) = (BlockId::from_raw(src), BlockId::from_raw(dst));
        graph.edit()?.graph.connect(source, out_port, target, in_port)
    })
}

/// Removes what is connected to an input; fine if nothing is.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if there is no such port,
///          PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_disconnect(
    graph: *mut ptl_graph,
    dst: ptl_block,
    in_port: u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        graph.edit()?.graph.disconnect(BlockId::from_raw(dst), in_port)
    })
}

/// What is connected to an input: `*src` is the block and `*out_port` its output; `*src` is 0 if
/// nothing is.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if there is no such port.
///          On error both are untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_input_source(
    graph: *const ptl_graph,
    dst: ptl_block,
    in_port: u32,
    src: *mut ptl_block,
    out_port: *mut u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, src: Out<ptl_block>, out_port: Out<u32> => {
        let graph = graph.look()?;
        let inputs = graph.block(BlockId::from_raw(dst))?.inputs();
        let source = super::error::at(inputs, in_port, "input")?;
        src.set(source.map_or(0, |source| source.block.to_raw()));
        out_port.set(source.map_or(0, |source| source.output));
        Ok(())
    })
}

/// Checks whether `output` can be computed, as far as the graph alone tells: every type that it
/// needs is known, every required input is connected, every connection is of the right kind.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_UNCONNECTED, PTL_E_TYPE_MISMATCH,
///          PTL_E_NOT_FOUND: the first fault's; ptl_error_fault_at() tells all.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_validate(
    graph: *const ptl_graph,
    output: ptl_block,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        graph.look()?.validate(BlockId::from_raw(output))
    })
}
