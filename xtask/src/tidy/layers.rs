//! Which module of ptlib may use which: the layer rule of ARCHITECTURE.md.

use std::collections::BTreeMap;

use super::{Fault, Rule, source::Source};

/// The modules of ptlib from the lowest up: each may use itself and those before it.
const LAYERS: [&str; 11] =
    ["limits", "error", "math", "value", "params", "block", "graph", "io", "run", "plugin", "ffi"];

/// The modules that hold blocks see one path only, and nothing but the registry sees them.
const BLOCKS: &str = "blocks";
const PRELUDE: &str = "block::prelude";

/// What the root of the crate offers under another name than that of the module which it comes
/// from: `Error` → `error`, `choice` → `params`.
pub(super) type RootNames = BTreeMap<String, String>;

/// Reads what the root of ptlib offers: the `pub use module::{A, B};` lines of lib.rs, and the
/// exported macros of all modules.
pub(super) fn root_names(sources: &[Source]) -> RootNames {
    let mut names = RootNames::new();
    for source in sources {
        match module_of(&source.path) {
            Some("lib") => reexports(source, &mut names),
            Some(module) => macros(source, module, &mut names),
            None => {}
        }
    }
    names
}

fn module_of(path: &str) -> Option<&str> {
    path.strip_prefix("ptlib/src/")?.split(['/', '.']).next()
}

fn macros(source: &Source, module: &str, names: &mut RootNames) {
    for (at, attribute) in source.code.match_indices("#[macro_export]") {
        let rest = source.code[at + attribute.len()..].trim_start();
        let Some(rest) = rest.strip_prefix("macro_rules!") else { continue };
        let name = rest.split('{').next().unwrap_or("").trim();
        names.insert(name.to_owned(), module.to_owned());
    }
}

fn reexports(library: &Source, names: &mut RootNames) {
    for (at, prefix) in library.code.match_indices("pub use ") {
        let statement = &library.code[at + prefix.len()..];
        let statement = statement.split(';').next().unwrap_or("");
        let Some((module, rest)) = statement.split_once("::") else { continue };
        for name in rest.split(|c: char| !c.is_alphanumeric() && c != '_') {
            names.insert(name.to_owned(), module.trim().to_owned());
        }
    }
}

/// Uses of a module that lies above, in one file of ptlib.
pub(super) fn check(source: &Source, names: &RootNames) -> Vec<Fault> {
    let Some(module) = module_of(&source.path).filter(|module| *module != "lib") else {
        return vec![];
    };
    let mut faults = Vec::new();
    for (at, path) in crate_paths(&source.code) {
        if source.is_test(at) {
            continue;
        }
        if let Err(message) = allowed(module, &source.path, &path, names) {
            let line = source.line(at);
            faults.push(Fault::new(Rule::Layers, &source.path, line, &path, message));
        }
    }
    faults
}

fn allowed(module: &str, file: &str, path: &str, names: &RootNames) -> Result<(), String> {
    let first = path.split("::").next().unwrap_or("");
    let used = names.get(first).map_or(first, String::as_str);
    if module == BLOCKS {
        // The lists of blocks name what a list is made of; the block files see the prelude.
        let is_list = file.ends_with("mod.rs") && path == "block::Family";
        return if path == PRELUDE || path.starts_with("block::prelude::") || is_list {
            Ok(())
        } else {
            Err(format!("blocks see crate::{PRELUDE} only, not crate::{path}"))
        };
    }
    let rank = |name: &str| LAYERS.iter().position(|layer| *layer == name);
    match (rank(module), rank(used)) {
        (Some(own), Some(other)) if other <= own => Ok(()),
        (Some(_), Some(_)) => Err(format!("{module} lies below {used}, which it uses")),
        (None, _) => Err(format!("module {module} is in no layer")),
        (_, None) => Err(format!("crate::{path} is in no layer that {module} may see")),
    }
}

/// The paths behind `crate::`, without macros: of `crate::{a::B, c}` there are two, `a::B` and
/// `c`. Deeper groups count as their first path.
fn crate_paths(code: &str) -> Vec<(usize, String)> {
    let mut paths = Vec::new();
    for (at, prefix) in code.match_indices("crate::") {
        // `pub(in crate::blocks)` says who may see, not what is seen.
        if code[..at].ends_with("(in ") {
            continue;
        }
        let start = at + prefix.len();
        if code[start..].starts_with('{') {
            let end = super::source::closing(code, start);
            let mut depth = 0_usize;
            let mut item = start + 1;
            for (place, byte) in code.bytes().enumerate().take(end + 1).skip(start) {
                match byte {
                    b'{' => depth += 1,
                    b'}' => depth = depth.saturating_sub(1),
                    _ => {}
                }
                if (byte == b',' && depth == 1) || place == end {
                    paths.extend(path_at(code, item));
                    item = place + 1;
                }
            }
        } else {
            paths.extend(path_at(code, start));
        }
    }
    paths
}

/// The path that starts behind the blanks here; none for nothing and for a macro.
fn path_at(code: &str, from: usize) -> Option<(usize, String)> {
    let from = from + code[from..].find(|c: char| !c.is_whitespace())?;
    let end = code[from..].find(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
    let end = end.map_or(code.len(), |length| from + length);
    let path = code[from..end].trim_end_matches(':');
    let is_macro = code[end..].starts_with('!');
    (!path.is_empty() && !is_macro).then(|| (from, path.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(path: &str, text: &str) -> Vec<String> {
        let library = "pub use error::{Error, ErrorKind};\npub use run::Engine;\n";
        let declare = "#[macro_export]\nmacro_rules! choice { () => {} }";
        let sources = [
            Source::new("ptlib/src/lib.rs", library),
            Source::new("ptlib/src/params/declare.rs", declare),
        ];
        let faults = check(&Source::new(path, text), &root_names(&sources));
        faults.into_iter().map(|fault| format!("{}: {}", fault.line, fault.message)).collect()
    }

    #[test]
    fn lower_modules_may_be_used() {
        let text = "use crate::{\n error::{Error, ErrorKind},\n math::simd,\n};\n\
                    fn f() -> crate::Error { $crate::params!() }";
        assert_eq!(faults("ptlib/src/graph/edit.rs", text), [""; 0]);
        let text = "use crate::{io, graph::Graph, choice};\npub(in crate::ffi) fn f() {}";
        assert_eq!(faults("ptlib/src/run/engine.rs", text), [""; 0]);
    }

    #[test]
    fn higher_modules_may_not_be_used() {
        let text = "use crate::{\n    error::Error,\n    run::Engine,\n};\n";
        assert_eq!(
            faults("ptlib/src/graph/edit.rs", text),
            ["3: graph lies below run, which it uses"]
        );
        assert_eq!(
            faults("ptlib/src/math/simd.rs", "fn f(x: crate::Engine) {}"),
            ["1: math lies below run, which it uses"]
        );
        assert_eq!(faults("ptlib/src/io/xml/read.rs", "use crate::blocks::FAMILIES;").len(), 1);
        assert_eq!(faults("ptlib/src/value/kind.rs", "use crate::choice;").len(), 1);
        assert_eq!(faults("ptlib/src/stray.rs", "use crate::math::simd;").len(), 1);
    }

    #[test]
    fn blocks_see_the_prelude_only() {
        let path = "ptlib/src/blocks/noise/cells.rs";
        assert_eq!(faults(path, "use crate::block::prelude::*;"), [""; 0]);
        assert_eq!(
            faults(path, "use crate::math::simd::SimdLevel;"),
            ["1: blocks see crate::block::prelude only, not crate::math::simd::SimdLevel"]
        );
        assert_eq!(faults(path, "use crate::block::Family;").len(), 1);
        assert_eq!(faults("ptlib/src/blocks/mod.rs", "use crate::block::Family;"), [""; 0]);
    }

    #[test]
    fn comments_and_tests_may_name_everything() {
        let text = "/// See [`run`](crate::run).\n#[cfg(test)]\nmod tests { use crate::run::X; }";
        assert_eq!(faults("ptlib/src/math/mod.rs", text), [""; 0]);
    }
}
