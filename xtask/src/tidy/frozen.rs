//! Lists that only grow: ids that are in somebody's files are there for ever.

use std::{collections::BTreeSet, path::Path, process::Command};

use super::{Fault, Rule};
use crate::process;

/// The lists; a test of ptlib holds them against the registry.
const LISTS: [&str; 1] = ["tests/frozen/ids.txt"];

/// Lines that were once in a list and are gone. Without git there is nothing to compare with.
pub(super) fn check(root: &Path) -> Vec<Fault> {
    let mut faults = Vec::new();
    for path in LISTS {
        let now = std::fs::read_to_string(root.join(path)).unwrap_or_default();
        for line in gone(&history(root, path), &now) {
            let message = format!("\"{line}\" was removed, but files of users may name it");
            faults.push(Fault::new(Rule::Frozen, path, 1, &line, message));
        }
    }
    faults
}

/// All changes of a file, uncommitted ones included, as unified diffs.
fn history(root: &Path, path: &str) -> String {
    let git = |arguments: &[&str]| {
        let mut git = Command::new("git");
        process::output(git.args(arguments).args(["--", path]).current_dir(root))
            .unwrap_or_default()
    };
    git(&["diff", "HEAD"]) + &git(&["log", "--patch", "--format="])
}

/// The lines that a history removed and `now` does not have.
fn gone(history: &str, now: &str) -> BTreeSet<String> {
    let now: BTreeSet<&str> = now.lines().collect();
    history
        .lines()
        .filter(|line| !line.starts_with("---"))
        .filter_map(|line| line.strip_prefix('-'))
        .filter(|line| !line.is_empty() && !line.starts_with('#') && !now.contains(line))
        .map(str::to_owned)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moving_a_line_is_no_removal() {
        let history = "--- a/ids.txt\n+++ b/ids.txt\n@@\n-mix\n-tile\n-# heading\n+mix\n tail\n";
        let gone = gone(history, "mix\ntail\n");
        assert_eq!(gone.into_iter().collect::<Vec<_>>(), ["tile"]);
    }
}
