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

/// Truncates levels from 0 up. Those that lie so near to a whole one that the error of their
/// arithmetic, below `near`, would decide how they are truncated are computed again: level `i` by
/// `exact(i)`.
#[inline(always)]
pub(super) fn truncate(levels: &mut [f32], near: f32, exact: impl Fn(usize) -> f64) {
    let is_near = |level: f32| {
        let whole = (level + 0.5).floor();
        whole >= 1.0 && (level - whole).abs() < near
    };
    // Whether any is near is found for many levels at once.
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
