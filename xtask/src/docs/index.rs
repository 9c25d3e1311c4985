//! The lists of blocks: `docs/blocks/index.md`, and the part of `docs/SUMMARY.md` behind its
//! heading "Block reference".
//!
//! The list is no README.md: mdBook makes that an index.html, but leaves links to it alone.

use super::{
    markdown::{NOTICE, escaped, table},
    page::tiling,
    registry::Block,
};
use crate::Result;

/// The heading of the summary behind which everything is written here.
const HEADING: &str = "# Block reference\n";

const ABOUT: &str = "\
A block of a graph has a type. These are the types, by family; each has a page that says what it
does, what goes in and out, and what its parameters mean.

On the pages, *allowed* is what a parameter may be, and *usual* the range in which it does what one
expects: an editor's slider has it. Where the essays speak of the *specification*, they mean the
description of what PT Designer's blocks compute, whose clauses they number; *8-bit precision* is
explained in [Units and resolution](../src/units.md).

The pictures are 128 × 128 pixels. The first is the block at its defaults; the others say
which parameters they change, and to what. Files are those of `tests/conformance`. Unless a page says
otherwise, blocks that take pictures are given these, the first at slots 0, 2 and 4, the second at
slots 1 and 3, the third where a normal map is wanted:

| ![colour](pictures/given-colour.png) | ![grey](pictures/given-grey.png) | ![normal map](pictures/given-normals.png) |
|---|---|---|
";

/// The index page.
pub(super) fn index(blocks: &[Block]) -> String {
    let mut text = format!("{NOTICE}\n# Blocks\n\n{ABOUT}");
    for (family, blocks) in families(blocks) {
        let rows = blocks.iter().map(|block| [link(block), escaped(&block.summary)]);
        text.push_str(&format!("\n## {family}\n\n{}", table(["block", "what it does"], rows)));
    }
    let rows = blocks.iter().filter_map(|block| {
        block.in_pixels.as_ref().map(|lengths| [link(block), escaped(lengths)])
    });
    text.push_str("\n## Lengths in pixels\n\nThese blocks count pixels of the computation, so ");
    text.push_str("their pictures depend on its resolution.\n\n");
    text.push_str(&table(["block", "what is counted in pixels"], rows));
    let exceptions = blocks.iter().filter(|block| !block.tiles && !block.outputs.is_empty());
    text.push_str("\n## Blocks that do not always tile\n\n");
    text.push_str(&table(["block", "when"], exceptions.map(|block| [link(block), tiling(block)])));
    text.push_str("\n## Blocks that use the seed\n\n");
    let random = blocks.iter().filter(|block| block.uses_seed).map(link);
    text.push_str(&format!("{}.\n", random.collect::<Vec<_>>().join(", ")));
    text
}

fn link(block: &Block) -> String {
    format!("[{}]({}.md)", block.id, block.slug())
}

/// The summary with the list of blocks.
pub(super) fn summary(summary: &str, blocks: &[Block]) -> Result<String> {
    let (book, _) = summary
        .split_once(HEADING)
        .ok_or_else(|| format!("SUMMARY.md has no heading \"{}\"", HEADING.trim_end()))?;
    let mut text = format!("{book}{HEADING}\n- [All blocks](blocks/index.md)\n");
    for block in families(blocks).iter().flat_map(|(_, blocks)| blocks) {
        text.push_str(&format!("  - [{}](blocks/{}.md)\n", block.id, block.slug()));
    }
    Ok(text)
}

/// The blocks by family, in the order of the registry.
fn families(blocks: &[Block]) -> Vec<(&str, Vec<&Block>)> {
    let mut families: Vec<(&str, Vec<&Block>)> = Vec::new();
    for block in blocks {
        match families.iter_mut().find(|(family, _)| *family == block.family) {
            Some((_, members)) => members.push(block),
            None => families.push((&block.family, vec![block])),
        }
    }
    families
}
