//! Normals of a height map.
//!
//! The slope of the heights h is taken from the neighbours on both sides: sx = depth·W·(h(x+1) -
//! h(x-1))/2, where `depth` is the height of 1 in widths of the image and W the width in pixels; sy
//! alike over rows, with W too, since pixels are square. The normal is (-sx, sy, 1), made to length
//! 1; y points up, or down with `y axis`. Slopes are in image widths, so a larger picture of the
//! same heights gives the same normals.
//!
//! Nothing here knows of heads: it makes the normal map of any height map.

use ptlib_plugin::{
    Image, Row,
    prelude::*,
    simd::{self, Kernel},
};

use super::packing::{LANES, Packing, ZRange};

const HEIGHT: usize = 0;

choice! {
    /// Where y points.
    YAxis {
        /// To the upper edge of the image, as in OpenGL and glTF.
        Up = "up",
        /// To the lower edge of the image, as in Direct3D.
        Down = "down",
    }
}

choice! {
    /// What lies beyond the border.
    Border {
        /// The opposite side: the normals tile as the heights do.
        Wrap = "wrap",
        /// Nothing: at the border, slopes are taken from one side, over one pixel.
        OneSided = "one-sided",
    }
}

params! {
    /// Parameters of [`HeightToNormal`].
    Params {
        /// How high the height 1 rises above 0, in widths of the image. 0 makes everything flat;
        /// skin has about 0.005.
        depth: float [hard 0.0..=1.0 soft 0.0..=0.05] = 0.005;
        /// Where the second component of the normals, the green channel, points.
        y_axis "y axis": choice [YAxis] = YAxis::Up;
        /// How the third component lies in the blue channel. Whoever reads the normals must be
        /// told the same.
        z_range "z range": choice [ZRange] = ZRange::Positive;
        /// What lies beyond the border. With "one-sided" the normals do not tile.
        border: choice [Border] = Border::Wrap;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct HeightToNormal {
    /// What a difference over two pixels is multiplied by to give a slope.
    slope: f32,
    /// 1 if y points up, else -1.
    up: f32,
    z: Packing,
    wraps: bool,
}

impl Block for HeightToNormal {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.height to normal",
        name: c"Height to normal",
        category: c"skin",
        summary: c"The normal map of any height map, with the heights as alpha.",
        inputs: &[&input(c"height", Kind::Image)
            .anywhere()
            .doc(c"Heights, 0 low and 1 high, in the red channel. Any height map will do.")],
        outputs: &[&output(c"normals", Planes::ColourAlpha)
            .doc(c"Normals in red, green and blue, and the heights in alpha.")],
        shape: Shape::Gather,
        tiling_exception: c"with the border `one-sided`, it does not wrap around",
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self {
            slope: math::single(params.depth * f64::from(setup.width()) / 2.0),
            up: if params.y_axis == YAxis::Up { 1.0 } else { -1.0 },
            z: params.z_range.packing(),
            wraps: params.border == Border::Wrap,
        })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let heights = call.image(HEIGHT)?;
        let out = call.output(0)?;
        let corner = (out.x() as usize, out.y());
        out.rows().into_iter().try_for_each(|row| self.write(heights, corner, row))
    }
}

/// Heights around some pixels: what lies to the left of each, to the right, above and below.
struct Around<'a> {
    own: &'a [f32],
    sides: [&'a [f32]; 2],
    rows: [&'a [f32]; 2],
}

impl HeightToNormal {
    /// Writes a row of an output whose left upper pixel is (`x`, `y`) of the image.
    fn write(
        &self,
        heights: Image<'_>,
        (x, y): (usize, u32),
        row: Row<'_>,
    ) -> Result<(), BlockError> {
        let Ok(mut planes) = <[&mut [f32]; 4]>::try_from(row.channels) else {
            return Err(BlockError::from("the output has not four planes"));
        };
        let y = (y + row.y) as usize;
        let (above, below, down) = self.neighbours(y, heights.height() as usize);
        let [own, above, below] =
            [y, above, below].map(|y| heights.row(0, u32::try_from(y).unwrap_or(u32::MAX)));
        let (width, end) = (own.len(), x + planes[0].len());
        let mut write = |from: usize, to: usize, [left, right]: [usize; 2], across: f32| {
            let around = Around {
                own: &own[from..to],
                sides: [&own[left..], &own[right..]],
                rows: [&above[from..], &below[from..]],
            };
            let out = planes.each_mut().map(|plane| &mut plane[from - x..to - x]);
            simd::run(Normals { around, slopes: [across, down * self.up], z: self.z, out });
        };
        // What lies at a side of the image, and all between, whose neighbours follow each other.
        for border in [0, width - 1] {
            if (x..end).contains(&border) {
                let (left, right, across) = self.neighbours(border, width);
                write(border, border + 1, [left, right], across);
            }
        }
        let (from, to) = (x.max(1), end.min(width - 1));
        if from < to {
            write(from, to, [from - 1, from + 1], self.slope);
        }
        Ok(())
    }

    /// The neighbours of a place on a line of some length, and what their difference is multiplied
    /// by.
    fn neighbours(&self, at: usize, length: usize) -> (usize, usize, f32) {
        let last = length - 1;
        if self.wraps {
            return ((at + last) % length, (at + 1) % length, self.slope);
        }
        let is_border = at == 0 || at == last;
        let slope = if is_border { 2.0 * self.slope } else { self.slope };
        (at.saturating_sub(1), (at + 1).min(last), slope)
    }
}

/// Some normals of a row.
struct Normals<'a> {
    around: Around<'a>,
    /// What differences across and down are multiplied by.
    slopes: [f32; 2],
    z: Packing,
    out: [&'a mut [f32]; 4],
}

impl Kernel for Normals<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { around, slopes: [across, down], z: packing, out } = self;
        let own = around.own;
        let [left, right] = around.sides.map(|row| &row[..own.len()]);
        let [above, below] = around.rows.map(|row| &row[..own.len()]);
        let [red, green, blue, alpha] = out;
        let mut here = [[0.0; LANES]; 3];
        for start in (0..own.len()).step_by(LANES) {
            let end = own.len().min(start + LANES);
            let [left, right, above, below] =
                [left, right, above, below].map(|row| &row[start..end]);
            let [x, y, z] = here.each_mut().map(|plane| &mut plane[..end - start]);
            for i in 0..z.len() {
                let across = (left[i] - right[i]) * across;
                let down = (below[i] - above[i]) * down;
                let inverse = 1.0 / (across * across + down * down + 1.0).sqrt();
                x[i] = Packing::HALVED.packed(across * inverse);
                y[i] = Packing::HALVED.packed(down * inverse);
                z[i] = packing.packed(inverse);
            }
            red[start..end].copy_from_slice(x);
            green[start..end].copy_from_slice(y);
            blue[start..end].copy_from_slice(z);
        }
        alpha.copy_from_slice(own);
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{Image, params::ParamValue};

    use super::super::trial;

    const BLOCK: &str = "aging.height to normal";

    fn depth(depth: f64) -> (&'static str, ParamValue) {
        ("depth", ParamValue::Float(depth))
    }

    fn at(image: &Image, x: usize, y: u32) -> [f32; 4] {
        [0, 1, 2, 3].map(|channel| image.row(channel, y)[x])
    }

    fn assert_near(found: [f32; 4], expected: [f32; 4]) {
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(is_near, "{found:?}, expected {expected:?}");
    }

    /// The normal in the middle of 5 × 5 pixels with these differences across and down.
    fn middle(across: f32, down: f32, own: f32, params: &[(&str, ParamValue)]) -> [f32; 4] {
        let heights = trial::picture((5, 5), 1, |_, x, y| match (x, y) {
            (1, 2) => 0.5 - across / 2.0,
            (3, 2) => 0.5 + across / 2.0,
            (2, 1) => 0.5 - down / 2.0,
            (2, 3) => 0.5 + down / 2.0,
            _ => own,
        });
        at(&trial::made(BLOCK, &[Some(&heights)], params), 2, 2)
    }

    #[test]
    fn packed_normals_are_those_of_the_vectors() {
        // A depth of 0.4 at a width of 5 makes a slope of a difference over two pixels.
        let down = ("y axis", ParamValue::Choice(1));
        let one = [depth(0.4), down.clone()];
        assert_near(middle(0.5, 0.0, 0.4, &one), [0.276_393, 0.5, 0.894_427, 0.4]);
        assert_near(middle(0.6, -0.8, 0.3, &one), [0.287_868, 0.782_843, 0.5_f32.sqrt(), 0.3]);
        assert_near(middle(0.6, -0.8, 0.3, &one[..1]), [0.287_868, 0.217_157, 0.5_f32.sqrt(), 0.3]);
        let signed = [depth(0.4), down, ("z range", ParamValue::Choice(1))];
        assert_near(middle(0.5, 0.0, 0.4, &signed), [0.276_393, 0.5, 0.947_214, 0.4]);
    }

    #[test]
    fn slopes_are_in_widths_of_the_image() {
        for (width, red, blue) in [(512, 0.230_473, 0.842_271), (400, 0.276_393, 0.894_427)] {
            let heights =
                trial::picture((width, 3), 1, |_, x, _| if x % 4 < 2 { 0.5 } else { 0.0 });
            let normals = trial::made(BLOCK, &[Some(&heights)], &[]);
            // At column 4, there is 0 to the left and 0.5 to the right.
            assert_near(at(&normals, 4, 1), [red, 0.5, blue, 0.5]);
        }
    }

    #[test]
    fn a_ramp_wraps_or_ends() {
        let slopes = |size: (u32, u32), border| {
            let heights = trial::picture(size, 1, |_, x, y| (x + y) as f32 * 0.2);
            let params = [depth(2.0 / f64::from(size.0.max(4))), ("border", border)];
            let image = trial::made(BLOCK, &[Some(&heights)], &params);
            let along = |i: usize, y: u32| {
                let [red, green, z, _] = at(&image, i, y);
                [(0.5 - red) * 2.0 / z, (green - 0.5) * 2.0 / z]
            };
            if size.0 > 1 {
                [0, 1, 2, 3].map(|x| along(x, 0)[0])
            } else {
                [0, 1, 2, 3].map(|y| along(0, y)[1])
            }
        };
        let near = |found: [f32; 4], expected: [f32; 4]| {
            let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
            assert!(is_near, "{found:?}, expected {expected:?}");
        };
        // With a depth of 2 / W, a slope is the difference over two pixels.
        near(slopes((4, 1), ParamValue::Choice(0)), [-0.4, 0.4, 0.4, -0.4]);
        near(slopes((4, 1), ParamValue::Choice(1)), [0.4; 4]);
        // A column is 1 wide: at a depth of ½, slopes are a quarter of the difference.
        near(slopes((1, 4), ParamValue::Choice(0)), [-0.1, 0.1, 0.1, -0.1]);
        near(slopes((1, 4), ParamValue::Choice(1)), [0.1; 4]);
    }

    #[test]
    fn normals_have_length_1_and_no_seam() {
        let heights =
            trial::picture((64, 64), 1, |_, x, y| trial::wave((x * 3 + y * 2) as f32 / 64.0));
        let normals = trial::made(BLOCK, &[Some(&heights)], &[depth(0.05)]);
        for y in 0..64 {
            for x in 0..64 {
                let [red, green, z, _] = at(&normals, x, y).map(f64::from);
                let [x, y] = [red, green].map(|packed| packed * 2.0 - 1.0);
                assert!(z > 0.0 && ((x * x + y * y + z * z).sqrt() - 1.0).abs() < 1e-6);
            }
        }
        let [across, inside] = trial::steps(&normals);
        assert!(across <= inside, "{across} against {inside}");
    }

    #[test]
    fn threads_and_strips_do_not_matter_at_any_size() {
        for size in trial::SIZES {
            for border in 0..2 {
                let heights = trial::picture(size, 1, |_, x, y| trial::grain(x, y));
                let params = [depth(1.0), ("border", ParamValue::Choice(border))];
                trial::same_on_all_threads(BLOCK, &[Some(&heights)], &params);
            }
        }
    }
}
