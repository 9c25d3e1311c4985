//! `cargo xtask format [--check]`: lays out every source file of the repository.
//!
//! `cargo fmt` follows `mod` lines, and does not see those that a macro writes, such as the blocks
//! of a family. So this names each file.

use std::process::Command;

use crate::{Result, process::tool, repository};

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    let mut rustfmt = Command::new(tool("rustfmt")?);
    match arguments {
        [] => {}
        [check] if check == "--check" => {
            rustfmt.arg("--check");
        }
        _ => return Err("usage: cargo xtask format [--check]".into()),
    }
    let root = repository::root();
    let mut files = repository::files(&root)?;
    files.retain(|file| file.ends_with(".rs"));
    match rustfmt.current_dir(&root).args(&files).status()?.success() {
        true => Ok(()),
        false => Err("`cargo xtask format` lays the sources out".into()),
    }
}
