//! The skin: what a pixel of the head looks like.
//!
//! Eight pixels are shaded side by side. Tangent, bitangent and normal of a pixel lead from the
//! picture into texture space and back: there the ray is moved to the wrinkle that is seen
//! ([`Steps`]), there normals are read and joined. Light is ambient, diffuse, and J. Blinn's
//! highlight around the vector halfway between light and eye.

use ptlib_plugin::math;

use super::{
    parallax::Steps,
    params::{Parallax, Params, YAxis, ZRange},
    power::Power,
    surface::Batch,
    texture::{Heights, Lanes, Taps, Texture, each},
    vector::{Vectors, crosses, dots, mix, units},
};

/// What plays the part of the colour image where none is connected: light skin.
const SKIN: [f32; 3] = [0.86, 0.68, 0.57];

/// The least slant of the line of sight by which the true shift is divided.
const LEAST_SLANT: f32 = 0.1;

/// The images on the skin.
#[derive(Debug, Default)]
pub struct Textures<'a> {
    /// Its colour.
    pub color: Option<Texture<'a>>,
    /// Normals.
    pub normals: Option<Texture<'a>>,
    /// Heights of wrinkles, if these are searched for.
    pub heights: Option<Heights<'a>>,
    /// Normals of fine detail.
    pub fine: Option<Texture<'a>>,
    /// Where wrinkles are deep.
    pub mask: Option<Texture<'a>>,
}

/// What skin is drawn with.
#[derive(Debug)]
pub struct Skin<'a> {
    textures: Textures<'a>,
    steps: Option<Steps>,
    depth: f32,
    level: f32,
    parallax: Parallax,
    normals: Unpack,
    ambient: f32,
    specular: f32,
    shine: Power,
    /// The direction to the light.
    light: [f32; 3],
    eye: [f32; 3],
}

/// How normals lie in images.
#[derive(Debug, Clone, Copy)]
struct Unpack {
    up: f32,
    scale: f32,
    shift: f32,
}

impl<'a> Skin<'a> {
    /// Skin with these images, lit from a direction and seen from a place.
    pub fn new(params: &Params, textures: Textures<'a>, light: [f64; 3], eye: [f64; 3]) -> Self {
        let count = |steps: i32| u16::try_from(steps).unwrap_or_default();
        let (linear, binary) = (count(params.linear_steps), count(params.binary_steps));
        let steps = Steps::new(params.search, linear, binary);
        let (scale, shift) = match params.z_range {
            ZRange::Positive => (1.0, 0.0),
            ZRange::Signed => (2.0, -1.0),
        };
        let up = if params.y_axis == YAxis::Up { 1.0 } else { -1.0 };
        let depth = math::single(params.depth * params.age);
        Self {
            steps,
            textures,
            depth,
            level: math::single(params.level),
            parallax: params.parallax,
            normals: Unpack { up, scale, shift },
            ambient: math::single(params.ambient),
            specular: math::single(params.specular),
            shine: Power::new(params.shine),
            light: light.map(math::single),
            eye: eye.map(math::single),
        }
    }

    /// Red, green and blue of some pixels.
    pub fn shade(&self, batch: &Batch) -> [Lanes; 3] {
        let [x, y, z, hand] = batch.tangent;
        let normal = units(&batch.normal);
        let tangent = units(&[x, y, z]);
        let side = units(&crosses(&normal, &tangent));
        let side = side.map(|axis| each(|i| if hand[i] < 0.0 { -axis[i] } else { axis[i] }));
        let eye: Vectors =
            std::array::from_fn(|axis| each(|i| self.eye[axis] - batch.place[axis][i]));
        let eye = units(&eye);
        let shift = match self.steps {
            Some(steps) => {
                let view = [dots(&eye, &tangent), dots(&eye, &side), dots(&eye, &normal)];
                self.shift(steps, batch, &view)
            }
            None => [[0.0; 8]; 2],
        };
        let [u, v] = [0, 1].map(|axis: usize| each(|i| batch.uv[axis][i] + shift[axis][i]));
        let relief = self.relief(batch, [&u, &v], &shift);
        let normal = match relief {
            Some([x, y, z]) => units(&mix([&tangent, &side, &normal], [&x, &y, &z])),
            None => normal,
        };
        let color = match &self.textures.color {
            Some(texture) => texture.color(&texture.taps(&u, &v)),
            None => SKIN.map(|part| [part; 8]),
        };
        self.light(&normal, &eye, &color)
    }

    /// How far texture coordinates move to what is seen, with the directions to the eye in texture
    /// space. Exactly 0 where depth or mask is 0.
    fn shift(&self, steps: Steps, batch: &Batch, view: &Vectors) -> [Lanes; 2] {
        let Some(heights) = &self.textures.heights else { return [[0.0; 8]; 2] };
        let [u, v] = &batch.uv;
        let mut depth = [self.depth; 8];
        if let Some(mask) = &self.textures.mask {
            let mask = mask.read(0, &mask.taps(u, v));
            depth = each(|i| depth[i] * mask[i]);
        }
        if self.parallax == Parallax::True {
            depth = each(|i| depth[i] / view[2][i].max(LEAST_SLANT));
        }
        if depth == [0.0; 8] {
            return [[0.0; 8]; 2];
        }
        let along = [0, 1].map(|axis: usize| each(|i| depth[i] * view[axis][i]));
        let shift = |z: &Lanes| along.map(|along| each(|i| along[i] * (z[i] - self.level)));
        let z = steps.search(|z: &Lanes| {
            let [du, dv] = shift(z);
            heights.at(&each(|i| u[i] + du[i]), &each(|i| v[i] + dv[i]))
        });
        shift(&z)
    }

    /// The normal in texture space, if it is another than that of the surface.
    fn relief(&self, batch: &Batch, [u, v]: [&Lanes; 2], shift: &[Lanes; 2]) -> Option<Vectors> {
        let base = self
            .textures
            .normals
            .as_ref()
            .map(|texture| self.normals.read(texture, &texture.taps(u, v)));
        let Some(texture) = &self.textures.fine else { return base };
        let [a, b, c, d] = &batch.turn;
        let [du, dv] = shift;
        let u = each(|i| batch.fine[0][i] + (a[i] * du[i] + b[i] * dv[i]));
        let v = each(|i| batch.fine[1][i] + (c[i] * du[i] + d[i] * dv[i]));
        let fine = self.normals.read(texture, &texture.taps(&u, &v));
        Some(match base {
            Some(base) => join(&base, &fine),
            None => fine,
        })
    }

    fn light(&self, normal: &Vectors, eye: &Vectors, color: &[Lanes; 3]) -> [Lanes; 3] {
        let light = self.light.map(|part| [part; 8]);
        let half = units(&[0, 1, 2].map(|axis: usize| each(|i| light[axis][i] + eye[axis][i])));
        let lit = dots(normal, &light);
        let lit = each(|i| self.ambient + (1.0 - self.ambient) * lit[i].max(0.0));
        let mut mirrored = [0.0; 8];
        if self.specular > 0.0 {
            let towards = self.shine.each(&dots(normal, &half));
            mirrored = towards.map(|part| self.specular * part);
        }
        color.map(|color| each(|i| (color[i] * lit[i] + mirrored[i]).clamp(0.0, 1.0)))
    }
}

impl Unpack {
    #[inline(always)]
    fn read(&self, texture: &Texture<'_>, taps: &Taps) -> Vectors {
        let [x, y, z] = texture.color(taps);
        let x = x.map(|x| 2.0 * x - 1.0);
        let y = y.map(|y| self.up * (2.0 * y - 1.0));
        let z = z.map(|z| self.scale * z + self.shift);
        let [x, y, z] = [x, y, z];
        let normal = units(&[x, y, z]);
        // Black has no direction: flat.
        let is_none = dots(&normal, &normal).map(|square| square < 0.5);
        let z = each(|i| if is_none[i] { 1.0 } else { normal[2][i] });
        [normal[0], normal[1], z]
    }
}

/// Fine detail on a wrinkled surface, as `blend normals` joins it by its method "tangent".
#[inline(always)]
fn join(base: &Vectors, fine: &Vectors) -> Vectors {
    let [x, y, z] = base;
    let z = z.map(|z| z.max(1e-6));
    let zero = [0.0; 8];
    let along = units(&[z, zero, x.map(|x| -x)]);
    let side = units(&[zero, z, y.map(|y| -y)]);
    units(&mix([&along, &side, base], [&fine[0], &fine[1], &fine[2]]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn detail_is_joined_as_the_specification_says() {
        let lanes = |vector: [f32; 3]| vector.map(|part| [part; 8]);
        let check = |base, fine, expected: [f32; 3]| {
            let found = join(&lanes(base), &lanes(fine)).map(|part| part[5]);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?}");
        };
        check([0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.48, 0.6, 0.64]);
        check([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8], [0.0, 0.0, 1.0]);
        check([0.48, 0.36, 0.8], [0.0, 0.6, 0.8], [0.384, 0.835_153, 0.393_781]);
        check([0.6, 0.0, 0.8], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]);
    }
}
