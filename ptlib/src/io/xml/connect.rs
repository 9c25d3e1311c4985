//! Connections: specification 1.2. They are made when all blocks are there, in file order.

use std::collections::BTreeMap;

use super::{
    OLD_SLOTS, UNKNOWN_SLOTS,
    element::{Attribute, Element, shortened},
    report::{Report, raisable},
    root::whole_number,
};
use crate::{
    error::{Error, ErrorKind},
    graph::{BlockId, Connector, Graph, Source},
};

/// A block that is in the graph, and the inputs that its file gave it.
pub(super) struct Target<'a> {
    pub(super) handle: BlockId,
    pub(super) inputs: Vec<Element<'a>>,
}

/// The first block of each id; `None` for one that the file names but that is not in the graph
/// because of its faults.
pub(super) type Ids = BTreeMap<String, Option<BlockId>>;

/// Makes all connections.
pub(super) fn connect(
    graph: &mut Graph,
    targets: &[Target<'_>],
    ids: &Ids,
    report: &mut Report<'_>,
) {
    let count = targets.iter().map(|target| target.inputs.len()).sum();
    let mut connector = Connector::new(graph, count);
    let mut cycles = 0;
    for target in targets {
        for element in &target.inputs {
            if report.is_full() {
                return;
            }
            let Some(link) = Link::read(element, target.handle, ids, report) else { continue };
            let made = link.make(&mut connector, report.is_strict);
            // Finding a cycle may take a walk through the whole graph, whose result is not kept.
            cycles +=
                usize::from(made.as_ref().is_err_and(|error| error.kind() == ErrorKind::Cycle));
            if cycles > report.limit {
                let message = format!("more than {} connections would close cycles", report.limit);
                report.fault(link.offset, raisable(ErrorKind::Limit, message, "faults"));
                return;
            }
            let at_target = |error| connector.graph().at(link.target, error);
            match made {
                Err(error) => report.tolerate(link.offset, at_target(error)),
                Ok(doubt) => {
                    doubt.into_iter().for_each(|error| report.warn(link.offset, at_target(error)));
                }
            }
        }
    }
}

/// A connection that a file wants.
struct Link<'e> {
    source: &'e str,
    known: Option<BlockId>,
    output: i128,
    target: BlockId,
    slot: i128,
    offset: usize,
}

impl<'e> Link<'e> {
    /// The connection of an `input` element; `None` if it is incomplete, or if its source is a
    /// block that has faults of its own.
    fn read(
        element: &'e Element<'_>,
        target: BlockId,
        ids: &Ids,
        report: &mut Report<'_>,
    ) -> Option<Self> {
        if element.is_damaged {
            return None;
        }
        let mut need = |name| {
            let attribute = element.get(name);
            if attribute.is_none() {
                report.tolerate(element.offset, element.missing(name));
            }
            attribute
        };
        let (id, slot) = (need("id"), need("slot"));
        let (id, slot): (&Attribute<'_>, &Attribute<'_>) = (id?, slot?);
        let known = match ids.get(&*id.value) {
            Some(None) => return None,
            Some(Some(handle)) => Some(*handle),
            None => None,
        };
        let output = element.get("output").map_or(Some(0), |output| whole_number(output, report));
        let slot = whole_number(slot, report);
        let (output, slot) = (output?, slot?);
        Some(Self { source: &id.value, known, output, target, slot, offset: element.offset })
    }

    /// Makes the connection. The error of `Ok` is a doubt, not a refusal.
    fn make(&self, connector: &mut Connector<'_>, is_strict: bool) -> Result<Option<Error>, Error> {
        let graph = connector.graph();
        let slots = slots(graph, self.target, is_strict)?;
        let slot = u32::try_from(self.slot).ok().filter(|&slot| slot < slots);
        let Some(slot) = slot else {
            let message = match slots {
                0 => format!("takes no inputs, slot is {}", self.slot),
                _ => format!("slot is {}, allowed 0..={}", self.slot, slots - 1),
            };
            return Err(Error::new(ErrorKind::OutOfRange, message));
        };
        let Some(source) = self.known else {
            let message = format!("input {slot} names block {}", shortened(self.source));
            let error = Error::new(ErrorKind::NotFound, message);
            return Err(error.with_hint("there is no block of that id in the file"));
        };
        let source = Source { block: source, output: self.output(graph, source)? };
        let inputs = graph.block(self.target)?.inputs();
        let connected = inputs.iter().flatten().count();
        if connected >= slots as usize {
            let message = format!("input {slot} cannot be connected: all {slots} inputs are");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let is_repeated = inputs.get(slot as usize).is_some_and(Option::is_some);
        connector.connect(source, self.target, slot)?;
        if is_repeated {
            let message = format!("slot {slot} is there more than once: the last one counts");
            return Ok(Some(Error::new(ErrorKind::Parse, message)));
        }
        Ok(kind_mismatch(connector.graph(), source, self.target, slot))
    }

    /// The output that the connection reads.
    fn output(&self, graph: &Graph, source: BlockId) -> Result<u32, Error> {
        let block = graph.block(source)?;
        let count = block.spec().map(|spec| spec.about.outputs.len());
        let output = u32::try_from(self.output).ok();
        output.filter(|&output| count.is_none_or(|count| (output as usize) < count)).ok_or_else(
            || {
                let message = format!("block {} has no output {}", block.id(), self.output);
                Error::new(ErrorKind::NotFound, message)
            },
        )
    }
}

/// How many inputs a block has.
fn slots(graph: &Graph, block: BlockId, is_strict: bool) -> Result<u32, Error> {
    let declared = graph.block(block)?.spec().map(|spec| spec.about.inputs.len());
    let most = if is_strict { UNKNOWN_SLOTS } else { OLD_SLOTS };
    Ok(match declared.map(u32::try_from) {
        Some(Ok(count)) if is_strict => count,
        Some(Ok(count)) => count.min(most),
        _ => most,
    })
}

/// Says so if the ports are of different kinds. Such an input counts as unconnected.
fn kind_mismatch(graph: &Graph, source: Source, target: BlockId, slot: u32) -> Option<Error> {
    let (from, to) = (graph.block(source.block).ok()?, graph.block(target).ok()?);
    let gives = from.spec()?.about.outputs.get(source.output as usize)?;
    let takes = to.spec()?.about.inputs.get(slot as usize)?;
    (gives.kind != takes.kind).then(|| {
        let message = format!(
            "input {slot} (\"{}\") takes a value of kind {}, but block {} ({}) gives one of kind \
             {}",
            takes.id,
            takes.kind.name(),
            from.id(),
            from.type_id(),
            gives.kind.name()
        );
        Error::new(ErrorKind::TypeMismatch, message)
    })
}
