//! When plug-ins are loaded: those of the usual folders only if a block type is missing without
//! them. Loading runs code of strangers and takes time, and most graphs need none.

use std::path::{Path, PathBuf};

use ptlib::{Engine, Error, Graph, Reading, block::BlockSpec, plugin::search_folders};

use crate::{finding::Finding, terminal};

/// So many refused files are named with a block that may come from one of them.
const MOST_NAMED: usize = 3;

/// An engine, and the plug-ins that it may still need.
pub(crate) struct PluginLoader<'a> {
    engine: &'a Engine,
    /// Whether the usual folders are still to be searched.
    may_search: bool,
    warns: bool,
    /// What was refused in folders: the file and the reason.
    refused: Vec<String>,
}

impl<'a> PluginLoader<'a> {
    pub(super) fn new(engine: &'a Engine, may_search: bool, warns: bool) -> Self {
        Self { engine, may_search, warns, refused: vec![] }
    }

    pub(super) fn load_folders(&mut self, folders: &[PathBuf]) {
        self.engine.scan_plugins(folders, &mut |scanned| {
            if let Err(error) = &scanned.outcome {
                if self.warns {
                    let fact = Finding::error(error).fact_of(&scanned.path);
                    terminal::warning(&format!("{}: {fact}", scanned.path.display()));
                }
                self.refused.push(error.message().to_owned());
            }
            true
        });
    }

    /// Loads the plug-ins in the usual folders, unless that is done, or not wanted.
    ///
    /// Returns whether they were searched now.
    pub(crate) fn load_usual(&mut self) -> bool {
        let searches = std::mem::take(&mut self.may_search);
        if searches {
            let folders: Vec<_> = search_folders().into_iter().map(|folder| folder.path).collect();
            self.load_folders(&folders);
        }
        searches
    }

    /// The block type of that id.
    ///
    /// # Errors
    /// If neither the engine nor any plug-in has it.
    pub(crate) fn block_type(&mut self, id: &str) -> Result<&'static BlockSpec, Error> {
        if self.engine.registry().find(id).is_none() {
            self.load_usual();
        }
        self.engine.registry().get(id)
    }

    /// Reads a graph, with the plug-ins that it needs.
    ///
    /// # Errors
    /// As [`Engine::open_graph`].
    pub(crate) fn open_graph(&mut self, path: &Path) -> Result<Reading, Error> {
        let reading = self.engine.open_graph(path)?;
        let lacks_type = reading.graph.blocks().any(|(_, block)| block.spec().is_none());
        match lacks_type && self.load_usual() {
            true => self.engine.open_graph(path),
            false => Ok(reading),
        }
    }

    /// Says of blocks whose plug-in is missing which files were refused: one of them may be it.
    pub(crate) fn explain(&self, graph: &Graph, findings: &mut [Finding]) {
        if self.refused.is_empty() {
            return;
        }
        for finding in findings.iter_mut().filter(|finding| lacks_plugin(graph, finding)) {
            let hint = match finding.hint() {
                Some(hint) => format!("{hint}; {}", self.refused_in_words()),
                None => self.refused_in_words(),
            };
            finding.error = finding.error.clone().with_hint(hint);
        }
    }

    fn refused_in_words(&self) -> String {
        let named: Vec<_> = self.refused.iter().take(MOST_NAMED).map(String::as_str).collect();
        let mut words = format!("it may be in a file that was refused: {}", named.join("; "));
        if self.refused.len() > MOST_NAMED {
            words.push_str(&format!("; and {} more", self.refused.len() - MOST_NAMED));
        }
        words
    }
}

/// Whether a finding is about a block that comes from a plug-in which is not loaded: its file says
/// so, or its type has the form `vendor.name`, which no built-in one has.
fn lacks_plugin(graph: &Graph, finding: &Finding) -> bool {
    let block = finding.error.place().block.as_deref().and_then(|id| graph.find(id));
    block.and_then(|block| graph.block(block).ok()).is_some_and(|block| {
        block.spec().is_none() && (block.origin().is_some() || block.type_id().contains('.'))
    })
}
