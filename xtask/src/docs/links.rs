//! Links of the documentation: each leads to a file, and those of the book stay in the book.

use std::{fs, path::Path};

use crate::{Result, repository};

/// The folder of the book.
const BOOK: &str = "docs";

/// What is wrong with links in the book, and in the pages beside it.
pub(super) fn check(root: &Path) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for file in repository::files(root)?.iter().filter(|file| file.ends_with(".md")) {
        let is_book = file.starts_with("docs/");
        if !is_book && file.contains('/') {
            continue;
        }
        let text = fs::read_to_string(root.join(file))?;
        let folder = root.join(file).parent().unwrap_or(root).canonicalize()?;
        let book = root.join(BOOK).canonicalize()?;
        for target in targets(&text) {
            let path = target.split('#').next().unwrap_or_default();
            if path.is_empty() || target.contains("://") || target.starts_with("mailto:") {
                continue;
            }
            match folder.join(path).canonicalize() {
                Err(_) => faults.push(format!("{file}: the link to {target} leads nowhere")),
                Ok(found) if is_book && !found.starts_with(&book) => {
                    faults.push(format!("{file}: the link to {target} leads out of the book"));
                }
                Ok(_) => {}
            }
        }
    }
    Ok(faults)
}

/// Where the links and pictures of a text lead to.
fn targets(text: &str) -> Vec<&str> {
    let mut targets = Vec::new();
    let mut is_code = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code {
            let links = line.split("](").skip(1);
            targets.extend(links.filter_map(|link| link.split([')', ' ']).next()));
        }
    }
    targets
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_found_outside_of_code() {
        let text = "[a](b.md) and ![c](d/e.png \"t\")\n```\n[f](g)\n```\n[h](#i)\n";
        assert_eq!(targets(text), ["b.md", "d/e.png", "#i"]);
    }
}
