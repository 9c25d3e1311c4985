//! What files say, and what becomes of it.

mod connections;
mod faults;
mod parameters;
mod roots;
mod round_trip;

use std::sync::Arc;

use super::{Reading, read_graph};
use crate::{
    block::{Family, Registry, prelude::*},
    graph::{Block, Graph},
    limits::Limits,
};

choice! {
    /// One of three.
    Way {
        /// First.
        First = "first",
        /// Second.
        Second = "second",
        /// Third.
        Third = "third",
    }
}

params! {
    /// One of each kind.
    Knobs {
        /// A whole number.
        count: int [hard 0..=255 soft 0..=10] = 5;
        /// A number.
        amount "how much": float [hard -10.0..=10.0 soft 0.0..=1.0] = 0.5;
        /// A flag.
        really: bool = false;
        /// A choice.
        way: choice [Way] = Way::Second;
        /// A text.
        words: text = "a b";
        /// A path.
        path: path [read] = "";
    }
}

params! {
    /// None.
    Nothing {}
}

struct Plain;
struct Knobbed;

impl PointBlock for Plain {
    type Params = Nothing;
    fn prepare<L: Levels>(_: &Nothing, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }
    fn row<L: Levels>(&self, _: &RowContext<'_>, _: &InputRows<'_>, _: &mut OutputRow<'_>) {}
}

impl PointBlock for Knobbed {
    type Params = Knobs;
    fn prepare<L: Levels>(_: &Knobs, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }
    fn row<L: Levels>(&self, _: &RowContext<'_>, _: &InputRows<'_>, _: &mut OutputRow<'_>) {}
}

const IMAGE: crate::block::InputPort = input("image", Kind::Image);
const OUTPUT: crate::block::OutputPort = output("image", Planes::Grey);

macro_rules! spec {
    ($name:ident, $shape:ident, $id:literal, $inputs:expr, $outputs:expr, $role:ident) => {
        static $name: BlockSpec = BlockSpec::point::<$shape>(About {
            id: $id,
            inputs: $inputs,
            outputs: $outputs,
            role: Role::$role,
            ..About::DEFAULT
        });
    };
}

spec!(SOURCE, Plain, "source", &[], &[OUTPUT, OUTPUT], Inner);
spec!(COLORS, Plain, "colors", &[], &[OUTPUT.of_kind(Kind::Gradient)], Inner);
spec!(ONE, Plain, "one", &[IMAGE], &[OUTPUT], Inner);
spec!(TWO, Plain, "two", &[IMAGE, IMAGE], &[OUTPUT], Inner);
spec!(SIX, Plain, "six", &[IMAGE; 6], &[OUTPUT], Inner);
spec!(KNOBS, Knobbed, "knobs", &[], &[OUTPUT], Inner);
spec!(FINISH, Plain, "finish", &[IMAGE], &[OUTPUT], Result);

fn registry() -> Arc<Registry> {
    static FAMILY: Family =
        Family { name: "test", blocks: &[&SOURCE, &COLORS, &ONE, &TWO, &SIX, &KNOBS, &FINISH] };
    let registry = Registry::default();
    registry.add(&FAMILY).unwrap();
    Arc::new(registry)
}

fn try_read(xml: &str) -> Result<Reading, Error> {
    read_graph(xml.as_bytes(), &registry(), &Limits::default())
}

/// The graph of a file, and its warnings.
fn read(xml: &str) -> (Graph, Vec<String>) {
    let reading = try_read(xml).unwrap();
    (reading.graph, reading.warnings.iter().map(ToString::to_string).collect())
}

/// The graph of a file that gives no warnings.
fn read_clean(xml: &str) -> Graph {
    let (graph, warnings) = read(xml);
    assert_eq!(warnings, [""; 0]);
    graph
}

/// The faults of a file.
fn faults(xml: &str) -> Vec<String> {
    let error = try_read(xml).unwrap_err();
    error.faults().map(|fault| fault.to_string().lines().next().unwrap().to_owned()).collect()
}

/// The kind of a file's first fault.
fn fault_kind(xml: &str) -> ErrorKind {
    try_read(xml).unwrap_err().kind()
}

/// A file of PT Designer with these blocks; they start in line 2.
fn old(blocks: &str) -> String {
    let root = "<texturegraph width=\"8\" height=\"8\" seed=\"0\" supersampling=\"1\">";
    format!("{root}\n{blocks}\n</texturegraph>")
}

/// A file of ours with these blocks; they start in line 2.
fn ours(blocks: &str) -> String {
    old(blocks).replace("\">\n", "\" version=\"1\" precision=\"float\">\n")
}

fn block<'g>(graph: &'g Graph, id: &str) -> &'g Block {
    graph.block(graph.find(id).unwrap()).unwrap()
}

/// The inputs of a block: the file ids of what they read.
fn inputs<'g>(graph: &'g Graph, id: &str) -> Vec<Option<&'g str>> {
    let source = |source: &Option<crate::graph::Source>| {
        source.map(|source| graph.block(source.block).unwrap().id())
    };
    block(graph, id).inputs().iter().map(source).collect()
}
