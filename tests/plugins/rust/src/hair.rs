//! Hair on a mesh: roots in the middles of triangles, and strands from roots. The book shows this.

use ptlib_plugin::{
    prelude::*,
    stream::{DIRECTION, ID, POSITION, RADIUS, RANDOM},
};

/// A hair root in the middle of each triangle, away from its front.
pub struct Roots {
    seed: u64,
}

impl Block for Roots {
    type Params = ();

    const ABOUT: About = About {
        id: c"ptlib-rust.roots",
        category: c"hair",
        summary: c"A hair root in the middle of each triangle.",
        shape: Shape::Whole,
        inputs: &[&input(c"mesh", Kind::Mesh)],
        outputs: &[&output(c"roots", Planes::Grey).of_kind(Kind::Points)],
        uses_seed: true,
        ..About::DEFAULT
    };

    fn prepare((): &(), setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { seed: setup.seed() })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let mesh = call.mesh(0)?;
        let (corners, triangles) = (mesh.positions()?, mesh.triangles());
        let streams = (POSITION, DIRECTION, RANDOM, ID);
        let mut roots = call.new_points(0, triangles.len(), streams)?;
        // Pieces of the slices, on all threads.
        roots.fill(|first, (positions, directions, randoms, ids)| {
            for (i, triangle) in triangles[first..][..positions.len()].iter().enumerate() {
                let [a, b, c] = triangle.map(|vertex| corners.get(vertex as usize));
                positions[i] = std::array::from_fn(|axis| (a[axis] + b[axis] + c[axis]) / 3.0);
                directions[i] = normal(a, b, c);
                ids[i] = [u32::try_from(first + i).unwrap_or_default(), 0];
                randoms[i] = noise::uniform(self.seed, ids[i][0], 0, 0);
            }
            Ok(())
        })?;
        roots.finish()
    }
}

/// The direction away from the front of a triangle, of length 1; upwards, if it has no area.
fn normal(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> [f32; 3] {
    let [p, q] = [b, c].map(|corner| [0, 1, 2].map(|axis| f64::from(corner[axis] - a[axis])));
    let cross = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let length = (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt();
    if length > 0.0 { cross.map(|x| math::single(x / length)) } else { [0.0, 1.0, 0.0] }
}

params! {
    /// Parameters of [`Grow`].
    GrowParams {
        /// How long a hair is.
        length: float [hard 0.0..=10.0 soft 0.0..=1.0] = 1.0;
        /// Pieces of a hair.
        segments: int [hard 1..=64 soft 1..=16] = 4;
    }
}

/// A straight hair from each root.
pub struct Grow(GrowParams);

impl Block for Grow {
    type Params = GrowParams;

    const ABOUT: About = About {
        id: c"ptlib-rust.grow",
        category: c"hair",
        summary: c"A straight hair from each root.",
        shape: Shape::Whole,
        inputs: &[&input(c"roots", Kind::Points)],
        outputs: &[&output(c"hair", Planes::Grey).of_kind(Kind::Strands)],
        ..About::DEFAULT
    };

    fn prepare(params: &GrowParams, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(params.clone()))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let roots = call.points(0)?;
        let (from, along) = (roots.positions()?, roots.streams().need(DIRECTION)?);
        let segments = self.0.segments.unsigned_abs();
        let points = StrandPoints::Each(roots.count(), segments as usize + 1);
        // The strands share the streams of the roots, whatever these are: nothing is copied.
        let streams = (POSITION, RADIUS);
        let mut hair = call.new_strands(0, points, streams, roots.streams())?;
        hair.fill(|piece, (positions, radii), ()| {
            for strand in 0..piece.count() {
                let root = piece.first + strand;
                let (from, along) = (from.get(root), along.get(root));
                for (point, part) in piece.points(strand).zip(0_u16..) {
                    let t = math::single(f64::from(part) / f64::from(segments));
                    let length = t * math::single(self.0.length);
                    positions[point] =
                        std::array::from_fn(|axis| from[axis] + along[axis] * length);
                    radii[point] = 0.01 * (1.0 - t);
                }
            }
            Ok(())
        })?;
        hair.finish()
    }
}
