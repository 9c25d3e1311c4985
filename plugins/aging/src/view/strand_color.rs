//! The light of a thin hair: Kajiya and Kay, "Rendering Fur with Three Dimensional Textures",
//! SIGGRAPH 1989, with the vector halfway between light and eye.

use ptlib_plugin::math;

use super::{
    power::Power,
    vector::{dot, unit},
};

/// How hair takes light.
#[derive(Debug, Clone, Copy)]
pub struct Hair {
    /// Part of light that goes everywhere around the hair.
    pub diffuse: f64,
    /// Part that is mirrored.
    pub specular: f64,
    /// How narrow the highlight is.
    pub shine: Power,
    /// What is added, untinted.
    pub ambient: [f64; 3],
}

impl Hair {
    /// The parts of diffuse and mirrored light, each 0 to 1, of a hair along a direction, with
    /// directions to the light and to the eye, all of length 1.
    pub fn parts(&self, along: [f64; 3], light: [f64; 3], eye: [f64; 3]) -> [f64; 2] {
        let across = |cosine: f64| (1.0 - cosine * cosine).max(0.0).sqrt();
        let both = [0, 1, 2].map(|axis| light[axis] + eye[axis]);
        // Against the light there is no halfway direction; from 120° on the highlight fades, and
        // is gone before rounding tells where it is.
        let strength = dot(both, both).min(1.0);
        let mirrored = match unit(both) {
            Some(half) => strength * self.shine.of(across(dot(half, along))),
            None => 0.0,
        };
        [across(dot(light, along)), mirrored]
    }

    /// A hair's colour in that light.
    pub fn color(&self, [diffuse, mirrored]: [f64; 2], color: [f32; 3]) -> [f32; 3] {
        let light = self.diffuse * diffuse + self.specular * mirrored;
        [0, 1, 2]
            .map(|c| math::single((light * f64::from(color[c]) + self.ambient[c]).clamp(0.0, 1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing;

    fn hair() -> Hair {
        Hair { diffuse: 0.7, specular: 0.3, shine: Power::new(20.0), ambient: [0.05; 3] }
    }

    const COLOR: [f32; 3] = [0.5, 0.4, 0.3];

    fn near(found: &[f64], expected: &[f64]) {
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(is_near, "{found:?}, not {expected:?}");
    }

    fn check(vectors: [[f64; 3]; 3], parts: [f64; 2], color: [f64; 3]) {
        let [along, light, eye] = vectors.map(|vector| unit(vector).unwrap());
        let found = hair().parts(along, light, eye);
        near(&found, &parts);
        near(&hair().color(found, COLOR).map(f64::from), &color);
    }

    #[test]
    fn colours_are_those_of_the_specification() {
        let _host = testing::engine();
        let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        check([x, z, z], [1.0, 1.0], [0.55, 0.45, 0.35]);
        let (light, eye) = ([1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]);
        let diffuse = 0.5_f64.sqrt();
        check([x, light, eye], [diffuse, 1.0], [0.447_487, 0.367_990, 0.288_492]);
        check([[0.6, 0.0, 0.8], z, z], [0.6, 3.656_16e-5], [0.260_005, 0.218_004, 0.176_003]);
        let parts = hair().parts(x, x, z);
        near(&parts, &[0.0, 0.000_976_563]);
    }

    #[test]
    fn looking_into_the_light_is_defined() {
        let _host = testing::engine();
        let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(hair().parts(x, z, z.map(|c| -c)), [1.0, 0.0]);
        let almost = unit([1e-9, 0.0, -1.0]).unwrap();
        assert!(hair().parts(x, z, almost)[1] < 1e-6);
    }
}
