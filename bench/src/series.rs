//! A series of definitions: one graph at several sizes, each on several numbers of threads.
//!
//! A size has one hash, because results do not depend on the number of threads.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::{
    Result,
    definition::{Bits, By, Definition},
};

/// A series, as a file of definitions has it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct Series {
    /// Its name; those of the definitions have the size behind it.
    name: String,
    why: String,
    /// The graph's file, in `examples/graphs`.
    example: PathBuf,
    /// The sides of the results, which are squares.
    sizes: Vec<u32>,
    threads: Vec<u32>,
    precision: Bits,
    supersampling: Option<u32>,
    /// The hashes of the right results, one a size, by `--bless`.
    hashes: Vec<String>,
    /// The most memory that a process of its own ought to have at the largest size, in MiB: with
    /// it, there is one row more, of such processes.
    #[serde(default)]
    peak_mib: Option<f64>,
}

impl Series {
    /// The definitions of a series that stands in that file.
    pub(crate) fn definitions(&self, file: &Path) -> Vec<Definition> {
        let mut definitions = Vec::new();
        for place in 0..self.sizes.len() {
            for threads in &self.threads {
                definitions.push(self.definition(file, place, *threads));
            }
        }
        if self.peak_mib.is_some()
            && let (Some(largest), Some(threads)) =
                (self.sizes.len().checked_sub(1), self.threads.last())
        {
            let name = format!("{}, process, {}", self.name, self.sizes[largest]);
            let row = self.definition(file, largest, *threads);
            definitions.push(Definition { name, by: By::Process, ..row });
        }
        definitions
    }

    /// The definition of one of the sizes.
    fn definition(&self, file: &Path, place: usize, threads: u32) -> Definition {
        let side = self.sizes[place];
        Definition {
            name: format!("{}, {side}", self.name),
            why: self.why.clone(),
            graph: None,
            texture: None,
            example: Some(self.example.clone()),
            block: None,
            size: [side; 2],
            threads,
            precision: self.precision,
            supersampling: self.supersampling,
            by: By::Computing,
            peers: Vec::new(),
            plugin: None,
            picture: None,
            folder: None,
            kept: Vec::new(),
            change: None,
            written: None,
            target: None,
            hash: self.hashes.get(place).cloned().unwrap_or_default(),
            file: file.to_owned(),
            place: Some(place),
        }
    }
}

/// The text of a file with the hash of one size of a series replaced. `name` is that of the
/// definition.
pub(crate) fn with_hash(text: &str, name: &str, place: usize, hash: &str) -> Result<String> {
    let (series, _) = name.rsplit_once(", ").ok_or("the name has no size")?;
    let missing = || format!("the series {series} has no hash number {}", place + 1);
    let start = text.find(&format!("name = \"{series}\"")).ok_or_else(missing)?;
    let list = start + text[start..].find("hashes = [").ok_or_else(missing)?;
    let mut quotes = text[list..].match_indices('"').map(|(at, _)| list + at).skip(2 * place);
    let (Some(begin), Some(end)) = (quotes.next(), quotes.next()) else {
        return Err(missing().into());
    };
    Ok(format!("{}{hash}{}", &text[..=begin], &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[[series]]\nname = \"a\"\nhashes = [\"1\", \"2\"]\n[[series]]\n\
                        name = \"b\"\nhashes = [\n    \"\",\n    \"\",\n]\n";

    #[test]
    fn a_hash_is_written_where_it_belongs() {
        let text = with_hash(TEXT, "b, 512", 1, "44").unwrap();
        let text = with_hash(&text, "a, 64", 0, "11").unwrap();
        assert!(text.contains("hashes = [\"11\", \"2\"]"), "{text}");
        assert!(text.ends_with("hashes = [\n    \"\",\n    \"44\",\n]\n"), "{text}");
        assert!(with_hash(&text, "c, 64", 0, "5").is_err());
        assert!(with_hash(&text, "b, 64", 2, "5").is_err());
    }

    #[test]
    fn every_size_is_computed_on_every_number_of_threads() {
        let series: Series = toml::from_str(
            "name = \"a\"\nwhy = \"x.\"\nexample = \"a.xml\"\nsizes = [64, 128]\n\
             threads = [1, 2]\nprecision = \"float\"\nhashes = [\"1\", \"2\"]\n\
             peak-mib = 9.0\n",
        )
        .unwrap();
        let definitions = series.definitions(Path::new("f"));
        let rows: Vec<_> = definitions
            .iter()
            .map(|row| (row.name.as_str(), row.threads, row.hash.as_str()))
            .collect();
        assert_eq!(
            rows,
            [
                ("a, 64", 1, "1"),
                ("a, 64", 2, "1"),
                ("a, 128", 1, "2"),
                ("a, 128", 2, "2"),
                ("a, process, 128", 2, "2")
            ]
        );
    }
}
