//! The command line.

use std::path::PathBuf;

use crate::Result;

const USAGE: &str = "\
usage: ptlib-bench [--runs N] [--textures DIR] [--check | --bless | --cancel] [FILTER…]
       ptlib-bench [--runs N] [--textures DIR] [--peers] [--record] [FILTER…]

Measures the rows whose name contains one of the filters, or all of them.
  --runs N        how often each row is run at most (default 9)
  --textures DIR  where the graphs of the rows are that are not part of the repository
  --check         compute everything once and compare hashes; measure nothing
  --bless         write the hashes of the results into the definitions
  --cancel        measure how soon each block stops when it is asked to
  --peers         measure only rows that have peers, by turns with them
  --record        write what was measured to bench/record";

/// What to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    Measure,
    Check,
    Bless,
    Cancel,
    Peers,
}

/// The command line, read.
#[derive(Debug)]
pub(crate) struct Options {
    pub(crate) mode: Mode,
    pub(crate) runs: usize,
    pub(crate) textures: Option<PathBuf>,
    pub(crate) records: bool,
    pub(crate) filters: Vec<String>,
}

impl Options {
    pub(crate) fn read(arguments: &[String]) -> Result<Self> {
        let mut options = Self {
            mode: Mode::Measure,
            runs: 9,
            textures: None,
            records: false,
            filters: Vec::new(),
        };
        let mut arguments = arguments.iter();
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--check" => options.mode = Mode::Check,
                "--bless" => options.mode = Mode::Bless,
                "--cancel" => options.mode = Mode::Cancel,
                "--peers" => options.mode = Mode::Peers,
                "--record" => options.records = true,
                "--runs" => options.runs = arguments.next().ok_or(USAGE)?.parse()?,
                "--textures" => options.textures = Some(arguments.next().ok_or(USAGE)?.into()),
                flag if flag.starts_with('-') => return Err(USAGE.into()),
                filter => options.filters.push(filter.to_owned()),
            }
        }
        Ok(options)
    }
}

/// Whether a row of that name is wanted.
pub(crate) fn is_wanted(name: &str, filters: &[String]) -> bool {
    filters.is_empty() || filters.iter().any(|filter| name.contains(filter.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_and_flags_mix() {
        let arguments = ["blur", "--runs", "3", "perlin"].map(str::to_owned);
        let options = Options::read(&arguments).unwrap();
        assert_eq!((options.runs, options.mode), (3, Mode::Measure));
        assert!(is_wanted("a blur", &options.filters));
        assert!(!is_wanted("mix", &options.filters));
        assert!(is_wanted("mix", &[]));
        assert!(Options::read(&["--teapot".to_owned()]).is_err());
    }
}
