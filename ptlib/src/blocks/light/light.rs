//! A lit surface: ambient, diffuse and specular light on a normal map.
//!
//! Specification 2.30, after Phong ("Illumination for computer generated pictures", CACM 18(6),
//! 1975). The light is far away; the viewer hangs over the middle of the picture, but in its outer
//! fifth moves with the pixel, so that the view is vertical at the borders and the picture tiles.
//!
//! Kept from PT Designer: normals are not brought to length 1, so their rounding shows in the
//! brightness; and the curve `linear full` never falls below one half.
// Pictured: `diffuse red` `220`, `diffuse blue` `30`; or `diffuse red` `20`, `phong exponent` `9`.

use crate::block::prelude::*;

const NORMALS: usize = 0;

choice! {
    /// How bright a reflection is, by the cosine q of the angle between it and the viewer.
    ReflectionCurve {
        /// (q + 1)/2: soft, never dark.
        CosineSmooth = "cosine smooth",
        /// |q|: bright in the direction away from the viewer, too.
        CosineAbsolute = "cosine absolute",
        /// The angle itself, from 1 toward the viewer to 0 away from it.
        LinearHalf = "linear half",
        /// The angle itself, from 1 toward the viewer to one half away from it.
        LinearFull = "linear full",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Red of the light that comes from everywhere, 0..255.
        ambient_red "ambient red": int [hard 0..=255 soft 0..=255] = 5;
        /// Green of the light that comes from everywhere, 0..255.
        ambient_green "ambient green": int [hard 0..=255 soft 0..=255] = 0;
        /// Blue of the light that comes from everywhere, 0..255.
        ambient_blue "ambient blue": int [hard 0..=255 soft 0..=255] = 10;
        /// Red of the surface itself where the light falls on it straight, 0..255.
        diffuse_red "diffuse red": int [hard 0..=255 soft 0..=255] = 150;
        /// Green of the surface itself where the light falls on it straight, 0..255.
        diffuse_green "diffuse green": int [hard 0..=255 soft 0..=255] = 100;
        /// Blue of the surface itself where the light falls on it straight, 0..255.
        diffuse_blue "diffuse blue": int [hard 0..=255 soft 0..=255] = 100;
        /// Red of the highlights, 0..255.
        specular_red "specular red": int [hard 0..=255 soft 0..=255] = 255;
        /// Green of the highlights, 0..255.
        specular_green "specular green": int [hard 0..=255 soft 0..=255] = 245;
        /// Blue of the highlights, 0..255.
        specular_blue "specular blue": int [hard 0..=255 soft 0..=255] = 240;
        /// How highlights fade with the angle.
        reflection_curve "reflection curve":
            choice [ReflectionCurve] = ReflectionCurve::CosineAbsolute;
        /// How high the viewer is above the picture; 1 is the width of the picture.
        viewer_height "viewer height":
            float [hard 0.1..=1000.0 soft 0.1..=50.0 unit "of the width"] = 1.0;
        /// The larger, the smaller the highlights; negative ones light up what would be dark.
        phong_exponent "phong exponent": float [hard -1000.0..=1000.0 soft -10.0..=10.0] = 2.0;
        /// How much the light comes from the right, if bright is high; 1 is 45°, -1 from the left.
        direction_x "direction vector x": float [hard -10000.0..=10000.0 soft -99.0..=99.0] = 0.5;
        /// How much the light comes from below, if bright is high; 1 is 45°, -1 from above.
        direction_y "direction vector y": float [hard -10000.0..=10000.0 soft -99.0..=99.0] = 0.5;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Light>(About {
    id: "light",
    summary: "Lights the surface of a normal map.",
    inputs: &[input("normals", Kind::Image)],
    outputs: &[output("image", Planes::Colour)],
    ..About::DEFAULT
});

struct Light {
    ambient: [f32; 3],
    diffuse: [f32; 3],
    specular: [f32; 3],
    /// Toward the light, of length 1.
    light: [f32; 3],
    curve: ReflectionCurve,
    exponent: f32,
    /// From each column, from each row, and from the surface to the viewer, in pixels.
    viewer_x: Vec<f32>,
    viewer_y: Vec<f32>,
    viewer_z: f32,
}

impl PointBlock for Light {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let color = |levels: [i32; 3]| levels.map(|l| levels::from_level(convert::level(l)));
        let (x, y) = (params.direction_x, params.direction_y);
        let length = (x * x + y * y + 1.0).sqrt();
        Ok(Self {
            ambient: color([params.ambient_red, params.ambient_green, params.ambient_blue]),
            diffuse: color([params.diffuse_red, params.diffuse_green, params.diffuse_blue]),
            specular: color([params.specular_red, params.specular_green, params.specular_blue]),
            light: [x / length, y / length, 1.0 / length].map(convert::single),
            curve: params.reflection_curve,
            exponent: convert::single(params.phong_exponent),
            viewer_x: to_viewer(cx.width),
            viewer_y: to_viewer(cx.height),
            viewer_z: convert::single(f64::from(cx.width) * params.viewer_height),
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        match self.curve {
            ReflectionCurve::CosineSmooth => {
                self.lit::<L>(cx, inputs, out, |q| f32::midpoint(q, 1.0));
            }
            ReflectionCurve::CosineAbsolute => self.lit::<L>(cx, inputs, out, f32::abs),
            ReflectionCurve::LinearHalf => {
                const PER_RADIAN: f32 = std::f32::consts::FRAC_1_PI;
                self.lit::<L>(cx, inputs, out, |q| 1.0 - elementary::acos(q) * PER_RADIAN);
            }
            ReflectionCurve::LinearFull => {
                const PER_RADIAN: f32 = 0.5 * std::f32::consts::FRAC_1_PI;
                self.lit::<L>(cx, inputs, out, |q| 1.0 - elementary::acos(q) * PER_RADIAN);
            }
        }
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        (u64::from(width) + u64::from(height)) * size_of::<f32>() as u64
    }
}

impl Light {
    /// Writes the lit surface; `curve` makes the brightness of a reflection of its cosine.
    #[inline(always)]
    fn lit<L: Levels>(
        &self,
        cx: &RowContext<'_>,
        inputs: &InputRows<'_>,
        out: &mut OutputRow<'_>,
        curve: impl Fn(f32) -> f32,
    ) {
        let [red, green, blue] = out.rgb();
        let count = red.len();
        let (green, blue) = (&mut green[..count], &mut blue[..count]);
        let [nx, ny, nz] = inputs.rgb(NORMALS).map(|row| &row[..count]);
        let viewer_x = &self.viewer_x[cx.x as usize..][..count];
        let viewer_y = self.viewer_y[cx.y as usize];
        for i in 0..count {
            let normal = [nx[i], ny[i], nz[i]].map(component);
            let facing = dot(normal, self.light);
            let viewer = [viewer_x[i], viewer_y, self.viewer_z];
            let q = reflection(normal, facing, self.light, viewer);
            let brightness = elementary::power(curve(q).clamp(0.0, 1.0), self.exponent);
            [red[i], green[i], blue[i]] = std::array::from_fn(|c| {
                let diffuse = L::store((facing * self.diffuse[c]).clamp(0.0, 1.0));
                let specular = L::store((brightness * self.specular[c]).min(1.0));
                self.ambient[c] + diffuse + specular
            });
        }
    }
}

/// The component of a normal that a value of a normal map stands for.
#[inline(always)]
fn component(value: f32) -> f32 {
    value * (255.0 / 128.0) - 127.0 / 128.0
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cosine between the direction to the viewer and that of the reflection 2 · facing · N - l.
#[inline(always)]
fn reflection(normal: [f32; 3], facing: f32, light: [f32; 3], viewer: [f32; 3]) -> f32 {
    let reflected = std::array::from_fn(|i| 2.0 * facing * normal[i] - light[i]);
    // One root for both lengths. A reflection of length 0 has cosine 0.
    let squares = dot(reflected, reflected) * dot(viewer, viewer);
    dot(reflected, viewer) / squares.max(f32::MIN_POSITIVE).sqrt()
}

/// From each of `length` pixels to where the viewer of that pixel is.
fn to_viewer(length: u32) -> Vec<f32> {
    let middle = f64::from(length) / 2.0;
    let border = (0.2 * f64::from(length)).trunc();
    let viewer = |x: f64| {
        let from_end = x - f64::from(length) + border;
        if border == 0.0 {
            middle
        } else if x <= border {
            x / border * middle
        } else if from_end >= 0.0 {
            middle + from_end / border * middle
        } else {
            middle
        }
    };
    (0..length).map(|x| convert::single(viewer(f64::from(x)) - f64::from(x))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    /// The colours at those places of a surface that looks everywhere alike.
    fn lit(normal: [u8; 3], trial: impl Fn(Trial) -> Trial, places: &[usize]) -> Vec<[u8; 3]> {
        let planes = normal.map(|level| vec![level; 64 * 64]);
        let image = image_of_levels(64, &planes.each_ref().map(Vec::as_slice));
        let trial = trial(Trial::of(&BLOCK).input(NORMALS, image));
        trial.assert_same_bits();
        let channels: [_; 3] = std::array::from_fn(|channel| trial.levels(channel));
        places.iter().map(|place| channels.each_ref().map(|levels| levels[*place])).collect()
    }

    #[test]
    fn a_flat_surface_follows_the_vectors_of_the_specification() {
        let places = [32 * 64 + 32, 0, 32 * 64 + 6, 32 * 64 + 12, 20 * 64 + 50];
        let expected =
            [[255, 244, 251], [255, 244, 251], [255, 216, 223], [237, 186, 194], [255, 241, 248]];
        assert_eq!(lit([127, 127, 255], |trial| trial, &places), expected);
    }

    #[test]
    fn each_curve_follows_the_vectors_of_the_specification() {
        let expected = [[102, 80, 89], [196, 170, 177], [126, 103, 111], [215, 188, 195]];
        for (curve, expected) in (0..).zip(expected) {
            let trial =
                |trial: Trial| trial.choice("reflection curve", curve).float("phong exponent", 1.0);
            assert_eq!(lit([40, 200, 180], trial, &[32 * 64 + 32]), [expected], "curve {curve}");
        }
    }

    #[test]
    fn the_view_is_vertical_at_the_borders() {
        for length in [5, 6, 64, 77] {
            let to_viewer = to_viewer(length);
            assert_eq!(to_viewer[0], 0.0);
            // The pixel after the last is the first again.
            assert!(to_viewer.last().unwrap().abs() < convert::pixels(length) / 2.0);
        }
        assert_eq!(to_viewer(64)[32], 0.0);
        assert_eq!(to_viewer(4)[1], 1.0);
    }

    #[test]
    fn extremes_stay_in_range() {
        for exponent in [-1000.0, -10.0, 0.0, 1000.0] {
            for normal in [[0, 0, 0], [255, 255, 255], [127, 127, 127], [0, 255, 127]] {
                for curve in 0..4 {
                    let trial = |trial: Trial| {
                        trial
                            .choice("reflection curve", curve)
                            .float("phong exponent", exponent)
                            .float("direction vector x", -1e4)
                            .float("viewer height", 0.1)
                    };
                    // Values that are not finite would have become black.
                    let places = [0, 2080, 4095];
                    let colors = lit(normal, trial, &places);
                    assert!(colors.iter().all(|color| color[0] >= 5), "{normal:?} {exponent}");
                }
            }
        }
    }
}
