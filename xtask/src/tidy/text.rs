//! Checks of any text file: unfinished work, paths of one machine.

use super::{Fault, Rule, source::words};

/// Marks of unfinished work that name no issue (`#12`).
pub(super) fn unfinished(path: &str, text: &str) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (number, line) in text.lines().enumerate() {
        for word in UNFINISHED {
            let is_open = |at: &usize| !names_an_issue(&line[at + word.len()..]);
            if words(line, word).iter().any(is_open) {
                let message = format!("{word} without the number of an issue");
                faults.push(Fault::new(Rule::Unfinished, path, number + 1, "", message));
            }
        }
    }
    faults
}

/// Written in two parts, so that this file does not find itself.
const UNFINISHED: [&str; 2] = [concat!("TO", "DO"), concat!("FIX", "ME")];

fn names_an_issue(rest: &str) -> bool {
    rest.strip_prefix("(#").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// Starts of paths that exist on somebody's machine only.
const MACHINE: [&str; 4] =
    [concat!("/ho", "me/"), concat!("/ro", "ot/"), concat!("/Us", "ers/"), concat!(":\\Us", "ers")];

/// Paths that only exist on the machine of whoever wrote them. Examples are about `somebody`.
pub(super) fn machine_paths(path: &str, text: &str, root: &str) -> Vec<Fault> {
    let is_path = |line: &str, start: &str, at: usize| {
        let before = line[..at].chars().next_back();
        let is_inner = before.is_some_and(|c| c.is_alphanumeric() || "_.}-/".contains(c));
        let rest = line[at + start.len()..].trim_start_matches(['/', '\\']);
        (start.starts_with(':') || !is_inner) && !rest.starts_with("somebody")
    };
    let mut faults = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let found = MACHINE
            .iter()
            .copied()
            .chain(std::iter::once(root))
            .any(|start| line.match_indices(start).any(|(at, _)| is_path(line, start, at)));
        if found {
            let message = "a path that exists on one machine only".to_owned();
            faults.push(Fault::new(Rule::MachinePath, path, number + 1, "", message));
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unfinished_work_names_its_issue() {
        let [todo, fixme] = UNFINISHED;
        let text = format!("// {todo}: a\n// {todo}(#12): b\n// {fixme}(#): c\nnot{todo}\n");
        let lines: Vec<_> = unfinished("a.rs", &text).iter().map(|fault| fault.line).collect();
        assert_eq!(lines, [1, 3]);
    }

    #[test]
    fn paths_of_one_machine_are_found() {
        let [home, .., windows] = MACHINE;
        let text = format!(
            "see {home}ann/x\nhttps://example.org{home}\nC{windows}\\ann\n\"/src/ptlib/a\"\n\
             ${{prefix}}{home}x\nas in {home}somebody/x\n"
        );
        let faults = machine_paths("a.md", &text, "/src/ptlib");
        let lines: Vec<_> = faults.iter().map(|fault| fault.line).collect();
        assert_eq!(lines, [1, 3, 4]);
    }
}
