//! Points by the square of tiles that they lie in: where the search of [`cutting`](super::cutting)
//! starts.

use std::ops::Range;

use super::{
    SIDE,
    candidates::Candidates,
    cutting::{Square, Torus},
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
const POINTS_PER_BUCKET: usize = 1;

impl Buckets {
    /// The points of an image of that many tiles.
    pub(super) fn new(points: &Candidates, tiles: [usize; 2], torus: Torus) -> Self {
        let whole = tiles[0].max(tiles[1]).next_power_of_two();
        let [width, height] = torus.size;
        let is_inside = |[x, y]: &[f32; 2]| (0.0..width).contains(x) && (0.0..height).contains(y);
        let mut side = whole;
        if points.places[..points.count].iter().all(is_inside) {
            let count = points.count;
            while side > 1 && count * side * side > POINTS_PER_BUCKET * tiles[0] * tiles[1] {
                side /= 2;
            }
        }
        let buckets = Self::sorted(points, tiles, side);
        // Squares in the void look far around. Where points crowd in few buckets, one is better.
        let used = buckets.starts.windows(2).filter(|ends| ends[0] < ends[1]).count();
        let most = points.count.min(buckets.starts.len() - 1);
        if used * 2 > most { buckets } else { Self::sorted(points, tiles, whole) }
    }

    fn sorted(points: &Candidates, tiles: [usize; 2], side: usize) -> Self {
        let count = tiles.map(|tiles| tiles.div_ceil(side));
        let bucket = |x: f32, y: f32| {
            let [column, row] = [(x, count[0]), (y, count[1])]
                .map(|(at, count)| (convert::truncate_to_index(at) / (side * SIDE)).min(count - 1));
            row * count[0] + column
        };
        let all = points.places.iter().take(points.count);
        let places: Vec<_> = all.map(|[x, y]| bucket(*x, *y)).collect();
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
        let points = points.ordered(&order);
        Self { points, starts, count, side }
    }

    /// Writes the points of the buckets in a square and of `rings` rings of buckets around it.
    /// Returns how far in one direction all other points are from it at least.
    pub(super) fn around(
        &self,
        square: Square,
        rings: usize,
        torus: Torus,
        near: &mut Candidates,
    ) -> f32 {
        let side = convert::position(self.side * SIDE);
        near.count = 0;
        let own = square.side / self.side;
        // No pixel of the square has more than half a turn to any of the points.
        near.is_straight =
            torus.size.iter().all(|size| convert::position(2 * (rings + own)) * side <= *size);
        let [columns, rows] = [(0, square.x), (1, square.y)].map(|(axis, tile)| {
            let first = tile >> self.side.trailing_zeros();
            let turn = if near.is_straight { torus.size[axis] } else { 0.0 };
            pieces(first..first + own, rings, self.count[axis], turn)
        });
        for (rows, down) in &rows {
            for row in rows.clone() {
                let starts = &self.starts[row * self.count[0]..][..=self.count[0]];
                for (columns, right) in columns.iter().filter(|(columns, _)| !columns.is_empty()) {
                    let places = starts[columns.start]..starts[columns.end];
                    near.append(&self.points, places, [*right, *down]);
                }
            }
        }
        if self.count.iter().all(|count| 2 * rings + own >= *count) {
            return f32::INFINITY;
        }
        // The last bucket of a row or column may be narrower than the others.
        let missing = [0, 1].map(|i| convert::position(self.count[i]) * side - torus.size[i]);
        convert::position(rings) * side - greater(missing[0], missing[1])
    }
}

/// Of `count` buckets in a circle, some and `rings` on each side of them: in two pieces, since there
/// may be an edge between them. How far to move the points of each piece to have them where they
/// are without the edge, for a circle of length `turn`.
fn pieces(own: Range<usize>, rings: usize, count: usize, turn: f32) -> [(Range<usize>, f32); 2] {
    let end = own.end + rings;
    if 2 * rings + own.len() >= count {
        [(0..count, 0.0), (0..0, 0.0)]
    } else if own.start < rings {
        [(own.start + count - rings..count, -turn), (0..end, 0.0)]
    } else {
        [(own.start - rings..end.min(count), 0.0), (0..end.saturating_sub(count), turn)]
    }
}
