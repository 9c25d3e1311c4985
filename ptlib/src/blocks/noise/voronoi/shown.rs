//! What distances look like.
//!
//! PT Designer takes the shorter way around also to points that lie more than a turn from a pixel,
//! as those of large figures do. It is negative then, and what it gives outside of 0..255 is taken
//! modulo 256; the texture `big x` is made of that. In 8-bit precision it is kept. In float
//! precision, points are wrapped first, and nothing leaves 0..1.

use crate::block::prelude::*;

/// The value of a distance, in units that are white.
#[inline(always)]
pub(in crate::blocks::noise) fn distance<L: Levels>(distance: f32) -> f32 {
    let value = if distance < 1.0 { distance } else { 1.0 };
    if L::EIGHT_BIT && value < 0.0 { modulo_256(value * 255.0) } else { value }
}

/// The value of the ratio of the two least distances.
#[inline(always)]
pub(in crate::blocks::noise) fn ratio<L: Levels>(nearest: f32, second: f32) -> f32 {
    // Equal distances give 1 by themselves; two points here would give 0/0.
    let ratio = if nearest == 0.0 { 0.0 } else { nearest / second };
    if L::EIGHT_BIT && !(0.0..=1.0).contains(&ratio) {
        modulo_256(255.0 * nearest / second)
    } else {
        ratio
    }
}

/// The value of a level that has left 0..255.
#[inline(always)]
fn modulo_256(level: f32) -> f32 {
    levels::from_level(convert::level(convert::truncate(level) & 255))
}
