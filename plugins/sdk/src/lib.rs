//! Write blocks for ptlib in Rust.
//!
//! A block is a type with parameters, a description, and two functions:
//!
//! ```
//! use ptlib_plugin::prelude::*;
//!
//! params! {
//!     /// Parameters of the threshold.
//!     Params {
//!         /// Values below it become black, others white.
//!         level: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.5;
//!     }
//! }
//!
//! /// The prepared block.
//! pub struct Threshold {
//!     level: f32,
//! }
//!
//! impl Block for Threshold {
//!     type Params = Params;
//!
//!     const ABOUT: About = About {
//!         id: c"acme.threshold",
//!         summary: c"Black where an image is below a level, white elsewhere.",
//!         inputs: &[&input(c"image", Kind::Image)],
//!         outputs: &[&output(c"image", Planes::AsInput(0))],
//!         ..About::DEFAULT
//!     };
//!
//!     fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
//!         Ok(Self { level: math::single(params.level) })
//!     }
//!
//!     fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
//!         let image = call.image(0)?;
//!         let mut out = call.output(0)?;
//!         for channel in 0..out.channels() {
//!             for y in 0..out.height() {
//!                 let row = out.row_mut(channel, y).iter_mut().zip(image.row(channel, y));
//!                 row.for_each(|(out, value)| *out = f32::from(*value >= self.level));
//!             }
//!         }
//!         Ok(())
//!     }
//! }
//!
//! export_plugin! {
//!     id: c"acme.tools",
//!     name: c"Acme tools",
//!     vendor: c"Acme",
//!     license: c"MIT",
//!     blocks: [Threshold],
//! }
//! # fn main() {}
//! ```
//!
//! Build it as a `cdylib`, and name the library so that it ends with `.ptplugin.so` (`.dll`,
//! `.dylib`). A panic in a block becomes an error of the computation, with the block's name.
//!
//! Blocks of shape Whole may also take and give meshes, points, strands ([`Call::new_points`]),
//! colour transitions and texts; [`stream`] has the ids of what belongs to each vertex or point.
//!
//! Results may depend on parameters, seed, size, precision and inputs only, and must be the same on
//! every platform: take transcendental functions from [`math`], random numbers from [`noise`], and
//! no time, no order of a hash map, no fused multiply-add.
#![allow(unsafe_code, reason = "this crate is what makes the tables of pointers safe")]

mod block;
mod call;
mod error;
mod export;
mod host;
mod image;
mod job;
mod make;
pub mod math;
pub mod noise;
mod params;
mod parts;
mod scratch;
mod setup;
mod shim;
pub mod simd;
pub mod stream;
mod value;
mod wire;
mod work;

pub mod prelude;

pub use block::{
    About, Block, GraphInput, InputPort, Kind, OutputPort, Planes, Shape, Threads, input, output,
};
pub use call::Call;
pub use error::BlockError;
pub use host::{Level, log};
pub use image::{Image, ImageMut, Row};
pub use make::{NewMesh, NewPoints, NewStrands, Piece, StrandPoints, Triangles};
pub use params::{ParamSet, ParamType};
pub use parts::{Bits, Constant, Like, Parts, Split};
pub use scratch::{Plain, Scratch};
pub use setup::Setup;
pub use stream::{AnyStream, Element, Stream, StreamId};
pub use value::{Gradient, GradientStop, Mesh, Points, Strands, Streams};
pub use work::Work;

/// What the macros use; not for people.
#[doc(hidden)]
pub mod private {
    pub use ptlib_plugin_abi as abi;

    pub use crate::{
        export::init,
        params::{number, value_of},
        shim::{graph_input, table},
    };

    /// A count of what is written down in a program: far below 2³².
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "nobody writes so many of anything")]
    pub const fn count(number: usize) -> u32 {
        number as u32
    }

    /// The compiler that builds this crate, and so the plug-in.
    pub const BUILT_WITH: &str = concat!(env!("PTLIB_BUILT_WITH"), "\0");
}
