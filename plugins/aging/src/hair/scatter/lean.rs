//! In which direction a hair leaves the skin: along the normal, leaning a random way.
//!
//! The end of the lean is spread evenly over a disk: its distance from the middle is the root of a
//! random number. The frame is made from the normal alone (Duff and others, "Building an
//! Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6(1), 2017), so that it
//! needs no tangents.

use std::f64::consts::TAU;

use ptlib_plugin::{
    prelude::*,
    simd::{self, Kernel},
};

use super::batch::BATCH;
use crate::hair::{
    random,
    vector::{Vector, length},
};

/// Channels of the random numbers.
pub const DISTANCE: u32 = 3;
pub const ANGLE: u32 = 4;

/// Steps of the table of a circle.
const STEPS: usize = 256;
/// Bits of an angle behind those of its step.
const REST_BITS: u32 = 24 - STEPS.trailing_zeros();

/// How hairs lean.
#[derive(Debug)]
pub struct Lean {
    slope: f64,
    /// Cosine and sine of each step of a circle.
    circle: Vec<[f64; 2]>,
}

impl Lean {
    /// Hairs that lean by up to `spread` degrees.
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    pub fn new(spread: f64) -> Self {
        let angle = |step: usize| step as f64 / STEPS as f64 * TAU;
        let circle = (0..STEPS).map(|step| [math::cos(angle(step)), math::sin(angle(step))]);
        Self { slope: math::tan(spread.to_radians()), circle: circle.collect() }
    }

    /// The directions of a batch of hairs, by axis: from 24 random bits of each for its distance and
    /// for its angle, and from the normals.
    pub fn directions(
        &self,
        [distances, angles]: [&[u32; BATCH]; 2],
        normals: &[[f64; BATCH]; 3],
    ) -> [[f32; BATCH]; 3] {
        let [mut cos, mut sin] = [[0.0; BATCH]; 2];
        for ((cos, sin), parts) in cos.iter_mut().zip(&mut sin).zip(angles) {
            [*cos, *sin] = self.circle[(parts >> REST_BITS) as usize % STEPS];
        }
        let steps = [&cos, &sin];
        simd::run(Leaning { slope: self.slope, distances, angles, steps, normals })
    }
}

/// Cosine and sine of 2⁻²⁴ parts of a circle: the step's, turned by the small rest, for which a few
/// terms are exact to 10⁻¹⁵.
#[inline(always)]
fn turned([cos, sin]: [f64; 2], parts: u32) -> [f64; 2] {
    let rest = (parts & ((1 << REST_BITS) - 1)).cast_signed();
    let rest = f64::from(rest) * (TAU / 16_777_216.0);
    let square = rest * rest;
    let small_sin = rest * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    let small_cos = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    [cos * small_cos - sin * small_sin, sin * small_cos + cos * small_sin]
}

struct Leaning<'a> {
    slope: f64,
    distances: &'a [u32; BATCH],
    angles: &'a [u32; BATCH],
    /// Cosine and sine of the steps of the angles.
    steps: [&'a [f64; BATCH]; 2],
    normals: &'a [[f64; BATCH]; 3],
}

impl Kernel for Leaning<'_> {
    type Output = [[f32; BATCH]; 3];

    #[inline(always)]
    fn run(self) -> Self::Output {
        let mut directions = [[0.0; BATCH]; 3];
        for i in 0..BATCH {
            let normal = self.normals.each_ref().map(|numbers| numbers[i]);
            let distance = self.slope * random::unit(self.distances[i]).sqrt();
            let [cos, sin] = turned(self.steps.map(|numbers| numbers[i]), self.angles[i]);
            let [t, b] = frame(normal);
            let leaning =
                [0, 1, 2].map(|axis| normal[axis] + distance * (cos * t[axis] + sin * b[axis]));
            // At least as long as the normal, which lies across the lean.
            let inverse = 1.0 / length(leaning);
            for (numbers, number) in directions.iter_mut().zip(leaning) {
                numbers[i] = math::single(number * inverse);
            }
        }
        directions
    }
}

/// Two vectors of length 1, perpendicular to a normal and to each other.
#[inline(always)]
fn frame(n: Vector) -> [Vector; 2] {
    let sign = 1.0_f64.copysign(n[2]);
    let a = -1.0 / (sign + n[2]);
    let b = n[0] * n[1] * a;
    [[1.0 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]], [b, sign + n[1] * n[1] * a, -n[1]]]
}

#[cfg(test)]
mod tests {
    use ptlib::math::elementary;

    use super::*;
    use crate::hair::vector::{cross, length};

    #[test]
    fn a_frame_is_perpendicular() {
        let normals = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, -0.8, 0.0], [0.48, 0.36, -0.8]];
        for n in normals {
            let [t, b] = frame(n);
            let normal = cross(t, b);
            assert!((0..3).all(|axis| (normal[axis] - n[axis]).abs() < 1e-12), "{n:?}");
            assert!((length(t) - 1.0).abs() < 1e-12 && (length(b) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn angles_are_exact() {
        let angle = |parts: u32| f64::from(parts) * (TAU / 16_777_216.0);
        for parts in (0..16_777_216).step_by(99_991) {
            let step = angle(parts >> 16 << 16);
            let step = [elementary::cos64(step), elementary::sin64(step)];
            let [cos, sin] = turned(step, parts);
            assert!((cos - elementary::cos64(angle(parts))).abs() < 1e-14, "{parts}");
            assert!((sin - elementary::sin64(angle(parts))).abs() < 1e-14, "{parts}");
        }
    }
}
