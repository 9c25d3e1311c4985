//! The parameter by which users choose how a block resamples.

use crate::value;

crate::choice! {
    /// How values between the points of a coarse grid are found.
    Interpolation {
        /// The nearest one: blocks.
        Nearest = "nearest",
        /// A straight line from one to the next.
        Linear = "linear",
        /// A quarter of a sine wave: steep after each point, with visible creases.
        Sine = "sine",
    }
}

impl From<Interpolation> for value::Interpolation {
    fn from(choice: Interpolation) -> Self {
        match choice {
            Interpolation::Nearest => Self::Nearest,
            Interpolation::Linear => Self::Linear,
            Interpolation::Sine => Self::Sine,
        }
    }
}
