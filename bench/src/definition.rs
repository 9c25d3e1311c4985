//! `bench/defs/*.toml`: work that somebody cares about, and its right result.

use std::{
    fs,
    hint::black_box,
    path::{Path, PathBuf},
};

use ptlib::Precision;
use serde::Deserialize;

use crate::{
    Result,
    measure::{Times, timed},
    options::{Options, is_wanted},
    process,
    report::{Row, Subject, rounded},
    work::{self, Settings, Work, hash, precision_name},
};

/// One file of definitions.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    bench: Vec<Definition>,
}

/// One definition.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct Definition {
    /// Its name: what filters look at.
    pub(crate) name: String,
    /// Why the row exists.
    why: String,
    /// The graph's file, in `bench/graphs`.
    graph: Option<PathBuf>,
    /// Or the graph's file in the folder of `--textures`.
    texture: Option<PathBuf>,
    /// The id of the block whose output is computed; the graph's result if there is none. Graphs
    /// with test cards name the block that is measured: see [`Work`].
    block: Option<String>,
    /// Width and height of the result.
    size: [u32; 2],
    threads: u32,
    precision: Bits,
    /// The graph's, if there is none here.
    supersampling: Option<u32>,
    /// How it is measured.
    #[serde(default)]
    by: By,
    /// The hash of the right result, by `--bless`.
    #[serde(default)]
    hash: String,
    /// The file that it stands in.
    #[serde(skip)]
    file: PathBuf,
}

#[derive(Debug, Clone, Copy, Deserialize)]
enum Bits {
    #[serde(rename = "float")]
    Float,
    #[serde(rename = "8-bit")]
    Eight,
}

/// How a definition is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum By {
    /// Again and again in this process.
    #[default]
    Computing,
    /// The same, next to copying as many bytes as the result has.
    Memcpy,
    /// A process of its own each time: it reads the graph, computes, and saves a PNG.
    Process,
}

/// The wanted definitions, by file and in their order there.
pub(crate) fn all(filters: &[String]) -> Result<Vec<Definition>> {
    let mut files: Vec<PathBuf> =
        fs::read_dir(home().join("defs"))?.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    files.sort();
    let mut definitions = Vec::new();
    for path in files {
        let text = fs::read_to_string(&path)?;
        let file: File =
            toml::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
        for mut definition in file.bench {
            definition.file.clone_from(&path);
            if is_wanted(&definition.name, filters) {
                definitions.push(definition);
            }
        }
    }
    Ok(definitions)
}

/// The folder of this crate.
pub(crate) fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

impl Definition {
    /// Why the row cannot be measured here, if it cannot.
    pub(crate) fn missing(&self, options: &Options) -> Option<String> {
        match (&self.texture, &options.textures) {
            (Some(texture), None) => Some(format!("needs --textures for {}", texture.display())),
            _ => None,
        }
    }

    /// Whether a result's hash is the right one.
    pub(crate) fn verdict(&self, hash: &str) -> std::result::Result<(), String> {
        if self.hash == hash {
            return Ok(());
        }
        Err(format!("hash is {hash}, expected \"{}\" ({})", self.hash, self.why))
    }

    pub(crate) fn hash_now(&self, options: &Options) -> Result<String> {
        Ok(hash(&self.work(options)?.compute()?))
    }

    /// Writes a hash into the definition's file: behind its name.
    pub(crate) fn write_hash(&self, hash: &str) -> Result {
        let text = fs::read_to_string(&self.file)?;
        Ok(fs::write(&self.file, with_hash(&text, &self.name, hash)?)?)
    }

    /// The row, and the hash of what was computed.
    pub(crate) fn measure(&self, options: &Options) -> Result<(Row, String)> {
        let mut work = self.work(options)?;
        let hash = hash(&work.compute()?);
        let Settings { size, threads, precision, .. } = work.settings;
        let (name, precision) = (self.name.clone(), precision_name(precision));
        let subject = Subject { name, size, threads, precision };
        let row = match self.by {
            By::Computing => Row::new(subject, &Times::of(options.runs, || work.run())?),
            By::Memcpy => next_to_memcpy(&mut work, subject, options.runs)?,
            By::Process => {
                let (times, peak) = process::measure(&self.path(options), &work, options.runs)?;
                let mut row = Row::new(subject, &times);
                row.peak_mib = peak.map(rounded);
                row
            }
        };
        Ok((row, hash))
    }

    fn path(&self, options: &Options) -> PathBuf {
        match (&self.graph, &self.texture, &options.textures) {
            (Some(graph), ..) => home().join("graphs").join(graph),
            (None, Some(texture), Some(folder)) => folder.join(texture),
            _ => PathBuf::new(),
        }
    }

    fn work(&self, options: &Options) -> Result<Work> {
        let engine = work::engine(self.threads, 0);
        let path = self.path(options);
        let in_file = |error| format!("{}: {error}", path.display());
        let graph = engine.open_graph(&path).map_err(in_file)?.graph;
        let block = match &self.block {
            Some(id) => graph.find(id).ok_or_else(|| format!("the graph has no block {id}"))?,
            None => graph.main_result()?,
        };
        let precision = match self.precision {
            Bits::Float => Precision::Float,
            Bits::Eight => Precision::EightBit,
        };
        let (size, threads) = (self.size.into(), self.threads);
        let supersampling = self.supersampling;
        Work::new(graph, Settings { block, size, threads, precision, supersampling })
    }
}

/// Computing, and copying as many bytes as the result has from warm memory to warm memory.
fn next_to_memcpy(work: &mut Work, subject: Subject, runs: usize) -> Result<Row> {
    let image = work.compute()?;
    let source: Vec<f32> =
        (0..image.planes()).flat_map(|plane| image.channel(plane)).copied().collect();
    drop(image);
    let mut target = source.clone();
    let (times, copies) = Times::by_turns(
        runs,
        || work.run(),
        || {
            timed(|| {
                black_box(&mut target).copy_from_slice(black_box(&source));
                Ok(())
            })
        },
    )?;
    let mut row = Row::new(subject, &times);
    row.of_memcpy = Some(rounded(copies.median() / times.median()));
    Ok(row)
}

/// The text of a file with the hash of one definition replaced.
fn with_hash(text: &str, name: &str, hash: &str) -> Result<String> {
    let start = text
        .find(&format!("name = \"{name}\""))
        .ok_or_else(|| format!("no definition is called {name}"))?;
    let end = text[start..].find("[[bench]]").map_or(text.len(), |length| start + length);
    let old = text[start..end]
        .find("hash = \"")
        .ok_or_else(|| format!("the definition {name} has no line `hash = \"\"`"))?;
    let old = start + old + "hash = \"".len();
    let length = text[old..].find('"').ok_or("the hash does not end")?;
    Ok(format!("{}{hash}{}", &text[..old], &text[old + length..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_is_written_where_it_belongs() {
        let text = "[[bench]]\nname = \"a\"\nhash = \"1\"\n[[bench]]\nname = \"b\"\nhash = \"\"\n";
        let text = with_hash(text, "b", "22").unwrap();
        let text = with_hash(&text, "a", "33").unwrap();
        assert!(text.contains("name = \"a\"\nhash = \"33\"\n"));
        assert!(text.ends_with("name = \"b\"\nhash = \"22\"\n"));
        assert!(with_hash(&text, "c", "4").is_err());
    }

    #[test]
    fn every_definition_has_a_graph_and_a_reason() {
        let definitions = all(&[]).unwrap();
        assert!(!definitions.is_empty());
        for definition in definitions {
            let graph = definition.graph.as_ref().map(|graph| home().join("graphs").join(graph));
            assert_eq!(graph.is_some(), definition.texture.is_none(), "{}", definition.name);
            assert!(graph.is_none_or(|graph| graph.is_file()), "{}", definition.name);
            assert!(definition.why.ends_with('.'), "{}", definition.name);
        }
    }
}
