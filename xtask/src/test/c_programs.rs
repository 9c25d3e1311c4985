//! C and C++ programs against the installable tree: built in each way that a user may choose, and
//! run.
//!
//! The programs are the examples and those of `tests/abi/dist`. Each is one file that runs without
//! arguments, in an empty folder that it may write to, and ends with 0. The plug-in for ageing heads
//! is there for those that use it.

use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use super::aging_plugin;
use crate::{
    Result,
    dist::{self, Names, Platform},
    process::{self, LIBRARY_PATH, empty_folder, tool},
    repository,
};

/// The folders that programs are in.
const FOLDERS: [&str; 3] = ["examples/c", "examples/cpp", "tests/abi/dist"];

/// Warnings that a program, and the header that it includes, must not give.
const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-pedantic-errors", "-Werror"];

/// The tree that the step `dist` made.
fn tree() -> PathBuf {
    dist::Options::default().out
}

/// One program in source.
struct Program {
    source: PathBuf,
    is_cpp: bool,
}

impl Program {
    /// All programs, C ones first.
    fn all() -> Result<Vec<Self>> {
        let mut programs = Vec::new();
        for (extension, is_cpp) in [("c", false), ("cpp", true)] {
            for folder in FOLDERS {
                let sources = repository::files_in(&repository::root().join(folder), extension)?;
                programs.extend(sources.into_iter().map(|source| Self { source, is_cpp }));
            }
        }
        if programs.is_empty() { Err("there are no C programs".into()) } else { Ok(programs) }
    }

    fn name(&self) -> String {
        let stem = self.source.file_stem().unwrap_or_default().to_string_lossy();
        format!("{stem}-{}", if self.is_cpp { "cpp" } else { "c" })
    }

    /// Compiles and links it with further arguments; returns the program's path.
    fn build(&self, folder: &Path, arguments: &[OsString]) -> Result<PathBuf> {
        let (compiler, standard) =
            if self.is_cpp { ("c++", "-std=c++17") } else { ("cc", "-std=c99") };
        let program = folder.join(self.name());
        let mut command = Command::new(tool(compiler)?);
        command.arg(standard).args(WARNINGS).args(["-g", "-pthread"]);
        command.arg(&self.source).arg("-o").arg(&program).args(arguments);
        process::output(&mut command)?;
        Ok(program)
    }
}

/// Runs a program, perhaps under another one, in an empty folder.
fn execute(program: &Path, library: Option<&Path>, under: &[OsString]) -> Result {
    let folder = program.with_extension("run");
    empty_folder(&folder)?;
    let mut words = under.iter().cloned().chain([program.as_os_str().to_owned()]);
    let mut command = Command::new(words.next().unwrap_or_default());
    command.args(words).current_dir(folder);
    command.env("PTLIB_EXAMPLES", repository::root().join("examples"));
    command.env(aging_plugin::VARIABLE, program.with_file_name(aging_plugin::file_name()));
    if let Some(library) = library {
        command.env(LIBRARY_PATH, library);
    }
    process::output(&mut command)?;
    println!("  {} runs", program.file_name().unwrap_or_default().to_string_lossy());
    Ok(())
}

/// A folder for the programs of a step, empty but for the plug-in that some load.
fn folder(step: &str) -> Result<PathBuf> {
    let folder = repository::target().join("c-programs").join(step);
    empty_folder(&folder)?;
    aging_plugin::build(&folder)?;
    Ok(folder)
}

/// What pkg-config says about the tree at `prefix`.
fn flags(prefix: &Path, arguments: &[&str]) -> Result<Vec<OsString>> {
    let mut command = Command::new(tool("pkg-config")?);
    command.env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig")).args(arguments).arg("ptlib");
    let output = process::output(&mut command)?;
    Ok(output.split_whitespace().map(OsString::from).collect())
}

/// The shared library carries its versioned name, and the links lead to it.
pub(super) fn soname(_: bool) -> Result {
    let version = dist::abi_version()?;
    let names = Names::new(Platform::here(), version);
    for (link, _) in names.links() {
        fs::metadata(tree().join(&link)).map_err(|error| format!("{link}: {error}"))?;
    }
    if Platform::here() != Platform::Elf {
        return Ok(());
    }
    let library = tree().join(names.shared());
    let dynamic = process::output(Command::new(tool("readelf")?).arg("-d").arg(library))?;
    let wanted = format!("Library soname: [{}]", names.soname());
    let found = dynamic.lines().find(|line| line.contains("SONAME")).unwrap_or("no SONAME");
    if found.contains(&wanted) { Ok(()) } else { Err(format!("{wanted}, but {found}").into()) }
}

/// The shared library by pkg-config.
pub(super) fn pkg_config(_: bool) -> Result {
    let folder = folder("pkg-config")?;
    let flags = flags(&tree(), &["--cflags", "--libs"])?;
    for program in Program::all()? {
        execute(&program.build(&folder, &flags)?, Some(&tree().join("lib")), &[])?;
    }
    Ok(())
}

/// The static library by `pkg-config --static`, in a copy of the tree that has no shared one: so
/// the tree can be moved, too.
pub(super) fn static_library(_: bool) -> Result {
    let folder = folder("static")?;
    let moved = folder.join("moved tree without shared library");
    for file in walk(&tree())? {
        let from = tree().join(&file);
        let is_shared = from.to_string_lossy().contains(".so") || from.is_symlink();
        if !is_shared {
            let to = moved.join(&file);
            fs::create_dir_all(to.parent().unwrap_or(&moved))?;
            fs::copy(from, to)?;
        }
    }
    // pkg-config escapes the blanks of a path for a shell, which is not there: a name without
    // blanks leads to the folder.
    let link = folder.join("moved");
    symlink(&moved, &link)?;
    let flags = flags(&link, &["--static", "--cflags", "--libs"])?;
    for program in Program::all()? {
        execute(&program.build(&folder, &flags)?, None, &[])?;
    }
    Ok(())
}

#[cfg(unix)]
fn symlink(to: &Path, link: &Path) -> Result {
    Ok(std::os::unix::fs::symlink(to, link)?)
}

#[cfg(not(unix))]
fn symlink(to: &Path, link: &Path) -> Result {
    Ok(fs::rename(to, link)?)
}

/// The files below a folder, relative to it.
fn walk(root: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.push(path.strip_prefix(root)?.to_path_buf());
            }
        }
    }
    Ok(files)
}

/// Both libraries by CMake's `find_package`.
pub(super) fn cmake(_: bool) -> Result {
    let folder = folder("cmake")?;
    let (cmake, compiler, cpp) = (tool("cmake")?, tool("cc")?, tool("c++")?);
    let mut configure = Command::new(&cmake);
    configure.arg("-S").arg(repository::root().join("tests/abi/dist")).arg("-B").arg(&folder);
    configure.arg(format!("-DCMAKE_PREFIX_PATH={}", tree().display()));
    configure.env("CC", compiler).env("CXX", cpp);
    process::output(&mut configure)?;
    process::output(Command::new(&cmake).arg("--build").arg(&folder))?;
    for program in Program::all()? {
        for kind in ["shared", "static"] {
            let program = folder.join(format!("{}-{kind}", program.name()));
            execute(&program, None, &[])?;
        }
    }
    Ok(())
}

/// Plug-ins in C and C++: what newcomers copy, and larger ones.
const PLUGINS: [&str; 4] =
    ["plugins/templates/c", "plugins/templates/cpp", "plugins/c-hexagons", "plugins/cpp-kuwahara"];

/// Plug-ins by CMake, as their READMEs say, checked by the installed `ptc`.
pub(super) fn plugins(_: bool) -> Result {
    let folder = folder("plugins")?;
    let (cmake, compiler, cpp) = (tool("cmake")?, tool("cc")?, tool("c++")?);
    let ptc = tree().join("bin").join(format!("ptc{}", std::env::consts::EXE_SUFFIX));
    for plugin in PLUGINS {
        let built = folder.join(plugin.replace('/', "-"));
        let mut configure = Command::new(&cmake);
        configure.arg("-S").arg(repository::root().join(plugin)).arg("-B").arg(&built);
        configure.arg(format!("-DCMAKE_PREFIX_PATH={}", tree().display()));
        configure.env("CC", &compiler).env("CXX", &cpp);
        process::output(&mut configure)?;
        process::output(Command::new(&cmake).arg("--build").arg(&built))?;
        let extension = &std::env::consts::DLL_EXTENSION;
        let libraries = repository::files_in(&built, extension)?;
        if libraries.is_empty() {
            return Err(format!("{plugin}: CMake builds no plug-in").into());
        }
        for library in libraries {
            process::output(Command::new(&ptc).arg("check-plugin").arg(library))?;
            println!("  {plugin} is sound");
        }
    }
    Ok(())
}

/// Every program under Valgrind.
pub(super) fn valgrind(_: bool) -> Result {
    let valgrind = tool("valgrind")?;
    let folder = folder("valgrind")?;
    let arguments = [
        "--error-exitcode=99",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,possible",
        "--quiet",
    ];
    let known = repository::root().join("tests/abi/leaks.supp");
    let mut under = vec![valgrind.into_os_string(), joined("--suppressions=", &known)];
    under.extend(arguments.map(OsString::from));
    let link = [
        joined("-I", &tree().join("include")),
        joined("-L", &tree().join("lib")),
        OsString::from("-lptlib"),
    ];
    for program in Program::all()? {
        execute(&program.build(&folder, &link)?, Some(&tree().join("lib")), &under)?;
    }
    Ok(())
}

/// Every program with AddressSanitizer, which watches the C side, and its search for leaks, which
/// watches both.
pub(super) fn sanitizer(_: bool) -> Result {
    let folder = folder("sanitizer")?;
    let mut link = vec![
        OsString::from("-fsanitize=address,undefined"),
        OsString::from("-fno-sanitize-recover=all"),
        OsString::from("-DPTL_STATIC"),
        joined("-I", &tree().join("include")),
        tree().join("lib/libptlib.a").into_os_string(),
    ];
    link.extend(native_libraries()?);
    // As in `tests/abi/leaks.supp`, in the words of the address sanitizer.
    let known = folder.join("leaks.txt");
    fs::write(&known, "leak:abi_stable\n")?;
    let under = [
        OsString::from("env"),
        OsString::from("ASAN_OPTIONS=detect_leaks=1"),
        joined("LSAN_OPTIONS=print_suppressions=0:suppressions=", &known),
    ];
    for program in Program::all()? {
        execute(&program.build(&folder, &link)?, None, &under)?;
    }
    Ok(())
}

/// What the static library needs besides, as the tree tells pkg-config.
fn native_libraries() -> Result<Vec<OsString>> {
    let text = fs::read_to_string(tree().join("lib/pkgconfig/ptlib.pc"))?;
    let line = text.lines().find_map(|line| line.strip_prefix("Libs.private:"));
    let line = line.ok_or("ptlib.pc has no line Libs.private")?;
    Ok(line.split_whitespace().map(OsString::from).collect())
}

fn joined(flag: &str, path: &Path) -> OsString {
    let mut argument = OsString::from(flag);
    argument.push(path);
    argument
}
