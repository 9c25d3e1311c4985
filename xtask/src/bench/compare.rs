//! Two records side by side.
//!
//! A row counts as slower or faster if its time moved by more than the spread of the runs on
//! either side, and by more than [`LEAST`]: medians of a few runs move that much by themselves.
//! Rows with peers are compared by how far ahead of the peer they are, which says something even
//! if the machines differ.

use std::collections::BTreeSet;

use super::record::{Record, read};
use crate::Result;

/// The least change that is told.
const LEAST: f64 = 0.03;

/// What is compared of a row.
#[derive(Debug)]
struct Figure {
    key: Key,
    /// Milliseconds, or the part of the peer's time.
    value: f64,
    spread: f64,
}

/// What tells rows apart.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    name: String,
    size: (u32, u32),
    threads: u32,
    precision: String,
    /// The peer, without its version.
    peer: Option<String>,
}

/// A row that both records have.
#[derive(Debug)]
struct Change {
    key: Key,
    values: [f64; 2],
    noise: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Slower,
    Faster,
    Noise,
}

impl Change {
    /// How many times as long it takes in the second record.
    fn ratio(&self) -> f64 {
        self.values[1] / self.values[0]
    }

    fn verdict(&self) -> Verdict {
        let limit = 1.0 + self.noise.max(LEAST);
        if self.ratio() > limit {
            Verdict::Slower
        } else if self.ratio() < 1.0 / limit {
            Verdict::Faster
        } else {
            Verdict::Noise
        }
    }
}

/// Shows how the rows of two records differ.
pub(super) fn run(a: &str, b: &str, shows_all: bool) -> Result {
    print!("{}", report(&read(a)?, &read(b)?, shows_all)?);
    Ok(())
}

fn report(a: &Record, b: &Record, shows_all: bool) -> Result<String> {
    let mut changes = changes(a, b);
    if changes.is_empty() {
        return Err(format!("{} and {} have no row in common", a.name, b.name).into());
    }
    changes.sort_by(|one, other| other.ratio().total_cmp(&one.ratio()));
    let mut text = format!("A: {}\nB: {}\n", about(a), about(b));
    if a.machine != b.machine {
        text += "The machines differ: only rows with peers say which commit is faster.\n";
    }
    let is_shown = |change: &&Change| shows_all || change.verdict() != Verdict::Noise;
    let shown: Vec<_> = changes.iter().filter(is_shown).collect();
    if !shown.is_empty() {
        let [name, size, precision] = ["name", "size", "precision"];
        text += &format!(
            "\n{name:<52} {size:<9} threads {precision:<9} {:>10} {:>10} {:>6}\n",
            "A", "B", "B/A"
        );
    }
    for change in shown {
        text += &line(change);
    }
    let count = |verdict| changes.iter().filter(|change| change.verdict() == verdict).count();
    let (slower, faster) = (count(Verdict::Slower), count(Verdict::Faster));
    let (only_a, only_b) = (only(a, b), only(b, a));
    text += &format!(
        "\n{} rows: {slower} slower, {faster} faster, {} within noise; {} only in A, {} only in B\n",
        changes.len(),
        count(Verdict::Noise),
        only_a.len(),
        only_b.len(),
    );
    if shows_all {
        let list = |letter, keys: &[Key]| -> String {
            keys.iter().map(|key| format!("only in {letter}: {}\n", title(key))).collect()
        };
        text += &list("A", &only_a);
        text += &list("B", &only_b);
    }
    Ok(text)
}

fn about(record: &Record) -> String {
    let Record { name, commit, machine, .. } = record;
    format!("{name} ({commit}, {}, {})", machine.cpu, machine.simd)
}

fn title(key: &Key) -> String {
    match &key.peer {
        Some(peer) => format!("{}, of {peer}'s time", key.name),
        None => key.name.clone(),
    }
}

fn line(change: &Change) -> String {
    let Change { key, values: [a, b], .. } = change;
    let word = match change.verdict() {
        Verdict::Slower => "  SLOWER",
        Verdict::Faster => "  faster",
        Verdict::Noise => "",
    };
    let size = format!("{}x{}", key.size.0, key.size.1);
    let (unit, digits) = if key.peer.is_some() { ("  ", 3) } else { ("ms", 2) };
    format!(
        "{:<52} {size:<9} {:>7} {:<9} {a:>7.digits$} {unit} {b:>7.digits$} {unit} {:>6.2}{word}\n",
        title(key),
        key.threads,
        key.precision,
        change.ratio(),
    )
}

fn figures(record: &Record) -> Vec<Figure> {
    let rows = record.rows.iter().map(|row| Figure {
        key: Key {
            name: row.name.clone(),
            size: (row.width, row.height),
            threads: row.threads,
            precision: row.precision.clone(),
            peer: None,
        },
        value: row.median_ms,
        spread: row.spread,
    });
    let peers = record.peers.iter().map(|row| Figure {
        key: Key {
            name: row.name.clone(),
            size: (row.width, row.height),
            threads: row.threads,
            precision: row.precision.clone(),
            peer: row.peer.split(' ').next().map(str::to_owned),
        },
        value: 1.0 / row.ratio,
        spread: row.spread,
    });
    rows.chain(peers).filter(|figure| figure.value > 0.0 && figure.value.is_finite()).collect()
}

/// The rows that both records have.
fn changes(a: &Record, b: &Record) -> Vec<Change> {
    let others = figures(b);
    let change = |figure: Figure| {
        let other = others.iter().find(|other| other.key == figure.key)?;
        let values = [figure.value, other.value];
        Some(Change { key: figure.key, values, noise: figure.spread.max(other.spread) })
    };
    figures(a).into_iter().filter_map(change).collect()
}

/// The rows that only the first record has.
fn only(record: &Record, other: &Record) -> Vec<Key> {
    let others: BTreeSet<Key> = figures(other).into_iter().map(|figure| figure.key).collect();
    let keys = figures(record).into_iter().map(|figure| figure.key);
    keys.filter(|key| !others.contains(key)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::record::tests::record;

    #[test]
    fn only_what_is_beyond_noise_is_told() {
        let a = record(&[("blur", 10.0, 0.01), ("mix", 10.0, 0.5), ("wood", 10.0, 0.0)]);
        let b = record(&[("blur", 14.0, 0.01), ("mix", 14.0, 0.01), ("wood", 10.2, 0.0)]);
        let text = report(&a, &b, false).unwrap();
        assert!(text.contains("SLOWER") && text.contains("blur"), "{text}");
        assert!(!text.contains("mix") && !text.contains("wood"), "{text}");
        assert!(text.contains("3 rows: 1 slower, 0 faster, 2 within noise"), "{text}");
        let text = report(&b, &a, true).unwrap();
        assert!(text.contains("  faster\n") && text.contains("mix"), "{text}");
    }

    #[test]
    fn rows_of_one_side_are_counted() {
        let a = record(&[("blur", 10.0, 0.0), ("old", 1.0, 0.0)]);
        let mut b = record(&[("blur", 10.0, 0.0)]);
        b.machine.cpu = "Another".to_owned();
        let text = report(&a, &b, true).unwrap();
        assert!(text.contains("1 only in A, 0 only in B\nonly in A: old\n"), "{text}");
        assert!(text.contains("machines differ"), "{text}");
        let error = report(&record(&[("x", 1.0, 0.0)]), &b, true).unwrap_err().to_string();
        assert!(error.contains("no row in common"), "{error}");
    }
}
