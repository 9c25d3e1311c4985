//! What marble and wood have in common: their directions, their noise, and levels that come out
//! of fast sines exactly.

use super::super::noise::lattice::Settings;
use crate::block::prelude::*;

choice! {
    /// A direction in the picture; the numbers are those of PT Designer's files.
    Direction {
        /// To the right.
        Right = "right",
        /// Downwards.
        Down = "down",
        /// To the right and downwards.
        RightAndDown = "right and down",
        /// To the left and downwards.
        LeftAndDown = "left and down",
    }
}

impl Direction {
    /// One step in the direction: to the right, and down.
    pub(super) fn step(self) -> (i64, i64) {
        match self {
            Self::Right => (1, 0),
            Self::Down => (0, 1),
            Self::RightAndDown => (1, 1),
            Self::LeftAndDown => (-1, 1),
        }
    }
}

/// The noise of a block that nothing is connected to (specification 2.16).
pub(super) fn noise() -> Settings {
    Settings {
        amplitude: 128,
        frequency: 5,
        max_octaves: None,
        interpolation: Interpolation::Linear.into(),
        smooth: true,
    }
}

/// Replaces what lies so near a whole level that rounding in single precision decides how it is
/// truncated: pixel `i` of `levels` by `exact(i)`. One in some hundred pixels of a picture does.
#[inline(always)]
pub(super) fn settle(levels: &mut [f32], exact: impl Fn(usize) -> f64) {
    /// More than the error of a level that a sine in single precision gives.
    const NEAR: f32 = 1.0 / 512.0;
    let is_near = |level: f32| (level - (level + 0.5).floor()).abs() < NEAR;
    // Whether any is near is found for many pixels at once.
    if levels.iter().fold(false, |any, level| any | is_near(*level)) {
        for (i, level) in levels.iter_mut().enumerate() {
            if is_near(*level) {
                *level = convert::single(exact(i).trunc());
            }
        }
    }
    for level in levels {
        *level = level.trunc();
    }
}
