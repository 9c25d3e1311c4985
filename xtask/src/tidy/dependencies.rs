//! What Cargo.toml files may depend on.

use super::{Fault, Rule};

/// The most direct dependencies of ptlib: whoever embeds it carries them all.
const MOST_OF_PTLIB: usize = 8;

/// Dependencies without a comment above them that says why, and too many of them.
pub(super) fn check(path: &str, text: &str) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut section = "";
    let mut before = "";
    let mut shipped = 0;
    for (number, line) in text.lines().map(str::trim).enumerate() {
        if line.starts_with('[') {
            section = line.trim_matches(['[', ']']);
        } else if let Some(name) = dependency(section, line) {
            shipped += usize::from(section == "dependencies");
            if !before.starts_with('#') {
                let message = format!("{name} has no comment above it that says why it is here");
                faults.push(Fault::new(Rule::Dependencies, path, number + 1, name, message));
            }
        }
        before = line;
    }
    if path == "ptlib/Cargo.toml" && shipped > MOST_OF_PTLIB {
        let message = format!("{shipped} direct dependencies, allowed {MOST_OF_PTLIB}");
        faults.push(Fault::new(Rule::Dependencies, path, 1, "", message));
    }
    faults
}

/// The name of the dependency that a line declares. Packages of this workspace need no reason.
fn dependency<'a>(section: &str, line: &'a str) -> Option<&'a str> {
    let declares = section == "dependencies" || section.ends_with("-dependencies");
    if !(declares || section.ends_with(".dependencies")) || line.starts_with('#') {
        return None;
    }
    let (name, value) = line.split_once('=')?;
    let name = name.trim();
    let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    (is_name && !value.contains("path =")).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_dependency_has_its_reason() {
        let text = "[package]\nname = \"x\"\n[dependencies]\n# Why.\na = \"1\"\nb = \"1\"\n\
                    ptlib = { path = \"../ptlib\" }\n[target.'cfg(unix)'.dependencies]\nc = \"1\"\n\
                    [dev-dependencies]\n# Why.\n\nd = { version = \"1\" }\n";
        let items: Vec<_> = check("x/Cargo.toml", text).into_iter().map(|f| f.item).collect();
        assert_eq!(items, ["b", "c", "d"]);
    }

    #[test]
    fn ptlib_depends_on_little() {
        let with = |count| {
            let list: String = (0..count).map(|i| format!("# Why.\nd{i} = \"1\"\n")).collect();
            let text = format!("[dependencies]\n{list}[dev-dependencies]\n# Why.\nx = \"1\"\n");
            check("ptlib/Cargo.toml", &text).len()
        };
        assert_eq!((with(8), with(9)), (0, 1));
    }
}
