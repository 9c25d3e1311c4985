//! The C ABI from outside: the shipped header and library, compiled and called by C and C++
//! programs, under tools that see what a program may not do with memory.
//!
//! The programs are in `../abi`. They need blocks that panic and that are slow, so they run against
//! a release build of their own with the feature `test-blocks`.
#![cfg(target_os = "linux")]

use std::{
    collections::BTreeSet,
    env, fs,
    path::{Path, PathBuf},
    process::Command,
    sync::OnceLock,
};

use crate::plugins;

/// Programs that end with 0 if everything is as it should be.
const PROGRAMS: [&str; 9] = [
    "sizes.c",
    "misuse.c",
    "lifecycle.c",
    "compute.c",
    "values.c",
    "threads.c",
    "panic.c",
    "wrapper.cpp",
    "plugins.c",
];

/// What a program may not do, not even under its breath.
const WARNINGS: [&str; 5] = ["-Wall", "-Wextra", "-pedantic-errors", "-Werror", "-g"];

/// What a program that links the static library needs besides.
const NATIVE_LIBRARIES: [&str; 6] = ["-lgcc_s", "-lutil", "-lrt", "-lpthread", "-lm", "-ldl"];

/// Functions that C++ programs call as they are, or through macros of the header.
const WITHOUT_WRAPPER: [&str; 7] = [
    "ptl_abi_sizeof",
    "ptl_abi_version",
    "ptl_compute_options_init",
    "ptl_engine_options_init",
    "ptl_error_status",
    "ptl_has_feature",
    "ptl_version_number",
];

pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a member of the workspace")
}

/// A folder for what these tests build.
pub(crate) fn scratch() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("abi")
}

/// The path of a program, or `None` if it is not there: then the test is skipped, and says so. In
/// strict runs that is a failure.
pub(crate) fn tool(name: &str) -> Option<PathBuf> {
    let path = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file());
    if found.is_none() {
        let is_strict = env::var_os("PTLIB_TEST_STRICT").is_some_and(|strict| strict == "1");
        assert!(!is_strict, "{name} is not installed");
        println!("skipped: {name} is not installed");
    }
    found
}

/// Runs a command to its end; its output is shown if it fails.
pub(crate) fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{text}{errors}", output.status);
    text
}

/// The folder with the library that the programs are linked with.
fn library() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let target = scratch().join("target");
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["build", "--release", "--package", "ptlib"]);
        cargo.args(["--no-default-features", "--features", "png,test-blocks"]);
        // What takes long and changes nothing here.
        cargo.env("CARGO_PROFILE_RELEASE_LTO", "off");
        cargo.env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "16");
        run(cargo.arg("--target-dir").arg(&target).current_dir(root()));
        let folder = target.join("release");
        let link = folder.join(soname());
        if !link.exists() {
            std::os::unix::fs::symlink("libptlib.so", link).unwrap();
        }
        folder
    })
}

fn header() -> String {
    fs::read_to_string(root().join("include/ptlib/ptlib.h")).unwrap()
}

fn soname() -> String {
    let header = header();
    let version = header.lines().find_map(|line| line.strip_prefix("#define PTL_ABI_VERSION "));
    format!("libptlib.so.{}", version.unwrap())
}

/// A compiler for a file of `../abi`, told to be strict and where the header is.
fn compiler(source: &str, standard: &str) -> Option<Command> {
    let is_cpp = standard.starts_with("c++");
    let mut command = Command::new(tool(if is_cpp { "c++" } else { "cc" })?);
    command.arg(format!("-std={standard}")).args(WARNINGS).arg("-pthread");
    let language: &[_] = if is_cpp { &["-x", "c++"] } else { &["-x", "c", "-Wstrict-prototypes"] };
    command.args(language).arg("-I").arg(root().join("include"));
    command.arg(root().join("tests/abi").join(source)).args(["-x", "none"]);
    Some(command)
}

/// Builds a program with further arguments and runs it, perhaps under another one, in an empty
/// folder.
fn build_and_run(program: &str, how: &str, arguments: &[&str], under: &[&str]) {
    let standard = if program.ends_with(".cpp") { "c++17" } else { "c99" };
    let Some(mut compiler) = compiler(program, standard) else { return };
    let folder = scratch().join(how).join(program);
    fs::create_dir_all(&folder).unwrap();
    let executable = folder.join("program");
    run(compiler.arg("-o").arg(&executable).args(arguments));
    let executable = executable.to_str().unwrap();
    let mut words = under.iter().copied().chain([executable]);
    let mut command = Command::new(words.next().unwrap());
    command.args(words).current_dir(folder).env("LD_LIBRARY_PATH", library());
    command.env("PTLIB_TEST_PLUGINS", plugin_folder());
    // As in leaks.supp, in the words of the address sanitizer.
    let leaks = scratch().join("leaks.txt");
    fs::write(&leaks, "leak:abi_stable\n").unwrap();
    command.env("LSAN_OPTIONS", format!("suppressions={}:print_suppressions=0", leaks.display()));
    run(&mut command);
}

/// A folder with a plug-in, a file that only has the name of one, and a folder with more: those of
/// the repository, in C, C++ and Rust, and one of the tests.
fn plugin_folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = scratch().join("plugin-folder");
        fs::create_dir_all(&folder).unwrap();
        if let Some(plugin) = plugins::build("points") {
            fs::copy(plugin, folder.join("points.ptplugin.so")).unwrap();
        }
        fs::write(folder.join("garbage.ptplugin.so"), b"no library").unwrap();
        let more = folder.join("more");
        fs::create_dir_all(&more).unwrap();
        let copy = |plugin: PathBuf| fs::copy(&plugin, more.join(plugin.file_name().unwrap()));
        for plugin in [plugins::hexagons(), plugins::kuwahara()].into_iter().flatten() {
            copy(plugin).unwrap();
        }
        copy(plugins::rust_plugin()).unwrap();
        for name in ["gradient_noise", "reaction_diffusion"] {
            copy(plugins::rust_library(&format!("libptlib_{name}.so"), name)).unwrap();
        }
        folder
    })
}

fn shared_library() -> [String; 2] {
    [format!("-L{}", library().display()), "-lptlib".to_owned()]
}

#[test]
fn the_header_is_clean_under_every_standard() {
    let standards =
        ["c89", "c99", "c11", "c17", "c2x", "c++98", "c++11", "c++14", "c++17", "c++20"];
    for standard in standards {
        let Some(mut compiler) = compiler("header.c", standard) else { return };
        run(compiler.arg("-fsyntax-only"));
    }
}

#[test]
fn the_wrapper_is_clean_under_newer_standards() {
    for standard in ["c++17", "c++20"] {
        let Some(mut compiler) = compiler("wrapper.cpp", standard) else { return };
        run(compiler.arg("-fsyntax-only"));
    }
}

#[test]
fn the_layout_is_the_same_on_every_platform() {
    let Some(clang) = tool("clang") else { return };
    let targets = [
        "x86_64-pc-windows-msvc",
        "i686-pc-windows-msvc",
        "aarch64-apple-darwin",
        "i686-unknown-linux-gnu",
        "armv7-unknown-linux-gnueabihf",
        "powerpc64-unknown-linux-gnu",
    ];
    for target in targets {
        let mut command = Command::new(&clang);
        command.arg(format!("--target={target}")).args(WARNINGS);
        command.args([
            "-std=c99",
            "-ffreestanding",
            "-fsyntax-only",
            "-Wno-unused-command-line-argument",
        ]);
        command.arg("-I").arg(root().join("include")).arg(root().join("tests/abi/header.c"));
        run(&mut command);
    }
}

/// The functions that a text names: `ptl_` names behind `before`.
fn names(text: &str, before: &str) -> BTreeSet<String> {
    let words = text.split(before).skip(1);
    let name = |word: &str| {
        let end = word.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        word.get(..end.unwrap_or(word.len())).unwrap_or_default().to_owned()
    };
    words.map(name).filter(|name| name.starts_with("ptl_")).collect()
}

#[test]
fn the_library_exports_what_the_list_and_the_header_say() {
    let Some(nm) = tool("nm") else { return };
    let list = fs::read_to_string(root().join("tests/abi/symbols.txt")).unwrap();
    let listed: BTreeSet<String> = list.lines().map(str::to_owned).collect();
    assert_eq!(listed, names(&header(), "PTL_CALL "), "the header's functions");
    let mut command = Command::new(nm);
    command.args(["-D", "--defined-only", "--format=just-symbols"]);
    let exported = run(command.arg(library().join("libptlib.so")));
    let exported: BTreeSet<String> = exported.lines().map(str::to_owned).collect();
    assert_eq!(listed, exported, "the library's symbols");
}

#[test]
fn every_exported_function_is_called_by_a_program() {
    let folder = root().join("tests/abi");
    let programs = PROGRAMS.map(|program| fs::read_to_string(folder.join(program)).unwrap());
    let wrapper = fs::read_to_string(root().join("include/ptlib/ptlib.hpp")).unwrap();
    for name in names(&header(), "PTL_CALL ") {
        let call = format!("{name}(");
        assert!(programs.iter().any(|program| program.contains(&call)), "{name} in C");
        let is_known = wrapper.contains(&name) || WITHOUT_WRAPPER.contains(&&*name);
        assert!(is_known, "{name} in C++");
    }
}

#[test]
fn programs_get_what_the_header_promises() {
    let library = shared_library();
    for program in PROGRAMS {
        build_and_run(program, "shared", &library.each_ref().map(String::as_str), &[]);
    }
}

#[test]
fn programs_run_clean_under_valgrind() {
    let Some(valgrind) = tool("valgrind") else { return };
    let library = shared_library();
    let under = [
        valgrind.to_str().unwrap(),
        "--quiet",
        "--error-exitcode=99",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,possible",
        &format!("--suppressions={}", root().join("tests/abi/leaks.supp").display()),
    ];
    for program in PROGRAMS {
        build_and_run(program, "valgrind", &library.each_ref().map(String::as_str), &under);
    }
}

#[test]
fn programs_with_the_static_library_run_clean_under_the_address_sanitizer() {
    let archive = library().join("libptlib.a");
    let mut arguments = vec!["-fsanitize=address", archive.to_str().unwrap()];
    arguments.extend(NATIVE_LIBRARIES);
    for program in PROGRAMS {
        build_and_run(program, "address", &arguments, &[]);
    }
}
