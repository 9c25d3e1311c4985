//! Where things are in the repository, and which files belong to it.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{Result, process};

/// The folder that holds the workspace's Cargo.toml.
pub(crate) fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().expect("xtask is a folder of the workspace").to_path_buf()
}

/// The folder that cargo builds into.
pub(crate) fn target() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => root().join(folder),
        None => root().join("target"),
    }
}

/// The version of the workspace's packages.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The files of the repository, relative to `root`, sorted: what git tracks or would track, or
/// all files if this is no git checkout.
pub(crate) fn files(root: &Path) -> Result<Vec<String>> {
    let mut files = match tracked(root) {
        Some(files) => files,
        None => walked(root)?,
    };
    files.retain(|file| root.join(file).is_file());
    files.sort();
    files.dedup();
    Ok(files)
}

fn tracked(root: &Path) -> Option<Vec<String>> {
    let arguments = ["ls-files", "-z", "--cached", "--others", "--exclude-standard"];
    let mut git = Command::new("git");
    let list = process::output(git.args(arguments).current_dir(root)).ok()?;
    Some(list.split('\0').filter(|file| !file.is_empty()).map(str::to_owned).collect())
}

fn walked(root: &Path) -> Result<Vec<String>> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            let hidden = path.file_name().is_some_and(|name| name == "target" || name == ".git");
            if path.is_dir() {
                if !hidden {
                    folders.push(path);
                }
            } else if let Some(file) = path.strip_prefix(root)?.to_str() {
                files.push(file.replace('\\', "/"));
            }
        }
    }
    Ok(files)
}

/// The files directly in `folder` whose name ends in `.EXTENSION`, sorted; none if there is no
/// such folder.
pub(crate) fn files_in(folder: &Path, extension: &str) -> Result<Vec<PathBuf>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|found| found == extension) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}
