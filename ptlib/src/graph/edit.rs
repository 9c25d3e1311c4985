//! Changing a graph.

use std::{path::PathBuf, sync::Arc};

use super::{Block, BlockId, Graph, Source, model::Slot};
use crate::{
    block::{Role, nearest},
    error::{Error, ErrorKind},
    math::levels::Precision,
    params::{ParamKind, ParamSpec, ParamValue},
};

impl Graph {
    /// Sets the size of the results in pixels.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] if one is 0.
    pub fn set_size(&mut self, width: u32, height: u32) -> Result<(), Error> {
        if width == 0 || height == 0 {
            let message = format!("size {width} × {height} is empty, allowed from 1 × 1");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let settings = &mut Arc::make_mut(&mut self.data).settings;
        (settings.width, settings.height) = (width, height);
        Ok(())
    }

    /// Sets the seed of all blocks that have none of their own.
    pub fn set_seed(&mut self, seed: u64) {
        Arc::make_mut(&mut self.data).settings.seed = seed;
    }

    /// Sets the supersampling.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] unless it is 1 to 6.
    pub fn set_supersampling(&mut self, level: u32) -> Result<(), Error> {
        let max = super::Settings::MAX_SUPERSAMPLING;
        if !(1..=max).contains(&level) {
            let message = format!("supersampling is {level}, allowed 1..={max}");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        Arc::make_mut(&mut self.data).settings.supersampling = level;
        Ok(())
    }

    /// Sets what values are computed in.
    pub fn set_precision(&mut self, precision: Precision) {
        Arc::make_mut(&mut self.data).settings.precision = precision;
    }

    /// Sets the folder that paths in parameters are relative to; `None` for a graph that reads no
    /// files.
    pub fn set_folder(&mut self, folder: Option<PathBuf>) {
        Arc::make_mut(&mut self.data).folder = folder;
    }

    /// Adds a block with default parameters, behind all others.
    ///
    /// # Errors
    /// [`ErrorKind::NotFound`] if there is no such type.
    pub fn add(&mut self, type_id: &str) -> Result<BlockId, Error> {
        let spec = self.registry.get(type_id)?;
        let id = self.unused_id();
        Ok(self.insert(Block {
            id,
            type_id: spec.about.id.into(),
            spec: Some(spec),
            origin: None,
            seed: None,
            values: spec.params.iter().map(ParamSpec::default_value).collect(),
            inputs: vec![None; spec.about.inputs.len()],
            extra_attributes: Vec::new(),
            extra_parameters: Vec::new(),
        }))
    }

    /// Adds a block as a file describes it.
    pub(crate) fn insert(&mut self, block: Block) -> BlockId {
        let data = Arc::make_mut(&mut self.data);
        let block = Some(Arc::new(block));
        let has_free = data.order.len() < data.slots.len();
        let free = has_free.then(|| data.slots.iter().position(|slot| slot.block.is_none()));
        let place = match free.flatten() {
            Some(place) => {
                let slot = &mut data.slots[place];
                slot.generation = slot.generation.wrapping_add(1);
                slot.block = block;
                place
            }
            None => {
                data.slots.push(Slot { generation: 1, block, given: None });
                data.slots.len() - 1
            }
        };
        let index = u32::try_from(place).expect("a graph has fewer than 2³² blocks");
        data.order.push(index);
        BlockId { index, generation: data.slots[place].generation }
    }

    /// Remembers which version of the file format the graph was read from.
    pub(crate) fn set_file_version(&mut self, version: Option<u32>) {
        Arc::make_mut(&mut self.data).file_version = version;
    }

    pub(crate) fn set_extra_attributes(&mut self, attributes: Vec<(String, String)>) {
        Arc::make_mut(&mut self.data).extra_attributes = attributes;
    }

    /// Removes a block and all its connections.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`].
    pub fn remove(&mut self, id: BlockId) -> Result<(), Error> {
        self.block(id)?;
        let data = Arc::make_mut(&mut self.data);
        let slot = &mut data.slots[id.index as usize];
        slot.block = None;
        slot.given = None;
        slot.generation = slot.generation.wrapping_add(1);
        data.order.retain(|&index| index != id.index);
        for slot in &mut data.slots {
            let Some(block) = &mut slot.block else { continue };
            let reads = |source: &Option<Source>| source.is_some_and(|source| source.block == id);
            if block.inputs.iter().any(reads) {
                for source in Arc::make_mut(block).inputs.iter_mut().filter(|source| reads(source))
                {
                    *source = None;
                }
            }
        }
        Ok(())
    }

    /// Connects output `output` of `source` with input `input` of `target`; what was connected
    /// there before is replaced.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`]; [`ErrorKind::NotFound`] if there is no such port;
    /// [`ErrorKind::TypeMismatch`] if the ports are of different kinds; [`ErrorKind::Cycle`] if
    /// the target would depend on itself.
    pub fn connect(
        &mut self,
        source: BlockId,
        output: u32,
        target: BlockId,
        input: u32,
    ) -> Result<(), Error> {
        self.check_kinds(source, output, target, input)?;
        self.connect_unchecked_kinds(Source { block: source, output }, target, input)
    }

    /// Connects without a look at the kinds, as files of PT Designer do: a wrong kind counts as
    /// unconnected when the block is computed (specification 1.2).
    pub(crate) fn connect_unchecked_kinds(
        &mut self,
        source: Source,
        target: BlockId,
        input: u32,
    ) -> Result<(), Error> {
        self.check_source(source, target)?;
        if self.depends_on(source.block, target) {
            return Err(self.cycle(source, target, input));
        }
        self.put_source(source, target, input)
    }

    /// Whether anybody may read a source: nobody reads what ends a graph.
    pub(super) fn check_source(&self, source: Source, target: BlockId) -> Result<(), Error> {
        let from = self.block(source.block)?;
        let to = self.block(target)?;
        if from.has_role(Role::Result) || from.has_role(Role::Writer) {
            let message = format!("ends the graph: {} cannot read it", name(to));
            return Err(self.at(source.block, Error::new(ErrorKind::TypeMismatch, message)));
        }
        Ok(())
    }

    /// The error of a connection that would close a cycle.
    pub(super) fn cycle(&self, source: Source, target: BlockId, input: u32) -> Error {
        let (from, to) = match (self.block(source.block), self.block(target)) {
            (Ok(from), Ok(to)) => (name(from), name(to)),
            (Err(error), _) | (_, Err(error)) => return error,
        };
        let message = format!("connecting {from} to input {input} of {to} would close a cycle");
        self.at(target, Error::new(ErrorKind::Cycle, message))
    }

    /// Stores a connection that was checked.
    pub(super) fn put_source(
        &mut self,
        source: Source,
        target: BlockId,
        input: u32,
    ) -> Result<(), Error> {
        let place = input as usize;
        let inputs = &mut self.block_mut(target)?.inputs;
        if place >= inputs.len() {
            inputs.resize(place + 1, None);
        }
        inputs[place] = Some(source);
        Ok(())
    }

    /// Gives a block another id in its graph's file, one that no other block has.
    pub(crate) fn set_file_id(&mut self, id: BlockId, file_id: String) -> Result<(), Error> {
        self.block_mut(id)?.id = file_id;
        Ok(())
    }

    /// Removes what is connected to an input; fine if nothing is.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`]; [`ErrorKind::NotFound`] if there is no such port.
    pub fn disconnect(&mut self, target: BlockId, input: u32) -> Result<(), Error> {
        let count = self.block(target)?.inputs.len();
        if input as usize >= count {
            let message = format!("has no input {input}, but {count} from 0 on");
            return Err(self.at(target, Error::new(ErrorKind::NotFound, message)));
        }
        self.block_mut(target)?.inputs[input as usize] = None;
        Ok(())
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`]; [`ErrorKind::NotFound`] if the block has no such parameter;
    /// [`ErrorKind::TypeMismatch`] or [`ErrorKind::OutOfRange`] if it cannot hold the value.
    pub fn set(&mut self, id: BlockId, parameter: &str, value: ParamValue) -> Result<(), Error> {
        let (place, spec) = self.parameter(id, parameter)?;
        spec.check(&value).map_err(|error| self.at(id, error))?;
        self.block_mut(id)?.values[place] = value;
        Ok(())
    }

    /// Sets a whole number, a flag (0 or not) or a choice (by number).
    ///
    /// # Errors
    /// As [`set`](Self::set).
    pub fn set_int(&mut self, id: BlockId, parameter: &str, value: i64) -> Result<(), Error> {
        let (_, spec) = self.parameter(id, parameter)?;
        let out_of_range = || {
            let message = format!("is {value}, which no parameter can hold");
            let error = Error::new(ErrorKind::OutOfRange, message).at_parameter(parameter);
            self.at(id, error)
        };
        let value = match spec.kind {
            ParamKind::Bool => ParamValue::Bool(value != 0),
            ParamKind::Choice(_) => {
                ParamValue::Choice(u32::try_from(value).map_err(|_| out_of_range())?)
            }
            #[expect(clippy::cast_precision_loss, reason = "a caller's number, rounded to nearest")]
            ParamKind::Float { .. } => ParamValue::Float(value as f64),
            _ => ParamValue::Int(i32::try_from(value).map_err(|_| out_of_range())?),
        };
        self.set(id, parameter, value)
    }

    /// Sets a number.
    ///
    /// # Errors
    /// As [`set`](Self::set).
    pub fn set_float(&mut self, id: BlockId, parameter: &str, value: f64) -> Result<(), Error> {
        self.set(id, parameter, ParamValue::Float(value))
    }

    /// Sets a parameter of any kind from a text: a number, `true` or `false`, the id or the number
    /// of an alternative, or the text itself.
    ///
    /// # Errors
    /// As [`set`](Self::set), and [`ErrorKind::Parse`].
    pub fn set_text(&mut self, id: BlockId, parameter: &str, text: &str) -> Result<(), Error> {
        let (_, spec) = self.parameter(id, parameter)?;
        let value = parse(spec, text).ok_or_else(|| {
            let message = format!("\"{text}\" is no {}", spec.kind.name());
            self.at(id, Error::new(ErrorKind::Parse, message).at_parameter(parameter))
        })?;
        self.set(id, parameter, value)
    }

    /// The value of a parameter.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`] or [`ErrorKind::NotFound`].
    pub fn get(&self, id: BlockId, parameter: &str) -> Result<&ParamValue, Error> {
        let (place, _) = self.parameter(id, parameter)?;
        Ok(&self.block(id)?.values[place])
    }

    /// Sets a parameter to its default.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`] or [`ErrorKind::NotFound`].
    pub fn reset(&mut self, id: BlockId, parameter: &str) -> Result<(), Error> {
        let (_, spec) = self.parameter(id, parameter)?;
        self.set(id, parameter, spec.default_value())
    }

    /// Gives a block its own seed, or the graph's again.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`].
    pub fn set_block_seed(&mut self, id: BlockId, seed: Option<u64>) -> Result<(), Error> {
        self.block_mut(id)?.seed = seed;
        Ok(())
    }

    /// The place and the declaration of a block's parameter.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`]; [`ErrorKind::NotFound`], with the nearest known id as a hint.
    pub fn parameter(
        &self,
        id: BlockId,
        parameter: &str,
    ) -> Result<(usize, &'static ParamSpec), Error> {
        let spec = self.known(id)?;
        spec.param(parameter).ok_or_else(|| {
            let error =
                Error::new(ErrorKind::NotFound, format!("has no parameter \"{parameter}\""));
            let ids = spec.params.iter().map(|spec| spec.id);
            let error = match nearest(parameter, ids) {
                Some(known) => error.with_hint(format!("did you mean \"{known}\"?")),
                None => error,
            };
            self.at(id, error)
        })
    }

    pub(super) fn block_mut(&mut self, id: BlockId) -> Result<&mut Block, Error> {
        self.block(id)?;
        let slot = &mut Arc::make_mut(&mut self.data).slots[id.index as usize];
        Ok(Arc::make_mut(slot.block.as_mut().expect("the handle was checked")))
    }

    /// Whether computing `block` needs `other`.
    pub(super) fn depends_on(&self, block: BlockId, other: BlockId) -> bool {
        let mut seen = vec![false; self.data.slots.len()];
        let mut waiting = vec![block];
        while let Some(id) = waiting.pop() {
            if id == other {
                return true;
            }
            if std::mem::replace(&mut seen[id.index as usize], true) {
                continue;
            }
            if let Ok(block) = self.block(id) {
                waiting.extend(block.inputs.iter().flatten().map(|source| source.block));
            }
        }
        false
    }

    /// A whole number that is no block's file id.
    fn unused_id(&self) -> String {
        let numbers = self.blocks().filter_map(|(_, block)| block.id.parse::<u64>().ok());
        match numbers.max().map(|max| max.checked_add(1)) {
            None => "0".to_owned(),
            Some(Some(next)) => next.to_string(),
            Some(None) => {
                let unused = (0_u64..).find(|number| self.find(&number.to_string()).is_none());
                unused.expect("a graph has fewer than 2⁶⁴ blocks").to_string()
            }
        }
    }
}

/// The value of a text for a parameter; `None` if it is none.
fn parse(spec: &ParamSpec, text: &str) -> Option<ParamValue> {
    let word = text.trim();
    Some(match spec.kind {
        ParamKind::Int { .. } => ParamValue::Int(word.parse().ok()?),
        ParamKind::Float { .. } => ParamValue::Float(word.parse().ok()?),
        ParamKind::Bool => match word {
            "true" | "1" => ParamValue::Bool(true),
            "false" | "0" => ParamValue::Bool(false),
            _ => return None,
        },
        ParamKind::Choice(items) => {
            let number = items.iter().position(|item| item.id == word);
            let number = number.or_else(|| word.parse().ok())?;
            ParamValue::Choice(u32::try_from(number).ok()?)
        }
        ParamKind::Text | ParamKind::Path(_) => ParamValue::Text(text.into()),
    })
}

pub(super) fn name(block: &Block) -> String {
    format!("block {} ({})", block.id, block.type_id)
}
