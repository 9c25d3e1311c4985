//! From a file to the entry of a plug-in: the two envelopes.
//!
//! The library is opened once, with every symbol bound now (a missing one is an error here, not a
//! crash later) and none of its symbols visible to others, and never closed. `abi_stable`, which
//! opens lazily, is asked after that and gets the same library.

use std::{
    error::Error as _,
    fs::{self, File},
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
};

use ptlib_plugin_abi::{
    PTLP_ENTRY_SYMBOL,
    envelope::{LibraryError, PluginRootRef, lib_header_from_path},
    ptlp_entry,
};

use crate::error::{Error, ErrorKind};

/// How the names of plug-ins end on this platform.
pub(super) const SUFFIX: &str = if cfg!(windows) {
    ".ptplugin.dll"
} else if cfg!(target_os = "macos") {
    ".ptplugin.dylib"
} else {
    ".ptplugin.so"
};

/// Why a file is no plug-in that can be used.
pub(super) struct Refusal {
    pub(super) error: Error,
    /// What only people want to read who look for a fault.
    pub(super) details: Option<String>,
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self { error, details: None }
    }
}

fn refusal(kind: ErrorKind, message: impl Into<String>) -> Refusal {
    Error::new(kind, message).into()
}

/// The absolute path of a file that may be opened as a library: opening runs code of it, so what
/// is not called a plug-in is left alone.
pub(super) fn resolve(path: &Path) -> Result<PathBuf, Error> {
    let fault = |message| Err(Error::new(ErrorKind::PluginLoad, message));
    let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    if !name.ends_with(SUFFIX) {
        return fault(format!("the names of plug-ins end with \"{SUFFIX}\""));
    }
    let found = fs::canonicalize(path).and_then(|path| Ok((fs::metadata(&path)?, path)));
    let (metadata, path) = match found {
        Ok(found) => found,
        Err(error) => return fault(error.to_string()),
    };
    if !metadata.is_file() {
        return fault("is no regular file".to_owned());
    }
    if let Err(error) = File::open(&path) {
        return fault(error.to_string());
    }
    Ok(path)
}

/// Opens a plug-in and finds its entry. The library stays open.
pub(super) fn open(path: &Path) -> Result<*const ptlp_entry, Refusal> {
    let library = load(path)?;
    match rust_entry(path) {
        Some(entry) => entry,
        None => symbol(&library).ok_or_else(|| {
            let symbol = PTLP_ENTRY_SYMBOL.to_string_lossy();
            let message = format!("is a library, but exports no `{symbol}`: it is no plug-in");
            refusal(ErrorKind::PluginSymbol, message)
        }),
    }
}

#[cfg(unix)]
type Library = std::mem::ManuallyDrop<libloading::os::unix::Library>;
#[cfg(windows)]
type Library = std::mem::ManuallyDrop<libloading::os::windows::Library>;

#[cfg(unix)]
fn load(path: &Path) -> Result<Library, Refusal> {
    use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};
    // SAFETY: opening runs the library's constructors: that is what loading a plug-in means.
    let library = unsafe { Library::open(Some(path), RTLD_NOW | RTLD_LOCAL) };
    library.map(std::mem::ManuallyDrop::new).map_err(|error| cannot_load(&error))
}

#[cfg(windows)]
fn load(path: &Path) -> Result<Library, Refusal> {
    use libloading::os::windows::{
        LOAD_LIBRARY_SEARCH_DEFAULT_DIRS, LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR, Library,
    };
    let flags = LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_DEFAULT_DIRS;
    // SAFETY: opening runs the library's constructors: that is what loading a plug-in means.
    let library = unsafe { Library::load_with_flags(path, flags) };
    library.map(std::mem::ManuallyDrop::new).map_err(|error| cannot_load(&error))
}

/// The error of the system with all that caused it: the first says only that it failed.
fn cannot_load(error: &libloading::Error) -> Refusal {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let text = error.to_string();
        if !message.contains(&text) {
            message = format!("{message}: {text}");
        }
        cause = error.source();
    }
    let error = Error::new(ErrorKind::PluginLoad, format!("cannot be loaded: {message}"));
    let hint = "is it a library for this machine, and is everything there that it needs?";
    error.with_hint(hint).into()
}

/// The entry behind the data symbol.
fn symbol(library: &Library) -> Option<*const ptlp_entry> {
    // SAFETY: only the address is taken; the tables behind it are checked by their reader.
    let symbol = unsafe { library.get::<*const ptlp_entry>(PTLP_ENTRY_SYMBOL.to_bytes_with_nul()) };
    symbol.ok().map(|symbol| symbol.into_raw().cast_const().cast())
}

/// The entry behind the root module of `abi_stable`; `None` if there is no such module.
fn rust_entry(path: &Path) -> Option<Result<*const ptlp_entry, Refusal>> {
    let found = catch_unwind(AssertUnwindSafe(|| {
        lib_header_from_path(path)?.init_root_module::<PluginRootRef>()
    }));
    match found {
        Ok(Ok(root)) => Some(Ok((root.entry())().get())),
        Ok(Err(LibraryError::GetSymbolError { .. })) => None,
        Ok(Err(error)) => Some(Err(mismatch(&error))),
        Err(_) => {
            let message = "abi_stable panicked while it compared the layout of its tables";
            Some(Err(refusal(ErrorKind::PluginLayout, message)))
        }
    }
}

/// `abi_stable` prints hundreds of lines: they are for the log.
fn mismatch(error: &LibraryError) -> Refusal {
    let what = match error {
        LibraryError::InvalidAbiHeader(_) | LibraryError::InvalidCAbi { .. } => {
            "it was built with another version of abi_stable"
        }
        LibraryError::IncompatibleVersionNumber { .. } | LibraryError::ParseVersionError(_) => {
            "it was built with another version of ptlib-plugin-abi"
        }
        LibraryError::RootModule { .. } => "its root module could not be made",
        _ => "its tables are laid out in another way than here",
    };
    let error_text = error.to_string();
    let hint = "build it again with the ptlib-plugin of this library; the log has the details";
    Refusal {
        error: Error::new(ErrorKind::PluginLayout, what).with_hint(hint),
        details: Some(error_text),
    }
}
