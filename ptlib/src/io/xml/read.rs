//! The walk through a file.

use std::{collections::btree_map::Entry, sync::Arc};

use quick_xml::{
    Reader,
    errors::{Error as XmlError, IllFormedError},
    escape::resolve_xml_entity,
    events::{BytesDecl, BytesStart, Event},
};

use super::{
    Reading,
    block::Draft,
    connect::{Ids, Target, connect},
    element::{Element, shortened},
    is_xml_char,
    position::position,
    report::{Report, raisable},
    root::read_root,
};
use crate::{
    block::Registry,
    error::{Error, ErrorKind},
    graph::{BlockId, Graph},
    limits::Limits,
};

/// Reads a graph file's contents.
///
/// # Errors
/// All faults of the file, by line and column, in one error.
pub(crate) fn read_graph(
    xml: &[u8],
    registry: &Arc<Registry>,
    limits: &Limits,
) -> Result<Reading, Error> {
    if xml.len() as u64 > limits.file_bytes {
        let message = format!("the file has {} bytes, allowed {}", xml.len(), limits.file_bytes);
        return Err(raisable(ErrorKind::Limit, message, "file_bytes"));
    }
    let text = decode(xml)?;
    let mut walk = Walk {
        text,
        limits,
        registry,
        graph: Graph::new(Arc::clone(registry)),
        report: Report::new(text, limits),
        open: Vec::new(),
        has_root: false,
        is_broken: false,
        draft: None,
        blocks: 0,
        inputs: 0,
        targets: Vec::new(),
        ids: Ids::new(),
        repeated: Vec::new(),
    };
    walk.read();
    walk.finish()
}

/// The text of a file: UTF-8, with or without a byte order mark, of characters that XML has.
fn decode(xml: &[u8]) -> Result<&str, Error> {
    if xml.starts_with(&[0xff, 0xfe]) || xml.starts_with(&[0xfe, 0xff]) {
        let error = Error::new(ErrorKind::Unsupported, "the file is in UTF-16, allowed UTF-8");
        return Err(error.with_hint("save it as UTF-8").at_position(1, 1));
    }
    let xml = xml.strip_prefix(b"\xef\xbb\xbf").unwrap_or(xml);
    let (text, fault) = match str::from_utf8(xml) {
        Ok(text) => (text, None),
        Err(error) => {
            let (valid, _) = xml.split_at_checked(error.valid_up_to()).unwrap_or_default();
            let message = "here is a byte that is not UTF-8";
            let error = Error::new(ErrorKind::Parse, message).with_hint("save the file as UTF-8");
            (str::from_utf8(valid).unwrap_or_default(), Some((valid.len(), error)))
        }
    };
    let strange = text.char_indices().find(|&(_, character)| !is_xml_char(character));
    let fault = match strange {
        Some((offset, character)) => {
            let message = format!("character {}, which XML forbids", u32::from(character));
            Some((offset, Error::new(ErrorKind::Parse, message)))
        }
        None => fault,
    };
    match fault {
        None => Ok(text),
        Some((offset, error)) => {
            let (line, column) = position(text, offset);
            Err(error.at_position(line, column))
        }
    }
}

struct Walk<'a> {
    text: &'a str,
    limits: &'a Limits,
    registry: &'a Registry,
    graph: Graph,
    report: Report<'a>,
    /// Where the elements start whose end has not come yet.
    open: Vec<usize>,
    has_root: bool,
    /// Whether ends of elements are missing: then no more of them are reported as missing.
    is_broken: bool,
    /// The block whose children are being read.
    draft: Option<Draft<'a>>,
    blocks: u32,
    inputs: u32,
    targets: Vec<Target<'a>>,
    ids: Ids,
    /// Blocks with the id of an earlier block.
    repeated: Vec<(usize, BlockId)>,
}

/// Whether to read on.
type Flow = std::ops::ControlFlow<()>;

impl<'a> Walk<'a> {
    fn read(&mut self) {
        let mut reader = Reader::from_str(self.text);
        let mut flow = Flow::Continue(());
        while flow.is_continue() && !self.report.is_full() {
            let start = offset(reader.buffer_position());
            flow = match reader.read_event() {
                Ok(Event::Start(tag)) => self.element(start, &tag, false),
                Ok(Event::Empty(tag)) => self.element(start, &tag, true),
                Ok(Event::End(_)) => self.end(),
                Ok(Event::Text(text)) => self.stray(start, &text),
                Ok(Event::CData(text)) => self.stray(start, &text),
                Ok(Event::GeneralRef(name)) => self.reference(start, &name),
                Ok(Event::Decl(declaration)) => self.declaration(start, &declaration),
                Ok(Event::Comment(_) | Event::PI(_) | Event::DocType(_)) => Flow::Continue(()),
                Ok(Event::Eof) => self.end_of_file(),
                Err(error) => self.malformed(offset(reader.error_position()), &error),
            };
        }
    }

    fn finish(mut self) -> Result<Reading, Error> {
        if !self.is_broken {
            connect(&mut self.graph, &self.targets, &self.ids, &mut self.report);
        }
        self.rename_repeated();
        self.report.finish(self.graph)
    }

    fn element(&mut self, start: usize, tag: &BytesStart<'_>, is_empty: bool) -> Flow {
        let depth = self.open.len();
        if depth >= self.limits.nesting as usize {
            let message = format!("elements are nested deeper than {}", self.limits.nesting);
            return self.stop(start, raisable(ErrorKind::Limit, message, "nesting"));
        }
        let element = Element::read(self.text, start, tag, self.limits, &mut self.report);
        let flow = match depth {
            0 => self.root(&element),
            1 => self.block(element),
            2 => self.child(element),
            _ => Flow::Continue(()),
        };
        self.open.push(start);
        if is_empty && flow.is_continue() { self.end() } else { flow }
    }

    fn root(&mut self, element: &Element<'_>) -> Flow {
        if self.has_root {
            let error = Error::new(ErrorKind::Parse, "there is a second root element");
            return self.stop(element.offset, error);
        }
        self.has_root = true;
        if read_root(element, &mut self.graph, self.limits, &mut self.report) {
            Flow::Continue(())
        } else {
            self.is_broken = true;
            Flow::Break(())
        }
    }

    fn block(&mut self, element: Element<'a>) -> Flow {
        self.blocks = self.blocks.saturating_add(1);
        if self.blocks > self.limits.blocks {
            let message = format!("more than {} blocks", self.limits.blocks);
            return self.stop(element.offset, raisable(ErrorKind::Limit, message, "blocks"));
        }
        if element.name != "block" {
            let name = shortened(element.name);
            let message = format!("<{name}> where only <block> is allowed");
            let mut error = Error::new(ErrorKind::Parse, message);
            if !self.report.is_strict {
                error = error.with_hint("taken as a block");
            }
            self.report.tolerate(element.offset, error);
        }
        self.draft = Some(Draft::new(element));
        Flow::Continue(())
    }

    fn child(&mut self, element: Element<'a>) -> Flow {
        let Some(draft) = &mut self.draft else { return Flow::Continue(()) };
        match element.name {
            "parameter" => draft.parameters.push(element),
            "input" => {
                self.inputs = self.inputs.saturating_add(1);
                if self.inputs > self.limits.connections {
                    let message = format!("more than {} connections", self.limits.connections);
                    let error = raisable(ErrorKind::Limit, message, "connections");
                    return self.stop(element.offset, error);
                }
                draft.inputs.push(element);
            }
            name => {
                let message = format!("<{}> is ignored", shortened(name));
                let error = Error::new(ErrorKind::Parse, message);
                let error = error.with_hint("a block has elements <input> and <parameter>");
                self.report.warn(element.offset, error);
            }
        }
        Flow::Continue(())
    }

    fn end(&mut self) -> Flow {
        self.open.pop();
        if self.open.len() != 1 {
            return Flow::Continue(());
        }
        let Some(draft) = self.draft.take() else { return Flow::Continue(()) };
        let id = draft.id().map(|id| (id.offset, id.value.clone().into_owned()));
        let target = draft.insert(&mut self.graph, self.registry, &mut self.report);
        let handle = target.as_ref().map(|target| target.handle);
        if let Some((offset, id)) = id {
            match self.ids.entry(id) {
                Entry::Vacant(entry) => {
                    entry.insert(handle);
                }
                Entry::Occupied(_) => {
                    self.repeated.extend(handle.map(|handle| (offset, handle)));
                }
            }
        }
        self.targets.extend(target);
        Flow::Continue(())
    }

    /// Gives unused ids to blocks with the id of an earlier block, so that ids name one block.
    fn rename_repeated(&mut self) {
        let mut next = 0_u64;
        for (offset, handle) in std::mem::take(&mut self.repeated) {
            while self.ids.contains_key(&next.to_string()) {
                next += 1;
            }
            let id = next.to_string();
            let error = Error::new(ErrorKind::Parse, "an earlier block has that id")
                .with_hint(format!("this one is block {id} from now on"));
            self.report.warn(offset, self.graph.at(handle, error));
            if let Err(error) = self.graph.set_file_id(handle, id.clone()) {
                self.report.fault(offset, error);
            }
            self.ids.insert(id, Some(handle));
        }
    }

    /// Text where none belongs: ignored inside of the root, malformed outside.
    fn stray(&mut self, start: usize, text: &str) -> Flow {
        let trimmed = text.trim_ascii_start();
        if trimmed.is_empty() {
            return Flow::Continue(());
        }
        let offset = start + (text.len() - trimmed.len());
        if self.open.is_empty() {
            let error = Error::new(ErrorKind::Parse, "text outside of the root element");
            return self.stop(offset, error);
        }
        let message = format!("text \"{}\" is ignored", shortened(trimmed.trim_ascii_end()));
        self.report.warn(offset, Error::new(ErrorKind::Parse, message));
        Flow::Continue(())
    }

    /// A reference such as `&amp;` between elements.
    fn reference(&mut self, start: usize, name: &str) -> Flow {
        if name.starts_with('#') || resolve_xml_entity(name).is_some() {
            return self.stray(start, "&");
        }
        let message = format!(
            "entity &{}; is none of the five of XML, and others are never expanded",
            shortened(name)
        );
        self.report.fault(start, Error::new(ErrorKind::Parse, message));
        Flow::Continue(())
    }

    fn declaration(&mut self, start: usize, declaration: &BytesDecl<'_>) -> Flow {
        let Some(Ok(encoding)) = declaration.encoding() else { return Flow::Continue(()) };
        let is_utf8 = ["utf-8", "utf8", "us-ascii", "ascii"]
            .iter()
            .any(|name| encoding.eq_ignore_ascii_case(name));
        if !is_utf8 {
            let message = format!("the encoding is \"{}\", allowed UTF-8", shortened(&encoding));
            let error = Error::new(ErrorKind::Unsupported, message);
            self.report.fault(start, error.with_hint("save the file as UTF-8"));
        }
        Flow::Continue(())
    }

    fn end_of_file(&mut self) -> Flow {
        if !self.has_root {
            let error = Error::new(ErrorKind::Parse, "the file has no root element");
            return self.stop(self.text.len(), error.with_hint("is this a graph file?"));
        }
        if let (Some(&start), false) = (self.open.last(), self.is_broken) {
            let error =
                Error::new(ErrorKind::Parse, "the file ends before the end of this element");
            return self.stop(start, error);
        }
        Flow::Break(())
    }

    /// What the XML parser says. It can go on after a wrong end tag or a lone `&`.
    fn malformed(&mut self, at: usize, error: &XmlError) -> Flow {
        let fault = Error::new(ErrorKind::Parse, malformed_message(error));
        match error {
            XmlError::IllFormed(IllFormedError::MismatchedEndTag { .. }) => {
                self.report.fault(at, fault);
                self.is_broken = true;
                self.end()
            }
            XmlError::IllFormed(IllFormedError::UnmatchedEndTag(_)) => self.stop(at, fault),
            XmlError::IllFormed(_) => {
                self.report.fault(at, fault);
                Flow::Continue(())
            }
            _ => self.stop(at, fault),
        }
    }

    /// Reports a fault behind which nothing in the file makes sense.
    fn stop(&mut self, at: usize, error: Error) -> Flow {
        self.report.fault(at, error);
        self.is_broken = true;
        Flow::Break(())
    }
}

fn malformed_message(error: &XmlError) -> String {
    match error {
        XmlError::IllFormed(IllFormedError::MismatchedEndTag { expected, found }) => {
            format!("</{}> where </{}> should be", shortened(found), shortened(expected))
        }
        XmlError::IllFormed(IllFormedError::UnmatchedEndTag(found)) => {
            format!("</{}> ends no element", shortened(found))
        }
        XmlError::IllFormed(IllFormedError::UnclosedReference) => {
            "an & without its ; (write &amp;)".to_owned()
        }
        XmlError::Syntax(error) => error.to_string(),
        other => other.to_string(),
    }
}

fn offset(position: u64) -> usize {
    usize::try_from(position).unwrap_or(usize::MAX)
}
