//! Gradients at the corners of a lattice: directions by place, from a hash.

use ptlib_plugin::{math, noise};

/// How many directions there are.
const DIRECTIONS: u32 = 64;

/// The gradients of an octave.
#[derive(Debug, Clone)]
pub(crate) struct Gradients {
    directions: Box<[[f32; 2]; DIRECTIONS as usize]>,
    seed: u32,
}

/// The gradients of a row of corners.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GradientRow<'a> {
    directions: &'a [[f32; 2]; DIRECTIONS as usize],
    seed: u32,
}

impl Gradients {
    /// Of a seed and an octave.
    pub(crate) fn new(seed: u64, octave: u32) -> Self {
        let mut directions = Box::new([[0.0; 2]; DIRECTIONS as usize]);
        for (direction, number) in directions.iter_mut().zip(0..DIRECTIONS) {
            let angle = f64::from(number) * std::f64::consts::TAU / f64::from(DIRECTIONS);
            *direction = [math::single(math::cos(angle)), math::single(math::sin(angle))];
        }
        Self { directions, seed: noise::hash(seed, octave, 0, 0) }
    }

    /// Those of a row.
    #[inline(always)]
    pub(crate) fn row(&self, y: u32) -> GradientRow<'_> {
        GradientRow { directions: &self.directions, seed: mix(y ^ self.seed) }
    }
}

impl GradientRow<'_> {
    /// The gradient at a corner.
    #[inline(always)]
    pub(crate) fn at(&self, x: u32) -> [f32; 2] {
        let number = mix(x ^ self.seed) % DIRECTIONS;
        self.directions[number as usize]
    }
}

/// Mixes the bits of a number ("lowbias32" of Chris Wellons' hash prospector).
#[inline(always)]
fn mix(mut bits: u32) -> u32 {
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    bits ^ (bits >> 16)
}
