//! Points on a torus, and the ones that are nearest to a pixel.
//!
//! The image is cut into tiles. A tile knows the points that are nearest or second nearest to one
//! of its pixels, so that a pixel looks at a handful of points, however many there are.
//! [`cutting`] finds out which these are.

mod buckets;
mod cutting;
pub(super) mod placement;
pub(super) mod shown;

use std::ops::Range;

use self::{
    buckets::Buckets,
    cutting::{Candidates, Part, Square, Torus},
};
use crate::block::prelude::*;

/// Width and height of the smallest tile in pixels: one 256-bit register.
const SIDE: usize = 8;

/// A point in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    x: f32,
    y: f32,
    /// The shade of its cell.
    shade: f32,
}

impl Point {
    pub(super) fn new((x, y): (i64, i64), shade: f32) -> Self {
        Self { x: convert::distance(x), y: convert::distance(y), shade }
    }
}

/// A way to measure distances. Points are compared by a number that grows with the distance.
pub(super) trait Measure {
    /// A number that grows with the distance, for distances across and down.
    fn compare(across: f32, down: f32) -> f32;
    /// The distance, from what [`compare`](Self::compare) gave.
    fn distance(compared: f32) -> f32;

    /// The least and the greatest distance along one direction that [`compare`](Self::compare) gets
    /// to see between a point and pixels, of which the middle one is at `distance` and no other is
    /// more than `half` from that. It is negative where a point lies more than a turn away.
    #[inline(always)]
    fn range(distance: f32, half: f32) -> [f32; 2] {
        [distance - half, distance + half]
    }
}

/// In a straight line.
pub(super) struct Euclidean;

impl Measure for Euclidean {
    #[inline(always)]
    fn compare(across: f32, down: f32) -> f32 {
        across * across + down * down
    }

    #[inline(always)]
    fn distance(compared: f32) -> f32 {
        compared.sqrt()
    }

    #[inline(always)]
    fn range(distance: f32, half: f32) -> [f32; 2] {
        // Squares do not tell what was negative.
        let distance = distance.abs();
        [greater(distance - half, 0.0), distance + half]
    }
}

/// Along rows and columns.
pub(super) struct Taxicab;

impl Measure for Taxicab {
    #[inline(always)]
    fn compare(across: f32, down: f32) -> f32 {
        across + down
    }

    #[inline(always)]
    fn distance(compared: f32) -> f32 {
        compared
    }
}

/// The greater of both directions.
pub(super) struct Chebyshev;

impl Measure for Chebyshev {
    #[inline(always)]
    fn compare(across: f32, down: f32) -> f32 {
        greater(across, down)
    }

    #[inline(always)]
    fn distance(compared: f32) -> f32 {
        compared
    }
}

/// Points, and for each tile of the image those that matter there.
#[derive(Debug)]
pub(super) struct Cells {
    points: Vec<Point>,
    width: f32,
    height: f32,
    /// Tiles across the image.
    across: usize,
    /// For each tile, its list.
    tiles: Vec<u32>,
    /// For each list, where it starts in `members`; then the end of the last one.
    starts: Vec<u32>,
    /// Numbers of points. Where only the nearest is needed they rise in each list, so that the
    /// first of several equally near points is found first.
    members: Vec<u32>,
}

impl Cells {
    /// The most members of all lists together. Only strange placements come near it, such as a
    /// circle around the tile: then tiles share the list of the tile that they came from.
    fn most_members(points: u64, tiles: u64) -> u64 {
        (32 * tiles + 4 * points).min(u64::from(u32::MAX / 2))
    }

    fn tiles_of(width: u32, height: u32) -> u64 {
        u64::from(width).div_ceil(SIDE as u64) * u64::from(height).div_ceil(SIDE as u64)
    }

    /// The most memory of the cells of `points` points, in bytes.
    pub(super) fn bytes_of(points: u64, width: u32, height: u32) -> u64 {
        let tiles = Self::tiles_of(width, height);
        // While they are built, the lists of parts exist besides the finished ones, and on each
        // thread those of one square of each size.
        let members = 2 * Self::most_members(points, tiles) + cutting::PARTS * 8 * points;
        points * size_of::<Point>() as u64 + (members + 8 * tiles) * size_of::<u32>() as u64
    }

    /// The cells of at least one point, prepared to find the `needed` (1 or 2) nearest ones.
    pub(super) fn new<M: Measure>(
        points: Vec<Point>,
        needed: usize,
        cx: &Context<'_>,
    ) -> Result<Self, Error> {
        let across = (cx.width as usize).div_ceil(SIDE);
        let down = (cx.height as usize).div_ceil(SIDE);
        let distinct = distinct(&points, needed);
        let candidates = Candidates::of(&points, &distinct);
        let most = Self::most_members(points.len() as u64, (across * down) as u64);
        let torus = Torus { size: [convert::pixels(cx.width), convert::pixels(cx.height)], needed };
        let buckets = Buckets::new(&candidates, [across, down], torus);
        let mut parts = Part::all(across, down, convert::index(most.cast_signed()));
        cx.parallel_pieces(&mut parts, 1, |_, part| {
            part.iter_mut().try_for_each(|part| part.cut::<M>(torus, &buckets, cx))
        })?;
        let mut cells = Self {
            points,
            width: convert::pixels(cx.width),
            height: convert::pixels(cx.height),
            across,
            tiles: vec![0; across * down],
            starts: vec![0],
            members: Vec::with_capacity(parts.iter().map(|part| part.members.len()).sum()),
        };
        for part in parts {
            let mut start = 0;
            for (square, end) in part.lists {
                cells.keep(square, &part.members[start..end]);
                start = end;
            }
        }
        Ok(cells)
    }

    /// Makes `members` the list of the tiles of `square`.
    fn keep(&mut self, square: Square, members: &[u32]) {
        self.members.extend_from_slice(members);
        let list = u32::try_from(self.starts.len() - 1).unwrap_or(u32::MAX);
        self.starts.push(u32::try_from(self.members.len()).unwrap_or(u32::MAX));
        let right = (square.x + square.side).min(self.across);
        for row in self.tiles.chunks_exact_mut(self.across).skip(square.y).take(square.side) {
            row[square.x..right].fill(list);
        }
    }

    /// Writes `shown` of the comparison number and the shade of each pixel's nearest point.
    #[inline(always)]
    pub(super) fn nearest<M: Measure>(
        &self,
        cx: &RowContext<'_>,
        out: &mut [f32],
        shown: impl Fn(f32, f32) -> f32,
    ) {
        let y = convert::pixels(cx.y);
        for tile in self.tiles(cx, out.len()) {
            let (mut nearest, mut shade) = ([f32::INFINITY; SIDE], [0_u32; SIDE]);
            for i in tile.members {
                let point = &self.points[*i as usize];
                let down = around((y - point.y).abs(), self.height);
                let mut compared = [0.0; SIDE];
                for lane in 0..SIDE {
                    let across = around((tile.column + LANES[lane] - point.x).abs(), self.width);
                    compared[lane] = M::compare(across, down);
                }
                for lane in 0..SIDE {
                    // By bits: a choice between numbers would become a branch for each.
                    let is_nearer = 0_u32.wrapping_sub(u32::from(compared[lane] < nearest[lane]));
                    shade[lane] = shade[lane] & !is_nearer | point.shade.to_bits() & is_nearer;
                }
                for lane in 0..SIDE {
                    nearest[lane] = lesser(compared[lane], nearest[lane]);
                }
            }
            let mut values = [0.0; SIDE];
            for lane in 0..SIDE {
                values[lane] = shown(nearest[lane], f32::from_bits(shade[lane]));
            }
            out[tile.pixels].copy_from_slice(&values[tile.wanted]);
        }
    }

    /// Writes `shown` of the comparison numbers of each pixel's two nearest points; the second is
    /// infinite if there is but one.
    #[inline(always)]
    pub(super) fn nearest_two<M: Measure>(
        &self,
        cx: &RowContext<'_>,
        out: &mut [f32],
        shown: impl Fn(f32, f32) -> f32,
    ) {
        let y = convert::pixels(cx.y);
        for tile in self.tiles(cx, out.len()) {
            let (mut nearest, mut second) = ([f32::INFINITY; SIDE], [f32::INFINITY; SIDE]);
            for i in tile.members {
                let point = &self.points[*i as usize];
                let down = around((y - point.y).abs(), self.height);
                for lane in 0..SIDE {
                    let across = around((tile.column + LANES[lane] - point.x).abs(), self.width);
                    let compared = M::compare(across, down);
                    second[lane] = lesser(second[lane], greater(nearest[lane], compared));
                    nearest[lane] = lesser(nearest[lane], compared);
                }
            }
            let mut values = [0.0; SIDE];
            for lane in 0..SIDE {
                values[lane] = shown(nearest[lane], second[lane]);
            }
            out[tile.pixels].copy_from_slice(&values[tile.wanted]);
        }
    }

    /// The tiles that `len` pixels of a row lie in, from left to right.
    #[inline(always)]
    fn tiles(&self, cx: &RowContext<'_>, len: usize) -> impl Iterator<Item = Tile<'_>> {
        let (left, right) = (cx.x as usize, cx.x as usize + len);
        let row = &self.tiles[cx.y as usize / SIDE * self.across..][..self.across];
        (left / SIDE..right.div_ceil(SIDE)).map(move |number| {
            let list = row[number] as usize;
            let members = self.starts[list] as usize..self.starts[list + 1] as usize;
            let start = number * SIDE;
            let (from, to) = (start.max(left), (start + SIDE).min(right));
            Tile {
                members: &self.members[members],
                column: convert::position(start),
                wanted: from - start..to - start,
                pixels: from - left..to - left,
            }
        })
    }
}

/// The part of a tile that lies in a row.
struct Tile<'a> {
    /// The numbers of the points that matter there.
    members: &'a [u32],
    /// Its first column.
    column: f32,
    /// The columns of the tile that are asked for.
    wanted: Range<usize>,
    /// Their places in what is asked for.
    pixels: Range<usize>,
}

const LANES: [f32; SIDE] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// The numbers of points, without those that lie where `needed` earlier ones do: they change
/// nothing, and no cutting would ever separate them.
fn distinct(points: &[Point], needed: usize) -> Vec<u32> {
    let place = |point: &Point| u64::from(point.y.to_bits()) << 32 | u64::from(point.x.to_bits());
    // Mostly all places differ. That is told without their numbers, in a third of the time.
    let mut places: Vec<_> = points.iter().map(place).collect();
    places.sort_unstable();
    if places.windows(2).all(|pair| pair[0] != pair[1]) {
        return (0..).take(points.len()).collect();
    }
    let mut order: Vec<_> = points.iter().map(place).zip(0_u32..).collect();
    order.sort_unstable();
    let mut kept: Vec<u32> = order
        .chunk_by(|a, b| a.0 == b.0)
        .flat_map(|same| same.iter().map(|(_, i)| *i).take(needed))
        .collect();
    kept.sort_unstable();
    kept
}

/// The shorter way around a torus of that size.
#[inline(always)]
fn around(distance: f32, size: f32) -> f32 {
    lesser(distance, size - distance)
}

// One instruction each, which `f32::min` and `f32::max` are not: they look for NaN.

#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
