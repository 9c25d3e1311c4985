//! Gradients at the corners of a lattice: directions by place, from a hash.

use ptlib_plugin::math;

/// How many directions there are.
const DIRECTIONS: u32 = 64;

/// The gradients of an octave.
#[derive(Debug, Clone)]
pub(crate) struct Gradients {
    directions: Vec<[f32; 2]>,
    seed: u32,
}

impl Gradients {
    /// Of a seed and an octave.
    pub(crate) fn new(seed: u64, octave: u32) -> Self {
        let direction = |number: u32| {
            let angle = f64::from(number) * std::f64::consts::TAU / f64::from(DIRECTIONS);
            [math::single(math::cos(angle)), math::single(math::sin(angle))]
        };
        let seed = ptlib_plugin::noise::hash(seed, octave, 0, 0);
        Self { directions: (0..DIRECTIONS).map(direction).collect(), seed }
    }

    /// The gradient at a corner.
    #[inline(always)]
    pub(crate) fn at(&self, x: u32, y: u32) -> [f32; 2] {
        let number = mix(x ^ mix(y ^ self.seed)) % DIRECTIONS;
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
