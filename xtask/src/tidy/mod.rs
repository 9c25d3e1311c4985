//! `cargo xtask tidy`: the house rules that neither rustc nor clippy knows.
//!
//! Each rule is a function from text to [`Fault`]s in a file of its own. Limits that must not bind
//! somewhere are listed with their reasons in [`exceptions`].

mod dependencies;
mod exceptions;
mod frozen;
mod layers;
mod sizes;
mod source;
mod text;
mod unsafety;

use std::{fmt, path::Path};

use self::source::Source;
use crate::{Result, repository};

/// What a fault is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rule {
    LineLength,
    FileLength,
    FunctionLength,
    Parameters,
    Macro,
    Layers,
    Unsafe,
    Unfinished,
    MachinePath,
    Dependencies,
    Frozen,
    Exceptions,
}

/// A place that breaks a rule.
struct Fault {
    rule: Rule,
    path: String,
    line: usize,
    /// What it is about: a function, a macro, a dependency; empty for a line or a file.
    item: String,
    message: String,
    /// Over a limit that one should know of, but may pass.
    is_soft: bool,
}

impl Fault {
    fn new(rule: Rule, path: &str, line: usize, item: &str, message: String) -> Self {
        Self { rule, path: path.to_owned(), line, item: item.to_owned(), message, is_soft: false }
    }

    fn soft_unless(mut self, is_hard: bool) -> Self {
        self.is_soft = !is_hard;
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rule, path, line, item, message, .. } = self;
        write!(f, "{path}:{line}: {rule:?}: ")?;
        if !item.is_empty() {
            write!(f, "{item}: ")?;
        }
        f.write_str(message)
    }
}

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    let shows_soft = match arguments {
        [] => false,
        [flag] if flag == "--soft" => true,
        _ => return Err("usage: cargo xtask tidy [--soft]".into()),
    };
    let faults = check(&repository::root())?;
    let (soft, hard): (Vec<_>, Vec<_>) = faults.iter().partition(|fault| fault.is_soft);
    let shown = if shows_soft { faults.iter().collect() } else { hard.clone() };
    for fault in shown {
        println!("{fault}");
    }
    if !soft.is_empty() && !shows_soft {
        println!("{} over a soft limit (cargo xtask tidy --soft lists them)", soft.len());
    }
    if hard.is_empty() { Ok(()) } else { Err(format!("tidy: {} faults", hard.len()).into()) }
}

/// All faults of the repository.
fn check(root: &Path) -> Result<Vec<Fault>> {
    let mut faults = frozen::check(root);
    let mut sources = Vec::new();
    let machine = root.to_string_lossy();
    for path in repository::files(root)? {
        // Pictures and other binary files have no lines to check.
        let Ok(text) = std::fs::read_to_string(root.join(&path)) else { continue };
        faults.extend(text::unfinished(&path, &text));
        faults.extend(text::machine_paths(&path, &text, &machine));
        if path.ends_with("Cargo.toml") {
            faults.extend(dependencies::check(&path, &text));
        }
        if has_short_lines(&path) {
            faults.extend(sizes::lines(&path, &text));
        }
        if path.ends_with(".rs") {
            sources.push(Source::new(&path, &text));
        }
    }
    let names = layers::root_names(&sources);
    for source in &sources {
        faults.extend(sizes::file(source));
        faults.extend(sizes::functions(source));
        faults.extend(sizes::macros(source));
        faults.extend(unsafety::check(source));
        faults.extend(layers::check(source, &names));
    }
    Ok(exceptions::apply(faults, exceptions::EXCEPTIONS))
}

/// Whether the limit of columns holds for a file: prose, data and generated text have their own
/// ideas of a line.
fn has_short_lines(path: &str) -> bool {
    let is_code = Path::new(path).extension().and_then(|extension| extension.to_str()).is_some_and(
        |extension| ["rs", "c", "h", "hpp", "cpp", "sh", "cmake"].contains(&extension),
    );
    is_code && path != "include/ptlib/ptlib.h"
}
