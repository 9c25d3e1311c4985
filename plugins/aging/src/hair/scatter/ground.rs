//! What hair grows on: the triangles of a mesh, and the images that say where and how dense.

use ptlib_plugin::{
    Element, Image, Mesh, Stream,
    prelude::*,
    simd::{self, Kernel},
};

use super::batch::{BATCH, Batch};
use crate::hair::vector::{Vector, between, cross, direction, length, minus, wide};

/// Normals that are shorter have no direction.
const SHORTEST: f64 = 1e-6;

/// The triangles and images of one computation.
#[derive(Debug)]
pub struct Ground<'a> {
    /// The corners of the triangles.
    pub triangles: &'a [[u32; 3]],
    positions: Corners<'a, [f32; 3]>,
    texcoords: Corners<'a, [f32; 2]>,
    normals: Option<Corners<'a, [f32; 3]>>,
    loss_age: Image<'a>,
    density: Option<Image<'a>>,
}

impl<'a> Ground<'a> {
    /// The ground of a mesh, with the age of loss and perhaps a density.
    ///
    /// # Errors
    /// If the mesh has no texture coordinates.
    pub fn new(
        mesh: Mesh<'a>,
        loss_age: Image<'a>,
        density: Option<Image<'a>>,
    ) -> Result<Self, BlockError> {
        let texcoords = mesh.texcoords().ok_or_else(|| {
            BlockError::invalid(
                "the mesh has no texture coordinates, which say where the image `loss age` lies \
                 on it: `aging.load mesh` reads them from files that have them, and the caller \
                 of a `mesh input` gives them as the stream \"texcoord\"",
            )
        })?;
        Ok(Self {
            triangles: mesh.triangles(),
            positions: Corners::of(mesh.positions()?),
            texcoords: Corners::of(texcoords),
            normals: mesh.normals().map(Corners::of),
            loss_age,
            density,
        })
    }

    #[inline(always)]
    fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.positions.of_triangle(self.triangles[triangle])
    }

    /// The vector product of two edges: away from the front, twice as long as the area is large.
    fn front(&self, triangle: usize) -> Vector {
        let [a, b, c] = self.corners(triangle).map(wide);
        cross(minus(b, a), minus(c, a))
    }

    /// The area of a triangle.
    #[inline(always)]
    pub fn area(&self, triangle: usize) -> f64 {
        length(self.front(triangle)) / 2.0
    }

    /// The texture coordinates of the corners.
    #[inline(always)]
    pub fn texcoords(&self, triangle: usize) -> [[f32; 2]; 3] {
        self.texcoords.of_triangle(self.triangles[triangle])
    }

    /// The point of a triangle at these weights of its second and third corner.
    #[inline(always)]
    pub fn root(&self, triangle: usize, weights: [f64; 2]) -> [f32; 3] {
        between(self.corners(triangle), weights).map(math::single)
    }

    /// The directions away from the surface at the roots of a batch, by axis: the normals' means, or
    /// the fronts of triangles whose normals cancel each other or are not there.
    pub fn normals(&self, batch: &Batch) -> [[f64; BATCH]; 3] {
        let mut normals = [[0.0; BATCH]; 3];
        if let Some(of_corners) = &self.normals {
            for (i, ([triangle, _], weights)) in batch.hairs().enumerate() {
                let corners = self.triangles[triangle as usize];
                put(&mut normals, i, between(of_corners.of_triangle(corners), weights));
            }
            simd::run(Units(&mut normals));
        }
        for (i, ([triangle, _], _)) in batch.hairs().enumerate() {
            if normals.each_ref().map(|numbers| numbers[i]) == [0.0; 3] {
                let front = direction(self.front(triangle as usize), 0.0);
                put(&mut normals, i, front.unwrap_or([0.0, 1.0, 0.0]));
            }
        }
        normals
    }

    /// The age at which hair is lost at texture coordinates; 0 where none grows.
    #[inline(always)]
    pub fn loss_age(&self, texcoord: [f64; 2]) -> f32 {
        let age = pixel(&self.loss_age, texcoord);
        // What is not a number is no hair.
        if age > 0.0 { age.min(1.0) } else { 0.0 }
    }

    /// The part of hairs that stay there.
    #[inline(always)]
    pub fn density(&self, texcoord: [f64; 2]) -> Option<f64> {
        self.density.as_ref().map(|density| f64::from(pixel(density, texcoord)))
    }
}

#[inline(always)]
fn put(vectors: &mut [[f64; BATCH]; 3], i: usize, vector: Vector) {
    for (numbers, number) in vectors.iter_mut().zip(vector) {
        numbers[i] = number;
    }
}

/// Makes vectors of length 1; those that have no direction become zero.
struct Units<'a>(&'a mut [[f64; BATCH]; 3]);

impl Kernel for Units<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let [xs, ys, zs] = self.0;
        for i in 0..BATCH {
            let length = length([xs[i], ys[i], zs[i]]);
            let inverse = 1.0 / length;
            let unit = |x: f64| if length > SHORTEST { x * inverse } else { 0.0 };
            (xs[i], ys[i], zs[i]) = (unit(xs[i]), unit(ys[i]), unit(zs[i]));
        }
    }
}

/// What each vertex has. Elements that lie one after the other are read as a slice, which is faster.
#[derive(Debug)]
struct Corners<'a, T> {
    stream: Stream<'a, T>,
    slice: Option<&'a [T]>,
}

impl<'a, T: Element> Corners<'a, T> {
    fn of(stream: Stream<'a, T>) -> Self {
        Self { stream, slice: stream.as_slice() }
    }

    #[inline(always)]
    fn of_triangle(&self, vertices: [u32; 3]) -> [T; 3] {
        match self.slice {
            Some(slice) => vertices.map(|vertex| slice[vertex as usize]),
            None => vertices.map(|vertex| self.stream.get(vertex as usize)),
        }
    }
}

/// The pixel that contains texture coordinates, which wrap around; v points up.
#[inline(always)]
fn pixel(image: &Image<'_>, [u, v]: [f64; 2]) -> f32 {
    let (x, y) = (place(u, image.width()), place(v, image.height()));
    image.row(0, image.height() - 1 - y)[x as usize]
}

/// Which of `count` equal parts of the unit interval contains a coordinate that wraps around.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the place is one of few, and not negative"
)]
fn place(coordinate: f64, count: u32) -> u32 {
    // Nearly all lie there.
    let is_inside = (0.0..1.0).contains(&coordinate);
    let wrapped = if is_inside { coordinate } else { wrapped(coordinate) };
    ((wrapped * f64::from(count)) as u32).min(count - 1)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "coordinates of values are below 2^63"
)]
fn wrapped(coordinate: f64) -> f64 {
    // `floor` is a call on processors of the baseline.
    let rest = coordinate - (coordinate as i64) as f64;
    if rest < 0.0 { rest + 1.0 } else { rest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_wrap_around() {
        let cases = [
            (0.0, 0),
            (0.25, 1),
            (0.999, 3),
            (1.0, 0),
            (1.3, 1),
            (-0.1, 3),
            (-1.0, 0),
            (-1e-20, 3),
            (1e18, 0),
            (-1e18, 0),
        ];
        for (coordinate, expected) in cases {
            assert_eq!(place(coordinate, 4), expected, "{coordinate}");
        }
        assert_eq!(place(0.7, 1), 0);
    }

    #[test]
    fn a_point_of_a_triangle_is_the_mean_of_its_corners_by_weight() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let found = between(corners, [0.3, 0.4]);
        assert!((found[0] - 0.6).abs() < 1e-12 && (found[1] - 0.4).abs() < 1e-12);
        assert_eq!(found[2], 0.0);
        let area = |a, b| length(cross(a, b)) / 2.0;
        assert_eq!(area([3.0, 0.0, 0.0], [0.0, 4.0, 0.0]), 6.0);
        assert_eq!(area([1.0, 0.0, 1.0], [0.0, 2.0, 1.0]), 1.5);
    }
}
