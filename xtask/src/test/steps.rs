//! The steps of `cargo xtask test`, fast ones first.

use super::{c_programs, csharp};
use crate::{
    Result, bench, dist, docs, format, guide, header,
    process::{self, cargo, tool},
    repository, size, tidy,
};

/// One step.
pub(super) struct Step {
    /// Its name on the command line.
    pub(super) name: &'static str,
    /// What it checks.
    pub(super) about: &'static str,
    /// Whether `--quick` runs it as well.
    pub(super) is_quick: bool,
    /// The steps that have to pass before it.
    pub(super) needs: &'static [&'static str],
    /// Runs it; the argument tells whether missing tools are failures.
    pub(super) run: fn(is_strict: bool) -> Result,
}

/// All steps, in their order.
pub(super) const STEPS: &[Step] = &[
    quick("format", "the layout of the code is rustfmt's", |_| {
        format::run(&["--check".to_owned()])
    }),
    quick("tidy", "house rules: sizes, layers, ids, dependencies", |_| tidy::run(&[])),
    quick("header", "ptlib.h is what the sources give", |_| header::run(&["--check".to_owned()])),
    quick("reference", "docs/blocks is what the blocks declare, and links lead somewhere", |_| {
        docs::run(&["--check".to_owned()])
    }),
    quick("speed", "the tables of docs/src/speed.md are what the records give", |_| {
        bench::run(&["page", "--check"].map(str::to_owned))
    }),
    quick("clippy", "no warning of rustc or clippy", clippy),
    quick("tests", "unit tests, laws, conformance, golden images, C ABI", tests),
    slow("docs", "the documentation has no broken links", &[], rustdoc),
    slow("features", "ptlib without picture formats, and with one of them", &[], features),
    slow("guide", "CONTRIBUTING.md, replayed", &[], |_| guide::run(&[])),
    slow("dist", "the installable tree", &[], |_| dist::make(&dist::Options::default())),
    slow("size", "the shared library is small", &[], |_| size::run(&["--check".to_owned()])),
    slow("soname", "programs ask for the versioned library", &["dist"], c_programs::soname),
    slow("pkg-config", "C and C++ programs, shared library", &["dist"], c_programs::pkg_config),
    slow("static", "C and C++ programs, static library", &["dist"], c_programs::static_library),
    slow("cmake", "C and C++ programs, find_package", &["dist"], c_programs::cmake),
    slow("plugins", "plug-ins in C and C++, find_package", &["dist"], c_programs::plugins),
    slow("valgrind", "no invalid access, no leak", &["dist"], c_programs::valgrind),
    slow("sanitizer", "the same by AddressSanitizer", &["dist"], c_programs::sanitizer),
    slow("csharp", "the C# binding, under each .NET that is here", &["dist"], csharp::csharp),
    slow("simd", "the same bits without the vectoriser, and at every SIMD level", &[], simd),
    // Behind `dist`, which asks rustc about the same package and would have it compiled again.
    slow("bench", "the benchmarks give the right pictures", &[], benchmarks),
    slow("fuzz", "a short run of each fuzz target", &[], fuzz),
];

const fn quick(name: &'static str, about: &'static str, run: fn(bool) -> Result) -> Step {
    Step { name, about, is_quick: true, needs: &[], run }
}

const fn slow(
    name: &'static str,
    about: &'static str,
    needs: &'static [&'static str],
    run: fn(bool) -> Result,
) -> Step {
    Step { name, about, is_quick: false, needs, run }
}

fn clippy(_: bool) -> Result {
    tool("cargo-clippy")?;
    let arguments = ["clippy", "--locked", "--workspace", "--all-targets", "--", "-D", "warnings"];
    process::run(cargo().args(arguments))
}

/// All tests of the workspace, the examples of the documentation included.
fn tests(is_strict: bool) -> Result {
    let mut cargo = cargo();
    cargo.args(["test", "--locked", "--workspace", "--no-fail-fast"]);
    if is_strict {
        cargo.env("PTLIB_TEST_STRICT", "1");
    }
    process::run(&mut cargo)
}

fn rustdoc(_: bool) -> Result {
    let arguments = ["doc", "--locked", "--workspace", "--no-deps", "--document-private-items"];
    process::run(cargo().args(arguments).env("RUSTDOCFLAGS", "-D warnings"))
}

/// A build without any format of picture files has no warning and passes its unit tests; so does
/// one with a single format that is not PNG.
fn features(_: bool) -> Result {
    tool("cargo-clippy")?;
    for features in ["", "exr"] {
        let of_ptlib = ["--locked", "-p", "ptlib", "--no-default-features", "--features", features];
        let mut clippy = cargo();
        clippy.arg("clippy").args(of_ptlib).args(["--all-targets", "--", "-D", "warnings"]);
        process::run(&mut clippy)?;
        process::run(cargo().arg("test").args(of_ptlib).arg("--lib"))?;
    }
    Ok(())
}

/// The compiler vectorises nothing in the profile for development (level 1): what is computed there
/// is scalar, and the hashes of it are what every level has to give in the profile for release.
fn simd(_: bool) -> Result {
    let folder = repository::target().join("simd");
    process::empty_folder(&folder)?;
    for profile in ["dev", "release"] {
        let mut cargo = cargo();
        cargo.args(["test", "--locked", "-p", "ptlib-tests", "--profile", profile]);
        cargo.args(["--", "simd::", "golden::"]).env("PTLIB_HASHES", folder.join("hashes.txt"));
        process::run(&mut cargo)?;
    }
    Ok(())
}

/// Each benchmark once: a fast wrong answer is none.
fn benchmarks(_: bool) -> Result {
    let arguments = ["run", "--locked", "--release", "-p", "ptlib-bench", "--", "--check"];
    process::run(cargo().args(arguments))
}

/// How long each fuzz target runs.
const FUZZ_SECONDS: u32 = 20;

fn fuzz(_: bool) -> Result {
    let folder = repository::root().join("fuzz");
    let targets = repository::files_in(&folder.join("fuzz_targets"), "rs")?;
    if targets.is_empty() {
        return Err("fuzz/fuzz_targets has no targets".into());
    }
    tool("cargo-fuzz")?;
    for target in targets {
        let name = target.file_stem().unwrap_or_default();
        let mut command = cargo();
        command.args(["fuzz", "run", "-s", "none"]).arg(name).arg("--");
        command.arg(format!("-max_total_time={FUZZ_SECONDS}")).arg("-timeout=10");
        // The coverage that guides the fuzzer is in every compiler, behind a nightly flag.
        process::run(command.env("RUSTC_BOOTSTRAP", "1"))?;
    }
    Ok(())
}
