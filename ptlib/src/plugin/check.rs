//! From the tables of a plug-in to what the engine believes: every pointer, text and number is
//! checked here, and nowhere else.
//!
//! What cannot be checked is a promise of the contract: that a pointer which is neither NULL nor
//! misaligned leads to a table, that an array is as long as its count says, that a text ends with
//! NUL, and that all of it stays as it is as long as the process lives.

use std::{collections::BTreeSet, ffi::c_char};

use ptlib_plugin_abi::{
    PTLP_ABI_MAJOR, ptlp_block, ptlp_entry, ptlp_param, ptlp_port,
    values::{
        PTL_KIND_GRADIENT, PTL_KIND_IMAGE, PTL_KIND_MESH, PTL_KIND_POINTS, PTL_KIND_STRANDS,
        PTL_KIND_TEXT,
    },
};

use crate::{
    error::{Error, ErrorKind},
    math::convert::count,
    value::Kind,
};

/// How much a plug-in may declare. Real ones have some dozens of everything.
const MAX_BLOCKS: u32 = 1024;
const MAX_PORTS: u32 = count(crate::block::MAX_INPUTS);
const MAX_PARAMS: u32 = 256;
const MAX_CHOICES: u32 = 1024;
/// Bytes of a text, its end included.
const MAX_TEXT: usize = 64 << 10;
/// Bytes of an id.
const MAX_ID: usize = 128;

/// A table that starts with its size.
///
/// # Safety
/// The type is `repr(C)`, starts with its size as `u32`, and any bits are a value of it.
pub(super) unsafe trait Table: Sized {
    const NAME: &'static str;
}

// SAFETY: see `ptlib_plugin_abi`; function pointers are `Option`s, of which NULL is one, and what
// else is in them is the contract's promise.
unsafe impl Table for ptlp_entry {
    const NAME: &'static str = "ptlp_entry";
}
// SAFETY: as above.
unsafe impl Table for ptlp_block {
    const NAME: &'static str = "ptlp_block";
}
// SAFETY: as above.
unsafe impl Table for ptlp_port {
    const NAME: &'static str = "ptlp_port";
}
// SAFETY: as above.
unsafe impl Table for ptlp_param {
    const NAME: &'static str = "ptlp_param";
}

/// Where in the tables the reader is, for messages.
#[derive(Debug, Clone)]
pub(super) struct Reader {
    place: String,
}

impl Reader {
    pub(super) fn new() -> Self {
        Self { place: String::new() }
    }

    /// A reader of a part.
    pub(super) fn at(&self, part: impl std::fmt::Display) -> Self {
        let separator = if self.place.is_empty() { "" } else { ", " };
        Self { place: format!("{}{separator}{part}", self.place) }
    }

    /// The error that field `field` is wrong.
    pub(super) fn fault(&self, field: &str, message: impl std::fmt::Display) -> Error {
        let separator = if self.place.is_empty() { "" } else { ": " };
        let message = format!("{}{separator}`{field}` {message}", self.place);
        Error::new(ErrorKind::PluginDescriptor, message)
    }

    /// A table.
    ///
    /// # Safety
    /// The contract: `table` is NULL, misaligned, or leads to a table.
    pub(super) unsafe fn table<T: Table>(
        &self,
        table: *const T,
        field: &str,
    ) -> Result<&'static T, Error> {
        if table.is_null() || !table.is_aligned() {
            let what = if table.is_null() { "is NULL" } else { "is not aligned for its type" };
            return Err(self.fault(field, what));
        }
        // SAFETY: not NULL, aligned, and a table starts with its size.
        let size = unsafe { table.cast::<u32>().read() };
        if size as usize != size_of::<T>() {
            let message = format!(
                "has a struct_size of {size}, but a {} of this contract has {} bytes",
                T::NAME,
                size_of::<T>()
            );
            return Err(self.fault(field, message));
        }
        // SAFETY: it says that it is as long as a table is.
        Ok(unsafe { &*table })
    }

    /// An array of pointers.
    ///
    /// # Safety
    /// The contract: `array` is NULL, misaligned, or as long as `count` says.
    pub(super) unsafe fn array<T>(
        &self,
        array: *const *const T,
        count: u32,
        most: u32,
        field: &str,
    ) -> Result<&'static [*const T], Error> {
        if count > most {
            return Err(self.fault(field, format!("has {count} entries, allowed {most}")));
        }
        if count == 0 {
            return Ok(&[]);
        }
        if array.is_null() || !array.is_aligned() {
            return Err(self.fault(field, format!("is no array, but its count is {count}")));
        }
        // SAFETY: not NULL, aligned, few entries, and as long as its count says.
        Ok(unsafe { std::slice::from_raw_parts(array, count as usize) })
    }

    /// Tables in an array of pointers.
    ///
    /// # Safety
    /// Those of [`array`](Self::array) and [`table`](Self::table).
    unsafe fn tables<T: Table>(
        &self,
        array: *const *const T,
        count: u32,
        most: u32,
        field: &str,
    ) -> Result<Vec<&'static T>, Error> {
        // SAFETY: the caller's promise.
        let pointers = unsafe { self.array(array, count, most, field) }?;
        let tables = pointers.iter().enumerate().map(|(i, table)| {
            // SAFETY: the caller's promise.
            unsafe { self.table(*table, &format!("{field}[{i}]")) }
        });
        tables.collect()
    }

    /// A text that may be missing.
    ///
    /// # Safety
    /// The contract: `text` is NULL or ends with NUL.
    pub(super) unsafe fn optional_text(
        &self,
        text: *const c_char,
        field: &str,
    ) -> Result<Option<&'static str>, Error> {
        if text.is_null() {
            return Ok(None);
        }
        // Byte by byte, so that nothing behind the NUL is read.
        // SAFETY: up to its NUL, and no further than the limit, the text can be read.
        let end = (0..MAX_TEXT).find(|i| unsafe { text.add(*i).read() } == 0);
        let Some(end) = end else {
            return Err(self.fault(field, format!("has no end within {MAX_TEXT} bytes")));
        };
        // SAFETY: the bytes up to the NUL were read above.
        let bytes = unsafe { std::slice::from_raw_parts(text.cast::<u8>(), end) };
        match std::str::from_utf8(bytes) {
            Ok(text) if !text.contains(|c: char| c.is_control() && c != '\n') => Ok(Some(text)),
            Ok(_) => Err(self.fault(field, "has a control character")),
            Err(error) => {
                let message = format!("is not UTF-8 from byte {}", error.valid_up_to());
                Err(self.fault(field, message))
            }
        }
    }

    /// A text.
    ///
    /// # Safety
    /// That of [`optional_text`](Self::optional_text).
    pub(super) unsafe fn text(
        &self,
        text: *const c_char,
        field: &str,
    ) -> Result<&'static str, Error> {
        // SAFETY: the caller's promise.
        let text = unsafe { self.optional_text(text, field) }?;
        text.ok_or_else(|| self.fault(field, "is NULL"))
    }

    /// An id of words.
    ///
    /// # Safety
    /// That of [`optional_text`](Self::optional_text).
    pub(super) unsafe fn id(
        &self,
        text: *const c_char,
        field: &str,
    ) -> Result<&'static str, Error> {
        // SAFETY: the caller's promise.
        let id = unsafe { self.text(text, field) }?;
        if is_words(id) { Ok(id) } else { Err(self.bad_id(field, id, "words")) }
    }

    fn bad_id(&self, field: &str, id: &str, what: &str) -> Error {
        let message = format!(
            "is \"{}\", allowed {what} of a to z, 0 to 9 and hyphens, separated by single blanks",
            id.escape_debug()
        );
        self.fault(field, message)
    }

    /// Fails unless `number` has only known bits.
    pub(super) fn flags(&self, number: u32, known: u32, field: &str) -> Result<(), Error> {
        if number & !known == 0 {
            return Ok(());
        }
        Err(self.fault(field, format!("is {number:#x}, known are the bits {known:#x}")))
    }
}

/// Whether an id has one word or more: lower-case, with single blanks between.
fn is_words(id: &str) -> bool {
    let is_word = |word: &str| {
        !word.is_empty()
            && word.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-')
    };
    id.len() <= MAX_ID && id.split(' ').all(is_word)
}

/// What a plug-in says of itself.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) table: &'static ptlp_entry,
    pub(super) id: &'static str,
    pub(super) name: &'static str,
    pub(super) vendor: &'static str,
    pub(super) version: &'static str,
    pub(super) license: &'static str,
    pub(super) built_with: &'static str,
}

impl Entry {
    /// Reads the entry, without its blocks.
    ///
    /// # Errors
    /// [`ErrorKind::PluginAbi`], [`ErrorKind::PluginDescriptor`].
    ///
    /// # Safety
    /// The contract.
    pub(super) unsafe fn read(entry: *const ptlp_entry) -> Result<Self, Error> {
        let reader = Reader::new();
        if entry.is_null() || !entry.is_aligned() {
            return Err(reader.fault("ptl_plugin_entry_v1", "leads nowhere"));
        }
        // SAFETY: not NULL and aligned; every entry starts with its size and its version.
        let [size, major, minor] = unsafe { entry.cast::<[u32; 3]>().read() };
        if major != PTLP_ABI_MAJOR {
            let message = format!(
                "was built for version {major}.{minor} of the plug-in contract, this library has \
                 version {PTLP_ABI_MAJOR}"
            );
            let hint = "get a version of the plug-in for this library, or build it again";
            return Err(Error::new(ErrorKind::PluginAbi, message).with_hint(hint));
        }
        if size as usize != size_of::<ptlp_entry>() {
            let message = format!(
                "its entry has a struct_size of {size}, but one of version {major} has {} bytes",
                size_of::<ptlp_entry>()
            );
            return Err(Error::new(ErrorKind::PluginAbi, message));
        }
        // SAFETY: a table of this version, as long as it should be.
        let table = unsafe { reader.table(entry, "ptl_plugin_entry_v1") }?;
        reader.flags(table.flags, 0, "flags")?;
        // SAFETY: the contract.
        let text = |text, field| unsafe { reader.text(text, field) };
        let entry = Self {
            id: text(table.id, "id")?,
            name: text(table.name, "name")?,
            vendor: text(table.vendor, "vendor")?,
            version: text(table.version, "version")?,
            license: text(table.license, "license")?,
            // SAFETY: the contract.
            built_with: unsafe { reader.optional_text(table.built_with, "built_with") }?
                .unwrap_or_default(),
            table,
        };
        let mut parts = entry.id.split('.');
        let is_id = parts.by_ref().take(2).all(|part| is_words(part) && !part.contains(' '));
        if !is_id || parts.next().is_some() || entry.prefix() == "ptl" {
            let message = format!(
                "is \"{}\", allowed a vendor (not ptl), perhaps followed by a point and a word",
                entry.id.escape_debug()
            );
            return Err(reader.fault("id", message));
        }
        Ok(entry)
    }

    /// What the ids of its blocks have before their point.
    pub(super) fn prefix(&self) -> &'static str {
        self.id.split('.').next().unwrap_or_default()
    }

    /// Its block types.
    ///
    /// # Errors
    /// [`ErrorKind::PluginDescriptor`].
    ///
    /// # Safety
    /// The contract.
    pub(super) unsafe fn blocks(&self) -> Result<Vec<Block>, Error> {
        let (table, reader) = (self.table, Reader::new());
        // SAFETY: the contract.
        let tables =
            unsafe { reader.tables(table.blocks, table.block_count, MAX_BLOCKS, "blocks") }?;
        let mut ids = BTreeSet::new();
        let mut blocks = Vec::with_capacity(tables.len());
        for (number, table) in tables.into_iter().enumerate() {
            let reader = reader.at(format_args!("block {number}"));
            // SAFETY: the contract.
            let block = unsafe { Block::read(&reader, table, self.prefix()) }?;
            if !ids.insert(block.id) {
                return Err(reader.fault("id", format!("is \"{}\" once more", block.id)));
            }
            blocks.push(block);
        }
        Ok(blocks)
    }
}

/// What a plug-in says of a block type: tables that are what they should be, texts that are texts.
/// Whether its numbers make sense is for [`describe`](super::foreign).
#[derive(Debug)]
pub(super) struct Block {
    pub(super) reader: Reader,
    pub(super) table: &'static ptlp_block,
    pub(super) id: &'static str,
    pub(super) inputs: Vec<Port>,
    pub(super) outputs: Vec<Port>,
    pub(super) params: Vec<Param>,
}

/// A port.
#[derive(Debug)]
pub(super) struct Port {
    pub(super) reader: Reader,
    pub(super) table: &'static ptlp_port,
    pub(super) id: &'static str,
    pub(super) kind: Kind,
}

/// A parameter.
#[derive(Debug)]
pub(super) struct Param {
    pub(super) reader: Reader,
    pub(super) table: &'static ptlp_param,
    pub(super) id: &'static str,
    /// Ids and meanings of alternatives.
    pub(super) choices: Vec<(&'static str, &'static str)>,
}

impl Block {
    /// # Safety
    /// The contract.
    unsafe fn read(
        reader: &Reader,
        table: &'static ptlp_block,
        prefix: &str,
    ) -> Result<Self, Error> {
        // SAFETY: the contract.
        let id = unsafe { reader.text(table.id, "id") }?;
        let words = id.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('.'));
        if !words.is_some_and(is_words) || id.len() > MAX_ID {
            return Err(reader.bad_id("id", id, &format!("\"{prefix}.\" and words")));
        }
        let reader = reader.at(format_args!("\"{id}\""));
        // SAFETY: the contract.
        let ports = |ports, count, field| unsafe { Port::read_all(&reader, ports, count, field) };
        let inputs = ports(table.inputs, table.input_count, "inputs")?;
        let outputs = ports(table.outputs, table.output_count, "outputs")?;
        // SAFETY: the contract.
        let params = unsafe { Param::read_all(&reader, table) }?;
        Ok(Self { table, id, inputs, outputs, params, reader })
    }

    /// A text of the block that may be missing.
    pub(super) fn text(&self, text: *const c_char, field: &str) -> Result<&'static str, Error> {
        // SAFETY: the contract.
        unsafe { self.reader.optional_text(text, field) }.map(Option::unwrap_or_default)
    }
}

impl Port {
    /// # Safety
    /// The contract.
    unsafe fn read_all(
        reader: &Reader,
        ports: *const *const ptlp_port,
        count: u32,
        field: &str,
    ) -> Result<Vec<Self>, Error> {
        // SAFETY: the contract.
        let tables = unsafe { reader.tables(ports, count, MAX_PORTS, field) }?;
        let mut ids = BTreeSet::new();
        let port = |(number, table): (usize, &'static ptlp_port)| {
            let reader = reader.at(format_args!("{field}[{number}]"));
            // SAFETY: the contract.
            let id = unsafe { reader.id(table.id, "id") }?;
            if !ids.insert(id) {
                return Err(reader.fault("id", format!("is \"{id}\" once more")));
            }
            // SAFETY: the contract.
            unsafe { reader.optional_text(table.doc, "doc") }?;
            let Some(kind) = kind_of(table.kind) else {
                return Err(reader.fault("kind", format!("is {}, which is none", table.kind)));
            };
            Ok(Self { table, id, kind, reader })
        };
        tables.into_iter().enumerate().map(port).collect()
    }
}

/// The kind of a number.
pub(super) fn kind_of(number: u32) -> Option<Kind> {
    match number {
        PTL_KIND_IMAGE => Some(Kind::Image),
        PTL_KIND_GRADIENT => Some(Kind::Gradient),
        PTL_KIND_TEXT => Some(Kind::Text),
        PTL_KIND_POINTS => Some(Kind::Points),
        PTL_KIND_MESH => Some(Kind::Mesh),
        PTL_KIND_STRANDS => Some(Kind::Strands),
        _ => None,
    }
}

impl Param {
    /// # Safety
    /// The contract.
    unsafe fn read_all(reader: &Reader, block: &'static ptlp_block) -> Result<Vec<Self>, Error> {
        // SAFETY: the contract.
        let tables =
            unsafe { reader.tables(block.params, block.param_count, MAX_PARAMS, "params") }?;
        let mut ids = BTreeSet::new();
        let param = |(number, table): (usize, &'static ptlp_param)| {
            let reader = reader.at(format_args!("params[{number}]"));
            // SAFETY: the contract.
            let id = unsafe { reader.id(table.id, "id") }?;
            if !ids.insert(id) {
                return Err(reader.fault("id", format!("is \"{id}\" once more")));
            }
            // SAFETY: the contract.
            let choices = unsafe { choices(&reader, table) }?;
            Ok(Self { table, id, choices, reader })
        };
        tables.into_iter().enumerate().map(param).collect()
    }

    /// A text of the parameter that may be missing.
    pub(super) fn text(&self, text: *const c_char, field: &str) -> Result<&'static str, Error> {
        // SAFETY: the contract.
        unsafe { self.reader.optional_text(text, field) }.map(Option::unwrap_or_default)
    }
}

/// # Safety
/// The contract.
unsafe fn choices(
    reader: &Reader,
    param: &ptlp_param,
) -> Result<Vec<(&'static str, &'static str)>, Error> {
    let count = param.choice_count;
    // SAFETY: the contract.
    let ids = unsafe { reader.array(param.choice_ids, count, MAX_CHOICES, "choice_ids") }?;
    let docs = if param.choice_docs.is_null() {
        &[][..]
    } else {
        // SAFETY: the contract.
        unsafe { reader.array(param.choice_docs, count, MAX_CHOICES, "choice_docs") }?
    };
    let mut known = BTreeSet::new();
    let choice = |(number, id): (usize, &*const c_char)| {
        // SAFETY: the contract.
        let id = unsafe { reader.id(*id, &format!("choice_ids[{number}]")) }?;
        if !known.insert(id) {
            return Err(reader.fault("choice_ids", format!("has \"{id}\" twice")));
        }
        let doc = docs.get(number).copied().unwrap_or_else(|| c"".as_ptr());
        // SAFETY: the contract.
        let doc = unsafe { reader.optional_text(doc, &format!("choice_docs[{number}]")) }?;
        Ok((id, doc.unwrap_or_default()))
    };
    ids.iter().enumerate().map(choice).collect()
}
