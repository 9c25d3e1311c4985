//! `cargo xtask docs`: writes the reference of blocks in `docs/blocks`, and the list of it in
//! `docs/SUMMARY.md`.
//!
//! A page says what the declaration of its block says (`ptc list --json`, see [`registry`]), and
//! what the essay at the top of the block's file says ([`essay`]). So a new block gets its page
//! without another line being written. Its pictures show it at its defaults and at two settings
//! that [`settings`] derives from the declaration, unless the block's file gives better ones
//! ([`examples`]); `--pictures` draws them ([`pictures`]).
//!
//! Pages and pictures are committed, so that they can be read in the repository. `--check` fails
//! if pages are not what the declarations give, if pictures are missing or left over, or if a link
//! of the documentation leads nowhere ([`links`]). It draws nothing, so it is fast.

mod essay;
mod examples;
mod index;
mod links;
mod markdown;
mod page;
mod pictures;
mod registry;
mod settings;

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::PathBuf,
};

use self::registry::{Block, Role};
use crate::{Result, process, repository};

const USAGE: &str = "usage: cargo xtask docs [--check | --pictures]";

/// The folder of the pages, and the file with the book's table of contents.
const FOLDER: &str = "docs/blocks";
const SUMMARY: &str = "docs/SUMMARY.md";

/// The folder of the pictures.
const PICTURES: &str = "docs/blocks/pictures";

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        [] => write(&registry::read(&ptc()?)?),
        ["--pictures"] => {
            let ptc = ptc()?;
            let blocks = registry::read(&ptc)?;
            pictures::draw(&ptc, &blocks)?;
            write(&blocks)
        }
        ["--check"] => check(&registry::read(&ptc()?)?),
        _ => Err(USAGE.into()),
    }
}

/// Builds `ptc` and tells where it is.
fn ptc() -> Result<PathBuf> {
    process::output(process::cargo().args(["build", "--locked", "--package", "ptc"]))?;
    let file = repository::target().join("debug/ptc");
    Ok(file.with_extension(std::env::consts::EXE_EXTENSION))
}

/// What the files should say, by their paths in the repository.
fn generate(blocks: &[Block]) -> Result<BTreeMap<String, String>> {
    let mut files = BTreeMap::new();
    for block in blocks {
        let essay = essay::read(block)?;
        files.insert(format!("{FOLDER}/{}.md", block.slug()), page::page(block, &essay));
    }
    files.insert(format!("{FOLDER}/index.md"), index::index(blocks));
    let summary = fs::read_to_string(repository::root().join(SUMMARY))?.replace("\r\n", "\n");
    files.insert(SUMMARY.to_owned(), index::summary(&summary, blocks)?);
    Ok(files)
}

fn write(blocks: &[Block]) -> Result {
    let root = repository::root();
    let files = generate(blocks)?;
    fs::create_dir_all(root.join(FOLDER))?;
    for file in leftovers(blocks, &files)? {
        fs::remove_file(root.join(file))?;
    }
    for (path, text) in &files {
        fs::write(root.join(path), text)?;
    }
    Ok(())
}

fn check(blocks: &[Block]) -> Result {
    let root = repository::root();
    let files = generate(blocks)?;
    let mut faults = Vec::new();
    for (path, text) in &files {
        match fs::read_to_string(root.join(path)) {
            Ok(committed) if committed.replace("\r\n", "\n") == *text => {}
            Ok(_) => faults.push(format!("{path} is not what the blocks declare")),
            Err(error) => faults.push(format!("{path}: {error}")),
        }
    }
    let leftovers = leftovers(blocks, &files)?.into_iter();
    faults.extend(leftovers.map(|file| format!("{file} belongs to no block")));
    faults.extend(links::check(&root)?);
    if faults.is_empty() {
        return Ok(());
    }
    faults.push("hint: `cargo xtask docs` writes the pages, `--pictures` the pictures too".into());
    Err(faults.join("\n").into())
}

/// Files among the pages and pictures that no block has.
fn leftovers(blocks: &[Block], pages: &BTreeMap<String, String>) -> Result<Vec<String>> {
    let drawn = blocks.iter().filter(|block| has_pictures(block));
    let mut pictures: BTreeSet<String> = drawn.flat_map(pictures::paths).collect();
    pictures.extend(pictures::CARDS.map(|(name, _)| format!("{PICTURES}/{name}")));
    let mut files = Vec::new();
    for (folder, extension) in [(FOLDER, "md"), (PICTURES, "png")] {
        for file in repository::files_in(&repository::root().join(folder), extension)? {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            files.push(format!("{folder}/{name}"));
        }
    }
    files.retain(|file| !pages.contains_key(file) && !pictures.contains(file));
    Ok(files)
}

/// Whether there is something to see: results and files show what they are given, and some values
/// are no pictures, nor does a block make one of them.
fn has_pictures(block: &Block) -> bool {
    let shows = |kind: &str| matches!(kind, "image" | "gradient" | "text");
    matches!(block.role, Role::Inner | Role::Input)
        && block.outputs.first().is_some_and(|output| shows(&output.kind))
}
