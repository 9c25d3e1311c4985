//! Where the head, the camera and the light are.

use ptlib_plugin::math;
use ptlib_raster::Camera;

use super::params::Params;

/// What is nearer to the camera than this many radii is not seen.
const NEAR: f64 = 1e-3;

/// The head, the camera and the light. Lengths count radii of the head, from its middle, so that
/// heads of any size are seen alike.
#[derive(Debug)]
pub struct Stage {
    /// The middle of the head.
    pub centre: [f64; 3],
    /// Its radius: half the diagonal of its bounds.
    pub unit: f64,
    /// What it is seen with.
    pub camera: Camera,
    /// The direction to the light, of length 1.
    pub light: [f64; 3],
}

impl Stage {
    /// The stage for something of these bounds.
    pub fn new(params: &Params, bounds: [[f32; 3]; 2], size: [u32; 2]) -> Self {
        let [low, high] = bounds.map(|corner| corner.map(f64::from));
        let half = [0, 1, 2].map(|axis: usize| (high[axis] - low[axis]) / 2.0);
        let length = (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt();
        let [yaw, pitch] = [params.yaw, params.pitch].map(turn);
        let ([sin_yaw, cos_yaw], [sin_pitch, cos_pitch]) = (yaw, pitch);
        let back = towards(yaw, pitch);
        let half_angle = params.field_of_view.to_radians() / 2.0;
        Self {
            centre: [0, 1, 2].map(|axis: usize| low[axis] + half[axis]),
            unit: if length > 0.0 { length } else { 1.0 },
            camera: Camera {
                eye: back.map(|x| x * params.distance),
                axes: [
                    [cos_yaw, 0.0, -sin_yaw],
                    [-sin_yaw * sin_pitch, cos_pitch, -cos_yaw * sin_pitch],
                    back.map(|x| -x),
                ],
                scale: f64::from(size[1]) / 2.0 / math::tan(half_angle),
                size,
                near: NEAR,
            },
            light: towards(turn(params.light_yaw), turn(params.light_pitch)),
        }
    }

    /// A place in radii of the head from its middle.
    pub fn scaled(&self, place: [f32; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis: usize| (f64::from(place[axis]) - self.centre[axis]) / self.unit)
    }
}

/// Sine and cosine of an angle in degrees.
fn turn(degrees: f64) -> [f64; 2] {
    let angle = degrees.to_radians();
    [math::sin(angle), math::cos(angle)]
}

/// The direction to what is turned to the right and lifted by these angles, from the front.
fn towards([sin_yaw, cos_yaw]: [f64; 2], [sin_pitch, cos_pitch]: [f64; 2]) -> [f64; 3] {
    [sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch]
}
