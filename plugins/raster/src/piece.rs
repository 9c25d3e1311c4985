//! A triangle in the picture: exact coverage with integers.
//!
//! A pixel is covered if its middle is inside, or on an edge that is a top or a left edge
//! (J. Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988). So triangles that share an
//! edge cover each pixel along it once.
//!
//! Corners are less than 2¹⁷ pixels from the corner of the picture, in steps of 1/256: ±2²⁵.
//! Differences have 26 bits, their products 52, and the edge functions 53, and i64 holds them with
//! room to spare; so does f64, exactly.

use crate::{
    grid::Rect,
    number::{index, signed},
};

/// Steps of a pixel that corners snap to.
pub(crate) const STEPS: i32 = 256;

/// Pixels from the middle of the picture to where triangles are cut: with half of the largest
/// picture it is 2¹⁷.
pub(crate) const GUARD: f64 = 98_304.0;

/// A triangle, or a part of one that was clipped.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    /// Corners in steps.
    pub at: [[i32; 2]; 3],
    /// 1 through the distance of each corner.
    pub inverse: [f64; 3],
    /// What part each corner of the whole triangle has in these corners, if they are others.
    pub parts: Option<[[f64; 3]; 3]>,
}

/// The line through two corners: positive on the side of the third.
#[derive(Debug, Clone, Copy)]
struct Edge {
    from: [i64; 2],
    along: [i64; 2],
    /// 0 if pixels on the edge belong to the triangle, else 1.
    bias: i64,
}

impl Edge {
    /// The edge function, in square steps, at the middle of a pixel.
    #[inline]
    fn at(&self, x: usize, y: usize) -> i64 {
        let [x, y] = [x, y].map(middle);
        self.along[0] * (y - self.from[1]) - self.along[1] * (x - self.from[0])
    }
}

#[inline]
fn middle(pixel: usize) -> i64 {
    i64::from(signed(pixel)) * i64::from(STEPS) + i64::from(STEPS / 2)
}

/// A triangle of some area, ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Setup {
    /// The edges opposite to the corners.
    edges: [Edge; 3],
    /// Twice the area, more than 0.
    area: f64,
    pub piece: Piece,
}

impl Setup {
    /// None if the triangle has no area.
    pub fn new(piece: &Piece) -> Option<Self> {
        let [a, b, c] = piece.at.map(|corner| corner.map(i64::from));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        // Both sides are drawn: the edges of the other one run the other way round.
        let turn = area.signum();
        let edge = |from: [i64; 2], to: [i64; 2]| {
            let along = [turn * (to[0] - from[0]), turn * (to[1] - from[1])];
            let is_inside = along[1] < 0 || along[1] == 0 && along[0] > 0;
            Edge { from, along, bias: i64::from(!is_inside) }
        };
        let edges = [edge(b, c), edge(c, a), edge(a, b)];
        (area != 0).then_some(Self { edges, area: area.abs() as f64, piece: *piece })
    }

    /// The pixels in which it may be, of those.
    pub fn pixels(&self, within: Rect) -> Rect {
        pixels(&self.piece.at, within)
    }

    /// Whether it covers a pixel.
    pub fn covers(&self, x: usize, y: usize) -> bool {
        self.edges.iter().all(|edge| edge.at(x, y) >= edge.bias)
    }

    /// The row of a few pixels: what the edge functions are at the first, less their bias, and how
    /// much they grow from one to the next. It covers a pixel where none of them is negative.
    #[inline]
    pub fn row(&self, x: usize, y: usize) -> ([i64; 3], [i64; 3]) {
        let starts = self.edges.map(|edge| edge.at(x, y) - edge.bias);
        (starts, self.edges.map(|edge| -edge.along[1] * i64::from(STEPS)))
    }

    /// The same for 1 through the distance, which is linear in the picture.
    #[inline]
    pub fn depth(&self, x: usize, y: usize) -> (f64, f64) {
        let [a, b, c] = self.piece.inverse;
        // From the first corner, so that a pixel has the same depth whatever tile it is drawn in.
        let (to_b, to_c) = (b - a, c - a);
        let start = self.edges[1].at(x, y) as f64 * to_b + self.edges[2].at(x, y) as f64 * to_c;
        let steps = [1, 2].map(|i| (-self.edges[i].along[1] * i64::from(STEPS)) as f64);
        (a + start / self.area, (steps[0] * to_b + steps[1] * to_c) / self.area)
    }

    /// What part each corner of the whole triangle has in a pixel that is covered, in perspective.
    #[inline]
    pub fn weights(&self, x: usize, y: usize) -> [f64; 3] {
        let Piece { inverse, parts, .. } = self.piece;
        let each = [0, 1, 2].map(|i| self.edges[i].at(x, y) as f64 * inverse[i]);
        let sum = each[0] + each[1] + each[2];
        let weights = each.map(|weight| weight / sum);
        match parts {
            None => weights,
            Some(p) => [0, 1, 2]
                .map(|i| weights[0] * p[0][i] + weights[1] * p[1][i] + weights[2] * p[2][i]),
        }
    }
}

/// The pixels whose middles lie in the box around corners, of those.
pub(crate) fn pixels(corners: &[[i32; 2]], within: Rect) -> Rect {
    let ends = |axis: usize| {
        let places = corners.iter().map(|corner| corner[axis]);
        let (low, high) = (places.clone().min().unwrap_or(0), places.max().unwrap_or(-1));
        let first = (low + STEPS / 2 - 1).div_euclid(STEPS);
        let last = (high - STEPS / 2).div_euclid(STEPS);
        (index(first), index(last + 1))
    };
    let ((x0, x1), (y0, y1)) = (ends(0), ends(1));
    Rect { x0, y0, x1, y1 }.and(within)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(at: [[i32; 2]; 3]) -> Piece {
        Piece { at, inverse: [1.0, 0.5, 0.25], parts: None }
    }

    /// How often each pixel of a picture of 40 × 40 is covered.
    fn covered(triangles: &[[[i32; 2]; 3]]) -> Vec<u32> {
        let within = Rect { x0: 0, y0: 0, x1: 40, y1: 40 };
        let mut counts = vec![0; 1600];
        for setup in triangles.iter().filter_map(|at| Setup::new(&piece(*at))) {
            let rect = setup.pixels(within);
            for (x, y) in (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| (x, y))) {
                counts[y * 40 + x] += u32::from(setup.covers(x, y));
            }
        }
        counts
    }

    #[test]
    fn a_square_of_two_triangles_is_covered_once_on_any_grid() {
        for (shift, size) in [(0, 2560), (128, 2560), (77, 3001), (-3000, 9000), (127, 258)] {
            let at = |x: i32, y: i32| [shift + x * size, shift + y * size];
            let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            for split in [[[a, b, c], [a, c, d]], [[b, a, d], [b, c, d]]] {
                let counts = covered(&split);
                for (i, count) in counts.iter().enumerate() {
                    let [x, y] = [i % 40, i / 40].map(|pixel| middle(pixel) - i64::from(shift));
                    let is_in = [x, y].iter().all(|x| (0..i64::from(size)).contains(x));
                    assert_eq!(*count, u32::from(is_in), "{shift} {size}: {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn a_fan_around_a_point_covers_each_pixel_once() {
        // Rays to the corners of a square through middles of pixels, where ties are.
        let (middle, far) = ([20 * 256 + 128, 19 * 256 + 128], 40 * 256);
        let mut rim: Vec<[i32; 2]> = (0..=40).map(|i| [i * 256, 0]).collect();
        rim.extend((1..=40).map(|i| [far, i * 256]));
        rim.extend((0..40).rev().map(|i| [i * 256, far]));
        rim.extend((0..40).rev().map(|i| [0, i * 256]));
        let fan: Vec<_> = rim.windows(2).map(|pair| [middle, pair[0], pair[1]]).collect();
        assert!(covered(&fan).iter().all(|count| *count == 1));
    }

    #[test]
    fn the_extremes_of_the_guard_band_do_not_overflow() {
        let g = 131_072 * 256;
        let counts = covered(&[[[-g, -g], [g, -g], [-g, g]], [[g, g], [-g, g], [g, -g]]]);
        assert!(counts.iter().all(|count| *count == 1));
        assert!(Setup::new(&piece([[-g, -g], [g, g], [0, 0]])).is_none(), "no area");
    }

    #[test]
    fn weights_are_right_in_perspective() {
        let setup = Setup::new(&piece([[0, 0], [2560, 0], [0, 2560]])).unwrap();
        let weights = setup.weights(2, 4);
        // b = (.3, .25, .45) in the picture, times 1/w, divided by their sum.
        let sum = 0.3 + 0.25 * 0.5 + 0.45 * 0.25;
        for (weight, expected) in weights.iter().zip([0.3, 0.125, 0.1125]) {
            assert!((weight - expected / sum).abs() < 1e-12, "{weights:?}");
        }
        let (depth, step) = setup.depth(2, 4);
        assert!((depth - sum).abs() < 1e-12, "{depth}");
        assert!((setup.depth(3, 4).0 - depth - step).abs() < 1e-12);
    }
}
