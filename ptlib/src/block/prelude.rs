//! All that a block file sees: `use crate::block::prelude::*;`.

pub use std::sync::Arc;

pub use super::{
    About, BlockSpec, Context, GatherBlock, InputRows, Interpolation, OutputRow, Planes,
    PointBlock, PrepareContext, Role, RowContext, Tiling, WholeBlock, WholeContext, input, output,
};
pub use crate::{
    choice,
    error::{Error, ErrorKind},
    math::{convert, decimal, elementary, elias, levels, levels::Levels, ray, simd::Kernel},
    params,
    value::{
        Axis, Gradient, GradientStop, Image, Kind, Mesh, Plane, Points, Resampling, Span, Strands,
        Stream, Value, box_sum, byte_list, cells, convolution, fill, ring,
    },
};
