//! The tasks of this repository, run as `cargo xtask TASK`.
//!
//! One file a task: [`mod@test`] is the one command that checks everything, [`dist`] makes the
//! installable tree, [`header`] writes the C header, [`tidy`] checks the house rules that no
//! compiler knows, [`mod@format`] lays the sources out, [`docs`] writes the reference of blocks,
//! [`guide`] replays CONTRIBUTING.md, [`mod@bench`] compares records of the benchmarks, [`size`] measures
//! the library. Only the tools that a Rust programmer has anyway are needed; a
//! missing tool is named together with how to install it.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line program")]

use std::process::ExitCode;

mod bench;
mod dist;
mod docs;
mod format;
mod guide;
mod header;
mod process;
mod repository;
mod size;
mod test;
mod tidy;

/// What a task gives: its failure is a message for the person who ran it.
type Result<T = ()> = std::result::Result<T, Box<dyn std::error::Error + Send + Sync>>;

const USAGE: &str = "\
usage: cargo xtask TASK

tasks:
  test [--strict] [--quick] [STEP…]   check everything; --strict fails on a missing tool,
                                      --quick leaves out what takes minutes
  test --list                         the steps of `test`
  bench compare [--all] A B           compare two records of bench/record
  bench page [RECORD… | --check]      write the tables of docs/src/speed.md, or check them
  size [--check]                      write there what each picture format adds to the library, or
                                      check only that the whole is small enough
  dist [--out DIR] [--debug]          make the installable tree (default: target/dist)
  header [--check]                    write include/ptlib/ptlib.h, or check that it is up to date
  docs [--check | --pictures]         write the reference of blocks, or check it; --pictures draws
                                      its pictures too
  format [--check]                    lay out all sources; `cargo fmt` misses the blocks
  tidy [--soft]                       check the house rules; --soft lists what is near a limit
  guide                               replay CONTRIBUTING.md in a scratch copy";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (task, rest) = match arguments.split_first() {
        Some((task, rest)) => (task.as_str(), rest),
        None => ("", &[][..]),
    };
    let done = match task {
        "test" => test::run(rest),
        "bench" => bench::run(rest).map(|()| ExitCode::SUCCESS),
        "size" => size::run(rest).map(|()| ExitCode::SUCCESS),
        "dist" => dist::run(rest).map(|()| ExitCode::SUCCESS),
        "header" => header::run(rest).map(|()| ExitCode::SUCCESS),
        "docs" => docs::run(rest).map(|()| ExitCode::SUCCESS),
        "format" => format::run(rest).map(|()| ExitCode::SUCCESS),
        "tidy" => tidy::run(rest).map(|()| ExitCode::SUCCESS),
        "guide" => guide::run(rest).map(|()| ExitCode::SUCCESS),
        _ => Err(USAGE.into()),
    };
    match done {
        Ok(code) => code,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
