//! `ptc plugins`: which plug-ins are found where, and why something is none.

mod loader;
mod options;

use std::{
    collections::BTreeSet,
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

use ptlib::{
    Engine,
    block::PluginInfo,
    plugin::{FolderOrigin, Scanned, search_folders},
    run::LogLevel,
};
use serde::Serialize;

pub(crate) use loader::PluginLoader;
pub(crate) use options::{PluginOptions, engine_for_types};

use crate::{
    description::PluginDescription,
    exit::{Exit, Fault},
    finding::{Finding, Severity},
    terminal::{self, Printable, counted},
};

/// The command's arguments.
#[derive(Debug, clap::Args)]
pub(crate) struct PluginsArguments {
    /// Show everything that is known of why a file is refused
    #[arg(long)]
    verbose: bool,

    /// Print what was found as JSON: {"places": [{"folder", "origin", "exists", "files": [...]}]}
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    options: PluginOptions,
}

/// What was found: what `--json` prints.
#[derive(Debug, Serialize)]
struct Report {
    /// In the order in which they are searched: what comes first wins.
    places: Vec<Place>,
}

/// A folder that is searched, or the files that the command line names.
#[derive(Debug, Serialize)]
struct Place {
    #[serde(skip_serializing_if = "Option::is_none")]
    folder: Option<String>,
    /// `command line`, `PTLIB_PLUGIN_PATH`, `user` or `system`.
    origin: &'static str,
    exists: bool,
    files: Vec<File>,
}

/// A file; or a folder that cannot be read.
#[derive(Debug, Serialize)]
struct File {
    path: String,
    /// `loaded`, `refused`, `repeated` if it is in an earlier place too, or `not opened` because of
    /// its name.
    state: State,
    #[serde(skip_serializing_if = "Option::is_none")]
    plugin: Option<PluginDescription>,
    /// Its block types.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    blocks: Vec<&'static str>,
    /// The number of the kind of error, as in the C interface.
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<u32>,
    /// Why it is not loaded.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// What else is known of that.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    details: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum State {
    Loaded,
    Refused,
    Repeated,
    #[serde(rename = "not opened")]
    NotOpened,
}

impl File {
    /// A file that nobody tried to load here.
    fn not_tried(path: String, state: State, reason: impl Into<String>) -> Self {
        let (plugin, kind, blocks, details) = (None, None, vec![], vec![]);
        Self { path, state, plugin, blocks, kind, reason: Some(reason.into()), details }
    }
}

/// Runs the command.
pub(crate) fn run(arguments: &PluginsArguments) -> Result<Exit, Fault> {
    arguments.options.check_folders()?;
    let report = Search::new().report(&arguments.options);
    let mut out = terminal::stdout();
    if arguments.json {
        terminal::write_json(&mut out, &report)?;
    } else {
        print(&mut out, &report, arguments.verbose)?;
        terminal::note(&summary(&report));
    }
    let is_refused = count(&report, State::Refused) > 0;
    Ok(if is_refused { Exit::Failed } else { Exit::Success })
}

/// An engine that loads, and what it says meanwhile.
struct Search {
    engine: Engine,
    said: Arc<Mutex<Vec<String>>>,
    /// Files that were seen, by their real names: a folder may be named twice.
    seen: BTreeSet<PathBuf>,
}

impl Search {
    fn new() -> Self {
        let engine = engine_for_types();
        let said = Arc::new(Mutex::new(vec![]));
        let heard = Arc::clone(&said);
        let log = move |_, message: &str| {
            heard.lock().unwrap_or_else(PoisonError::into_inner).push(message.to_owned());
        };
        engine.set_log(Some((LogLevel::Debug, Arc::new(log))));
        Self { engine, said, seen: BTreeSet::new() }
    }

    fn report(&mut self, options: &PluginOptions) -> Report {
        let mut places = vec![];
        let mut files = vec![];
        for path in &options.files {
            let outcome = self.engine.load_plugin(path);
            files.push(self.file(&Scanned { path: path.clone(), outcome }));
        }
        if !files.is_empty() {
            places.push(Place { folder: None, origin: "command line", exists: true, files });
        }
        for folder in &options.folders {
            places.push(self.place(folder, "command line"));
        }
        if !options.no_plugins {
            for folder in search_folders() {
                places.push(self.place(&folder.path, origin(folder.origin)));
            }
        }
        Report { places }
    }

    fn place(&mut self, folder: &Path, origin: &'static str) -> Place {
        let mut files = vec![];
        let mut scanned = vec![];
        self.engine.scan_plugins(&[folder.to_path_buf()], &mut |found| {
            // What a file said while it was loaded is known only until the next one comes.
            scanned.push((found.clone(), self.take_said()));
            true
        });
        for (found, details) in scanned {
            files.push(File { details, ..self.file(&found) });
        }
        files.extend(misnamed(folder));
        files.sort_by(|a, b| a.path.cmp(&b.path));
        let exists = folder.is_dir();
        Place { folder: Some(folder.display().to_string()), origin, exists, files }
    }

    fn file(&mut self, scanned: &Scanned) -> File {
        let path = scanned.path.display().to_string();
        let details = self.take_said();
        let real = fs::canonicalize(&scanned.path).unwrap_or_else(|_| scanned.path.clone());
        if !self.seen.insert(real) {
            return File::not_tried(path, State::Repeated, "is in an earlier place too");
        }
        match &scanned.outcome {
            Ok(plugin) => File {
                path,
                state: State::Loaded,
                plugin: Some(PluginDescription::of(plugin)),
                blocks: self.blocks_of(plugin),
                kind: None,
                reason: None,
                details,
            },
            Err(error) => File {
                path,
                state: State::Refused,
                plugin: None,
                blocks: vec![],
                kind: Some(error.kind() as u32),
                reason: Some(Finding::error(error).fact_of(&scanned.path)),
                details,
            },
        }
    }

    fn take_said(&self) -> Vec<String> {
        std::mem::take(&mut *self.said.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn blocks_of(&self, plugin: &'static PluginInfo) -> Vec<&'static str> {
        let registry = self.engine.registry();
        let ids = registry.blocks().into_iter().map(|spec| spec.about.id);
        let is_its = |id: &&str| registry.plugin_of(id).is_some_and(|of| std::ptr::eq(of, plugin));
        ids.filter(is_its).collect()
    }
}

fn origin(origin: FolderOrigin) -> &'static str {
    match origin {
        FolderOrigin::Variable => "PTLIB_PLUGIN_PATH",
        FolderOrigin::User => "user",
        FolderOrigin::System => "system",
    }
}

/// Shared libraries in a folder that are not named as plug-ins are, and so are never opened.
fn misnamed(folder: &Path) -> Vec<File> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let files = entries.map(|entry| entry.path()).filter(|path| path.is_file());
    let libraries = files.filter_map(|path| {
        let name = path.file_name()?.to_string_lossy().into_owned();
        let (stem, ending) = name.rsplit_once('.')?;
        let is_library = ["so", "dll", "dylib"].contains(&ending);
        let is_foreign = ending != std::env::consts::DLL_EXTENSION;
        if !is_library || stem.ends_with(".ptplugin") && !is_foreign {
            return None;
        }
        let reason = if is_foreign {
            format!("libraries of this platform end with .{}", std::env::consts::DLL_EXTENSION)
        } else {
            format!("the names of plug-ins end with .ptplugin.{ending}")
        };
        Some(File::not_tried(path.display().to_string(), State::NotOpened, reason))
    });
    libraries.collect()
}

/// Prints a heading a place, and below it some lines a file.
fn print(out: &mut impl Write, report: &Report, verbose: bool) -> io::Result<()> {
    let heading = terminal::heading();
    for place in &report.places {
        let name = place.folder.as_deref().unwrap_or("files");
        writeln!(out, "{heading}{}{heading:#} ({})", Printable(name), place.origin)?;
        if place.files.is_empty() {
            let what = if place.exists { "holds no plug-in" } else { "does not exist" };
            writeln!(out, "  {what}")?;
        }
        for file in &place.files {
            print_file(out, place, file)?;
            for detail in file.details.iter().filter(|_| verbose).flat_map(|text| text.lines()) {
                writeln!(out, "      {}", Printable(detail))?;
            }
        }
    }
    Ok(())
}

fn print_file(out: &mut impl Write, place: &Place, file: &File) -> io::Result<()> {
    let is_in_folder = place.folder.as_deref() != Some(&*file.path);
    let name = Path::new(&file.path).file_name().filter(|_| place.folder.is_some() && is_in_folder);
    let name = name.map_or(file.path.clone(), |name| name.to_string_lossy().into_owned());
    let (name, reason) = (Printable(&name), file.reason.as_deref().unwrap_or_default());
    let reason = Printable(reason);
    match (file.state, &file.plugin) {
        (State::Loaded, Some(plugin)) => {
            writeln!(out, "  {name}: {}", Printable(&plugin.in_words()))?;
            let columns = terminal::columns().saturating_sub(6);
            for line in terminal::wrap(&file.blocks.join(", "), columns) {
                writeln!(out, "      {line}")?;
            }
            Ok(())
        }
        (State::NotOpened, _) => writeln!(out, "  {name}: not opened: {reason}"),
        (State::Repeated, _) => writeln!(out, "  {name}: {reason}"),
        _ => {
            let style = terminal::severity_style(Severity::Error);
            writeln!(out, "  {name}: {style}refused:{style:#} {reason}")
        }
    }
}

fn count(report: &Report, state: State) -> usize {
    let files = report.places.iter().flat_map(|place| &place.files);
    files.filter(|file| file.state == state).count()
}

fn summary(report: &Report) -> String {
    let loaded = counted(count(report, State::Loaded), "plug-in");
    let mut summary = format!("{loaded} loaded, {} refused", count(report, State::Refused));
    if report.places.iter().all(|place| place.files.is_empty()) {
        summary.push_str("; --plugins DIR searches another folder");
    }
    summary
}
