//! Which plug-ins a command loads.

use std::path::PathBuf;

use ptlib::{Engine, EngineOptions};

use super::loader::PluginLoader;
use crate::{exit::Fault, terminal::Printable};

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
    /// Loads what the command line names into an engine. What is refused in a folder is warned of
    /// if `warns`, because no graph may need it.
    ///
    /// # Errors
    /// Where a file or a folder that the command line names cannot be used.
    pub(crate) fn load<'a>(
        &'a self,
        engine: &'a Engine,
        warns: bool,
    ) -> Result<PluginLoader<'a>, Fault> {
        // A command line that makes no sense is refused before anything is loaded.
        self.check_folders()?;
        for file in &self.files {
            engine.load_plugin(file).map_err(|error| Fault::of_file(file, &error))?;
        }
        let mut loader = PluginLoader::new(engine, !self.no_plugins, warns);
        loader.load_folders(&self.folders);
        Ok(loader)
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

/// An engine for commands that compute nothing: it needs no threads.
pub(crate) fn engine_for_types() -> Engine {
    Engine::new(EngineOptions { threads: 1, cache_bytes: 0, ..Default::default() })
}
