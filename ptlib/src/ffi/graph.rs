//! Graphs: making, reading and writing them.

use std::{
    ffi::{c_char, c_void},
    path::Path,
    sync::{
        Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard,
        atomic::{AtomicBool, Ordering},
    },
};

use super::{
    bytes::BytesObject,
    engine::EngineObject,
    error::at,
    fault::Fault,
    handle::{Handle, NewHandle, Opaque, Tagged, give, tag, tagged},
    ptl_bytes, ptl_engine, ptl_error, ptl_fault, ptl_status,
    structs::InOut,
};
use crate::{
    error::{Error, ErrorKind},
    graph::Graph,
    io::{Reading, write_graph},
    run::LogLevel,
};

/// A texture: blocks and their connections. It is reference counted. Functions that take it as
/// const may run on several threads at once; of those that change it, one at a time: a second one
/// gets PTL_E_BUSY. Changing a graph while it is being computed is fine, the computation has its
/// own copy.
#[derive(Debug)]
pub struct ptl_graph {
    _opaque: [u8; 0],
}

impl Opaque for ptl_graph {
    type Object = GraphObject;
    const TAG: u32 = tag(b'g');
    const NAME: &'static str = "ptl_graph";
}

/// A graph, its engine, and what keeps threads apart.
///
/// Whoever reads waits for the lock, which is held for moments only: computations copy the graph
/// first. Two threads that edit at once would overwrite each other's work whatever the lock does,
/// so the second is told. A panic during an edit poisons the lock: the graph may be half-changed,
/// and every later call says so.
#[derive(Debug)]
pub(super) struct GraphObject {
    pub(super) engine: Arc<Tagged<EngineObject>>,
    graph: RwLock<Graph>,
    is_edited: AtomicBool,
    warnings: Arc<[Fault]>,
}

/// The right to change a graph.
#[derive(Debug)]
pub(super) struct Edit<'a> {
    pub(super) graph: RwLockWriteGuard<'a, Graph>,
    is_edited: &'a AtomicBool,
}

impl Drop for Edit<'_> {
    fn drop(&mut self) {
        self.is_edited.store(false, Ordering::Release);
    }
}

impl GraphObject {
    fn new(engine: Arc<Tagged<EngineObject>>, graph: Graph, warnings: Arc<[Fault]>) -> Self {
        Self { engine, graph: RwLock::new(graph), is_edited: AtomicBool::new(false), warnings }
    }

    /// A handle's object for a graph that was read; its warnings go to the log.
    fn read_from(engine: Arc<Tagged<EngineObject>>, reading: Reading) -> Arc<Tagged<Self>> {
        let warnings: Arc<[_]> = reading.warnings.iter().flat_map(Fault::all_of).collect();
        for warning in &reading.warnings {
            engine.log.tell(LogLevel::Warning, &warning.to_string());
        }
        tagged::<ptl_graph>(Self::new(engine, reading.graph, warnings))
    }

    /// The graph, to look at.
    pub(super) fn look(&self) -> Result<RwLockReadGuard<'_, Graph>, Error> {
        self.graph.read().map_err(half_changed)
    }

    /// The graph as it is now.
    pub(super) fn snapshot(&self) -> Result<Graph, Error> {
        Ok(self.look()?.clone())
    }

    /// The graph, to change.
    pub(super) fn edit(&self) -> Result<Edit<'_>, Error> {
        if self.is_edited.swap(true, Ordering::Acquire) {
            let message = "another thread is changing the graph";
            return Err(Error::new(ErrorKind::Busy, message)
                .with_hint("let one thread change a graph at a time, or give each its clone"));
        }
        match self.graph.write() {
            Ok(graph) => Ok(Edit { graph, is_edited: &self.is_edited }),
            Err(poison) => {
                self.is_edited.store(false, Ordering::Release);
                Err(half_changed(poison))
            }
        }
    }
}

fn half_changed<T>(_: PoisonError<T>) -> Error {
    let message = "a defect of ptlib ended an earlier change of this graph half-way";
    Error::new(ErrorKind::Internal, message).with_hint("release the graph and load it again")
}

/// Makes an empty graph.
///
/// Ownership: `out` receives one reference; release it with ptl_graph_release(). The graph keeps
///            the engine alive.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_create(
    engine: *mut ptl_engine,
    out: *mut *mut ptl_graph,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; engine: Handle<ptl_engine>, out: NewHandle<ptl_graph> => {
        let graph = engine.engine.new_graph();
        // SAFETY: handles of this type are only made by `give`.
        let engine = unsafe { engine.retain() };
        out.set(tagged::<ptl_graph>(GraphObject::new(engine, graph, Arc::new([]))));
        Ok(())
    })
}

/// Copies a graph; blocks keep their handles in the copy. It costs nothing until one of the two is
/// changed.
///
/// Ownership: `out` receives one reference; release it with ptl_graph_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_clone(
    graph: *const ptl_graph,
    out: *mut *mut ptl_graph,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, out: NewHandle<ptl_graph> => {
        let (engine, warnings) = (Arc::clone(&graph.engine), Arc::clone(&graph.warnings));
        out.set(tagged::<ptl_graph>(GraphObject::new(engine, graph.snapshot()?, warnings)));
        Ok(())
    })
}

/// Reads the contents of a graph file. Its blocks may read files only after
/// ptl_graph_set_folder(), or below the engine's `read_folders`.
///
/// Ownership: `out` receives one reference; release it with ptl_graph_release(). `data` is not
///            kept.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_PARSE with all faults of the file (see
///            ptl_error_fault_at()), PTL_E_LIMIT. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_load(
    engine: *mut ptl_engine,
    data: *const c_void,
    size: usize,
    out: *mut *mut ptl_graph,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error;
        engine: Handle<ptl_engine>, data: &[u8] = (data, size), out: NewHandle<ptl_graph> => {
        let reading = engine.engine.read_graph(data)?;
        // SAFETY: handles of this type are only made by `give`.
        out.set(GraphObject::read_from(unsafe { engine.retain() }, reading));
        Ok(())
    })
}

/// Reads a graph file. Its blocks may read files below its folder. `path` is UTF-8.
///
/// Ownership: `out` receives one reference; release it with ptl_graph_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_IO, PTL_E_PARSE with all faults of the file (see
///            ptl_error_fault_at()), PTL_E_LIMIT. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_load_file(
    engine: *mut ptl_engine,
    path: *const c_char,
    out: *mut *mut ptl_graph,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; engine: Handle<ptl_engine>, path: &str, out: NewHandle<ptl_graph> => {
        let reading = engine.engine.open_graph(Path::new(path))?;
        // SAFETY: handles of this type are only made by `give`.
        out.set(GraphObject::read_from(unsafe { engine.retain() }, reading));
        Ok(())
    })
}

/// The graph as the contents of a file. Nothing that its file said is lost.
///
/// Ownership: `out` receives the bytes; release them with ptl_bytes_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_save(
    graph: *const ptl_graph,
    out: *mut *mut ptl_bytes,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, out: NewHandle<ptl_bytes> => {
        out.set(tagged::<ptl_bytes>(BytesObject::of(&write_graph(&graph.snapshot()?))));
        Ok(())
    })
}

/// One more reference to the same graph; NULL for NULL.
///
/// Ownership: release each reference with ptl_graph_release().
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_retain(graph: *mut ptl_graph) -> *mut ptl_graph {
    // SAFETY: handles of this type are only made by `give`.
    pt_fn!(else std::ptr::null_mut(); graph: Handle<ptl_graph> => give(unsafe { graph.retain() }))
}

/// Gives up one reference; NULL is fine. Computations of the graph go on.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_release(graph: *mut ptl_graph) {
    // SAFETY: the caller gives up its reference.
    pt_fn!(else (); graph: Handle<ptl_graph> => drop(unsafe { graph.take() }));
}

/// The number of warnings of the file that the graph was read from: what the file says and the
/// graph does not follow. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_warning_count(graph: *const ptl_graph) -> u32 {
    pt_fn!(else 0; graph: Handle<ptl_graph> =>
        u32::try_from(graph.warnings.len()).unwrap_or(u32::MAX))
}

/// Fills in warning number `index`.
///
/// Ownership: the texts live as long as the graph.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_warning_at(
    graph: *const ptl_graph,
    index: u32,
    inout: *mut ptl_fault,
) -> ptl_status {
    pt_fn!(std::ptr::null_mut(); graph: Handle<ptl_graph>, inout: InOut<ptl_fault> => {
        inout.set(&at(&graph.warnings, index, "warning")?.to_c());
        Ok(())
    })
}
