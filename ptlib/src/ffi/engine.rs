//! Engines: what computations share.

use std::{ffi::c_char, path::PathBuf};

use super::{
    PTL_ENGINE_NO_CACHE,
    argument::{Argument, Texts},
    catalogue::Catalogue,
    handle::{Handle, NewHandle, Opaque, give, tag, tagged},
    log::Log,
    ptl_engine_options, ptl_error, ptl_status,
    structs::{In, Uninitialised},
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    run::{Engine, EngineOptions},
};

/// What computations share: the block types, the threads, the cache, the limits. It is reference
/// counted, and any thread may use it; graphs keep theirs alive.
#[derive(Debug)]
pub struct ptl_engine {
    _opaque: [u8; 0],
}

impl Opaque for ptl_engine {
    type Object = EngineObject;
    const TAG: u32 = tag(b'e');
    const NAME: &'static str = "ptl_engine";
}

#[derive(Debug)]
pub(super) struct EngineObject {
    pub(super) engine: Engine,
    pub(super) catalogue: Catalogue,
    pub(super) log: Log,
}

/// Makes all fields 0, which means "as usual", and sets `struct_size`. Call it as
/// PTL_ENGINE_OPTIONS_INIT(&options), which gives the size that your program was built with.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_options_init(
    options: *mut ptl_engine_options,
    struct_size: usize,
) {
    pt_fn!(else (); options: Uninitialised = (options, struct_size) => options.init());
}

/// Makes an engine with the built-in block types. `options` may be NULL.
///
/// Ownership: `out` receives one reference; release it with ptl_engine_release(). Nothing of
///            `options` is kept.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_UNSUPPORTED. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_create(
    options: *const ptl_engine_options,
    out: *mut *mut ptl_engine,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; options: In<ptl_engine_options>, out: NewHandle<ptl_engine> => {
        let engine = Engine::new(engine_options(&options.0)?);
        let catalogue = Catalogue::of(engine.registry());
        out.set(tagged::<ptl_engine>(EngineObject { engine, catalogue, log: Log::default() }));
        Ok(())
    })
}

fn engine_options(options: &ptl_engine_options) -> Result<EngineOptions, Error> {
    if options.flags & !PTL_ENGINE_NO_CACHE != 0 || options.reserved0 != 0 {
        let message = "`options` has flags or reserved fields that this version does not know";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let usual = EngineOptions::default();
    let cache_bytes = match options.cache_bytes {
        _ if options.flags & PTL_ENGINE_NO_CACHE != 0 => 0,
        0 => usual.cache_bytes,
        bytes => bytes,
    };
    Ok(EngineOptions {
        threads: options.threads,
        cache_bytes,
        limits: limits(options, usual.limits),
        read_folders: folders(options.read_folders, options.read_folder_count, "read_folders")?,
        write_folders: folders(options.write_folders, options.write_folder_count, "write_folders")?,
        ..usual
    })
}

fn limits(options: &ptl_engine_options, usual: Limits) -> Limits {
    fn or<T: PartialEq + Default>(wanted: T, usual: T) -> T {
        if wanted == T::default() { usual } else { wanted }
    }
    Limits {
        memory_bytes: or(options.max_memory_bytes, usual.memory_bytes),
        file_bytes: or(options.max_file_bytes, usual.file_bytes),
        read_bytes: or(options.max_read_bytes, usual.read_bytes),
        blocks: or(options.max_blocks, usual.blocks),
        connections: or(options.max_connections, usual.connections),
        text_bytes: or(options.max_text_bytes, usual.text_bytes),
        text_symbols: or(options.max_text_symbols, usual.text_symbols),
        image_side: or(options.max_image_side, usual.image_side),
        faults: or(options.max_faults, usual.faults),
        ..usual
    }
}

fn folders(
    list: *const *const c_char,
    count: u32,
    name: &'static str,
) -> Result<Vec<PathBuf>, Error> {
    // SAFETY: callers promise that the list has as many texts as its count says.
    let texts = unsafe { <Texts<'_> as Argument<_>>::receive((list, count as usize), name) }?;
    Ok(texts.0.into_iter().map(PathBuf::from).collect())
}

/// One more reference to the same engine; NULL for NULL.
///
/// Ownership: release each reference with ptl_engine_release().
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_retain(engine: *mut ptl_engine) -> *mut ptl_engine {
    pt_fn!(else std::ptr::null_mut(); engine: Handle<ptl_engine> => {
        // SAFETY: handles of this type are only made by `give`.
        give(unsafe { engine.retain() })
    })
}

/// Gives up one reference; NULL is fine. The engine lives on as long as one of its graphs.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_release(engine: *mut ptl_engine) {
    // SAFETY: the caller gives up its reference.
    pt_fn!(else (); engine: Handle<ptl_engine> => drop(unsafe { engine.take() }));
}
