//! The surface of a mesh at pixels: from the streams of corners to numbers side by side.

use ptlib_plugin::{
    Mesh, Stream, math,
    prelude::BlockError,
    stream::{TANGENT, TEXCOORD1},
};
use ptlib_raster::Fragment;

use super::texture::{LANES, Lanes};

/// Which streams the connected images ask for.
#[derive(Debug, Clone, Copy)]
pub struct Needs {
    /// There are normals in images.
    pub tangent: bool,
    /// There are images on the skin.
    pub texcoord: bool,
    /// There is fine detail.
    pub fine: bool,
}

/// The streams of a mesh.
#[derive(Debug)]
pub struct Surface<'a> {
    triangles: &'a [[u32; 3]],
    position: Stream<'a, [f32; 3]>,
    normal: Option<Stream<'a, [f32; 3]>>,
    tangent: Option<Stream<'a, [f32; 4]>>,
    texcoord: Option<Stream<'a, [f32; 2]>>,
    fine: Option<Stream<'a, [f32; 2]>>,
    centre: [f64; 3],
    unit: f64,
}

/// Some pixels to shade.
#[derive(Debug, Clone)]
pub struct Batch {
    /// Columns in the tile.
    pub x: [usize; LANES],
    /// How many there are; what is in the other lanes is of no account.
    pub count: usize,
    /// Where they are in space, in radii of the head.
    pub place: [Lanes; 3],
    /// Normals, not of length 1.
    pub normal: [Lanes; 3],
    /// Tangents, and the sign of the other direction.
    pub tangent: [Lanes; 4],
    /// Texture coordinates.
    pub uv: [Lanes; 2],
    /// Those of fine detail.
    pub fine: [Lanes; 2],
    /// How these change with the first: ∂fine u/∂u, ∂fine u/∂v, ∂fine v/∂u, ∂fine v/∂v.
    pub turn: [Lanes; 4],
}

/// A triangle's corners, corner by corner.
#[derive(Debug, Clone)]
pub struct Corners {
    triangle: u32,
    place: [[f32; 3]; 3],
    normal: [[f32; 3]; 3],
    tangent: [[f32; 4]; 3],
    uv: [[f32; 2]; 3],
    fine: [[f32; 2]; 3],
    turn: [f32; 4],
}

impl Default for Corners {
    fn default() -> Self {
        Self {
            triangle: u32::MAX,
            place: [[0.0; 3]; 3],
            normal: [[0.0; 3]; 3],
            tangent: [[0.0; 4]; 3],
            uv: [[0.0; 2]; 3],
            fine: [[0.0; 2]; 3],
            turn: [1.0, 0.0, 0.0, 1.0],
        }
    }
}

impl Default for Batch {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            x: [0; LANES],
            count: 0,
            place: [zero; 3],
            normal: [zero; 3],
            tangent: [zero; 4],
            uv: [zero; 2],
            fine: [zero; 2],
            turn: [zero; 4],
        }
    }
}

impl<'a> Surface<'a> {
    /// The streams that are needed; none if there is no triangle.
    ///
    /// # Errors
    /// If one is missing, with the block that makes it.
    pub fn new(
        mesh: Mesh<'a>,
        needs: Needs,
        (centre, unit): ([f64; 3], f64),
    ) -> Result<Self, BlockError> {
        let missing = |what: &str, block: &str| {
            BlockError::invalid(format!("the mesh has no {what}; {block}"))
        };
        let is_empty = mesh.triangles().is_empty();
        let frames = "the block \"aging.mesh frames\" makes them";
        let normal = mesh.normals();
        if normal.is_none() && !is_empty {
            return Err(missing("normals", frames));
        }
        let tangent = mesh.streams().get(TANGENT).filter(|_| needs.tangent);
        if needs.tangent && tangent.is_none() && !is_empty {
            return Err(missing("tangents, which normals in images need", frames));
        }
        let texcoord = mesh.texcoords();
        if needs.texcoord && texcoord.is_none() && !is_empty {
            let from = "they come from the mesh's file, or from whoever sets \"mesh input\"";
            return Err(missing("texture coordinates, which images on the skin need", from));
        }
        let fine = mesh.streams().get(TEXCOORD1).filter(|_| needs.fine);
        if needs.fine && fine.is_none() && texcoord.is_none() && !is_empty {
            let from = "the block \"aging.sphere coordinates\" makes them";
            return Err(missing("coordinates for the input \"fine\"", from));
        }
        let (triangles, position) = (mesh.triangles(), mesh.positions()?);
        Ok(Self { triangles, position, normal, tangent, texcoord, fine, centre, unit })
    }

    /// Where a vertex is, in radii of the head from its middle.
    #[inline]
    pub fn place(&self, vertex: u32) -> [f64; 3] {
        let position = self.position.get(vertex as usize);
        [0, 1, 2].map(|axis: usize| (f64::from(position[axis]) - self.centre[axis]) / self.unit)
    }

    /// Adds a pixel to the others; `corners` keeps the triangle from one call to the next.
    #[inline]
    pub fn add(&self, batch: &mut Batch, corners: &mut Corners, fragment: Fragment) {
        if corners.triangle != fragment.triangle {
            self.load(corners, fragment.triangle);
        }
        let i = batch.count;
        (batch.x[i], batch.count) = (fragment.x, i + 1);
        let [a, b, c] = fragment.weights;
        put(&mut batch.place, i, between(&corners.place, a, b, c));
        put(&mut batch.normal, i, between(&corners.normal, a, b, c));
        put(&mut batch.tangent, i, between(&corners.tangent, a, b, c));
        put(&mut batch.uv, i, between(&corners.uv, a, b, c));
        put(&mut batch.fine, i, between(&corners.fine, a, b, c));
        put(&mut batch.turn, i, corners.turn);
    }

    fn load(&self, corners: &mut Corners, triangle: u32) {
        let vertices = self.triangles[triangle as usize];
        corners.triangle = triangle;
        corners.place = vertices.map(|vertex| self.place(vertex).map(math::single));
        if let Some(normal) = &self.normal {
            corners.normal = vertices.map(|vertex| normal.get(vertex as usize));
        }
        if let Some(tangent) = &self.tangent {
            corners.tangent = vertices.map(|vertex| tangent.get(vertex as usize));
        }
        if let Some(texcoord) = &self.texcoord {
            corners.uv = vertices.map(|vertex| texcoord.get(vertex as usize));
        }
        corners.fine = corners.uv;
        if let Some(fine) = &self.fine {
            corners.fine = vertices.map(|vertex| fine.get(vertex as usize));
            corners.turn = turn(&corners.uv, &corners.fine);
        }
    }
}

#[inline]
fn between<const N: usize>(corners: &[[f32; N]; 3], a: f32, b: f32, c: f32) -> [f32; N] {
    std::array::from_fn(|n| a * corners[0][n] + b * corners[1][n] + c * corners[2][n])
}

#[inline]
fn put<const N: usize>(lanes: &mut [Lanes; N], place: usize, numbers: [f32; N]) {
    for (lanes, number) in lanes.iter_mut().zip(numbers) {
        lanes[place] = number;
    }
}

/// How the second coordinates of a triangle change with the first; not at all where these have no
/// area.
fn turn(uv: &[[f32; 2]; 3], fine: &[[f32; 2]; 3]) -> [f32; 4] {
    let edges = |corners: &[[f32; 2]; 3]| {
        [1, 2].map(|i: usize| {
            [0, 1].map(|axis: usize| f64::from(corners[i][axis]) - f64::from(corners[0][axis]))
        })
    };
    let ([p, q], [r, s]) = (edges(uv), edges(fine));
    let area = p[0] * q[1] - q[0] * p[1];
    if area == 0.0 {
        return [0.0; 4];
    }
    let [u, v] = [0, 1].map(|axis: usize| {
        [(r[axis] * q[1] - s[axis] * p[1]) / area, (s[axis] * p[0] - r[axis] * q[0]) / area]
    });
    let limit = 1e9;
    [u[0], u[1], v[0], v[1]].map(|x| math::single(x.clamp(-limit, limit)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_turn_of_second_coordinates_follows_the_triangle() {
        let uv = [[0.1, 0.2], [0.5, 0.3], [0.2, 0.9]];
        let fine = uv.map(|[u, v]: [f32; 2]| [3.0 * u - v, 0.5 * u + 2.0 * v + 7.0]);
        let found = turn(&uv, &fine);
        let expected = [3.0, -1.0, 0.5, 2.0];
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "{found:?}");
        assert_eq!(turn(&[[0.3, 0.3]; 3], &fine), [0.0; 4]);
    }
}
