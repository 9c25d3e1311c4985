//! What rows ought to reach: `target` in the definitions of the benchmarks.

use std::fs;

use serde::Deserialize;

use super::record::Row;
use crate::{Result, repository};

#[derive(Debug, Deserialize)]
struct File {
    #[serde(default)]
    bench: Vec<Definition>,
    #[serde(default)]
    series: Vec<Series>,
}

#[derive(Debug, Deserialize)]
struct Definition {
    name: String,
    target: Option<Target>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Series {
    name: String,
    sizes: Vec<u32>,
    peak_mib: Option<f64>,
}

impl Series {
    /// The row of a process, and the memory that it ought to keep to.
    fn target(self) -> Option<(String, Target)> {
        let (side, peak) = (self.sizes.last()?, self.peak_mib?);
        Some((format!("{}, process, {side}", self.name), Target::Mib(peak)))
    }
}

/// A target; each kind says what is counted.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) enum Target {
    /// At least so many millions of pixels in a second.
    MpixelPerS(f64),
    /// At least that part of the speed of copying the result.
    OfMemcpy(f64),
    /// At most so many milliseconds.
    Ms(f64),
    /// At most so much memory, in MiB.
    Mib(f64),
    /// At most so many times the time of another row.
    Times(f64, String),
    /// At least so many times as fast as another row.
    Faster(f64, String),
}

/// The rows with targets, in the order of their files.
pub(super) fn all() -> Result<Vec<(String, Target)>> {
    let mut targets = Vec::new();
    for path in repository::files_in(&repository::root().join("bench/defs"), "toml")? {
        let in_file = |error| format!("{}: {error}", path.display());
        let file: File = toml::from_str(&fs::read_to_string(&path)?).map_err(in_file)?;
        targets.extend(file.bench.into_iter().filter_map(|row| Some((row.name, row.target?))));
        targets.extend(file.series.into_iter().filter_map(Series::target));
    }
    Ok(targets)
}

impl Target {
    /// The target in words.
    pub(super) fn words(&self) -> String {
        match self {
            Self::MpixelPerS(least) => format!("at least {least} Mpixel/s"),
            Self::OfMemcpy(least) => format!("at least {:.0} % of memcpy", least * 100.0),
            Self::Ms(most) => format!("at most {most} ms"),
            Self::Mib(most) => format!("at most {most} MiB"),
            Self::Times(most, other) => format!("at most {most} times \"{other}\""),
            Self::Faster(least, other) => {
                format!("at least {least} times as fast as \"{other}\"")
            }
        }
    }

    /// What was measured, in words, and whether it is on the right side; `None` if it was not.
    pub(super) fn verdict(&self, row: &Row, rows: &[Row]) -> Option<(String, bool)> {
        Some(match self {
            Self::MpixelPerS(least) => {
                (format!("{:.0} Mpixel/s", row.mpixel_per_s), row.mpixel_per_s >= *least)
            }
            Self::OfMemcpy(least) => {
                let part = row.of_memcpy?;
                (format!("{:.0} %", part * 100.0), part >= *least)
            }
            Self::Ms(most) => (format!("{:.1} ms", row.median_ms), row.median_ms <= *most),
            Self::Mib(most) => {
                let peak = row.peak_mib?;
                (format!("{peak:.0} MiB"), peak <= *most)
            }
            Self::Times(most, other) => {
                let other = rows.iter().find(|row| row.name == *other)?;
                let times = row.median_ms / other.median_ms;
                (format!("{times:.2} times"), times <= *most)
            }
            Self::Faster(least, other) => {
                let other = rows.iter().find(|row| row.name == *other)?;
                let times = other.median_ms / row.median_ms;
                (format!("{times:.2} times as fast"), times >= *least)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::record::tests::record;

    #[test]
    fn a_target_is_met_or_missed() {
        let rows = record(&[("a", 10.0, 0.0), ("b", 25.0, 0.0)]).rows;
        let verdict = |target: Target| target.verdict(&rows[1], &rows);
        assert_eq!(verdict(Target::Ms(25.0)), Some(("25.0 ms".to_owned(), true)));
        let times = Target::Times(2.0, "a".to_owned());
        assert_eq!(verdict(times), Some(("2.50 times".to_owned(), false)));
        let faster = Target::Faster(0.5, "a".to_owned());
        assert_eq!(verdict(faster), Some(("0.40 times as fast".to_owned(), false)));
        assert_eq!(verdict(Target::Mib(9.0)), None);
        assert_eq!(verdict(Target::Times(2.0, "c".to_owned())), None);
    }

    #[test]
    fn targets_of_other_rows_name_rows_that_there_are() {
        let targets = all().unwrap();
        assert!(targets.len() > 3);
        let names = fs::read_dir(repository::root().join("bench/defs")).unwrap().map(|file| {
            let text = fs::read_to_string(file.unwrap().path()).unwrap();
            toml::from_str::<File>(&text).unwrap().bench.into_iter().map(|row| row.name)
        });
        let names: Vec<_> = names.flatten().collect();
        let mut others = 0;
        for (row, target) in &targets {
            if let Target::Times(_, other) | Target::Faster(_, other) = target {
                others += 1;
                assert!(names.contains(other), "{row}: there is no row \"{other}\"");
            }
        }
        assert!(others > 1);
    }
}
