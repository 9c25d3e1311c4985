//! A record: what the benchmarks measured, where, and of which commit.

use std::{fs, path::PathBuf};

use serde::Deserialize;

use crate::{Result, repository};

#[derive(Debug, Deserialize)]
pub(super) struct Record {
    /// The file's name.
    #[serde(skip)]
    pub(super) name: String,
    pub(super) date: String,
    pub(super) machine: Machine,
    pub(super) commit: String,
    pub(super) toolchain: String,
    pub(super) rows: Vec<Row>,
    #[serde(default)]
    pub(super) peers: Vec<PeerRow>,
}

#[derive(Debug, PartialEq, Deserialize)]
pub(super) struct Machine {
    pub(super) cpu: String,
    pub(super) threads: usize,
    pub(super) system: String,
    pub(super) simd: String,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) threads: u32,
    pub(super) precision: String,
    pub(super) median_ms: f64,
    /// The width of the middle half of the runs, as a part of the median.
    pub(super) spread: f64,
    pub(super) mpixel_per_s: f64,
    pub(super) of_memcpy: Option<f64>,
    pub(super) peak_mib: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct PeerRow {
    pub(super) name: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) threads: u32,
    pub(super) precision: String,
    pub(super) peer: String,
    pub(super) does: String,
    /// How many times as long as ours theirs took.
    pub(super) ratio: f64,
    pub(super) spread: f64,
}

/// The folder of records.
fn folder() -> PathBuf {
    repository::root().join("bench/record")
}

/// Reads the record of that name or path.
pub(super) fn read(name: &str) -> Result<Record> {
    let candidates = [
        PathBuf::from(name),
        folder().join(name),
        folder().join(format!("{name}.json")),
        repository::root().join(name),
    ];
    let Some(path) = candidates.into_iter().find(|path| path.is_file()) else {
        return Err(format!("there is no record \"{name}\"; {}", known()?).into());
    };
    let text = fs::read_to_string(&path)?;
    let in_file = |error| format!("{} is no record: {error}", path.display());
    let mut record: Record = serde_json::from_str(&text).map_err(in_file)?;
    record.name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if record.rows.is_empty() && record.peers.is_empty() {
        return Err(format!("{} has no rows", path.display()).into());
    }
    Ok(record)
}

/// A sentence with the records that there are.
fn known() -> Result<String> {
    let files = repository::files_in(&folder(), "json")?;
    let names: Vec<_> = files.iter().filter_map(|file| file.file_stem()?.to_str()).collect();
    if names.is_empty() {
        return Ok("bench/record has none".to_owned());
    }
    Ok(format!("bench/record has\n  {}", names.join("\n  ")))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A record of one row for each name, with its time and spread.
    pub(crate) fn record(rows: &[(&str, f64, f64)]) -> Record {
        let row = |(name, median_ms, spread): &(&str, f64, f64)| Row {
            name: (*name).to_owned(),
            width: 512,
            height: 512,
            threads: 1,
            precision: "float".to_owned(),
            median_ms: *median_ms,
            spread: *spread,
            mpixel_per_s: 0.262_144 / median_ms * 1e3,
            of_memcpy: None,
            peak_mib: None,
        };
        let text = |text: &str| text.to_owned();
        let (cpu, system, simd) = (text("Some CPU"), text("linux"), text("avx2"));
        Record {
            name: text("some.json"),
            date: text("2026-01-31"),
            machine: Machine { cpu, threads: 2, system, simd },
            commit: text("0123456"),
            toolchain: text("rustc 1"),
            rows: rows.iter().map(row).collect(),
            peers: Vec::new(),
        }
    }

    #[test]
    fn a_record_that_is_not_there_is_told_with_those_that_are() {
        let error = read("no-such-record").unwrap_err().to_string();
        assert!(error.contains("no-such-record") && error.contains("bench/record has"), "{error}");
    }

    #[test]
    fn a_file_that_is_no_record_is_told_by_its_name() {
        let error = read("Cargo.toml").unwrap_err().to_string();
        assert!(error.contains("Cargo.toml is no record"), "{error}");
    }

    #[test]
    fn the_records_of_the_repository_are_read() {
        for file in repository::files_in(&folder(), "json").unwrap() {
            read(&file.to_string_lossy()).unwrap_or_else(|error| panic!("{error}"));
        }
    }
}
