//! `bench/defs/*.toml`: work that somebody cares about, and its right result.

use std::{
    fs,
    hint::black_box,
    path::{Path, PathBuf},
};

use ptlib::Precision;
use serde::{Deserialize, de::IgnoredAny};

use crate::{
    Result,
    change::{self, Change},
    given,
    measure::{Times, timed},
    options::{Options, is_wanted},
    peers::{self, Peer, Task},
    plugin, process,
    report::{PeerRow, Row, Subject, rounded},
    series::{self, Series},
    work::{self, Host, Settings, Work, hash, precision_name},
};

/// One file of definitions.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    bench: Vec<Definition>,
    #[serde(default)]
    series: Vec<Series>,
}

/// One definition.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct Definition {
    /// Its name: what filters look at.
    pub(crate) name: String,
    /// Why the row exists.
    pub(crate) why: String,
    /// The graph's file, in `bench/graphs`.
    pub(crate) graph: Option<PathBuf>,
    /// Or the graph's file in the folder of `--textures`.
    pub(crate) texture: Option<PathBuf>,
    /// Or the graph's file in `examples/graphs`.
    pub(crate) example: Option<PathBuf>,
    /// The id of the block whose output is computed; the graph's result if there is none. Graphs
    /// with test cards name the block that is measured: see [`Work`].
    pub(crate) block: Option<String>,
    /// Width and height of the result.
    pub(crate) size: [u32; 2],
    pub(crate) threads: u32,
    pub(crate) precision: Bits,
    /// The graph's, if there is none here.
    pub(crate) supersampling: Option<u32>,
    /// How it is measured.
    #[serde(default)]
    pub(crate) by: By,
    /// What `--peers` measures beside it: names of [`peers`].
    #[serde(default)]
    pub(crate) peers: Vec<String>,
    /// The plug-in of this repository that has the graph's blocks.
    pub(crate) plugin: Option<String>,
    /// Width and height of a grey test card that the graph's `image input` is given.
    pub(crate) picture: Option<[u32; 2]>,
    /// The folder of this repository that the graph's files lie in, if it is not the graph's own.
    pub(crate) folder: Option<PathBuf>,
    /// Ids of blocks whose outputs are there before each run, like test cards.
    #[serde(default)]
    pub(crate) kept: Vec<String>,
    /// What is different in each run. The hash is that of the result after the change.
    pub(crate) change: Option<Change>,
    /// The file that the block writes, which the hash is of.
    pub(crate) written: Option<PathBuf>,
    /// What it ought to reach: `cargo xtask bench page` reads that.
    #[expect(dead_code, reason = "a misspelt field shall be told, so this one is known")]
    pub(crate) target: Option<IgnoredAny>,
    /// The hash of the right result, by `--bless`.
    #[serde(default)]
    pub(crate) hash: String,
    /// The file that it stands in.
    #[serde(skip)]
    pub(crate) file: PathBuf,
    /// Its hash is one of a list, at this place.
    #[serde(skip)]
    pub(crate) place: Option<usize>,
}

/// A precision, as files name it.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(crate) enum Bits {
    #[serde(rename = "float")]
    Float,
    #[serde(rename = "8-bit")]
    Eight,
}

/// How a definition is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum By {
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
            definitions.push(definition);
        }
        definitions.extend(file.series.iter().flat_map(|series| series.definitions(&path)));
    }
    definitions.retain(|definition| is_wanted(&definition.name, filters));
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
        self.hash_of(&mut self.work(options)?)
    }

    fn hash_of(&self, work: &mut Work) -> Result<String> {
        let value = work.compute_value()?;
        match &self.written {
            Some(name) => work::hash_of_file(&work::written().join(name)),
            None => Ok(hash(&value)),
        }
    }

    /// Writes a hash into the definition's file: behind its name.
    pub(crate) fn write_hash(&self, hash: &str) -> Result {
        let text = fs::read_to_string(&self.file)?;
        let text = match self.place {
            Some(place) => series::with_hash(&text, &self.name, place, hash)?,
            None => with_hash(&text, &self.name, hash)?,
        };
        Ok(fs::write(&self.file, text)?)
    }

    /// The row, and the hash of what was computed.
    pub(crate) fn measure(&self, options: &Options) -> Result<(Row, String)> {
        let mut work = self.work(options)?;
        let hash = self.hash_of(&mut work)?;
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

    /// A row for each of its peers, measured by turns with ours, and the hash of ours.
    pub(crate) fn measure_peers(&self, options: &Options) -> Result<(Vec<PeerRow>, String)> {
        let mut work = self.work(options)?;
        let image = work.compute()?;
        let hash = hash(&image.clone().into());
        let task = Task { size: self.size.into(), picture: work.picture()? };
        let mut rows = Vec::new();
        for name in &self.peers {
            let peer = peers::find(name)?;
            let mut contender = (peer.make)(&task)?;
            let in_peer = |error| format!("{}, {name}: {error}", self.name);
            contender.run().map_err(in_peer)?;
            peer.check(contender.as_ref(), &image).map_err(in_peer)?;
            rows.push(self.beside(&mut work, peer, contender.as_mut(), options.runs)?);
        }
        Ok((rows, hash))
    }

    fn beside(
        &self,
        work: &mut Work,
        peer: &Peer,
        contender: &mut dyn peers::Contender,
        runs: usize,
    ) -> Result<PeerRow> {
        let pairs = Times::by_turns(runs, || work.run(), || timed(|| contender.run()))?;
        let Settings { size, threads, precision, .. } = work.settings;
        let (name, precision) = (self.name.clone(), precision_name(precision));
        let subject = Subject { name, size, threads, precision };
        Ok(PeerRow::new(subject, peer, &pairs))
    }

    fn path(&self, options: &Options) -> PathBuf {
        if let Some(example) = &self.example {
            return home().join("../examples/graphs").join(example);
        }
        match (&self.graph, &self.texture, &options.textures) {
            (Some(graph), ..) => home().join("graphs").join(graph),
            (None, Some(texture), Some(folder)) => folder.join(texture),
            _ => PathBuf::new(),
        }
    }

    fn work(&self, options: &Options) -> Result<Work> {
        let plugin = self.plugin.as_deref().map(plugin::file).transpose()?;
        let host = Host { plugin: plugin.as_deref(), writes: self.written.is_some() };
        let engine = work::engine_with(self.threads, 0, host)?;
        let path = self.path(options);
        let in_file = |error| format!("{}: {error}", path.display());
        let mut graph = engine.open_graph(&path).map_err(in_file)?.graph;
        if let Some([width, height]) = self.picture {
            given::give(&mut graph, given::card((width, height))?)?;
        }
        if let Some(folder) = &self.folder {
            graph.set_folder(Some(home().join("..").join(folder)));
        }
        let kept = self.kept.iter().map(|id| change::find(&graph, id)).collect::<Result<_>>()?;
        let block = match &self.block {
            Some(id) => change::find(&graph, id)?,
            None => graph.main_result()?,
        };
        let precision = match self.precision {
            Bits::Float => Precision::Float,
            Bits::Eight => Precision::EightBit,
        };
        let (size, threads) = (self.size.into(), self.threads);
        let supersampling = self.supersampling;
        let settings = Settings { block, size, threads, precision, supersampling };
        Work::with(graph, settings, host, kept, self.change.clone())
    }
}

/// Computing, and copying as many bytes as the result has from warm memory to warm memory.
fn next_to_memcpy(work: &mut Work, subject: Subject, runs: usize) -> Result<Row> {
    let image = work.compute()?;
    let source: Vec<f32> =
        (0..image.planes()).flat_map(|plane| image.channel(plane)).copied().collect();
    drop(image);
    let mut target = source.clone();
    let pairs = Times::by_turns(
        runs,
        || work.run(),
        || {
            timed(|| {
                black_box(&mut target).copy_from_slice(black_box(&source));
                Ok(())
            })
        },
    )?;
    let mut row = Row::new(subject, &pairs.ours);
    row.of_memcpy = Some(rounded(pairs.theirs.median() / pairs.ours.median()));
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
        let options = Options::read(&["--textures".to_owned(), "/".to_owned()]).unwrap();
        for definition in definitions {
            let name = &definition.name;
            let sources = [&definition.graph, &definition.texture, &definition.example];
            assert_eq!(sources.into_iter().flatten().count(), 1, "{name}");
            let is_here = definition.texture.is_none();
            assert!(!is_here || definition.path(&options).is_file(), "{name}");
            assert!(definition.why.ends_with('.'), "{name}");
            for peer in &definition.peers {
                assert!(peers::find(peer).is_ok(), "{name}: {peer}");
            }
        }
    }

    #[test]
    fn what_is_kept_and_changed_is_in_the_graph() {
        let options = Options::read(&[]).unwrap();
        let definitions = all(&[]).unwrap().into_iter();
        let mut rows = definitions.filter(|row| row.change.is_some() || !row.kept.is_empty());
        let mut small = rows.find(|row| row.name.starts_with("fifteen")).unwrap();
        small.size = [16; 2];
        let mut work = small.work(&options).unwrap();
        let first = hash(&work.compute_value().unwrap());
        work.run().unwrap();
        assert_eq!(hash(&work.compute_value().unwrap()), first);
        small.kept = vec!["no such block".to_owned()];
        let error = small.work(&options).unwrap_err().to_string();
        assert!(error.contains("no block no such block"), "{error}");
    }

    #[test]
    fn every_example_graph_is_measured() {
        let definitions = all(&[]).unwrap();
        for entry in fs::read_dir(home().join("../examples/graphs")).unwrap() {
            let name = PathBuf::from(entry.unwrap().file_name());
            let rows = definitions.iter().filter(|row| row.example.as_ref() == Some(&name));
            let expected = if name.extension() == Some("xml".as_ref()) { 7 } else { 0 };
            assert_eq!(rows.count(), expected, "{}", name.display());
        }
    }
}
