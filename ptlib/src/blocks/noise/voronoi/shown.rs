//! What distances look like.
//!
//! PT Designer takes the shorter way around also to points that lie more than a turn from a pixel,
//! as those of large figures do. It is negative then, and what it gives outside of 0..255 is taken
//! modulo 256; the texture `big x` is made of that. In 8-bit precision it is kept. In float
//! precision, points are wrapped first, and nothing leaves 0..1. Few pixels ever need it, so that
//! a register of pixels is asked at once.

use super::SIDE;
use crate::block::prelude::*;

/// The values of distances, in units that are white.
#[inline(always)]
pub(in crate::blocks::noise) fn distances<L: Levels>(distances: [f32; SIDE]) -> [f32; SIDE] {
    let values = distances.map(|distance| if distance < 1.0 { distance } else { 1.0 });
    if L::EIGHT_BIT && values.iter().fold(false, |any, value| any | (*value < 0.0)) {
        return values.map(|value| if value < 0.0 { modulo_256(value * 255.0) } else { value });
    }
    values
}

/// The values of the ratios of the two least distances.
#[inline(always)]
pub(in crate::blocks::noise) fn ratios<L: Levels>(
    nearest: [f32; SIDE],
    second: [f32; SIDE],
) -> [f32; SIDE] {
    let mut ratios = [0.0; SIDE];
    for lane in 0..SIDE {
        // Equal distances give 1 by themselves; two points here would give 0/0.
        ratios[lane] = if nearest[lane] == 0.0 { 0.0 } else { nearest[lane] / second[lane] };
    }
    let is_shown = |ratio: f32| (0.0..=1.0).contains(&ratio);
    if L::EIGHT_BIT && !ratios.iter().fold(true, |all, ratio| all & is_shown(*ratio)) {
        for lane in 0..SIDE {
            if !is_shown(ratios[lane]) {
                ratios[lane] = modulo_256(255.0 * nearest[lane] / second[lane]);
            }
        }
    }
    ratios
}

/// The value of a level that has left 0..255.
#[inline(always)]
fn modulo_256(level: f32) -> f32 {
    levels::from_level(convert::level(convert::truncate(level) & 255))
}
