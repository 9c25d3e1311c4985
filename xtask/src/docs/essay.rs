//! The essay at the top of a block's file: how it works, and where the algorithm comes from.

use std::fs;

use super::registry::Block;
use crate::{Result, repository};

/// The essay of a block, as Markdown.
pub(super) fn read(block: &Block) -> Result<String> {
    let path = source(block);
    let text = fs::read_to_string(repository::root().join(&path))
        .map_err(|error| format!("{path}, where the essay of {} belongs: {error}", block.id))?;
    let essay = essay(&text);
    if essay.is_empty() { Err(format!("{path} begins without an essay").into()) } else { Ok(essay) }
}

/// The file of a block.
pub(super) fn source(block: &Block) -> String {
    let name = block.id.replace([' ', '-'], "_");
    format!("ptlib/src/blocks/{}/{name}.rs", block.family)
}

/// The doc comment of a module, without the links that only rustdoc understands.
fn essay(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    let lines: Vec<&str> = lines.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
    without_links(lines.join("\n").trim())
}

/// ``[`name`](path)`` and ``[`name`]`` become `` `name` ``.
fn without_links(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("[`") {
        plain.push_str(before);
        let Some((name, behind)) = behind.split_once("`]") else {
            plain.push_str("[`");
            rest = behind;
            continue;
        };
        plain.extend(["`", name, "`"]);
        let target = behind.strip_prefix('(').and_then(|target| target.split_once(')'));
        rest = target.map_or(behind, |(_, behind)| behind);
    }
    plain + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_of_rustdoc_become_words() {
        assert_eq!(without_links("a [`B`] c [`d()`](crate::d), [e](f)"), "a `B` c `d()`, [e](f)");
        assert_eq!(without_links("a [`B"), "a [`B");
    }

    #[test]
    fn the_essay_ends_where_the_comment_ends() {
        let source = "//! One.\n//!\n//! Two:\n//!   three.\n\n//! Four.\nuse x;\n";
        assert_eq!(essay(source), "One.\n\nTwo:\n  three.");
        assert_eq!(essay("use x;\n"), "");
    }
}
