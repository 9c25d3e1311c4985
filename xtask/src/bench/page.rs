//! The tables of `docs/src/speed.md`.
//!
//! A comment `<!-- begin NAME -->` of the page is followed by what a command wrote, up to
//! `<!-- end NAME -->`. The table of records also tells which records the others are made of.

use std::fs;

use super::{
    record::{PeerRow, Record, Row, read},
    targets,
};
use crate::{Result, repository};

/// The page.
pub(crate) const PAGE: &str = "docs/src/speed.md";

/// Writes the tables from those records, or again from those of the page.
pub(super) fn write(names: &[&str]) -> Result {
    let path = repository::root().join(PAGE);
    let text = fs::read_to_string(&path)?;
    let records = match names {
        [] => records_of(&text)?,
        names => names.iter().map(|name| read(name)).collect::<Result<_>>()?,
    };
    Ok(fs::write(path, filled(&text, &records)?)?)
}

/// Fails if the tables are not what the page's records give.
pub(super) fn check() -> Result {
    let text = fs::read_to_string(repository::root().join(PAGE))?.replace("\r\n", "\n");
    if filled(&text, &records_of(&text)?)? == text {
        return Ok(());
    }
    let message =
        format!("{PAGE} is not what its records give: `cargo xtask bench page` writes it");
    Err(message.into())
}

/// The records that the page is made of: those of its first table.
fn records_of(page: &str) -> Result<Vec<Record>> {
    let table = page.split_once("<!-- begin records -->").ok_or("the page lists no records")?.1;
    let table = table.split("<!-- end records -->").next().unwrap_or_default();
    let names = table.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next());
    let records: Vec<Record> = names.map(read).collect::<Result<_>>()?;
    if records.is_empty() { Err("name a record: the page has none".into()) } else { Ok(records) }
}

fn filled(page: &str, records: &[Record]) -> Result<String> {
    let rows = firsts(records.iter().flat_map(|record| &record.rows), |row: &Row| {
        (row.name.clone(), row.width, row.threads, row.precision.clone())
    });
    let peers = firsts(records.iter().flat_map(|record| &record.peers), |row: &PeerRow| {
        (row.name.clone(), row.width, row.threads, row.peer.clone())
    });
    let tables = [
        ("records", records_table(records)),
        ("targets", targets_table(&rows)?),
        ("peers", peers_table(&peers)),
        ("ahead", ahead(&peers)),
        ("examples", examples_table(&rows)?),
        ("blocks", blocks_table(&rows)),
    ];
    let mut page = page.to_owned();
    for (name, table) in tables {
        page = fill(&page, name, &table)?;
    }
    Ok(page)
}

/// Copies of rows, the first one of each key.
fn firsts<'a, T: Clone + 'a, K: PartialEq>(
    rows: impl Iterator<Item = &'a T>,
    key: impl Fn(&T) -> K,
) -> Vec<T> {
    let mut firsts: Vec<T> = Vec::new();
    for row in rows {
        if !firsts.iter().any(|first| key(first) == key(row)) {
            firsts.push(row.clone());
        }
    }
    firsts
}

/// The page with another text between the marks of that name.
pub(crate) fn fill(page: &str, name: &str, text: &str) -> Result<String> {
    let (begin, end) = (format!("<!-- begin {name} -->\n"), format!("<!-- end {name} -->"));
    let missing = || format!("{PAGE} has no `{}` … `{end}`", begin.trim_end());
    let (before, rest) = page.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}\n{}\n\n{end}{after}", text.trim()))
}

/// A table, or a sentence if there is nothing in it.
fn table(titles: &str, rows: &[String]) -> String {
    if rows.is_empty() {
        return "Not in these records.".to_owned();
    }
    let rules = "---|".repeat(titles.matches(" | ").count() + 1);
    format!("| {titles} |\n|{rules}\n{}", rows.join("\n"))
}

fn records_table(records: &[Record]) -> String {
    let row = |record: &Record| {
        let Record { name, commit, machine, toolchain, .. } = record;
        let toolchain = toolchain.split(" (").next().unwrap_or_default();
        let (cpu, threads, system, simd) =
            (&machine.cpu, machine.threads, &machine.system, &machine.simd);
        let machine = format!("{cpu}, {threads} threads, {system}, {simd}");
        format!("| `{name}` | {} | `{commit}` | {machine} | {toolchain} |", record.date)
    };
    table(
        "record | day | commit | machine | compiler",
        &records.iter().map(row).collect::<Vec<_>>(),
    )
}

fn targets_table(rows: &[Row]) -> Result<String> {
    let line = |(name, target): (String, targets::Target)| {
        let row = rows.iter().find(|row| row.name == name);
        let verdict = row.and_then(|row| target.verdict(row, rows));
        let (measured, word) = match verdict {
            Some((measured, true)) => (measured, "met"),
            Some((measured, false)) => (measured, "**missed**"),
            None => ("–".to_owned(), "not measured"),
        };
        format!("| {name} | {} | {measured} | {word} |", target.words())
    };
    let lines: Vec<_> = targets::all()?.into_iter().map(line).collect();
    Ok(table("row | target | measured | ", &lines))
}

fn peers_table(peers: &[PeerRow]) -> String {
    let line = |row: &PeerRow| {
        let PeerRow { name, peer, does, ratio, spread, .. } = row;
        let half = ratio * spread / 2.0;
        format!("| {name} | {peer} | {does} | {ratio:.2} ± {half:.2} |")
    };
    table(
        "ours | peer | what the peer does | its time / ours",
        &peers.iter().map(line).collect::<Vec<_>>(),
    )
}

/// Where peers are ahead, in a list.
fn ahead(peers: &[PeerRow]) -> String {
    let mut ahead: Vec<_> = peers.iter().filter(|row| row.ratio < 1.0).collect();
    ahead.sort_by(|one, other| one.ratio.total_cmp(&other.ratio));
    if ahead.is_empty() {
        let nobody = if peers.is_empty() { "Not in these records." } else { "Nowhere." };
        return nobody.to_owned();
    }
    let line = |row: &&PeerRow| {
        format!("- *{}*: {} is {:.1} times as fast.", row.name, row.peer, 1.0 / row.ratio)
    };
    ahead.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn examples_table(rows: &[Row]) -> Result<String> {
    let graphs = repository::files_in(&repository::root().join("examples/graphs"), "xml")?;
    let mut lines = Vec::new();
    for graph in graphs {
        let name = graph.file_stem().unwrap_or_default().to_string_lossy().replace('-', " ");
        let time = |side: u32, threads: u32| {
            let label = format!("{name}, {side}");
            let is_it = |row: &&Row| row.name == label && row.threads == threads;
            rows.iter().find(is_it).map(|row| format!("{:.0}", row.median_ms))
        };
        let cells: Vec<Option<String>> =
            [512, 2048, 4096].into_iter().flat_map(|side| [time(side, 1), time(side, 2)]).collect();
        if cells.iter().any(Option::is_some) {
            let cells = cells.into_iter().map(|cell| cell.unwrap_or_else(|| "–".to_owned()));
            lines.push(format!("| {name} | {} |", cells.collect::<Vec<_>>().join(" | ")));
        }
    }
    let titles = [512, 2048, 4096].map(|side| format!("{side}² | on 2 threads")).join(" | ");
    Ok(table(&format!("graph | {titles}"), &lines))
}

/// Blocks alone, in float precision, one thread, the slowest first.
fn blocks_table(rows: &[Row]) -> String {
    let of_size =
        |row: &&Row| row.width == 2048 && row.threads == 1 && !row.name.contains(", 2048");
    let mut blocks: Vec<&Row> = rows.iter().filter(of_size).collect();
    blocks.retain(|row| row.precision == "float");
    blocks.sort_by(|one, other| one.mpixel_per_s.total_cmp(&other.mpixel_per_s));
    let line = |row: &&Row| {
        let in_bytes = rows.iter().find(|other| {
            (&other.name, other.width, other.threads) == (&row.name, row.width, row.threads)
                && other.precision == "8-bit"
        });
        let in_bytes = in_bytes.map_or("–".to_owned(), |row| format!("{:.0}", row.mpixel_per_s));
        format!("| {} | {:.0} | {in_bytes} |", row.name, row.mpixel_per_s)
    };
    table(
        "block at its defaults | Mpixel/s, float | Mpixel/s, 8-bit",
        &blocks.iter().map(line).collect::<Vec<_>>(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::record::tests::record;

    #[test]
    fn a_table_takes_the_place_of_the_old_one() {
        let page = "a\n<!-- begin x -->\n\nold\n\n<!-- end x -->\nb\n";
        let new = fill(page, "x", "new\n").unwrap();
        assert_eq!(new, "a\n<!-- begin x -->\n\nnew\n\n<!-- end x -->\nb\n");
        assert_eq!(fill(&new, "x", "new").unwrap(), new);
        assert!(fill(page, "y", "new").unwrap_err().to_string().contains("begin y"));
    }

    #[test]
    fn a_peer_that_is_ahead_is_named() {
        let peer = |peer: &str, ratio| PeerRow {
            name: "blur".to_owned(),
            width: 1,
            height: 1,
            threads: 1,
            precision: "float".to_owned(),
            peer: peer.to_owned(),
            does: String::new(),
            ratio,
            spread: 0.1,
        };
        let peers = [peer("slow 1.0", 4.0), peer("quick 2.0", 0.5)];
        assert_eq!(ahead(&peers), "- *blur*: quick 2.0 is 2.0 times as fast.");
        assert!(peers_table(&peers).contains("| blur | slow 1.0 |  | 4.00 ± 0.20 |"));
        assert_eq!(ahead(&peers[..1]), "Nowhere.");
    }

    #[test]
    fn of_rows_of_several_records_the_first_counts() {
        let records = [record(&[("a", 1.0, 0.0)]), record(&[("a", 2.0, 0.0), ("b", 3.0, 0.0)])];
        let rows = records.iter().flat_map(|record| &record.rows);
        let times: Vec<_> =
            firsts(rows, |row| row.name.clone()).iter().map(|r| r.median_ms).collect();
        assert_eq!(times, [1.0, 3.0]);
    }
}
