//! What the tests of the command share: folders to work in, graphs, and runs of the real program.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// The program, told to work in no particular folder. It finds no plug-ins of whoever tests it.
pub fn ptc() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ptc"));
    command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command.env_remove("PTLIB_PLUGIN_PATH");
    command.env("XDG_DATA_HOME", Path::new(env!("CARGO_TARGET_TMPDIR")).join("no-plugins"));
    command
}

/// How a run ended.
#[derive(Debug)]
pub struct Run {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("the program prints UTF-8");
        Self { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }
}

impl Run {
    /// Fails unless the run ended with that exit code.
    #[track_caller]
    pub fn ends_with(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        self
    }

    /// Fails unless standard error holds `part`.
    #[track_caller]
    pub fn says(self, part: &str) -> Self {
        assert!(self.err.contains(part), "no {part:?} in {self:#?}");
        self
    }

    /// Fails unless standard error is one line: `ptc: error: …`.
    #[track_caller]
    pub fn says_one_error(self) -> Self {
        assert!(self.err.starts_with("ptc: error: "), "{self:#?}");
        assert_eq!(self.err.lines().count(), 1, "{self:#?}");
        self
    }
}

/// A folder of one test, empty at first and removed at the end.
pub struct Folder(PathBuf);

impl Folder {
    /// The folder of the test of that name.
    pub fn new(test: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("the test's folder can be made");
        Self(path)
    }

    /// Runs the program here.
    pub fn ptc(&self, arguments: &[&str]) -> Run {
        let mut command = ptc();
        command.current_dir(&self.0).args(arguments);
        command.output().expect("the program starts").into()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Writes a file, and its folder where it is missing.
    pub fn write(&self, name: &str, content: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("it is below the folder")).unwrap();
        fs::write(path, content).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The PNG of that name.
    pub fn png(&self, name: &str) -> Png {
        Png::new(&self.read(name))
    }

    /// The names of all files here, hidden ones included, in order.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// What the header of a PNG file says.
#[derive(Debug, PartialEq, Eq)]
pub struct Png {
    pub width: u32,
    pub height: u32,
    pub bits: u8,
}

impl Png {
    fn new(bytes: &[u8]) -> Self {
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        assert!(bytes.ends_with(b"IEND\xae\x42\x60\x82"), "the file is incomplete");
        let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        Self { width: number(16), height: number(20), bits: bytes[24] }
    }
}

/// A graph file of 64 × 32 pixels with those blocks.
pub fn graph(blocks: &str) -> String {
    format!(
        "<!DOCTYPE ptgraph>\n\
         <texturegraph width=\"64\" height=\"32\" seed=\"0\" supersampling=\"1\">\n\
         {blocks}</texturegraph>\n"
    )
}

/// A result that shows block `source`.
pub fn end(id: &str, source: &str) -> String {
    format!("<block type=\"end\" id=\"{id}\"><input id=\"{source}\" slot=\"0\"/></block>\n")
}

/// White noise, block 0, shown by result 1: every seed gives another picture.
pub fn noise() -> String {
    graph(&format!("<block type=\"simple noise\" id=\"0\"/>\n{}", end("1", "0")))
}

/// The same graph, but its first block is of a type that is none.
pub fn broken() -> String {
    noise().replace("simple noise", "simpel noise")
}

/// Two results of blocks on lines 3 and 4 whose types are none.
pub fn twice_broken() -> String {
    let block = |kind: &str, id: u32| format!("<block type=\"{kind}\" id=\"{id}\"/>\n");
    let blocks = format!("{}{}", block("simpel noise", 0), block("ivert", 1));
    graph(&format!("{blocks}{}{}", end("2", "0"), end("3", "1")))
}
