//! Points by the square of tiles that they lie in: where the search of [`cutting`](super::cutting)
//! starts.

use super::{
    SIDE,
    cutting::{Candidates, Torus},
    greater,
};
use crate::block::prelude::*;

/// Points by the square that they lie in.
#[derive(Debug)]
pub(super) struct Buckets {
    /// Square by square, row by row.
    points: Candidates,
    /// Where each square's points start; then the end of the last one's.
    starts: Vec<usize>,
    /// Squares across and down.
    count: [usize; 2],
    /// Tiles along the side of a square, a power of 2.
    pub(super) side: usize,
}

/// As many points lie in a bucket in the mean, at most.
const POINTS_PER_BUCKET: usize = 12;

impl Buckets {
    /// The points of an image of that many tiles.
    pub(super) fn new(points: &Candidates, tiles: [usize; 2], torus: Torus) -> Self {
        let whole = tiles[0].max(tiles[1]).next_power_of_two();
        let is_inside = |places: &[f32], size| places.iter().all(|at| (0.0..size).contains(at));
        let [width, height] = torus.size;
        let mut side = whole;
        if is_inside(&points.x, width) && is_inside(&points.y, height) {
            let count = points.numbers.len();
            while side > 1 && count * side * side > POINTS_PER_BUCKET * tiles[0] * tiles[1] {
                side /= 2;
            }
        }
        let buckets = Self::sorted(points, tiles, side);
        // Squares in the void look far around. Where most buckets are empty, one is better.
        let used = buckets.starts.windows(2).filter(|ends| ends[0] < ends[1]).count();
        if used * 2 > buckets.starts.len() { buckets } else { Self::sorted(points, tiles, whole) }
    }

    fn sorted(points: &Candidates, tiles: [usize; 2], side: usize) -> Self {
        let count = tiles.map(|tiles| tiles.div_ceil(side));
        let bucket = |x: f32, y: f32| {
            let [column, row] = [(x, count[0]), (y, count[1])]
                .map(|(at, count)| (convert::truncate_to_index(at) / (side * SIDE)).min(count - 1));
            row * count[0] + column
        };
        let places: Vec<_> = points.x.iter().zip(&points.y).map(|(x, y)| bucket(*x, *y)).collect();
        let mut starts = vec![0; count[0] * count[1] + 1];
        for place in &places {
            starts[place + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut order = vec![0; places.len()];
        for (i, place) in places.iter().enumerate() {
            order[next[*place]] = i;
            next[*place] += 1;
        }
        let points = Candidates {
            numbers: order.iter().map(|i| points.numbers[*i]).collect(),
            x: order.iter().map(|i| points.x[*i]).collect(),
            y: order.iter().map(|i| points.y[*i]).collect(),
        };
        Self { points, starts, count, side }
    }

    /// Writes the points of the bucket at tile (`x`, `y`) and of `rings` rings of buckets around
    /// it. Returns how far in one direction all other points are from it at least.
    pub(super) fn around(
        &self,
        [x, y]: [usize; 2],
        rings: usize,
        torus: Torus,
        near: &mut Candidates,
    ) -> f32 {
        near.clear();
        let [columns, rows] = [(x, self.count[0]), (y, self.count[1])].map(|(first, count)| {
            let wanted = 2 * rings + 1;
            let first = first / self.side + rings.div_ceil(count) * count - rings;
            if wanted < count { (first % count, wanted) } else { (0, count) }
        });
        let (right, wrapped) = (self.count[0].min(columns.0 + columns.1), columns.0 + columns.1);
        for row in (rows.0..rows.0 + rows.1).map(|row| row % self.count[1]) {
            let row = row * self.count[0];
            let ends = |from: usize, to: usize| self.starts[row + from]..self.starts[row + to];
            near.append(&self.points, ends(columns.0, right));
            near.append(&self.points, ends(0, wrapped - right));
        }
        if columns.1 == self.count[0] && rows.1 == self.count[1] {
            return f32::INFINITY;
        }
        // The last bucket of a row or column may be narrower than the others.
        let side = convert::position(self.side * SIDE);
        let missing = [0, 1].map(|i| convert::position(self.count[i]) * side - torus.size[i]);
        convert::position(rings) * side - greater(missing[0], missing[1])
    }
}
