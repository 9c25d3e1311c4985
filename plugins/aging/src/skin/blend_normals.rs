//! Detail on a surface: one normal map laid on another.
//!
//! Both maps are unpacked, and turned towards straight up, (0, 0, 1), by what their age and the
//! mask leave: d ← normalise(lerp((0, 0, 1), d, w)) with w = age · mask, and the base alike. Then
//! they are joined.
//!
//! - tangent: the detail's axes are laid on the base b as t' = (bz, 0, -bx), b' = (0, bz, -by), both
//!   made to length 1, and d becomes t'·dx + b'·dy + b·dz. The two axes are not quite perpendicular.
//! - reoriented: the detail is turned as (0, 0, 1) has to be turned to become the base
//!   (C. Barré-Brisebois and S. Hill, "Blending in Detail", 2012).
//! - whiteout: slopes are added, (bx + dx, by + dy, bz · dz).
//!
//! A normal that would look into the surface is laid flat on it. Nothing here knows of heads: any
//! two normal maps will do.

use ptlib_plugin::{Image, Row, prelude::*};

use super::packing::{LANES, Packing, ZRange};

const BASE: usize = 0;
const DETAIL: usize = 1;
const MASK: usize = 2;

/// The least third component: that of a normal which lies in the surface.
const FLAT: f32 = 1e-6;

choice! {
    /// How two normals become one.
    Method {
        /// The detail on axes that lie along the base's slopes: exact where one of the base's
        /// slopes is 0.
        Tangent = "tangent",
        /// The detail turned by the rotation that turns a flat surface into the base: the most
        /// faithful.
        Reoriented = "reoriented",
        /// The slopes added, with the base's lessened a little: keeps small detail strong.
        Whiteout = "whiteout",
    }
}

params! {
    /// Parameters of [`BlendNormals`].
    Params {
        /// How much of the detail there is: 0 none, so that the base comes out as it is, and 1 all
        /// of it. The mask multiplies it.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
        /// How much of the base there is: 0 makes it flat, 1 leaves it as it is. The mask does not
        /// count here.
        base_age "base age": float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
        /// How two normals become one.
        method: choice [Method] = Method::Tangent;
        /// How the third component lies in the blue channel of both inputs and of the output.
        z_range "z range": choice [ZRange] = ZRange::Positive;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct BlendNormals {
    age: f32,
    base_age: f32,
    method: Method,
    z: Packing,
}

impl Block for BlendNormals {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.blend normals",
        name: c"Blend normals",
        category: c"skin",
        summary: c"Lays the detail of any normal map on another, as much as an age and a mask let.",
        inputs: &[
            &input(c"base", Kind::Image).doc(
                c"The normals of the surface, in red, green and blue. Alpha is kept. (A grey \
                       image is no normal map: it counts as red, green and blue alike.)",
            ),
            &input(c"detail", Kind::Image)
                .doc(c"The normals of what lies on it, in red, green and blue."),
            &input(c"mask", Kind::Image).optional().doc(
                c"How much detail there is at each place, in the red channel; all if missing.",
            ),
        ],
        outputs: &[&output(c"normals", Planes::AsInput(0))
            .doc(c"The normals of both, with the base's alpha if it has one.")],
        shape: Shape::Point,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self {
            age: math::single(params.age),
            base_age: math::single(params.base_age),
            method: params.method,
            z: params.z_range.packing(),
        })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let [base, detail] = [call.image(BASE)?, call.image(DETAIL)?];
        let mask = call.optional_image(MASK);
        for row in call.output(0)?.rows() {
            self.write(base, detail, mask, row);
        }
        Ok(())
    }
}

impl BlendNormals {
    fn write(&self, base: Image<'_>, detail: Image<'_>, mask: Option<Image<'_>>, row: Row<'_>) {
        let Row { y, mut channels } = row;
        for (channel, plane) in channels.iter_mut().enumerate().skip(3) {
            plane.copy_from_slice(base.row(channel, y));
        }
        // Of a grey base, green and blue are computed and thrown away.
        let mut spare = [vec![], vec![]];
        let [first, rest @ ..] = &mut channels[..] else { return };
        let [second, third] = &mut spare;
        let out: [&mut [f32]; 3] = match rest {
            [green, blue, ..] => [first, green, blue],
            _ => {
                second.resize(first.len(), 0.0);
                third.resize(first.len(), 0.0);
                [first, second, third]
            }
        };
        let rows = [base, detail].map(|image| [0, 1, 2].map(|channel| image.row(channel, y)));
        self.by_method(rows, mask.map(|mask| mask.row(0, y)), out);
    }

    /// Chooses the method outside of the loop over pixels.
    #[inline(always)]
    fn by_method(&self, rows: [[&[f32]; 3]; 2], mask: Option<&[f32]>, out: [&mut [f32]; 3]) {
        match self.method {
            Method::Tangent => self.blend(rows, mask, on_tangents, out),
            Method::Reoriented => self.blend(rows, mask, reoriented, out),
            Method::Whiteout => self.blend(rows, mask, whiteout, out),
        }
    }

    #[inline(always)]
    fn blend(
        &self,
        [base, detail]: [[&[f32]; 3]; 2],
        mask: Option<&[f32]>,
        join: impl Fn(Vector, Vector) -> Vector,
        mut out: [&mut [f32]; 3],
    ) {
        let mut here = Pixels { ages: [self.age; LANES], ..Pixels::NONE };
        let len = out[0].len();
        for start in (0..len).step_by(LANES) {
            let pixels = start..len.min(start + LANES);
            let read = |to: &mut [f32; LANES], from: &[f32]| {
                to[..pixels.len()].copy_from_slice(&from[pixels.clone()]);
            };
            for channel in 0..3 {
                read(&mut here.base[channel], base[channel]);
                read(&mut here.detail[channel], detail[channel]);
            }
            if let Some(mask) = mask {
                let ages = here.ages.iter_mut().zip(&mask[pixels.clone()]);
                ages.for_each(|(age, mask)| *age = self.age * mask);
            }
            self.join(&mut here, &join);
            for (out, base) in out.iter_mut().zip(&here.base) {
                out[pixels.clone()].copy_from_slice(&base[..pixels.len()]);
            }
        }
    }

    /// Joins some pixels, in place of the base. Those of age 0 stay as they are, in a loop of its
    /// own: a choice in the first one would keep it from computing several pixels at once.
    #[inline(always)]
    fn join(&self, here: &mut Pixels, join: impl Fn(Vector, Vector) -> Vector) {
        let Pixels { base, detail, ages } = here;
        for i in 0..LANES {
            let below = aged(self.unpacked(base.each_ref().map(|row| row[i])), self.base_age);
            let above = aged(self.unpacked(detail.each_ref().map(|row| row[i])), ages[i]);
            let [x, y, z] = unit(join(below, above));
            detail[0][i] = Packing::HALVED.packed(x);
            detail[1][i] = Packing::HALVED.packed(y);
            detail[2][i] = self.z.packed(z);
        }
        // No age is negative.
        let kept = if self.base_age == 1.0 { 0.0 } else { -1.0 };
        for (base, joined) in base.iter_mut().zip(detail) {
            for ((base, joined), age) in base.iter_mut().zip(joined).zip(ages.iter()) {
                *base = if *age == kept { *base } else { *joined };
            }
        }
    }

    #[inline(always)]
    fn unpacked(&self, [x, y, z]: [f32; 3]) -> Vector {
        [Packing::HALVED.unpacked(x), Packing::HALVED.unpacked(y), self.z.unpacked(z)]
    }
}

/// Pixels that are computed at a time.
struct Pixels {
    base: [[f32; LANES]; 3],
    detail: [[f32; LANES]; 3],
    ages: [f32; LANES],
}

impl Pixels {
    const NONE: Self =
        Self { base: [[0.0; LANES]; 3], detail: [[0.0; LANES]; 3], ages: [0.0; LANES] };
}

type Vector = [f32; 3];

/// A vector of length 1 that looks away from the surface, or lies in it.
#[inline(always)]
fn unit([x, y, z]: Vector) -> Vector {
    let z = if z > FLAT { z } else { FLAT };
    let inverse = 1.0 / (x * x + y * y + z * z).sqrt();
    [x * inverse, y * inverse, z * inverse]
}

/// A normal, between straight up and itself.
#[inline(always)]
fn aged([x, y, z]: Vector, age: f32) -> Vector {
    unit([x * age, y * age, (1.0 - age) + z * age])
}

#[inline(always)]
fn on_tangents([bx, by, bz]: Vector, [dx, dy, dz]: Vector) -> Vector {
    let across = dx / (bz * bz + bx * bx).sqrt();
    let along = dy / (bz * bz + by * by).sqrt();
    [bz * across + bx * dz, bz * along + by * dz, bz * dz - bx * across - by * along]
}

#[inline(always)]
fn reoriented([bx, by, bz]: Vector, [dx, dy, dz]: Vector) -> Vector {
    let gz = bz + 1.0;
    let scale = (gz * dz - bx * dx - by * dy) / gz;
    [bx * scale + dx, by * scale + dy, gz * scale - dz]
}

#[inline(always)]
fn whiteout([bx, by, bz]: Vector, [dx, dy, dz]: Vector) -> Vector {
    [bx + dx, by + dy, bz * dz]
}

#[cfg(test)]
mod tests {
    use ptlib::{Image, params::ParamValue};

    use super::super::trial;

    const BLOCK: &str = "aging.blend normals";
    const TANGENT: i32 = 0;
    const REORIENTED: i32 = 1;
    const WHITEOUT: i32 = 2;

    fn packed([x, y, z]: [f32; 3]) -> [f32; 4] {
        [x / 2.0 + 0.5, y / 2.0 + 0.5, z, 0.25]
    }

    fn params(method: i32, age: f64) -> [(&'static str, ParamValue); 2] {
        let method = u32::try_from(method).unwrap();
        [("method", ParamValue::Choice(method)), ("age", ParamValue::Float(age))]
    }

    fn blended(base: [f32; 3], detail: [f32; 3], method: i32, age: f64) -> [f32; 3] {
        let [base, detail] = [base, detail].map(|normal| trial::plain((3, 2), &packed(normal)));
        let image = trial::made(BLOCK, &[Some(&base), Some(&detail)], &params(method, age));
        assert_eq!((image.planes(), image.row(3, 1)[2]), (4, 0.25));
        let [x, y, z] = [0, 1, 2].map(|channel| image.row(channel, 1)[2]);
        [x * 2.0 - 1.0, y * 2.0 - 1.0, z]
    }

    fn assert_near(found: [f32; 3], expected: [f32; 3]) {
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(is_near, "{found:?}, expected {expected:?}");
    }

    #[test]
    fn the_vectors_of_all_methods() {
        let (base, detail) = ([0.6, 0.0, 0.8], [0.0, 0.6, 0.8]);
        for method in [TANGENT, REORIENTED] {
            assert_near(blended(base, detail, method, 1.0), [0.48, 0.6, 0.64]);
            assert_near(blended(base, detail, method, 0.5), [0.569_21, 0.316_228, 0.758_947]);
        }
        assert_near(blended(base, detail, WHITEOUT, 1.0), [0.564_532, 0.564_532, 0.602_168]);
        assert_near(blended(base, detail, WHITEOUT, 0.5), [0.589_483, 0.310_685, 0.745_644]);
        for method in [TANGENT, REORIENTED, WHITEOUT] {
            assert_near(blended(base, detail, method, 0.0), base);
            assert_near(blended(base, [-0.6, 0.0, 0.8], method, 1.0), [0.0, 0.0, 1.0]);
        }
        let base = [0.48, 0.36, 0.8];
        assert_near(blended(base, detail, TANGENT, 1.0), [0.384, 0.835_153, 0.393_781]);
        assert_near(blended(base, detail, REORIENTED, 1.0), [0.3264, 0.8448, 0.424]);
        assert_near(blended(base, detail, WHITEOUT, 1.0), [0.384_111, 0.768_221, 0.512_148]);
    }

    #[test]
    fn what_is_flat_leaves_the_other() {
        let (some, flat) = ([0.48, 0.36, 0.8], [0.0, 0.0, 1.0]);
        for method in [TANGENT, REORIENTED, WHITEOUT] {
            assert_near(blended(some, flat, method, 1.0), some);
            assert_near(blended(flat, some, method, 1.0), some);
        }
    }

    /// Anything that may come: most of it is no normal.
    fn anything(size: (u32, u32), planes: usize, salt: u32) -> Image {
        trial::picture(size, planes, |plane, x, y| {
            let number = trial::grain(x + 977 * salt, y + 131 * u32::try_from(plane).unwrap());
            if number < 0.1 { 0.0 } else { number }
        })
    }

    #[test]
    fn without_detail_the_base_comes_out_bit_for_bit() {
        let [base, detail] = [1, 2].map(|salt| anything((40, 9), 3, salt));
        let mask = trial::picture((40, 9), 1, |_, x, _| if x < 20 { 0.0 } else { 1.0 });
        for method in [TANGENT, REORIENTED, WHITEOUT] {
            let inputs = [Some(&base), Some(&detail)];
            let image = trial::made(BLOCK, &inputs, &params(method, 0.0));
            assert_eq!(trial::bits(&image), trial::bits(&base));
            let inputs = [Some(&base), Some(&detail), Some(&mask)];
            let image = trial::made(BLOCK, &inputs, &params(method, 1.0));
            for channel in 0..3 {
                let [row, own] = [&image, &base].map(|image| image.row(channel, 4));
                assert_eq!(row[..20], own[..20]);
                assert_ne!(row[20..], own[20..]);
            }
        }
    }

    #[test]
    fn normals_have_length_1_whatever_comes() {
        let [base, detail] = [1, 2].map(|salt| anything((61, 53), 4, salt));
        for method in [TANGENT, REORIENTED, WHITEOUT] {
            for (range, scale, offset) in [(0, 1.0, 0.0), (1, 2.0, -1.0)] {
                let [method, age] = params(method, 0.999);
                let params = [method, age, ("z range", ParamValue::Choice(range))];
                let image = trial::made(BLOCK, &[Some(&base), Some(&detail)], &params);
                for i in 0..61 * 53 {
                    let [x, y, z] = [0, 1, 2].map(|channel| f64::from(image.channel(channel)[i]));
                    let (x, y, z) = (x * 2.0 - 1.0, y * 2.0 - 1.0, z * scale + offset);
                    let length = (x * x + y * y + z * z).sqrt();
                    assert!((length - 1.0).abs() < 1e-6 && z >= 0.0, "{i}: {x} {y} {z}");
                }
            }
        }
    }

    #[test]
    fn base_age_0_leaves_the_detail() {
        let [base, detail] =
            [[0.6, 0.0, 0.8], [0.0, 0.6, 0.8]].map(|normal| trial::plain((2, 2), &packed(normal)));
        let age = [("base age", ParamValue::Float(0.0))];
        let image = trial::made(BLOCK, &[Some(&base), Some(&detail)], &age);
        let found = [0, 1, 2].map(|channel| image.channel(channel)[0]);
        assert_near(found, [0.5, 0.8, 0.8]);
    }

    #[test]
    fn grey_images_count_as_three_alike() {
        let grey = anything((9, 4), 1, 1);
        let colour = trial::picture((9, 4), 3, |_, x, y| grey.row(0, y)[x as usize]);
        let detail = anything((9, 4), 4, 2);
        for method in [TANGENT, REORIENTED, WHITEOUT] {
            let params = params(method, 0.5);
            let blended = |base| trial::made(BLOCK, &[Some(base), Some(&detail)], &params);
            let (grey, colour) = (blended(&grey), blended(&colour));
            assert_eq!((grey.planes(), grey.channel(0)), (1, colour.channel(0)));
        }
    }

    #[test]
    fn threads_and_strips_do_not_matter_at_any_size() {
        for size in trial::SIZES {
            let [base, detail] = [1, 2].map(|salt| anything(size, 3, salt));
            let mask = anything(size, 1, 3);
            let inputs = [Some(&base), Some(&detail), Some(&mask)];
            for method in [TANGENT, REORIENTED, WHITEOUT] {
                trial::same_on_all_threads(BLOCK, &inputs, &params(method, 0.7));
            }
        }
    }
}
