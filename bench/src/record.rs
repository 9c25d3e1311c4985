//! `bench/record/`: what was measured, where, and of which commit.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::{SystemTime, UNIX_EPOCH},
};

use ptlib::math::simd::SimdLevel;
use serde::{Deserialize, Serialize};

use crate::{
    Result,
    definition::home,
    report::{PeerRow, Row},
};

#[derive(Serialize, Deserialize)]
struct Record {
    date: String,
    machine: Machine,
    commit: String,
    toolchain: String,
    rows: Vec<Row>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    peers: Vec<PeerRow>,
}

#[derive(Serialize, Deserialize)]
struct Machine {
    cpu: String,
    threads: usize,
    system: String,
    simd: String,
}

/// Writes what was measured to a file named after the day and the machine; returns its path. Rows
/// that the file has already stay, if they were not measured again. A file of another commit stays
/// as it is: the new one has the commit in its name.
pub(crate) fn write(rows: &[Row], peers: &[PeerRow]) -> Result<PathBuf> {
    let machine = Machine {
        cpu: cpu(),
        threads: std::thread::available_parallelism()?.get(),
        system: std::env::consts::OS.to_owned(),
        simd: SimdLevel::best().name().to_owned(),
    };
    let days = SystemTime::now().duration_since(UNIX_EPOCH)?.as_secs() / 86_400;
    let date = date(days);
    let folder = home().join("record");
    fs::create_dir_all(&folder)?;
    let commit = told_by("git", &["describe", "--always", "--dirty", "--abbrev=12"]);
    let toolchain = told_by("rustc", &["--version"]);
    let mut path = folder.join(format!("{date}-{}.json", slug(&machine.cpu)));
    if read(&path).is_some_and(|old| old.commit != commit) {
        path.set_file_name(format!("{date}-{}-{}.json", slug(&machine.cpu), slug(&commit)));
    }
    let (rows, peers) = (rows.to_vec(), peers.to_vec());
    let mut record = Record { date, machine, commit, toolchain, rows, peers };
    if let Some(old) = read(&path) {
        record.rows = merged(old.rows, record.rows, |row| {
            (row.name.clone(), row.width, row.threads, row.precision.clone())
        });
        record.peers = merged(old.peers, record.peers, |row| {
            (row.name.clone(), row.width, row.threads, row.peer.clone(), row.does.clone())
        });
    }
    fs::write(&path, serde_json::to_string_pretty(&record)? + "\n")?;
    Ok(path)
}

/// The record in a file, if there is one.
fn read(path: &Path) -> Option<Record> {
    serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
}

/// Old rows, with new ones in the place of those of the same key, and the others behind them.
fn merged<T, K: PartialEq>(mut rows: Vec<T>, new: Vec<T>, key: impl Fn(&T) -> K) -> Vec<T> {
    for row in new {
        match rows.iter_mut().find(|old| key(old) == key(&row)) {
            Some(old) => *old = row,
            None => rows.push(row),
        }
    }
    rows
}

/// The first line that a program prints; `unknown` if it cannot be run.
fn told_by(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).current_dir(home()).output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let text = text.unwrap_or_default();
    text.lines().next().unwrap_or("unknown").to_owned()
}

/// The name of the processor, where the system tells it in a file.
fn cpu() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or(std::env::consts::ARCH, |(_, name)| name.trim()).to_owned()
}

/// A text as a part of a file's name.
fn slug(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_ascii_lowercase).collect::<Vec<_>>().join("-")
}

/// The calendar day that begins that many days after 1 January 1970, as `2026-01-31`.
fn date(mut days: u64) -> String {
    let mut year = 1970;
    let is_leap = |year: u64| {
        year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
    };
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let february = 28 + u64::from(is_leap(year));
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_become_dates() {
        assert_eq!(date(0), "1970-01-01");
        assert_eq!(date(11_016), "2000-02-29");
        assert_eq!(date(19_722), "2023-12-31");
        assert_eq!(date(19_723), "2024-01-01");
    }

    #[test]
    fn names_of_processors_become_names_of_files() {
        assert_eq!(slug("AMD EPYC(TM) 7B13 @ 3.5GHz"), "amd-epyc-tm-7b13-3-5ghz");
    }

    #[test]
    fn new_rows_take_the_place_of_old_ones() {
        let rows = merged(vec![("a", 1), ("b", 2)], vec![("b", 3), ("c", 4)], |row| row.0);
        assert_eq!(rows, [("a", 1), ("b", 3), ("c", 4)]);
    }
}
