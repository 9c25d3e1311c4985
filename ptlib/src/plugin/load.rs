//! Loading: from an entry to block types in an engine's registry.

use std::{
    collections::BTreeMap,
    ffi::CString,
    path::Path,
    sync::{Mutex, PoisonError},
};

use ptlib_plugin_abi::{PTLP_OK, ptlp_entry};

use super::{
    check::Entry,
    describe::{Described, describe},
    foreign::Foreign,
    host::host,
    library::{self, Refusal},
    services,
};
use crate::{
    block::{BlockSpec, LogLevel, PluginInfo},
    error::{Error, ErrorKind},
    run::Engine,
};

/// A plug-in whose tables were read, for as long as the process lives.
struct Plugin {
    info: PluginInfo,
    blocks: Vec<Described>,
}

/// What became of an entry: a plug-in is read, and initialised, once in a process.
type Outcome = Result<&'static Plugin, Error>;

/// By the address of the entry.
static KNOWN: Mutex<BTreeMap<usize, Outcome>> = Mutex::new(BTreeMap::new());

impl Engine {
    /// Loads a plug-in and adds its block types. Loading runs code of the file, with all rights of
    /// this program: only load what you trust. Loading one again changes nothing.
    ///
    /// # Errors
    /// [`ErrorKind::PluginLoad`], [`ErrorKind::PluginSymbol`], [`ErrorKind::PluginLayout`],
    /// [`ErrorKind::PluginAbi`], [`ErrorKind::PluginDescriptor`], [`ErrorKind::PluginInit`],
    /// [`ErrorKind::PluginDuplicate`]; each names the file.
    pub fn load_plugin(&self, path: &Path) -> Result<&'static PluginInfo, Error> {
        let loaded = library::resolve(path).map_err(Refusal::from).and_then(|path| {
            let entry = library::open(&path)?;
            // SAFETY: the file says that this is its entry.
            Ok(unsafe { self.add(entry, Some(&path)) }?)
        });
        loaded.map_err(|Refusal { error, details }| {
            if let Some(details) = details {
                self.tell(LogLevel::Debug, &format!("{}: {details}", path.display()));
            }
            in_file(path, &error)
        })
    }

    /// Adds the block types of a plug-in that is linked into this program. Adding one again changes
    /// nothing.
    ///
    /// # Errors
    /// As [`load_plugin`](Self::load_plugin).
    ///
    /// # Safety
    /// `entry` is NULL, or leads to tables as the contract asks for, which stay as they are for as
    /// long as the process lives.
    pub unsafe fn register_plugin(
        &self,
        entry: *const ptlp_entry,
    ) -> Result<&'static PluginInfo, Error> {
        // SAFETY: the caller's promise.
        unsafe { self.add(entry, None) }
    }

    /// # Safety
    /// That of [`register_plugin`](Self::register_plugin).
    unsafe fn add(
        &self,
        entry: *const ptlp_entry,
        path: Option<&Path>,
    ) -> Result<&'static PluginInfo, Error> {
        let outcome = {
            let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
            // SAFETY: the caller's promise.
            let read = || unsafe { self.read(entry, path) };
            known.entry(entry as usize).or_insert_with(read).clone()
        };
        let plugin = outcome?;
        let blocks = plugin.blocks.iter().map(|block| (block.family, block.spec));
        self.registry().add_plugin(&plugin.info, &blocks.collect::<Vec<_>>())?;
        Ok(&plugin.info)
    }

    /// # Safety
    /// That of [`register_plugin`](Self::register_plugin).
    unsafe fn read(&self, entry: *const ptlp_entry, path: Option<&Path>) -> Outcome {
        // SAFETY: the caller's promise.
        let (entry, blocks) = unsafe {
            let entry = Entry::read(entry)?;
            let blocks = entry.blocks()?;
            (entry, blocks)
        };
        let blocks = blocks.iter().map(describe).collect::<Result<_, _>>()?;
        let info = PluginInfo {
            id: entry.id.to_owned(),
            name: entry.name.to_owned(),
            vendor: entry.vendor.to_owned(),
            version: entry.version.to_owned(),
            license: entry.license.to_owned(),
            built_with: entry.built_with.to_owned(),
            path: path.map(Path::to_path_buf),
        };
        self.initialise(&entry, path)?;
        Ok(Box::leak(Box::new(Plugin { info, blocks })))
    }

    fn initialise(&self, entry: &Entry, path: Option<&Path>) -> Result<(), Error> {
        let Some(init) = entry.table.init else { return Ok(()) };
        let path = path.map(|path| path.to_string_lossy().into_owned()).unwrap_or_default();
        let path = CString::new(path).unwrap_or_default();
        // SAFETY: the contract; the host lives for ever, the path during the call.
        let status = unsafe { init(host(), path.as_ptr()) };
        let mut last = None;
        for (level, message) in services::said_outside() {
            self.tell(level, &format!("plug-in {}: {}", entry.id, message.message()));
            last = Some(message);
        }
        if status == PTLP_OK {
            return Ok(());
        }
        let message = match last {
            Some(said) => format!("`init` returned status {status}: {}", said.message()),
            None => format!("`init` returned status {status}"),
        };
        Err(Error::new(ErrorKind::PluginInit, message))
    }
}

/// The block of a plug-in behind a block type; `None` for a built-in one.
pub(super) fn foreign_of(spec: &BlockSpec) -> Option<&'static Foreign> {
    let known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let mut blocks = known.values().flatten().flat_map(|plugin| &plugin.blocks);
    blocks.find(|block| std::ptr::eq(block.spec, spec))?.foreign
}

/// `error` with the name of the file before its message.
fn in_file(path: &Path, error: &Error) -> Error {
    let message = error.message();
    let named = Error::new(error.kind(), format!("{}: {message}", path.display()));
    match error.hint() {
        Some(hint) => named.with_hint(hint),
        None => named,
    }
}
