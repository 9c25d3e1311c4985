//! The plug-in for ageing heads, for the programs that use it.

use std::{
    env, fs,
    path::{Path, PathBuf},
};

use crate::{
    Result,
    process::{self, cargo},
    repository,
};

/// Tells programs the file of the plug-in.
pub(super) const VARIABLE: &str = "PTLIB_AGING_PLUGIN";

/// The name of the file.
pub(super) fn file_name() -> String {
    format!("aging.ptplugin{}", env::consts::DLL_SUFFIX)
}

/// Builds the plug-in and puts it into a folder, under the name that plug-ins have. Returns its
/// path.
pub(super) fn build(folder: &Path) -> Result<PathBuf> {
    let arguments = ["build", "--locked", "--release", "--quiet", "--package", "ptlib-aging"];
    process::run(cargo().args(arguments))?;
    let (prefix, suffix) = (env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    let built = repository::target().join("release").join(format!("{prefix}ptlib_aging{suffix}"));
    let plugin = folder.join(file_name());
    fs::copy(built, &plugin)?;
    Ok(plugin)
}
