//! Cells: what the pixels of a picture are to an automaton.
//!
//! Specification 2.0, STATES and UNSTATES. A cell is one byte. A picture of them is a [`Grid`]
//! with a margin that repeats the opposite side, so that a neighbour is found by adding to a
//! place and no rule knows about edges. A generation goes from one grid to another, band by band
//! of rows, in any order; a [`Rule`] writes [`SIDE`] cells at a time, which the compiler makes
//! vectors of.

mod grid;

pub use grid::{Band, Grid, Rule, SIDE};

use super::Image;
use crate::math::{
    convert,
    levels::{self, Levels},
};

/// Writes the states of the pixels in row `y` of an image: 0..`states`, from dark to light. As
/// white counts as level 237 (Q), the lightest states may not occur.
pub fn write_states<L: Levels>(image: &Image, y: u32, states: u8, out: &mut [u8]) {
    let [red, green, blue] = [0, 1, 2].map(|channel| image.row(channel, y));
    for (((out, red), green), blue) in out.iter_mut().zip(red).zip(green).zip(blue) {
        *out = state_of::<L>(levels::luma::<L>([*red, *green, *blue]), states);
    }
}

/// The smallest i ≥ 1 for which a value is at most i/`states`, minus 1.
fn state_of<L: Levels>(value: f32, states: u8) -> u8 {
    let states = i32::from(states);
    let upper = if L::EIGHT_BIT {
        (convert::truncate(levels::to_level(value)) * states + 254) / 255
    } else {
        convert::truncate((value * convert::level(states)).ceil())
    };
    convert::clamped_byte((upper - 1).min(states - 1))
}

/// The value of each of `states` states: 0 is black, the last one white.
#[must_use]
pub fn value_of_state<L: Levels>(state: u8, states: u8) -> f32 {
    let (state, last) = (u32::from(state), u32::from(states.max(2)) - 1);
    if L::EIGHT_BIT {
        levels::from_level(convert::pixels(state * 255 / last))
    } else {
        convert::pixels(state) / convert::pixels(last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::levels::{Continuous, EightBit};

    #[test]
    fn states_are_those_of_the_specification() {
        for states in 1..=255_u8 {
            for level in 0..=255_u8 {
                let (g, m) = (f64::from(level), f64::from(states));
                let i = (1..=255).find(|i| g <= f64::from(*i) * 255.0 / m).unwrap();
                let value = levels::from_level(f32::from(level));
                assert_eq!(state_of::<EightBit>(value, states), i - 1, "{level} of {states}");
            }
        }
        let real = [0.0, 0.001, 0.2, 0.26, 0.99, 1.0];
        assert_eq!(real.map(|value| state_of::<Continuous>(value, 4)), [0, 0, 0, 1, 3, 3]);
    }

    #[test]
    fn values_run_from_black_to_white() {
        let levels = |states: u8| -> Vec<f32> {
            let value = |state| levels::to_level(value_of_state::<EightBit>(state, states));
            (0..states).map(value).collect()
        };
        assert_eq!(levels(6), [0.0, 51.0, 102.0, 153.0, 204.0, 255.0]);
        assert_eq!(levels(4), [0.0, 85.0, 170.0, 255.0]);
        assert_eq!(levels(8)[1], 36.0, "36.43 is truncated");
        assert_eq!(levels(1), [0.0]);
        assert_eq!(value_of_state::<Continuous>(1, 8), 1.0 / 7.0);
    }
}
