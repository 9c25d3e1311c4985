//! The one description of a block type.

use std::fmt;

use super::{GatherBlock, Implementation, PointBlock, WholeBlock, shapes};
use crate::{
    math::levels::Precision,
    params::{ParamSet, ParamSpec},
    value::{Kind, MAX_PLANES},
};

/// How a block reads an input image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// The row that it writes, at the same position: the input need not exist as a whole.
    SameRow,
    /// Anywhere: the input is computed and kept before the block starts.
    Anywhere,
}

/// An input of a block.
#[derive(Debug, Clone, Copy)]
pub struct InputPort {
    /// Its id; files and the C ABI name it by its place.
    pub id: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// Whether the block works without it.
    pub is_optional: bool,
    /// How an image is read.
    pub access: Access,
}

/// The number of planes of an output image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Planes {
    /// One.
    Grey,
    /// Three: red, green, blue.
    Colour,
    /// Four: red, green, blue, alpha.
    ColourAlpha,
    /// As many as that input has.
    As(usize),
    /// As many as the one of those inputs that has the most.
    Most(&'static [usize]),
    /// As the block says for its parameters ([`PointBlock::is_grey`] and its kin): one or three.
    ByParameters,
}

impl Planes {
    /// The most planes that such an output may have.
    #[must_use]
    pub fn at_most(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::Colour | Self::ByParameters => 3,
            Self::As(_) | Self::Most(_) | Self::ColourAlpha => MAX_PLANES,
        }
    }
}

/// An output of a block.
#[derive(Debug, Clone, Copy)]
pub struct OutputPort {
    /// Its id; the C ABI names it by its place.
    pub id: &'static str,
    /// What it gives.
    pub kind: Kind,
    /// How many planes, for an image.
    pub planes: Planes,
    /// Whether its values are any finite numbers (heights, distances) instead of 0..1. The engine
    /// clamps the others, and in 8-bit precision truncates them to levels.
    pub is_free: bool,
}

/// A required input that takes a `kind`, read at the same position.
#[must_use]
pub const fn input(id: &'static str, kind: Kind) -> InputPort {
    InputPort { id, kind, is_optional: false, access: Access::SameRow }
}

impl InputPort {
    /// The port, made optional.
    #[must_use]
    pub const fn optional(mut self) -> Self {
        self.is_optional = true;
        self
    }

    /// The port, read anywhere.
    #[must_use]
    pub const fn anywhere(mut self) -> Self {
        self.access = Access::Anywhere;
        self
    }
}

/// An output image of range 0..1.
#[must_use]
pub const fn output(id: &'static str, planes: Planes) -> OutputPort {
    OutputPort { id, kind: Kind::Image, planes, is_free: false }
}

impl OutputPort {
    /// The port, giving another kind than an image.
    #[must_use]
    pub const fn of_kind(mut self, kind: Kind) -> Self {
        self.kind = kind;
        self
    }

    /// The port, giving any finite numbers.
    #[must_use]
    pub const fn free(mut self) -> Self {
        self.is_free = true;
        self
    }
}

/// Whether a block's output tiles when its inputs do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tiling {
    /// Always: what every block is expected to do.
    Always,
    /// In float precision always; in 8-bit precision, which keeps what PT Designer did, not: when
    /// it does not, and why.
    ExceptInEightBit(&'static str),
    /// Not always: when it does not, and why, in one sentence.
    Except(&'static str),
}

impl Tiling {
    /// Why the output need not tile in that precision.
    #[must_use]
    pub fn exception(self, precision: Precision) -> Option<&'static str> {
        match self {
            Self::ExceptInEightBit(reason) if precision == Precision::EightBit => Some(reason),
            Self::Except(reason) => Some(reason),
            Self::ExceptInEightBit(_) | Self::Always => None,
        }
    }
}

/// What a block is for in its graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Its outputs are for other blocks.
    Inner,
    /// Its output is a result of the graph. No other block reads it.
    Result,
    /// It writes a file: only when the caller asks for that.
    Writer,
    /// The caller of the graph sets its one output, see
    /// [`Graph::set_input`](crate::graph::Graph::set_input). Its text parameter `name` is what the
    /// caller finds it by.
    Input,
}

/// What a block type is, apart from its parameters.
#[derive(Debug, Clone, Copy)]
pub struct About {
    /// Its id in files and interfaces: lower-case words separated by single blanks, for ever. That
    /// of a plug-in's block has the vendor and a point before it.
    pub id: &'static str,
    /// What people call it; empty: the words of its id.
    pub name: &'static str,
    /// The version of ptlib, ×1000 + minor, that it came with (1 is 0.1); 0 for a plug-in's block.
    pub since: u32,
    /// What it makes, in one sentence.
    pub summary: &'static str,
    /// What it takes.
    pub inputs: &'static [InputPort],
    /// What it gives. Every block gives something; a [`Role::Writer`] gives what it writes.
    pub outputs: &'static [OutputPort],
    /// What it is for in its graph.
    pub role: Role,
    /// Whether another seed gives another picture.
    pub uses_seed: bool,
    /// Whether the same inputs and parameters always give the same: all but some blocks of
    /// plug-ins, whose results, and what follows from them, are never taken from the cache.
    pub is_deterministic: bool,
    /// Whether its output tiles.
    pub tiling: Tiling,
    /// Which of its lengths count pixels, so that the picture depends on the resolution; empty if
    /// none does.
    pub in_pixels: &'static str,
}

impl About {
    /// A block without inputs or outputs; a starting point for `..About::DEFAULT`.
    pub const DEFAULT: Self = Self {
        id: "",
        name: "",
        since: 1,
        summary: "",
        inputs: &[],
        outputs: &[],
        role: Role::Inner,
        uses_seed: false,
        is_deterministic: true,
        tiling: Tiling::Always,
        in_pixels: "",
    };
}

/// How a block computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Row by row from the same rows of its inputs.
    Point,
    /// Row by row from whole inputs.
    Gather,
    /// All at once.
    Whole,
}

/// A block type as the registry, the files, the C ABI, the command line, the documentation and the
/// tests see it.
pub struct BlockSpec {
    /// What it is.
    pub about: About,
    /// Its parameters.
    pub params: &'static [ParamSpec],
    pub(crate) implementation: Implementation,
}

impl BlockSpec {
    /// A block of shape [`Point`](Shape::Point).
    #[must_use]
    pub const fn point<B: PointBlock>(about: About) -> Self {
        assert!(!reads_anywhere(&about), "a point block reads its inputs at the same position");
        Self {
            about,
            params: <B::Params as ParamSet>::SPECS,
            implementation: Implementation::Rows(&shapes::Point::<B>::FACTORY),
        }
    }

    /// A block of shape [`Gather`](Shape::Gather).
    #[must_use]
    pub const fn gather<B: GatherBlock>(about: About) -> Self {
        assert!(reads_anywhere(&about), "a gather block reads an input anywhere");
        Self {
            about,
            params: <B::Params as ParamSet>::SPECS,
            implementation: Implementation::Rows(&shapes::Gather::<B>::FACTORY),
        }
    }

    /// A block of shape [`Whole`](Shape::Whole). Its inputs exist as wholes, whatever their ports
    /// say.
    #[must_use]
    pub const fn whole<B: WholeBlock>(about: About) -> Self {
        Self {
            about,
            params: <B::Params as ParamSet>::SPECS,
            implementation: Implementation::Whole(&shapes::Whole::<B>::FACTORY),
        }
    }

    /// What people call it: `Perlin noise`.
    #[must_use]
    pub fn name(&self) -> String {
        if !self.about.name.is_empty() {
            return self.about.name.to_owned();
        }
        let words = self.about.id.rsplit('.').next().unwrap_or_default();
        let mut rest = words.chars();
        rest.next().map(|first| first.to_uppercase().chain(rest).collect()).unwrap_or_default()
    }

    /// How it computes.
    #[must_use]
    pub fn shape(&self) -> Shape {
        match self.implementation {
            Implementation::Whole(_) => Shape::Whole,
            Implementation::Rows(_) if reads_anywhere(&self.about) => Shape::Gather,
            Implementation::Rows(_) => Shape::Point,
        }
    }

    /// The parameter of that id and its place.
    #[must_use]
    pub fn param(&self, id: &str) -> Option<(usize, &'static ParamSpec)> {
        self.params.iter().enumerate().find(|(_, spec)| spec.id == id)
    }

    /// How the block reads the image at input `port`.
    pub(crate) fn access(&self, port: usize) -> Access {
        match self.implementation {
            Implementation::Whole(_) => Access::Anywhere,
            Implementation::Rows(_) => self.about.inputs[port].access,
        }
    }
}

impl fmt::Debug for BlockSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "BlockSpec({})", self.about.id)
    }
}

const fn reads_anywhere(about: &About) -> bool {
    let mut i = 0;
    while i < about.inputs.len() {
        if matches!(about.inputs[i].access, Access::Anywhere) {
            return true;
        }
        i += 1;
    }
    false
}
