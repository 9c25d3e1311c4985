//! The C# binding: compiled, tested and its samples run, under each .NET that is here.
//!
//! The binding has two halves from one source tree: .NET Standard 2.0, which mono compiles and
//! runs, and .NET 8, which takes a .NET SDK, or a folder with the programs `csc8` and `dotnet8`
//! that the variable `PTLIB_DOTNET8_TOOLS` names. A half that cannot run is a missing tool, unless the
//! variable `PTLIB_TEST_WITHOUT_DOTNET8` says that the second one is not wanted.

use std::{
    env,
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use super::aging_plugin;
use crate::{
    Result, dist,
    process::{self, empty_folder, tool},
    repository,
};

/// Names a folder with `csc8` (a C# 12 compiler) and `dotnet8` (a .NET 8 runtime).
const TOOLS: &str = "PTLIB_DOTNET8_TOOLS";

/// If it is set, the half for .NET 8 is left out.
const WITHOUT: &str = "PTLIB_TEST_WITHOUT_DOTNET8";

/// Assemblies of the binding: two libraries, the second uses the first; the others are programs
/// that use both.
const LIBRARY: &str = "PtLib";
const AGING: &str = "PtLib.Aging";
const LIBRARIES: [&str; 2] = [LIBRARY, AGING];
const TESTS: &str = "PtLib.Tests";
const AGING_TESTS: &str = "PtLib.Aging.Tests";
const RENDER_FILE: &str = "RenderFile";
const SAMPLES: [&str; 4] = [RENDER_FILE, "TextureClient", "ManagedBlock", "AgingClient"];

/// Files that a project takes from another one.
const SHARED: [(&str, &str); 3] = [
    (AGING, "PtLib/Native/NullableAttributes.cs"),
    (AGING_TESTS, "PtLib.Tests/Assert.cs"),
    (AGING_TESTS, "PtLib.Tests/Runner.cs"),
];

/// Native libraries that programs need besides the one they test.
struct Others {
    /// One that says to have another version.
    library: PathBuf,
    /// The plug-in for ageing heads.
    aging: PathBuf,
}

/// A .NET that is here.
enum DotNet {
    Mono { compiler: PathBuf, runtime: PathBuf },
    Tools(PathBuf),
    Sdk(PathBuf),
}

/// Runs whatever can be run, and then says what is missing.
pub(super) fn csharp(_: bool) -> Result {
    let folder = repository::target().join("csharp");
    empty_folder(&folder)?;
    let others = Others { library: other_library(&folder)?, aging: aging_plugin::build(&folder)? };
    let mut missing = None;
    let is_wanted = env::var_os(WITHOUT).is_none();
    let halves = [Some(mono()), is_wanted.then(dotnet8)];
    for found in halves.into_iter().flatten() {
        match found {
            Ok(all) => {
                for dotnet in all {
                    dotnet.check(&folder, &others)?;
                }
            }
            Err(error) => missing = Some(error),
        }
    }
    if !is_wanted {
        println!("  not tested, because of {WITHOUT}: the half for .NET 8");
    }
    missing.map_or(Ok(()), Err)
}

/// What runs the half for .NET Standard 2.0.
fn mono() -> Result<Vec<DotNet>> {
    Ok(vec![DotNet::Mono { compiler: tool("mcs")?, runtime: tool("mono")? }])
}

/// What runs the half for .NET 8: one of the two at least.
fn dotnet8() -> Result<Vec<DotNet>> {
    let tools = env::var_os(TOOLS).map(|folder| DotNet::Tools(repository::root().join(folder)));
    match (tools, tool("dotnet")) {
        (None, Err(error)) => Err(error),
        (tools, sdk) => Ok(tools.into_iter().chain(sdk.ok().map(DotNet::Sdk)).collect()),
    }
}

/// A library that says to have another version.
fn other_library(folder: &Path) -> Result<PathBuf> {
    let library = folder.join(format!("other{}", env::consts::DLL_SUFFIX));
    let source = bindings().join(TESTS).join("other_abi.c");
    let mut command = Command::new(tool("cc")?);
    command.args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source);
    process::output(&mut command)?;
    Ok(library)
}

fn bindings() -> PathBuf {
    repository::root().join("bindings/csharp")
}

fn project(name: &str) -> PathBuf {
    let samples = bindings().join("samples").join(name);
    if samples.is_dir() { samples } else { bindings().join(name) }
}

/// The C# files of a project: in its folder and those below, and those of other projects.
fn sources(name: &str) -> Result<Vec<PathBuf>> {
    let shared = SHARED.iter().filter(|(project, _)| *project == name);
    let mut files: Vec<_> = shared.map(|(_, file)| bindings().join(file)).collect();
    let mut folders = vec![project(name)];
    while let Some(folder) = folders.pop() {
        files.extend(repository::files_in(&folder, "cs")?);
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            let is_built = path.ends_with("bin") || path.ends_with("obj");
            if path.is_dir() && !is_built {
                folders.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

impl DotNet {
    const fn name(&self) -> &'static str {
        match self {
            Self::Mono { .. } => "mono",
            Self::Tools(_) => "dotnet8",
            Self::Sdk(_) => "dotnet",
        }
    }

    /// Compiles everything, runs the tests and the samples.
    fn check(&self, folder: &Path, others: &Others) -> Result {
        let folder = folder.join(self.name());
        fs::create_dir_all(&folder)?;
        for library in LIBRARIES {
            self.compile(library, &folder)?;
        }
        for tests in [TESTS, AGING_TESTS] {
            self.test(tests, &folder, others)?;
        }
        for sample in SAMPLES {
            self.compile(sample, &folder)?;
            let mut program = self.program(sample, &folder, others);
            if sample == RENDER_FILE {
                let graph = repository::root().join("examples/graphs/bark.xml");
                program.arg(graph).args(["bark.png", "64"]);
            }
            process::output(program.current_dir(&folder))?;
            println!("  {}: {sample} runs", self.name());
        }
        if let Self::Sdk(dotnet) = self {
            packages(dotnet, &folder)?;
        }
        Ok(())
    }

    /// Runs a program of tests, which counts them in its last line.
    fn test(&self, tests: &str, folder: &Path, others: &Others) -> Result {
        self.compile(tests, folder)?;
        let printed = process::output(&mut self.program(tests, folder, others))?;
        let last = printed.lines().last().unwrap_or_default();
        if !last.ends_with(" passed, 0 failed") {
            return Err(format!("{}: {tests} ends with \"{last}\"", self.name()).into());
        }
        println!("  {}: {tests}: {last}", self.name());
        Ok(())
    }

    /// Compiles a project; warnings are errors, and every public member has its comment.
    fn compile(&self, name: &str, folder: &Path) -> Result {
        let is_library = LIBRARIES.contains(&name);
        let mut command = match self {
            Self::Mono { compiler, .. } => {
                let mut command = Command::new(compiler);
                command.args(["-langversion:latest", "-warnaserror"]);
                if is_library {
                    command.arg(joined("-doc:", &folder.join(format!("{name}.xml"))));
                }
                command
            }
            Self::Tools(tools) => {
                let mut command = Command::new(tools.join("csc8"));
                command.arg("-warnaserror");
                if is_library {
                    command.arg("-nullable");
                }
                command
            }
            // `dotnet run` compiles.
            Self::Sdk(_) => return Ok(()),
        };
        command.arg("-unsafe").arg(joined("-out:", &self.assembly(name, folder)));
        if is_library {
            command.arg("-target:library");
        }
        for library in LIBRARIES.iter().take_while(|library| **library != name) {
            command.arg(joined("-r:", &self.assembly(library, folder)));
        }
        process::output(command.args(sources(name)?))?;
        Ok(())
    }

    fn assembly(&self, name: &str, folder: &Path) -> PathBuf {
        let is_program = !LIBRARIES.contains(&name) && matches!(self, Self::Mono { .. });
        folder.join(format!("{name}.{}", if is_program { "exe" } else { "dll" }))
    }

    /// A program of the binding, with the library of the tree that the step `dist` made.
    fn program(&self, name: &str, folder: &Path, others: &Others) -> Command {
        let tree = dist::Options::default().out;
        let mut command = match self {
            Self::Mono { runtime, .. } => Command::new(runtime),
            Self::Tools(tools) => Command::new(tools.join("dotnet8")),
            Self::Sdk(dotnet) => {
                let mut command = Command::new(dotnet);
                command.args(["run", "--configuration", "Release", "--framework", "net8.0"]);
                command.arg("--project").arg(project(name)).arg("--");
                command
            }
        };
        if !matches!(self, Self::Sdk(_)) {
            command.arg(self.assembly(name, folder));
        }
        command.env("PTLIB_NATIVE_PATH", tree.join("lib"));
        command.env("PTLIB_TEST_PTC", tree.join("bin").join("ptc"));
        command.env("PTLIB_TEST_OTHER_ABI", &others.library);
        command.env("PTLIB_REPOSITORY", repository::root());
        command.env(aging_plugin::VARIABLE, &others.aging);
        command
    }
}

/// Makes the packages, and a program that knows nothing else of ptlib.
fn packages(dotnet: &Path, folder: &Path) -> Result {
    let feed = folder.join("feed");
    let tree = dist::Options::default().out;
    let with = |name: &str, path: &Path| joined(&format!("-p:{name}="), path);
    let runtime = with("NativeRuntime", Path::new(&runtime_id()));
    for name in [LIBRARY, "PtLib.Native"] {
        let mut pack = Command::new(dotnet);
        pack.arg("pack").arg(project(name)).args(["--configuration", "Release"]);
        pack.arg("--output").arg(&feed).arg(&runtime).arg(with("NativeTree", &tree));
        process::output(&mut pack)?;
    }
    let out = folder.join("packages");
    let mut build = Command::new(dotnet);
    build.arg("build").arg(project("PtLib.Packages")).args(["--configuration", "Release"]);
    build.arg("--output").arg(&out).arg(&runtime).arg(with("PtLibFeed", &feed));
    process::output(&mut build)?;
    let mut program = Command::new(dotnet);
    program.arg(out.join("PtLib.Packages.dll"));
    program.arg(repository::root().join("examples/graphs/bark.xml")).args(["packages.png", "64"]);
    process::output(program.current_dir(folder).env_remove("PTLIB_NATIVE_PATH"))?;
    println!("  dotnet: a program from packages runs");
    Ok(())
}

/// What .NET calls this platform.
fn runtime_id() -> String {
    let system = match env::consts::OS {
        "windows" => "win",
        "macos" => "osx",
        other => other,
    };
    let processor = match env::consts::ARCH {
        "x86_64" => "x64",
        "aarch64" => "arm64",
        other => other,
    };
    format!("{system}-{processor}")
}

fn joined(flag: &str, path: &Path) -> OsString {
    let mut argument = OsString::from(flag);
    argument.push(path);
    argument
}
