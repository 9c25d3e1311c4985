//! Where plug-ins are looked for.

use std::{
    collections::BTreeSet,
    env, fs,
    path::{Path, PathBuf},
};

use super::library::SUFFIX;
use crate::{
    block::PluginInfo,
    error::{Error, ErrorKind},
    run::Engine,
};

/// The variable that names folders to look for plug-ins in, separated as in `PATH`.
const VARIABLE: &str = "PTLIB_PLUGIN_PATH";

/// What became of a file, or of a folder that cannot be read.
#[derive(Debug, Clone)]
pub struct Scanned {
    /// The file.
    pub path: PathBuf,
    /// The plug-in, or why it is not used.
    pub outcome: Result<&'static PluginInfo, Error>,
}

/// A folder to look for plug-ins in. It need not exist.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SearchFolder {
    /// The folder.
    pub path: PathBuf,
    /// Why it is searched.
    pub origin: FolderOrigin,
}

/// Why a folder is searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FolderOrigin {
    /// The variable `PTLIB_PLUGIN_PATH` names it.
    Variable,
    /// It is that of the user.
    User,
    /// It is that of the system.
    System,
}

/// The folders that are usually searched, those first that win: those of the variable
/// `PTLIB_PLUGIN_PATH` (separated as in `PATH`, empty ones left out), that of the user, those of
/// the system.
#[must_use]
pub fn search_folders() -> Vec<SearchFolder> {
    let named = env::var_os(VARIABLE);
    let named = named.iter().flat_map(|names| env::split_paths(names).collect::<Vec<_>>());
    let named = named.filter(|folder| !folder.as_os_str().is_empty());
    let as_of = |origin| move |path| SearchFolder { path, origin };
    let user = user_folder().into_iter().map(as_of(FolderOrigin::User));
    let system = system_folders().into_iter().map(as_of(FolderOrigin::System));
    named.map(as_of(FolderOrigin::Variable)).chain(user).chain(system).collect()
}

/// The folder below that of a variable.
fn below(variable: &str, rest: &str) -> Option<PathBuf> {
    let folder = PathBuf::from(env::var_os(variable)?);
    folder.is_absolute().then(|| folder.join(rest))
}

fn user_folder() -> Option<PathBuf> {
    if cfg!(windows) {
        below("APPDATA", "ptlib/plugins")
    } else if cfg!(target_os = "macos") {
        below("HOME", "Library/Application Support/ptlib/plugins")
    } else {
        below("XDG_DATA_HOME", "ptlib/plugins")
            .or_else(|| below("HOME", ".local/share/ptlib/plugins"))
    }
}

fn system_folders() -> Vec<PathBuf> {
    if cfg!(windows) {
        below("ProgramFiles", "ptlib/plugins").into_iter().collect()
    } else if cfg!(target_os = "macos") {
        vec![PathBuf::from("/Library/Application Support/ptlib/plugins")]
    } else {
        ["/usr/local/lib/ptlib/plugins", "/usr/lib/ptlib/plugins"].map(PathBuf::from).to_vec()
    }
}

impl Engine {
    /// Loads every plug-in in `folders`, in their order, each folder's files by name, and adds
    /// their block types. `report` hears of each file, and of each folder that is there but cannot
    /// be read; returning false ends the search. Of two plug-ins with a block type of one id, the
    /// first wins.
    pub fn scan_plugins(&self, folders: &[PathBuf], report: &mut dyn FnMut(&Scanned) -> bool) {
        let mut seen = BTreeSet::new();
        for folder in folders {
            let files = match files_in(folder) {
                Ok(files) => files,
                Err(error) => {
                    if report(&Scanned { path: folder.clone(), outcome: Err(error) }) {
                        continue;
                    }
                    return;
                }
            };
            for path in files {
                if !seen.insert(fs::canonicalize(&path).unwrap_or_else(|_| path.clone())) {
                    continue;
                }
                let outcome = self.load_plugin(&path);
                if !report(&Scanned { path, outcome }) {
                    return;
                }
            }
        }
    }
}

/// The plug-ins in a folder, by name; none if there is no such folder.
fn files_in(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let fault =
        |error: std::io::Error| Error::new(ErrorKind::Io, format!("{}: {error}", folder.display()));
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(vec![]),
        Err(error) => return Err(fault(error)),
    };
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(fault)?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        if name.is_some_and(|name| name.ends_with(SUFFIX)) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}
