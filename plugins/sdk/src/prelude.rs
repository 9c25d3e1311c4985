//! All that a block file needs: `use ptlib_plugin::prelude::*;`.

pub use crate::{
    About, Block, BlockError, Call, Gradient, GraphInput, Image, ImageMut, Kind, Mesh, Planes,
    Points, Row, Setup, Shape, StrandPoints, Strands, StreamId, Threads, Triangles, Work, choice,
    export_plugin, input, math, noise, output, params, stream,
};
