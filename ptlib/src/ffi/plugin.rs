//! Plug-ins: loading them into an engine.

use std::{
    env,
    ffi::{CString, c_char, c_void},
    path::{Path, PathBuf},
    ptr,
};

use ptlib_plugin_abi::ptlp_entry;

use super::{
    PTL_OK, engine::EngineObject, fault::c_string, handle::Handle, ptl_engine, ptl_error,
    ptl_scan_fn, ptl_scan_report, ptl_status, status::status_of,
};
use crate::{
    error::{Error, ErrorKind},
    plugin::{Scanned, search_folders},
};

/// Loads a plug-in from a file, and adds its block types to the engine. `path` is UTF-8 and ends
/// with ".ptplugin.so" (".dll", ".dylib"). This runs code of the file with all rights of your
/// program: only load what you trust. Loading one again changes nothing. Plug-ins are never
/// unloaded.
///
/// Threads: any; graphs of the engine may be computed meanwhile.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_PLUGIN_LOAD if the system cannot load the file (the
///          message has all causes), PTL_E_PLUGIN_SYMBOL if it is no plug-in, PTL_E_PLUGIN_LAYOUT,
///          PTL_E_PLUGIN_ABI, PTL_E_PLUGIN_DESCRIPTOR, PTL_E_PLUGIN_INIT, PTL_E_PLUGIN_DUPLICATE
///          if another one has a block type of the same id (the message names both).
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_load_plugin(
    engine: *mut ptl_engine,
    path: *const c_char,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; engine: Handle<ptl_engine>, path: &str => {
        engine.engine.load_plugin(Path::new(path))?;
        engine.catalogue.extend(engine.engine.registry());
        Ok(())
    })
}

/// Loads every plug-in in some folders, and adds their block types to the engine: see
/// ptl_engine_load_plugin(). `folders` are separated as in PATH; NULL for the usual ones: those of
/// the variable PTLIB_PLUGIN_PATH, that of the user, that of the system. Only files whose names end
/// with ".ptplugin.so" (".dll", ".dylib") are opened. A file that is refused does not end the
/// search, nor is it an error of this function: `report` (may be NULL) hears of each file. Of two
/// plug-ins with a block type of one id, the first wins.
///
/// Threads: any; graphs of the engine may be computed meanwhile.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_CANCELLED if `report` ended the search.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_scan_plugins(
    engine: *mut ptl_engine,
    folders: *const c_char,
    report: ptl_scan_fn,
    user_data: *mut c_void,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; engine: Handle<ptl_engine>, folders: Option<&str> => {
        let folders: Vec<PathBuf> = match folders {
            Some(folders) => env::split_paths(folders).collect(),
            None => search_folders().into_iter().map(|folder| folder.path).collect(),
        };
        let mut is_ended = false;
        engine.engine.scan_plugins(&folders, &mut |scanned| {
            engine.catalogue.extend(engine.engine.registry());
            // SAFETY: the caller's function, with the pointer that it was given for.
            is_ended = unsafe { tell(&engine, scanned, report, user_data) };
            !is_ended
        });
        if is_ended {
            let message = "the search for plug-ins was ended by `report`";
            return Err(Error::new(ErrorKind::Cancelled, message));
        }
        Ok(())
    })
}

/// Tells the caller of a file; whether to end the search.
///
/// # Safety
/// `report` may be called with `user_data`.
unsafe fn tell(
    engine: &EngineObject,
    scanned: &Scanned,
    report: ptl_scan_fn,
    user_data: *mut c_void,
) -> bool {
    let Some(report) = report else { return false };
    let path = c_string(&scanned.path.to_string_lossy());
    let texts = |texts: [&str; 4]| texts.map(c_string);
    let (status, texts): (_, [CString; 4]) = match &scanned.outcome {
        Ok(info) => (PTL_OK, texts([&info.id, &info.version, &info.built_with, ""])),
        Err(error) => (status_of(error.kind()), texts(["", "", "", &error.to_string()])),
    };
    let block_count = match &scanned.outcome {
        Ok(info) => {
            let registry = engine.engine.registry();
            let is_of = |id| registry.plugin_of(id).is_some_and(|plugin| ptr::eq(plugin, *info));
            registry.blocks().iter().filter(|spec| is_of(spec.about.id)).count()
        }
        Err(_) => 0,
    };
    let told = ptl_scan_report {
        struct_size: u32::try_from(size_of::<ptl_scan_report>()).unwrap_or_default(),
        status,
        path: path.as_ptr(),
        plugin_id: texts[0].as_ptr(),
        plugin_version: texts[1].as_ptr(),
        built_with: texts[2].as_ptr(),
        message: texts[3].as_ptr(),
        block_count: u32::try_from(block_count).unwrap_or(u32::MAX),
        reserved0: 0,
    };
    // SAFETY: the caller's promise.
    unsafe { report(&raw const told, user_data) != 0 }
}

/// Adds the block types of a plug-in that is linked into your program: `entry` is its ptlp_entry of
/// ptlib_plugin.h. Adding one again changes nothing.
///
/// Ownership: the tables are borrowed for as long as the process lives.
/// Threads:   any; graphs of the engine may be computed meanwhile.
/// Errors:    PTL_E_PLUGIN_ABI, PTL_E_PLUGIN_DESCRIPTOR, PTL_E_PLUGIN_INIT, PTL_E_PLUGIN_DUPLICATE.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_register_plugin(
    engine: *mut ptl_engine,
    entry: *const ptlp_entry,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; engine: Handle<ptl_engine> => {
        // SAFETY: the header asks for tables that stay.
        unsafe { engine.engine.register_plugin(entry) }?;
        engine.catalogue.extend(engine.engine.registry());
        Ok(())
    })
}
