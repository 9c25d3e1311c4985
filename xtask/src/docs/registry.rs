//! What `ptc list --json` says about the blocks.

use std::{fs, path::Path, process::Command};

use serde::Deserialize;
use serde_json::Value;

use super::{
    essay,
    examples::{self, Examples},
};
use crate::{Result, process, repository};

/// A block type.
#[derive(Debug, Deserialize)]
pub(super) struct Block {
    pub(super) id: String,
    pub(super) family: String,
    pub(super) summary: String,
    pub(super) role: Role,
    pub(super) since: String,
    pub(super) uses_seed: bool,
    pub(super) tiles: bool,
    pub(super) tiling_exception: Option<String>,
    pub(super) in_pixels: Option<String>,
    pub(super) inputs: Vec<Input>,
    pub(super) outputs: Vec<Output>,
    pub(super) parameters: Vec<Parameter>,
    /// What its file says about its pictures.
    #[serde(skip)]
    pub(super) examples: Examples,
}

/// What a block is for in a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Role {
    Inner,
    Result,
    Writer,
    Input,
}

/// An input; its place in the list is its slot.
#[derive(Debug, Deserialize)]
pub(super) struct Input {
    pub(super) id: String,
    pub(super) kind: String,
    pub(super) is_optional: bool,
}

/// An output.
#[derive(Debug, Deserialize)]
pub(super) struct Output {
    pub(super) id: String,
    pub(super) kind: String,
    pub(super) planes: Option<String>,
}

/// A parameter.
#[derive(Debug, Deserialize)]
pub(super) struct Parameter {
    pub(super) id: String,
    pub(super) kind: ParameterKind,
    pub(super) doc: String,
    pub(super) default: Value,
    pub(super) hard: Option<Range>,
    pub(super) soft: Option<Range>,
    pub(super) unit: Option<String>,
    #[serde(default)]
    pub(super) choices: Vec<Choice>,
}

/// What a parameter holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum ParameterKind {
    Int,
    Float,
    Bool,
    Choice,
    Text,
    Path,
}

/// The least and the greatest value.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub(super) struct Range {
    pub(super) min: f64,
    pub(super) max: f64,
}

/// An alternative.
#[derive(Debug, Deserialize)]
pub(super) struct Choice {
    pub(super) number: i64,
    pub(super) id: String,
    pub(super) doc: String,
}

#[derive(Deserialize)]
struct List {
    blocks: Vec<Block>,
}

/// All blocks, by family and id.
pub(super) fn read(ptc: &Path) -> Result<Vec<Block>> {
    let list = process::output(Command::new(ptc).args(["list", "--json"]))?;
    let mut blocks = serde_json::from_str::<List>(&list)?.blocks;
    for block in &mut blocks {
        let source = fs::read_to_string(repository::root().join(essay::source(block)))?;
        block.examples = examples::examples(&source);
        examples::check(block)?;
    }
    Ok(blocks)
}

impl Block {
    /// The name of its page and its pictures.
    pub(super) fn slug(&self) -> String {
        self.id.replace(' ', "-")
    }
}

impl ParameterKind {
    /// The word for it in graph files.
    pub(super) fn word_in_files(self) -> &'static str {
        match self {
            Self::Int | Self::Choice => "int",
            Self::Float => "double",
            Self::Bool => "bool",
            Self::Text | Self::Path => "string",
        }
    }

    /// The word for it in the reference.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Int => "whole number",
            Self::Float => "number",
            Self::Bool => "yes or no",
            Self::Choice => "choice",
            Self::Text => "text",
            Self::Path => "path of a file",
        }
    }
}

/// A value as graph files have it.
pub(super) fn value_in_files(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Bool(is_set) => u8::from(*is_set).to_string(),
        number => number.to_string(),
    }
}
