//! What flows on wires: images (planes of `f32`), gradients, texts, and meshes, points and strands
//! (counts and streams).
//!
//! Values are immutable once made and shared by reference count; cloning one is cheap. More kinds
//! (volumes) join [`Kind`] and [`Value`] here, and nothing elsewhere may assume that a wire is an
//! image.
//!
//! A [`Stream`] is one kind of data of each element, found by its id. It lies in [`Words`], which
//! are ours or the caller's; a [`Draft`] is a value whose words are still written. The rules for
//! what they contain are in `check`: who has a [`Mesh`], [`Points`] or [`Strands`] needs no further
//! checks.
//!
//! Beside them stands what blocks of several families make of images (specification 2.0): resampled
//! images, sums over boxes and lines ([`box_sum`]), weighted sums ([`convolution`]), states of
//! automata ([`cells`]) and filled regions ([`fill`]).

mod bounds;
pub mod box_sum;
pub mod byte_list;
pub mod cells;
mod check;
mod content;
pub mod convolution;
mod draft;
pub mod fill;
mod gradient;
mod image;
mod kind;
mod mesh;
mod pixels;
mod plane;
mod points;
mod resample;
pub mod ring;
mod strands;
mod stream;
mod words;
pub(crate) mod zeros;

pub use bounds::Bounds;
pub use content::ContentHash;
pub use draft::{Draft, MemorySource, StreamPlan, WordsPlan};
pub use gradient::{Gradient, GradientStop};
pub use image::{Image, MAX_PLANES};
pub use kind::{Kind, Value};
pub use mesh::Mesh;
pub use pixels::{Format, Pixels};
pub use plane::{BufferPool, Plane};
pub use points::Points;
pub use resample::{Axis, Interpolation, Resampling, Span};
pub use strands::{StrandParts, Strands};
pub use stream::{Elements, Scalar, Stream, StreamShape};

pub(crate) use words::check_bytes;
pub use words::{Memory, Words, WordsMut};
