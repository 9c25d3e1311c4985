//! The plug-ins of this repository, as files that an engine can load.

use std::{
    env::{self, consts},
    fs,
    path::PathBuf,
};

use crate::Result;

/// The file of a plug-in that is built with this program: cargo puts it beside or below it, under
/// a name that plug-ins do not have, so a copy with a right name is made.
pub(crate) fn file(name: &str) -> Result<PathBuf> {
    let stem = format!("ptlib_{}", name.replace('-', "_"));
    let library = format!("{}{stem}{}", consts::DLL_PREFIX, consts::DLL_SUFFIX);
    let program = env::current_exe()?;
    let folder = program.parent().ok_or("this program lies in no folder")?;
    let places = [folder.join("deps").join(&library), folder.join(&library)];
    let found = places.iter().find(|place| place.is_file());
    let found = found.ok_or_else(|| format!("there is no {library} at {}", folder.display()))?;
    let copies = env::temp_dir().join("ptlib-bench");
    fs::create_dir_all(&copies)?;
    let copy = copies.join(format!("{name}.ptplugin{}", consts::DLL_SUFFIX));
    let bytes = fs::read(found)?;
    // A library that is loaded must not change: another file takes its name.
    if fs::read(&copy).ok().as_ref() != Some(&bytes) {
        let unfinished = copies.join(format!("{name}-{}", std::process::id()));
        fs::write(&unfinished, bytes)?;
        fs::rename(unfinished, &copy)?;
    }
    Ok(copy)
}
