//! Triangles cut at the near plane and at the guard band, in double precision.
//!
//! A cut edge is computed from its end inside, so that both triangles that share it get the same
//! corner, bit for bit.

use crate::{
    camera::Camera,
    number::dot,
    piece::{GUARD, Piece},
};

/// A corner: column and row times the distance, the distance, and the parts of the corners of the
/// whole triangle.
#[derive(Debug, Clone, Copy)]
struct Corner {
    at: [f64; 3],
    parts: [f64; 3],
}

/// What a plane keeps, as factors of a homogeneous point, and a constant.
type Plane = ([f64; 3], f64);

/// The guard band; the near plane comes first, so that the distance is positive here.
const BAND: [Plane; 4] = [
    ([1.0, 0.0, GUARD], 0.0),
    ([-1.0, 0.0, GUARD], 0.0),
    ([0.0, 1.0, GUARD], 0.0),
    ([0.0, -1.0, GUARD], 0.0),
];

/// The pieces of a triangle that are left, at most six: each of five planes adds a corner.
pub(crate) fn pieces(
    camera: &Camera,
    corners: [[f64; 3]; 3],
) -> impl Iterator<Item = Piece> + use<'_> {
    let mut polygon = Vec::with_capacity(8);
    for (i, corner) in corners.into_iter().enumerate() {
        let mut parts = [0.0; 3];
        parts[i] = 1.0;
        polygon.push(Corner { at: camera.homogeneous(corner), parts });
    }
    for plane in [([0.0, 0.0, 1.0], -camera.near)].into_iter().chain(BAND) {
        polygon = cut(&polygon, plane);
    }
    for corner in &mut polygon {
        // Corners 10¹⁸ away leave rounding errors of any size.
        corner.at[2] = corner.at[2].max(camera.near);
    }
    let count = polygon.len().saturating_sub(2);
    (1..=count).map(move |i| {
        let corners = [polygon[0], polygon[i], polygon[i + 1]];
        Piece {
            at: corners.map(|corner| camera.snap(corner.at)),
            inverse: corners.map(|corner| 1.0 / corner.at[2]),
            parts: Some(corners.map(|corner| corner.parts)),
        }
    })
}

/// The part of a convex polygon on the inner side of a plane.
fn cut(polygon: &[Corner], (factors, constant): Plane) -> Vec<Corner> {
    let inside = |corner: &Corner| dot(factors, corner.at) + constant;
    let mut kept = Vec::with_capacity(8);
    for (i, corner) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let [here, there] = [corner, next].map(inside);
        if here >= 0.0 {
            kept.push(*corner);
        }
        if (here >= 0.0) != (there >= 0.0) {
            let (from, to, t) = if here >= 0.0 {
                (corner, next, here / (here - there))
            } else {
                (next, corner, there / (there - here))
            };
            let between = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t);
            kept.push(Corner { at: between(from.at, to.at), parts: between(from.parts, to.parts) });
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            eye: [0.0; 3],
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
            scale: 32.0,
            size: [64, 64],
            near: 0.1,
        }
    }

    #[test]
    fn what_is_in_sight_comes_through_and_what_is_behind_does_not() {
        let seen = [[0.0, 0.0, -1.0], [0.5, 0.0, -1.0], [0.0, 0.5, -1.0]];
        let whole: Vec<_> = pieces(&camera(), seen).collect();
        assert_eq!(whole.len(), 1);
        assert_eq!(whole[0].at, [[8192, 8192], [12288, 8192], [8192, 4096]]);
        let behind = seen.map(|[x, y, z]| [x, y, -z]);
        assert_eq!(pieces(&camera(), behind).count(), 0);
    }

    #[test]
    fn corners_of_any_size_stay_in_the_guard_band() {
        let far = 1e18;
        let limit = 131_072 * 256;
        let triangles = [
            [[far, far, -far], [-far, far, far], [0.0, -far, -1.0]],
            [[far, 0.0, 0.0], [-far, 1.0, 0.0], [0.0, 0.0, -0.1]],
            [[0.0, 0.0, far], [1e-9, 0.0, -far], [0.0, 1e-9, -0.1]],
            [[1e-30, 0.0, 0.0], [0.0; 3], [0.0, 1e-30, -1e-30]],
        ];
        for triangle in triangles {
            let all: Vec<_> = pieces(&camera(), triangle).collect();
            assert!(all.len() <= 6);
            for piece in all {
                assert!(piece.at.iter().flatten().all(|x| x.abs() <= limit), "{piece:?}");
                assert!(piece.inverse.iter().all(|w| w.is_finite() && *w > 0.0), "{piece:?}");
            }
        }
    }

    #[test]
    fn parts_of_a_clipped_corner_give_its_place() {
        let corners = [[0.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.5, -1.0]];
        for piece in pieces(&camera(), corners) {
            for (at, parts) in piece.at.iter().zip(piece.parts.unwrap()) {
                let point: [f64; 3] =
                    std::array::from_fn(|axis| (0..3).map(|i| parts[i] * corners[i][axis]).sum());
                let camera = camera();
                let expected = camera.snap(camera.homogeneous(point));
                for axis in 0..2 {
                    assert!((at[axis] - expected[axis]).abs() <= 1, "{at:?} {expected:?}");
                }
            }
        }
    }
}
