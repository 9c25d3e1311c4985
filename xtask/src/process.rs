//! Running other programs.

use std::{
    env,
    ffi::OsString,
    fmt,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use crate::{Result, repository};

/// A program that is not on this machine.
#[derive(Debug)]
pub(crate) struct MissingTool {
    /// Its name.
    pub(crate) name: &'static str,
    /// How to get it.
    pub(crate) install: &'static str,
}

impl fmt::Display for MissingTool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is not installed ({})", self.name, self.install)
    }
}

impl std::error::Error for MissingTool {}

/// The programs that the tasks use, and how to install each.
const TOOLS: &[(&str, &str)] = &[
    ("cc", "a C compiler: on Debian `apt-get install gcc`"),
    ("c++", "a C++ compiler: on Debian `apt-get install g++`"),
    ("pkg-config", "on Debian `apt-get install pkg-config`"),
    ("cmake", "on Debian `apt-get install cmake`"),
    ("valgrind", "on Debian `apt-get install valgrind`"),
    ("mcs", "on Debian `apt-get install mono-mcs`"),
    ("mono", "on Debian `apt-get install mono-runtime`"),
    ("dotnet", "the .NET SDK 8 or later: https://dotnet.microsoft.com"),
    ("readelf", "on Debian `apt-get install binutils`"),
    ("cargo-clippy", "`rustup component add clippy`"),
    ("rustfmt", "`rustup component add rustfmt`"),
    ("cargo-fuzz", "`cargo install --locked cargo-fuzz`"),
];

/// The path of a tool, or what to say about its absence. `CC` and `CXX` of the environment take
/// the place of `cc` and `c++`.
pub(crate) fn tool(name: &str) -> Result<PathBuf> {
    let (name, install) = TOOLS
        .iter()
        .find(|(known, _)| *known == name)
        .ok_or_else(|| format!("{name} is not in the list of tools"))?;
    let wanted = match *name {
        "cc" => env::var_os("CC"),
        "c++" => env::var_os("CXX"),
        _ => None,
    };
    let wanted = wanted.unwrap_or_else(|| OsString::from(name));
    find(&wanted).ok_or_else(|| MissingTool { name, install }.into())
}

fn find(program: &OsString) -> Option<PathBuf> {
    let path = env::var_os("PATH")?;
    env::split_paths(&path)
        .map(|folder| folder.join(program).with_extension(env::consts::EXE_EXTENSION))
        .find(|file| file.is_file())
}

/// Cargo, the same one that runs this task.
pub(crate) fn cargo() -> Command {
    let program = env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let mut cargo = Command::new(program);
    cargo.current_dir(repository::root());
    // What cargo says about this package to the task that it runs is not meant for packages that
    // are built from here: leaving it would compile them again and again.
    for (name, _) in env::vars_os() {
        let text = name.to_string_lossy();
        if text.starts_with("CARGO_PKG_") || text.starts_with("CARGO_MANIFEST_") {
            cargo.env_remove(name);
        }
    }
    cargo
}

/// Runs a program, showing what it prints.
pub(crate) fn run(command: &mut Command) -> Result {
    let status = command.status().map_err(|error| format!("{}: {error}", shown(command)))?;
    if status.success() { Ok(()) } else { Err(format!("{}: {status}", shown(command)).into()) }
}

/// Runs a program quietly: what it printed is shown only if it fails. Returns its output.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    command.stdin(Stdio::null());
    let output = command.output().map_err(|error| format!("{}: {error}", shown(command)))?;
    let text = String::from_utf8_lossy(&output.stdout);
    if output.status.success() {
        return Ok(text.into_owned());
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    Err(format!("{}: {}\n{text}{errors}", shown(command), output.status).into())
}

/// The command as one would type it.
fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let words: Vec<_> = words.map(|word| word.to_string_lossy().into_owned()).collect();
    words.join(" ")
}

/// The variable that tells the system's loader where to look for shared libraries first.
pub(crate) const LIBRARY_PATH: &str =
    if cfg!(target_os = "macos") { "DYLD_LIBRARY_PATH" } else { "LD_LIBRARY_PATH" };

/// An empty folder for a task's files.
pub(crate) fn empty_folder(path: &Path) -> Result {
    if path.exists() {
        std::fs::remove_dir_all(path)?;
    }
    Ok(std::fs::create_dir_all(path)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_tool_is_told_from_a_failure() {
        let error: Box<dyn std::error::Error + Send + Sync> =
            MissingTool { name: "valgrind", install: "buy one" }.into();
        assert!(error.downcast_ref::<MissingTool>().is_some());
        assert_eq!(error.to_string(), "valgrind is not installed (buy one)");
        let error = tool("teapot").unwrap_err();
        assert!(error.downcast_ref::<MissingTool>().is_none());
    }

    #[test]
    fn a_failing_program_shows_what_it_printed() {
        let error = output(cargo().arg("no-such-command")).unwrap_err().to_string();
        assert!(error.contains("no-such-command"), "{error}");
        assert!(output(cargo().arg("--version")).unwrap().starts_with("cargo "));
    }
}
