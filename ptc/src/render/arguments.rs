//! The arguments of `ptc render`, and what they mean to the engine.

use std::{path::PathBuf, str::FromStr};

use clap::ValueEnum;
use ptlib::{Cancel, ComputeOptions, EngineOptions, Graph, Precision, io::BitDepth};

use crate::{
    pattern::Pattern,
    plugins::PluginOptions,
    quantity::{Bytes, Size},
};

const AFTER_HELP: &str = "\
Output names:
  The format is that of the name's ending: .png, .exr, .tif, .jpg, .webp, .bmp, .tga, .qoi, .pnm …
  {name}            the graph file's name without folder and ending
  {folder}          the graph file's folder
  {block}           the id of the rendered block
  {width} {height}  the picture's size in pixels
  {seed}            the seed
  {{ and }} stand for braces. Folders are made where they are missing. A file appears when it is
  complete, or not at all.

Examples:
  ptc render lava.xml -o lava.png --size 2048
  ptc render textures/*.xml -o 'out/{name}.png' --size 512 --supersampling 2
  ptc render rock.xml -o 'rock-{block}.exr' --all-results --precision float
  ptc render old.xml -o old.png --input photo=face.png";

/// The command's arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct RenderArguments {
    /// Graph files; several are a batch
    #[arg(required = true, value_name = "GRAPH")]
    pub(super) graphs: Vec<PathBuf>,

    /// Where the picture goes; for several, a pattern such as 'out/{name}.png'
    #[arg(short, long, value_name = "FILE|PATTERN", required_unless_present = "allow_write")]
    pub(super) output: Option<Pattern>,

    /// Size in pixels: both sides, or the longer one, and the other keeps the graph's aspect ratio
    #[arg(long, value_name = "WxH|N")]
    pub(super) size: Option<Size>,

    /// Seed of all blocks without their own
    #[arg(long, value_name = "N")]
    pub(super) seed: Option<u64>,

    /// Compute each pixel as the mean of N × N
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=6))]
    supersampling: Option<u32>,

    /// What values are computed in: levels of 8 bits as PT Designer did, or floating point
    #[arg(long, value_enum)]
    precision: Option<PrecisionWord>,

    /// Render the output of this block (its id in the file) instead of the last `end`
    #[arg(long, value_name = "ID", requires = "output")]
    pub(super) block: Option<String>,

    /// Render every `end` block; the pattern needs {block} if there are several
    #[arg(long, requires = "output", conflicts_with = "block")]
    pub(super) all_results: bool,

    /// Bits of a channel in the file, in formats that leave the choice
    #[arg(long, value_enum, default_value = "8")]
    bits: Bits,

    /// Give an input of the graph its value: a picture, or a text; may be repeated
    #[arg(long = "input", value_name = "NAME=FILE")]
    pub(super) inputs: Vec<InputFile>,

    /// Let blocks read files below this folder, besides the graph's own
    #[arg(long, value_name = "DIR")]
    allow_read: Vec<PathBuf>,

    /// Let `save file` blocks write below this folder, and run them
    #[arg(long, value_name = "DIR")]
    allow_write: Vec<PathBuf>,

    /// The most memory that a computation may take, such as 8G [default: 4G]
    #[arg(long, value_name = "SIZE")]
    memory: Option<Bytes>,

    /// The most threads [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,

    /// Where a block fails, go on with a white image
    #[arg(long)]
    keep_going: bool,

    /// Show errors only
    #[arg(short, long)]
    pub(super) quiet: bool,

    /// Show how long each graph took
    #[arg(long, conflicts_with = "quiet")]
    pub(super) timing: bool,

    #[command(flatten)]
    pub(super) plugins: PluginOptions,
}

/// An input of the graph by name, and the file that its value comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct InputFile {
    pub(super) name: String,
    pub(super) path: PathBuf,
}

impl FromStr for InputFile {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, &'static str> {
        match text.split_once('=') {
            Some((name, path)) if !path.is_empty() => {
                Ok(Self { name: name.to_owned(), path: path.into() })
            }
            _ => Err("an input is the name of one, '=' and a file: photo=face.png"),
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PrecisionWord {
    #[value(name = "8")]
    EightBit,
    Float,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Bits {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
}

impl RenderArguments {
    /// What all computations share.
    pub(super) fn engine_options(&self) -> EngineOptions {
        let mut options = EngineOptions {
            threads: self.threads.unwrap_or(0),
            read_folders: self.allow_read.clone(),
            write_folders: self.allow_write.clone(),
            ..EngineOptions::default()
        };
        // One picture of a graph reads nothing twice: keeping results would only take memory.
        if !self.all_results && !self.runs_writers() {
            options.cache_bytes = 0;
        }
        options
    }

    /// How a computation of `graph` differs from what its file says.
    pub(super) fn compute_options(&self, graph: &Graph, cancel: &Cancel) -> ComputeOptions<'_> {
        ComputeOptions {
            size: Some(self.size_of(graph)),
            seed: self.seed,
            supersampling: self.supersampling,
            precision: self.precision.map(|word| match word {
                PrecisionWord::EightBit => Precision::EightBit,
                PrecisionWord::Float => Precision::Float,
            }),
            memory_bytes: self.memory.map(|Bytes(bytes)| bytes),
            keep_going: self.keep_going,
            cancel: Some(cancel.clone()),
            ..ComputeOptions::default()
        }
    }

    /// The size of a graph's pictures.
    pub(super) fn size_of(&self, graph: &Graph) -> (u32, u32) {
        let settings = graph.settings();
        let own = (settings.width, settings.height);
        self.size.map_or(own, |size| size.of(own.0, own.1))
    }

    /// Whether `save file` blocks run.
    pub(super) fn runs_writers(&self) -> bool {
        !self.allow_write.is_empty()
    }

    /// Whether white images stand for what fails.
    pub(super) fn goes_on(&self) -> bool {
        self.keep_going
    }

    pub(super) fn bit_depth(&self) -> BitDepth {
        match self.bits {
            Bits::Eight => BitDepth::Eight,
            Bits::Sixteen => BitDepth::Sixteen,
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::{Args as _, Command};

    use super::*;

    fn arguments(line: &str) -> RenderArguments {
        let command = RenderArguments::augment_args(Command::new("render"));
        let matches = command.try_get_matches_from(line.split(' ')).unwrap();
        clap::FromArgMatches::from_arg_matches(&matches).unwrap()
    }

    #[test]
    fn the_help_tells_the_default_limit() {
        let command = RenderArguments::augment_args(Command::new("render"));
        let memory = command.get_arguments().find(|argument| argument.get_id() == "memory");
        let help = memory.unwrap().get_help().unwrap().to_string();
        let Bytes(told) = help.split("default: ").nth(1).unwrap()[..2].parse().unwrap();
        assert_eq!(told, EngineOptions::default().limits.memory_bytes);
    }

    #[test]
    fn an_input_has_a_name_and_a_file() {
        let given = arguments("render a.xml -o a.png --input photo=a=b.png --input =x.txt");
        let names: Vec<_> = given.inputs.iter().map(|input| &*input.name).collect();
        assert_eq!(names, ["photo", ""]);
        assert_eq!(given.inputs[0].path, PathBuf::from("a=b.png"));
        assert!("photo".parse::<InputFile>().is_err() && "photo=".parse::<InputFile>().is_err());
    }

    #[test]
    fn options_reach_the_engine() {
        let given = arguments(
            "render a.xml -o a.png --size 64 --seed 5 --supersampling 2 --precision 8 \
             --memory 1G --threads 3 --allow-read x --allow-read y",
        );
        let options = given.engine_options();
        assert_eq!(options.threads, 3);
        assert_eq!(options.read_folders, [PathBuf::from("x"), PathBuf::from("y")]);
        assert_eq!(options.cache_bytes, 0);
        let graph = ptlib::Engine::new(options).new_graph();
        let options = given.compute_options(&graph, &Cancel::new());
        assert_eq!(options.size, Some((64, 64)));
        assert_eq!((options.seed, options.supersampling), (Some(5), Some(2)));
        assert_eq!(options.precision, Some(Precision::EightBit));
        assert_eq!(options.memory_bytes, Some(1 << 30));
        assert!(!options.keep_going);
    }

    #[test]
    fn without_options_the_graph_decides() {
        let given = arguments("render a.xml -o a.png");
        let mut graph = ptlib::Engine::new(given.engine_options()).new_graph();
        graph.set_size(20, 30).unwrap();
        let options = given.compute_options(&graph, &Cancel::new());
        assert_eq!(options.size, Some((20, 30)));
        assert_eq!((options.seed, options.supersampling), (None, None));
        assert_eq!((options.precision, options.memory_bytes), (None, None));
    }
}
