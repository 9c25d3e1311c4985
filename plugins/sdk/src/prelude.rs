//! All that a block file needs: `use ptlib_plugin::prelude::*;`.

pub use crate::{
    About, Block, BlockError, Call, Image, ImageMut, Kind, Planes, Row, Setup, Shape, Threads,
    Work, choice, export_plugin, input, math, noise, output, params,
};
