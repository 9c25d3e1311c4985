//! `cargo xtask dist`: the tree that a user of the C ABI installs.
//!
//! ```text
//! bin/ptc
//! include/ptlib/*.h *.hpp
//! lib/libptlib.so → .so.0 → .so.0.1.0   lib/libptlib.a
//! lib/pkgconfig/ptlib.pc                 lib/cmake/ptlib/ptlib-config.cmake
//! share/doc/ptlib/LICENSE-*
//! ```
//!
//! The tree may be moved: neither file names the place where it was made.

mod cmake;
mod names;
mod pkgconfig;

use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
};

pub(crate) use self::names::{Names, Platform};
use crate::{
    Result,
    process::{self, cargo},
    repository::{self, VERSION},
};

/// How the tree is made.
pub(crate) struct Options {
    /// Where.
    pub(crate) out: PathBuf,
    /// Whether to build without optimisation.
    pub(crate) is_debug: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { out: repository::target().join("dist"), is_debug: false }
    }
}

impl Options {
    fn profile(&self) -> &'static [&'static str] {
        if self.is_debug { &[] } else { &["--release"] }
    }

    /// Where cargo puts what it builds.
    fn built(&self) -> PathBuf {
        repository::target().join(if self.is_debug { "debug" } else { "release" })
    }
}

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    const USAGE: &str = "usage: cargo xtask dist [--out DIR] [--debug]";
    let mut options = Options::default();
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--debug" => options.is_debug = true,
            "--out" => options.out = arguments.next().ok_or(USAGE)?.into(),
            _ => return Err(USAGE.into()),
        }
    }
    make(&options)?;
    println!("{}", options.out.display());
    Ok(())
}

/// Builds and lays out the tree. Files that are there already are replaced, others are left alone:
/// the tree may be laid over `/usr/local`.
pub(crate) fn make(options: &Options) -> Result {
    let names = Names::new(Platform::here(), abi_version()?);
    // Before the real build, which then has the last word about the files in the target folder.
    let native = native_libraries(options)?;
    process::run(
        cargo().args(["build", "--locked", "-p", "ptlib", "-p", "ptc"]).args(options.profile()),
    )?;
    let built = options.built();
    let out = &options.out;
    copy(&built.join(names.built_shared()), &out.join(names.shared()))?;
    for (link, target) in names.links() {
        relink(&out.join(link), target)?;
    }
    if let Some(import) = names.import() {
        copy(&built.join(import.built), &out.join(import.installed))?;
    }
    copy(&built.join(names.static_library()), &out.join("lib").join(names.static_library()))?;
    copy(&built.join(names.program("ptc")), &out.join("bin").join(names.program("ptc")))?;
    headers(&out.join("include/ptlib"))?;
    let root = repository::root();
    for file in ["LICENSE-MIT", "LICENSE-APACHE"] {
        copy(&root.join(file), &out.join("share/doc/ptlib").join(file))?;
    }
    write(&out.join("lib/pkgconfig/ptlib.pc"), &pkgconfig::file(VERSION, &native))?;
    let cmake = out.join("lib/cmake/ptlib");
    write(&cmake.join("ptlib-config.cmake"), &cmake::config(&names, &native))?;
    write(&cmake.join("ptlib-config-version.cmake"), &cmake::version(VERSION))
}

/// The counter of incompatible changes, as the committed header tells it.
pub(crate) fn abi_version() -> Result<u32> {
    let header = repository::root().join("include/ptlib/ptlib.h");
    let text =
        fs::read_to_string(&header).map_err(|error| format!("{}: {error}", header.display()))?;
    abi_version_in(&text).ok_or_else(|| "ptlib.h defines no PTL_ABI_VERSION".into())
}

fn abi_version_in(header: &str) -> Option<u32> {
    let line = header.lines().find(|line| line.starts_with("#define PTL_ABI_VERSION "))?;
    line.split_whitespace().nth(2)?.trim_end_matches(['u', 'U']).parse().ok()
}

/// What a program that links the static library has to link besides, as rustc tells it.
fn native_libraries(options: &Options) -> Result<Vec<String>> {
    // To a file, because cargo forgets what rustc printed.
    let list = options.built().join("native-static-libs.txt");
    let mut print = OsString::from("--print=native-static-libs=");
    print.push(&list);
    let mut command = cargo();
    command.args(["rustc", "--locked", "-p", "ptlib", "--lib"]).args(options.profile());
    // The libraries depend on neither; without them this takes a tenth of the time.
    command.args(["--", "-Clto=no", "-Copt-level=0"]).arg(print);
    process::output(&mut command)?;
    let list = fs::read_to_string(list)?;
    let mut libraries: Vec<String> = list.split_whitespace().map(str::to_owned).collect();
    libraries.dedup();
    Ok(libraries)
}

fn headers(out: &Path) -> Result {
    let folder = repository::root().join("include/ptlib");
    for extension in ["h", "hpp"] {
        for header in repository::files_in(&folder, extension)? {
            copy(&header, &out.join(header.file_name().unwrap_or_default()))?;
        }
    }
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Result {
    fs::create_dir_all(to.parent().ok_or("a file lies in a folder")?)?;
    // A running program or a loaded library keeps the old file; the new one is another file.
    if to.is_symlink() || to.exists() {
        fs::remove_file(to)?;
    }
    fs::copy(from, to).map_err(|error| format!("{}: {error}", from.display()))?;
    Ok(())
}

fn write(to: &Path, text: &str) -> Result {
    fs::create_dir_all(to.parent().ok_or("a file lies in a folder")?)?;
    Ok(fs::write(to, text)?)
}

/// Makes a symbolic link, in the place of one that is there.
fn relink(link: &Path, target: &str) -> Result {
    if link.is_symlink() || link.exists() {
        fs::remove_file(link)?;
    }
    #[cfg(unix)]
    std::os::unix::fs::symlink(target, link)?;
    #[cfg(not(unix))]
    fs::copy(link.with_file_name(target), link)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_tells_the_abi_version() {
        let header = "/* x */\n#define PTL_ABI_VERSION_X 7\n#define PTL_ABI_VERSION 3u\n";
        assert_eq!(abi_version_in(header), Some(3));
        assert_eq!(abi_version_in("#define PTL_VERSION 3"), None);
    }
}
