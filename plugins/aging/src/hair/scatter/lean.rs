//! In which direction a hair leaves the skin: along the normal, leaning a random way.
//!
//! The end of the lean is spread evenly over a disk: its distance from the middle is the root of a
//! random number. The frame is made from the normal alone (Duff and others, "Building an
//! Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6(1), 2017), so that it
//! needs no tangents.

use std::f64::consts::TAU;

use ptlib_plugin::prelude::*;

use crate::hair::{
    random,
    vector::{Vector, direction},
};

const DISTANCE: u32 = 3;
const ANGLE: u32 = 4;

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

    /// The direction of a hair.
    #[inline(always)]
    pub fn direction(&self, seed: u64, [item, place]: [u32; 2], normal: Vector) -> [f32; 3] {
        let distance = self.slope * random::uniform(seed, item, place, DISTANCE).sqrt();
        let [cos, sin] = self.turn(random::bits24(seed, item, place, ANGLE));
        let [t, b] = frame(normal);
        let leaning =
            [0, 1, 2].map(|axis| normal[axis] + distance * (cos * t[axis] + sin * b[axis]));
        // At least as long as the normal, which lies across the lean.
        direction(leaning, 0.0).unwrap_or(normal).map(math::single)
    }

    /// Cosine and sine of 2⁻²⁴ parts of a circle: the step's, turned by the small rest, for which a
    /// few terms are exact to 10⁻¹⁵.
    #[inline(always)]
    fn turn(&self, parts: u32) -> [f64; 2] {
        let [cos, sin] = self.circle[(parts >> REST_BITS) as usize % STEPS];
        let rest = f64::from(parts & ((1 << REST_BITS) - 1)) * (TAU / 16_777_216.0);
        let square = rest * rest;
        let small_sin = rest * (1.0 - square / 6.0 * (1.0 - square / 20.0));
        let small_cos = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
        [cos * small_cos - sin * small_sin, sin * small_cos + cos * small_sin]
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
        let circle = (0..256)
            .map(|step| angle(step << 16))
            .map(|angle| [elementary::cos64(angle), elementary::sin64(angle)]);
        let lean = Lean { slope: 0.0, circle: circle.collect() };
        for parts in (0..16_777_216).step_by(99_991) {
            let [cos, sin] = lean.turn(parts);
            assert!((cos - elementary::cos64(angle(parts))).abs() < 1e-14, "{parts}");
            assert!((sin - elementary::sin64(angle(parts))).abs() < 1e-14, "{parts}");
        }
    }
}
