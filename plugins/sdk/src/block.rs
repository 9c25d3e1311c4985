//! What a block is: its description, and the trait that computes it.

use std::{
    ffi::{CStr, c_char},
    ptr,
};

use ptlib_plugin_abi::{values::*, *};

use crate::{BlockError, Call, ParamSet, Setup, private::count};

/// A block type. The implementing type is a *prepared* block: what [`prepare`](Self::prepare) made
/// of the parameters.
pub trait Block: Sized + Send + Sync + 'static {
    /// The parameters, declared with [`params!`](crate::params!); `()` for none.
    type Params: ParamSet;

    /// What it is.
    const ABOUT: About;

    /// Prepares a computation.
    ///
    /// # Errors
    /// Whatever makes the block fail.
    fn prepare(params: &Self::Params, setup: &Setup<'_>) -> Result<Self, BlockError>;

    /// Writes all of each output. For the shapes Point and Gather, this is called for one part of
    /// the image after the other, on several threads; for Whole, once.
    ///
    /// # Errors
    /// Whatever makes the block fail.
    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError>;

    /// The most memory in bytes that the prepared block and its computation take, if that grows
    /// with the image or a parameter.
    fn memory(_params: &Self::Params, _width: u32, _height: u32) -> u64 {
        0
    }
}

/// An input of graphs: a block type without a computation, whose one output the caller of a graph
/// sets. It may have one optional input, of the same kind, that stands in for what is not set.
pub trait GraphInput: 'static {
    /// The parameters, declared with [`params!`](crate::params!); `()` for none.
    type Params: ParamSet;

    /// What it is.
    const ABOUT: About;
}

/// What one call of [`Block::compute`] writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Any part of the image, from the same part of each input and the position.
    Point = PTLP_SHAPE_POINT as isize,
    /// Any part of the image, from whole inputs (those that are [`anywhere`](InputPort::anywhere)).
    Gather = PTLP_SHAPE_GATHER as isize,
    /// Everything, from whole inputs.
    Whole = PTLP_SHAPE_WHOLE as isize,
}

/// Which threads may be inside of a block type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Threads {
    /// Any: what Rust's `Sync` stands for.
    Any = PTLP_THREADS_TILES as isize,
    /// One for each prepared block: blocks that change themselves behind a `Mutex`, or call
    /// libraries that do.
    Instance = PTLP_THREADS_INSTANCE as isize,
    /// One in the process: blocks that call libraries with global state.
    Global = PTLP_THREADS_GLOBAL as isize,
}

/// What flows on a wire.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// An image.
    Image = PTL_KIND_IMAGE as isize,
    /// A colour transition.
    Gradient = PTL_KIND_GRADIENT as isize,
    /// A text of any meaning.
    Text = PTL_KIND_TEXT as isize,
    /// Points.
    Points = PTL_KIND_POINTS as isize,
    /// Triangles.
    Mesh = PTL_KIND_MESH as isize,
    /// Polylines.
    Strands = PTL_KIND_STRANDS as isize,
}

/// The planes of an output image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Planes {
    /// One.
    Grey,
    /// Red, green, blue.
    Colour,
    /// Red, green, blue, alpha.
    ColourAlpha,
    /// Those of an input.
    AsInput(u32),
    /// Those of the image input that has the most.
    Most,
}

/// What a block type is, apart from its parameters. Start from [`About::DEFAULT`].
#[derive(Debug, Clone, Copy)]
pub struct About {
    /// `vendor.name`: the vendor of the plug-in's id, and lower-case words separated by single
    /// blanks. For ever.
    pub id: &'static CStr,
    /// What people call it; empty: what stands behind the point of its id.
    pub name: &'static CStr,
    /// The family that it is listed with, such as `noise`.
    pub category: &'static CStr,
    /// What it makes, in one sentence.
    pub summary: &'static CStr,
    /// Counts up whenever its results change.
    pub version: u32,
    /// What one call writes.
    pub shape: Shape,
    /// Which threads may be inside.
    pub threads: Threads,
    /// What it takes.
    pub inputs: &'static [&'static InputPort],
    /// What it gives.
    pub outputs: &'static [&'static OutputPort],
    /// Whether another seed gives another result.
    pub uses_seed: bool,
    /// Whether the same inputs and parameters may give something else, so that results are not kept.
    pub varies: bool,
    /// Why its output need not tile although its inputs do; empty if it always tiles.
    pub tiling_exception: &'static CStr,
    /// Which of its lengths count pixels, so that the picture depends on the resolution.
    pub in_pixels: &'static CStr,
}

impl About {
    /// A Point block of version 1 without ports.
    pub const DEFAULT: Self = Self {
        id: c"",
        name: c"",
        category: c"",
        summary: c"",
        version: 1,
        shape: Shape::Point,
        threads: Threads::Any,
        inputs: &[],
        outputs: &[],
        uses_seed: false,
        varies: false,
        tiling_exception: c"",
        in_pixels: c"",
    };
}

/// An input: [`input`].
#[repr(transparent)]
#[derive(Debug, Clone, Copy)]
pub struct InputPort(ptlp_port);

/// An output: [`output`].
#[repr(transparent)]
#[derive(Debug, Clone, Copy)]
pub struct OutputPort(ptlp_port);

const fn port(id: &'static CStr, kind: Kind) -> ptlp_port {
    ptlp_port {
        struct_size: count(size_of::<ptlp_port>()),
        kind: kind as u32,
        flags: 0,
        planes: 0,
        planes_input: 0,
        reserved0: 0,
        id: id.as_ptr(),
        doc: ptr::null(),
    }
}

/// A required input, read at the place that is written.
#[must_use]
pub const fn input(id: &'static CStr, kind: Kind) -> InputPort {
    InputPort(port(id, kind))
}

impl InputPort {
    /// The port, made optional.
    #[must_use]
    pub const fn optional(mut self) -> Self {
        self.0.flags |= PTLP_PORT_OPTIONAL;
        self
    }

    /// The port of an image, read anywhere: for the shape Gather.
    #[must_use]
    pub const fn anywhere(mut self) -> Self {
        self.0.flags |= PTLP_PORT_ANYWHERE;
        self
    }

    /// The port, with a sentence on what it is.
    #[must_use]
    pub const fn doc(mut self, doc: &'static CStr) -> Self {
        self.0.doc = doc.as_ptr();
        self
    }
}

/// An output image of range 0..1.
#[must_use]
pub const fn output(id: &'static CStr, planes: Planes) -> OutputPort {
    let mut port = port(id, Kind::Image);
    (port.planes, port.planes_input) = match planes {
        Planes::Grey => (PTLP_PLANES_GREY, 0),
        Planes::Colour => (PTLP_PLANES_COLOUR, 0),
        Planes::ColourAlpha => (PTLP_PLANES_COLOUR_ALPHA, 0),
        Planes::AsInput(input) => (PTLP_PLANES_AS_INPUT, input),
        Planes::Most => (PTLP_PLANES_MOST, 0),
    };
    OutputPort(port)
}

impl OutputPort {
    /// The port, giving another kind than an image.
    #[must_use]
    pub const fn of_kind(mut self, kind: Kind) -> Self {
        self.0.kind = kind as u32;
        (self.0.planes, self.0.planes_input) = (0, 0);
        self
    }

    /// The port, giving any finite numbers.
    #[must_use]
    pub const fn free(mut self) -> Self {
        self.0.flags |= PTLP_PORT_FREE_RANGE;
        self
    }

    /// The port, with a sentence on what it is.
    #[must_use]
    pub const fn doc(mut self, doc: &'static CStr) -> Self {
        self.0.doc = doc.as_ptr();
        self
    }
}

/// A text that may be missing, as C has it.
pub(crate) const fn optional(text: &'static CStr) -> *const c_char {
    if text.is_empty() { ptr::null() } else { text.as_ptr() }
}
