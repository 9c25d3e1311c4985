//! What holds for a graph as a whole.

use std::{ffi::c_char, path::PathBuf};

use super::{
    PTL_PRECISION_8BIT, PTL_PRECISION_FLOAT, handle::Handle, ptl_error, ptl_graph, ptl_graph_info,
    ptl_status, structs::InOut,
};
use crate::{
    error::{Error, ErrorKind},
    math::levels::Precision,
};

/// The precision of a PTL_PRECISION_... number.
pub(super) fn precision_of(number: u32) -> Result<Precision, Error> {
    match number {
        PTL_PRECISION_8BIT => Ok(Precision::EightBit),
        PTL_PRECISION_FLOAT => Ok(Precision::Float),
        _ => {
            let message = format!(
                "`precision` is {number}, allowed PTL_PRECISION_8BIT ({PTL_PRECISION_8BIT}) and \
                 PTL_PRECISION_FLOAT ({PTL_PRECISION_FLOAT})"
            );
            Err(Error::new(ErrorKind::InvalidArgument, message))
        }
    }
}

/// Fills in what holds for the graph as a whole.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT. On error `inout` is untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_get_info(
    graph: *const ptl_graph,
    inout: *mut ptl_graph_info,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, inout: InOut<ptl_graph_info> => {
        let graph = graph.look()?;
        let settings = graph.settings();
        inout.set(&ptl_graph_info {
            struct_size: 0,
            width: settings.width,
            height: settings.height,
            supersampling: settings.supersampling,
            precision: match settings.precision {
                Precision::EightBit => PTL_PRECISION_8BIT,
                Precision::Float => PTL_PRECISION_FLOAT,
            },
            block_count: u32::try_from(graph.blocks().len()).unwrap_or(u32::MAX),
            seed: settings.seed,
        });
        Ok(())
    })
}

/// Sets the size of the graph's results in pixels.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_size(
    graph: *mut ptl_graph,
    width: u32,
    height: u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => graph.edit()?.graph.set_size(width, height))
}

/// Sets the seed of all blocks that have none of their own.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_seed(
    graph: *mut ptl_graph,
    seed: u64,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        graph.edit()?.graph.set_seed(seed);
        Ok(())
    })
}

/// Makes each pixel of the results the mean of `level` times `level`, 1 to 6.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_supersampling(
    graph: *mut ptl_graph,
    level: u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => graph.edit()?.graph.set_supersampling(level))
}

/// Sets what values are computed in: PTL_PRECISION_8BIT or PTL_PRECISION_FLOAT.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_precision(
    graph: *mut ptl_graph,
    precision: u32,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph> => {
        graph.edit()?.graph.set_precision(precision_of(precision)?);
        Ok(())
    })
}

/// Sets the folder (UTF-8) that paths in parameters are relative to and that blocks may read files
/// below; NULL for a graph that reads no files.
///
/// Threads: one at a time changes a graph.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_BUSY.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_set_folder(
    graph: *mut ptl_graph,
    folder: *const c_char,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, folder: Option<&str> => {
        graph.edit()?.graph.set_folder(folder.map(PathBuf::from));
        Ok(())
    })
}
