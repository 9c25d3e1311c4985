//! Which plug-ins a command loads.

use std::path::{Path, PathBuf};

use ptlib::{
    Engine, EngineOptions,
    plugin::{Scanned, search_folders},
};

use crate::{
    exit::Fault,
    finding::Finding,
    terminal::{self, Printable},
};

/// The options of all commands that need block types. Named plug-ins win over named folders, and
/// these over the usual ones.
#[derive(Debug, Clone, Default, clap::Args)]
#[command(next_help_heading = "Plug-ins (loading one runs its code)")]
pub(crate) struct PluginOptions {
    /// Load this plug-in; may be repeated
    #[arg(long = "plugin", value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,

    /// Load all plug-ins in this folder; may be repeated
    #[arg(long = "plugins", value_name = "DIR")]
    pub(super) folders: Vec<PathBuf>,

    /// Load none from the usual folders, which `ptc plugins` shows
    #[arg(long)]
    pub(super) no_plugins: bool,
}

impl PluginOptions {
    /// An engine that knows the block types, for commands that compute nothing: it needs no
    /// threads. What is refused is warned of.
    pub(crate) fn engine_for_types(&self) -> Result<Engine, Fault> {
        let engine = engine_without_threads();
        self.load(&engine, true)?;
        Ok(engine)
    }

    /// Adds the plug-ins' block types to an engine. What is refused in a folder is warned of if
    /// `warns`, because no graph may need it.
    ///
    /// # Errors
    /// Where a file or a folder that the command line names cannot be used.
    pub(crate) fn load(&self, engine: &Engine, warns: bool) -> Result<(), Fault> {
        for file in &self.files {
            engine.load_plugin(file).map_err(|error| Fault::of_file(file, &error))?;
        }
        self.check_folders()?;
        let usual = if self.no_plugins { vec![] } else { search_folders() };
        let usual = usual.into_iter().map(|folder| folder.path);
        let folders: Vec<_> = self.folders.iter().cloned().chain(usual).collect();
        engine.scan_plugins(&folders, &mut |scanned| {
            if warns && let Some(refusal) = refusal(scanned) {
                terminal::warning(&format!("{}: {refusal}", scanned.path.display()));
            }
            true
        });
        Ok(())
    }

    /// Refuses named folders that are none.
    pub(super) fn check_folders(&self) -> Result<(), Fault> {
        match self.folders.iter().find(|folder| !folder.is_dir()) {
            Some(folder) => {
                let folder = folder.display().to_string();
                let message = format!("--plugins: \"{}\" is no folder", Printable(&folder));
                Err(Fault::usage(message, "--plugin loads a single file"))
            }
            None => Ok(()),
        }
    }
}

pub(super) fn engine_without_threads() -> Engine {
    Engine::new(EngineOptions { threads: 1, cache_bytes: 0, ..Default::default() })
}

/// Why a file or folder is not used, if it is not.
pub(super) fn refusal(scanned: &Scanned) -> Option<String> {
    let error = scanned.outcome.as_ref().err()?;
    Some(fact(&scanned.path, error))
}

pub(super) fn fact(path: &Path, error: &ptlib::Error) -> String {
    Finding::error(error).fact_of(path)
}
