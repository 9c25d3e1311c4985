//! The picture of a head.

mod hairs;
pub mod head_view;
mod parallax;
mod params;
mod picture;
mod power;
mod skin;
mod stage;
mod strand_color;
mod surface;
mod texture;
mod vector;

#[cfg(test)]
mod trial;
