//! `cargo xtask bench`: what to do with the records that the benchmarks write.
//!
//! `compare` holds two of them side by side ([`mod@compare`]); `page` writes the tables of
//! `docs/src/speed.md` from records ([`page`]), so that nobody types a number.

mod compare;
mod page;
mod record;
mod targets;

use crate::Result;

pub(crate) use self::page::{PAGE, fill};

const USAGE: &str = "\
usage: cargo xtask bench compare [--all] A B
       cargo xtask bench page [RECORD…]
       cargo xtask bench page --check

Records are files in bench/record, with or without folder and ending, or paths of other files.
  compare  the rows whose times differ by more than noise; --all shows the others, too
  page     writes the tables of docs/src/speed.md; of a row that several records have, the first
           one counts. Without records, those of the page; --check only compares

`cargo run --release -p ptlib-bench -- --record` writes a record.";

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let is_flag = |word: &&str| word.starts_with('-');
    match words[..] {
        ["compare", "--all", a, b] if !is_flag(&a) && !is_flag(&b) => compare::run(a, b, true),
        ["compare", a, b] if !is_flag(&a) && !is_flag(&b) => compare::run(a, b, false),
        ["page", "--check"] => page::check(),
        ["page", ref records @ ..] if !records.iter().any(is_flag) => page::write(records),
        _ => Err(USAGE.into()),
    }
}
