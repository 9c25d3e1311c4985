//! The pictures of blocks: each is a small graph, rendered by `ptc`.
//!
//! Every input gets something that shows what the block does: image inputs a colour picture and a
//! grey one in turn, as in the tests of all blocks, and inputs for normals a normal map. The noise
//! behind them has few octaves: it is easier to recognise, and the files are smaller. Outputs that
//! are no picture are shown by a block that makes one of them.

use std::{fs, path::Path, process::Command};

use super::{
    PICTURES, has_pictures,
    registry::{Block, Parameter, ParameterKind, Role, value_in_files},
    settings::{Setting, changes, settings},
};
use crate::{Result, process, repository};

/// Pixels of a side.
const SIZE: u32 = 128;

/// What blocks that read files read, in the folder of the conformance tests.
const GRAMMAR: &str = "in/tree.txt";
const PICTURE: &str = "in/colour.png";

/// The pictures that blocks are given, for the index: their names and how they are made.
pub(super) const CARDS: [Card; 3] = [
    ("given-colour.png", Sketch::colour),
    ("given-grey.png", Sketch::grey),
    ("given-normals.png", Sketch::normals),
];
type Card = (&'static str, fn(&mut Sketch) -> usize);

/// The file name of a picture.
pub(super) fn name(block: &Block, setting: Setting) -> String {
    match setting {
        Setting::Default => format!("{}.png", block.slug()),
        _ => format!("{}-{}.png", block.slug(), setting.word()),
    }
}

/// The paths of a block's pictures in the repository.
pub(super) fn paths(block: &Block) -> Vec<String> {
    let names = settings(block).into_iter().map(|setting| name(block, setting));
    names.map(|name| format!("{PICTURES}/{name}")).collect()
}

/// Draws all pictures.
pub(super) fn draw(ptc: &Path, blocks: &[Block]) -> Result {
    let folder = repository::target().join("docs");
    process::empty_folder(&folder)?;
    let mut files = Vec::new();
    for block in blocks.iter().filter(|block| has_pictures(block)) {
        for setting in settings(block) {
            let file = folder.join(name(block, setting)).with_extension("xml");
            fs::write(&file, graph(block, setting)?)?;
            files.push(file);
        }
    }
    for (name, card) in CARDS {
        let file = folder.join(name).with_extension("xml");
        let mut sketch = Sketch::new();
        let shown = card(&mut sketch);
        fs::write(&file, sketch.finish(shown))?;
        files.push(file);
    }
    let root = repository::root();
    let mut command = Command::new(ptc);
    command.arg("render").args(files).arg("--output");
    command.arg(root.join(PICTURES).join("{name}.png"));
    command.arg("--allow-read").arg(root.join("tests/conformance"));
    process::output(&mut command)?;
    Ok(())
}

/// A graph file under construction.
pub(super) struct Sketch {
    text: String,
    blocks: usize,
}

impl Sketch {
    fn new() -> Self {
        Self { text: String::new(), blocks: 0 }
    }

    /// The file, with the output of a block as its result.
    fn finish(mut self, shown: usize) -> String {
        self.add("end", &[Some(shown)], &[]);
        format!(
            "<!DOCTYPE ptgraph>\n<texturegraph width=\"{SIZE}\" height=\"{SIZE}\" seed=\"0\" \
             supersampling=\"1\" version=\"1\" precision=\"float\">\n{}</texturegraph>\n",
            self.text
        )
    }

    /// Adds a block with these children, and tells its id.
    fn add(&mut self, block: &str, inputs: &[Option<usize>], parameters: &[String]) -> usize {
        let id = self.blocks;
        self.blocks += 1;
        self.text.push_str(&format!("\t<block type=\"{block}\" id=\"{id}\" seed=\"{id}\">\n"));
        for (slot, input) in inputs.iter().enumerate() {
            if let Some(input) = input {
                self.text.push_str(&format!("\t\t<input id=\"{input}\" slot=\"{slot}\"/>\n"));
            }
        }
        for parameter in parameters {
            self.text.push_str(&format!("\t\t{parameter}\n"));
        }
        self.text.push_str("\t</block>\n");
        id
    }

    fn grey(&mut self) -> usize {
        let octaves = [("frequency", "4"), ("max iterations", "4")];
        let parameters = octaves.map(|(name, value)| parameter_of(name, "int", value));
        self.add("perlin noise", &[], &parameters)
    }

    fn gradient(&mut self) -> usize {
        let stops = "0 10 0 60;90 200 40 20;160 240 200 60;255 250 255 255";
        self.add("color transition", &[], &[parameter_of("data", "string", stops)])
    }

    fn colour(&mut self) -> usize {
        let (noise, gradient) = (self.grey(), self.gradient());
        self.add("map transition", &[Some(noise), Some(gradient)], &[])
    }

    fn normals(&mut self) -> usize {
        let noise = self.grey();
        self.add("normal map", &[Some(noise)], &[])
    }

    fn text(&mut self) -> usize {
        self.add("l-system", &[], &[parameter_of("path", "string", &file(GRAMMAR))])
    }

    /// The block that an example gives. The type that a parameter has in files is that of its value.
    fn given(&mut self, block: &str, parameters: &[(String, String)]) -> usize {
        let parameters = parameters.iter().map(|(name, value)| {
            let kind = match value {
                value if value.parse::<i64>().is_ok() => "int",
                value if value.parse::<f64>().is_ok() => "double",
                _ => "string",
            };
            parameter_of(name, kind, value)
        });
        let parameters: Vec<String> = parameters.collect();
        self.add(block, &[], &parameters)
    }

    /// Something for the input of a block.
    fn source(&mut self, block: &Block, slot: usize) -> Result<Option<usize>> {
        let input = &block.inputs[slot];
        if let (0, Some((given, parameters))) = (slot, &block.examples.source) {
            return Ok(Some(self.given(given, parameters)));
        }
        Ok(Some(match (input.kind.as_str(), input.id.as_str()) {
            ("image", "normals") => self.normals(),
            ("image", _) if slot.is_multiple_of(2) => self.colour(),
            ("image", _) => self.grey(),
            ("gradient", _) => self.gradient(),
            // A text would replace what the block makes by itself.
            ("text", _) if input.is_optional && block.role != Role::Input => return Ok(None),
            ("text", _) => self.text(),
            (kind, _) => return Err(format!("no picture for inputs of kind {kind}").into()),
        }))
    }

    /// The block itself if its output is a picture, or what shows the output.
    fn shown(&mut self, block: &Block, id: usize) -> Result<usize> {
        let kind = block.outputs.first().map_or("nothing", |output| output.kind.as_str());
        match kind {
            "image" => Ok(id),
            "text" => Ok(self.add("turtle", &[Some(id)], &[])),
            "gradient" => {
                let noise = self.grey();
                Ok(self.add("map transition", &[Some(noise), Some(id)], &[]))
            }
            kind => Err(format!("no picture of outputs of kind {kind}").into()),
        }
    }
}

/// The graph that shows a block.
fn graph(block: &Block, setting: Setting) -> Result<String> {
    let mut sketch = Sketch::new();
    let mut inputs = Vec::new();
    for slot in 0..block.inputs.len() {
        inputs.push(sketch.source(block, slot)?);
    }
    let changes = changes(block, setting);
    let mut parameters: Vec<String> = changes
        .iter()
        .filter(|(spec, _)| spec.kind != ParameterKind::Path)
        .map(|(spec, value)| parameter(spec, &value_in_files(value)))
        .collect();
    let reads_text = block.outputs.iter().any(|output| output.kind == "text");
    for path in block.parameters.iter().filter(|spec| spec.kind == ParameterKind::Path) {
        let given = changes.iter().find(|(spec, _)| spec.id == path.id);
        let default = if reads_text { GRAMMAR } else { PICTURE };
        let name = given.map_or_else(|| default.to_owned(), |(_, value)| value_in_files(value));
        parameters.push(parameter(path, &file(&name)));
    }
    let id = sketch.add(&block.id, &inputs, &parameters);
    let shown = sketch.shown(block, id)?;
    Ok(sketch.finish(shown))
}

/// The path of a file of the conformance tests.
fn file(path: &str) -> String {
    repository::root().join("tests/conformance").join(path).display().to_string()
}

/// A parameter in a graph file.
pub(super) fn parameter(parameter: &Parameter, value: &str) -> String {
    parameter_of(&parameter.id, parameter.kind.word_in_files(), value)
}

fn parameter_of(name: &str, kind: &str, value: &str) -> String {
    let value = value.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
    format!("<parameter name=\"{name}\" type=\"{kind}\" value=\"{value}\"/>")
}
