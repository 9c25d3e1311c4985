//! Ids are for ever: every id that was ever released is still there, with the same meaning.
//!
//! `tests/frozen/ids.txt` lists block types, their parameters with kind and alternatives, and their
//! ports. Lines are only ever added to it: `PTLIB_BLESS=1` adds what is missing and removes
//! nothing.

use std::{collections::BTreeSet, fs};

use ptlib::{block::Registry, params::ParamKind};

use crate::picture::folder;

#[test]
fn released_ids_are_still_there() {
    let path = folder("frozen/ids.txt");
    let frozen = fs::read_to_string(&path).unwrap_or_default();
    let frozen: BTreeSet<String> = frozen.lines().map(str::to_owned).collect();
    let current = ids();
    if std::env::var_os("PTLIB_BLESS").is_some() {
        let all: Vec<&str> = frozen.union(&current).map(String::as_str).collect();
        fs::write(&path, all.join("\n") + "\n").expect("the repository can be written");
        return;
    }
    let lost: Vec<_> = frozen.difference(&current).collect();
    assert!(lost.is_empty(), "graph files rely on these, and they are gone: {lost:#?}");
    let new: Vec<_> = current.difference(&frozen).collect();
    assert!(new.is_empty(), "check the spelling, then run with PTLIB_BLESS=1: {new:#?}");
}

fn ids() -> BTreeSet<String> {
    let mut ids = BTreeSet::new();
    for spec in Registry::builtin().blocks() {
        let block = spec.about.id;
        ids.insert(format!("block \"{block}\""));
        for (number, port) in spec.about.inputs.iter().enumerate() {
            ids.insert(format!("block \"{block}\" input {number} \"{}\"", port.id));
        }
        for (number, port) in spec.about.outputs.iter().enumerate() {
            ids.insert(format!("block \"{block}\" output {number} \"{}\"", port.id));
        }
        for param in spec.params {
            let (id, kind) = (param.id, param.kind.name());
            ids.insert(format!("block \"{block}\" parameter \"{id}\" {kind}"));
            if let ParamKind::Choice(items) = param.kind {
                for (number, item) in items.iter().enumerate() {
                    ids.insert(format!(
                        "block \"{block}\" parameter \"{id}\" choice {number} \"{}\"",
                        item.id
                    ));
                }
            }
        }
    }
    ids
}
