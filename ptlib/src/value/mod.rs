//! What flows on wires: images (planes of `f32`), gradients, texts.
//!
//! Values are immutable once made and shared by reference count; cloning one is cheap. More kinds
//! (points, meshes, strands, volumes) join [`Kind`] and [`Value`] here, and nothing elsewhere may
//! assume that a wire is an image.
//!
//! Beside them stands what blocks of several families make of images (specification 2.0): resampled
//! images, sums over boxes and lines ([`box_sum`]), weighted sums ([`convolution`]), states of
//! automata ([`cells`]) and filled regions ([`fill`]).

pub mod box_sum;
pub mod byte_list;
pub mod cells;
pub mod convolution;
pub mod fill;
mod gradient;
mod image;
mod kind;
mod pixels;
mod plane;
mod resample;
pub mod ring;

pub use gradient::{Gradient, GradientStop};
pub use image::{Image, MAX_PLANES};
pub use kind::{Kind, Value};
pub use pixels::{Format, Pixels};
pub use plane::{BufferPool, Plane};
pub use resample::{Axis, Interpolation, Resampling, Span};
