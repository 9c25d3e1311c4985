//! A software rasteriser for blocks that draw: triangles and lines with a width, tile by tile.
//!
//! A picture is cut into [tiles](Grid) of 64 × 64 pixels, and each tile is drawn by one thread in a
//! fixed order, from numbers that do not depend on the tile: so the bits of a picture are the same
//! for any number of threads and any order of tiles. The caller brings the threads, the shading
//! and the memory; what grows with the geometry lies in slices that the caller allocates, and the
//! functions `…_bytes` and counts say how much that is.
//!
//! Triangles, in this order:
//! 1. [`Camera`] and the caller's positions make a [`Solid`]; [`Camera::place`] snaps each vertex
//!    to 1/256 pixel ([`Place`]). What is too near, or far outside of the picture, is clipped when it
//!    is drawn, so that edge functions are exact in 64 bits whatever the coordinates are.
//! 2. [`Solid::count`] and [`Solid::fill`] sort triangles into tiles.
//! 3. [`Tile::draw`] finds the nearest triangle of each pixel; [`Tile::fragments`] gives the caller
//!    what to shade: each pixel once, with weights of the three corners that are right in
//!    perspective.
//!
//! [Lines](mod@line) are drawn over that, from far to near, with [`line::draw`].
//!
//! No function here calls the mathematics of the platform: angles come as sines and cosines.

#![forbid(unsafe_code)]

mod bins;
mod camera;
mod clip;
mod grid;
pub mod line;
mod number;
mod piece;
mod solid;
mod tile;

pub use bins::{Bins, Count};
pub use camera::{Camera, Place};
pub use grid::{Grid, Rect, SIDE};
pub use solid::Solid;
pub use tile::{Fragment, Tile};
