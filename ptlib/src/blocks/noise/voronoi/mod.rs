//! Points on a torus, and the ones that are nearest to a pixel.
//!
//! The image is cut into tiles. A tile knows the points that are nearest or second nearest to one
//! of its pixels, so that a pixel looks at a handful of points, however many there are.
//! [`cutting`] finds out which these are.

mod buckets;
mod candidates;
mod cutting;
mod lists;
pub(super) mod placement;
pub(super) mod shown;

use std::{mem, slice};

use self::{
    buckets::Buckets,
    candidates::Candidates,
    cutting::Torus,
    lists::{GROUP, Group, List, Part, Span},
};
use crate::block::prelude::*;

/// Width and height of the smallest tile in pixels: one 256-bit register.
const SIDE: usize = 8;

/// As many threads make parts at once as memory is counted for. There may be more, but points
/// seldom crowd so that it matters.
const THREADS: u64 = 8;

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

    /// The least distance along one direction that [`compare`](Self::compare) gets to see between a
    /// point and pixels, of which the middle one is at `distance` and no other is more than `half`
    /// from that. It is negative where a point lies more than a turn away.
    #[inline(always)]
    fn least(distance: f32, half: f32) -> f32 {
        distance - half
    }

    /// The greatest one.
    #[inline(always)]
    fn most(distance: f32, half: f32) -> f32 {
        distance + half
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
    fn least(distance: f32, half: f32) -> f32 {
        // Squares do not tell what was negative.
        greater(distance.abs() - half, 0.0)
    }

    #[inline(always)]
    fn most(distance: f32, half: f32) -> f32 {
        distance.abs() + half
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

/// What cells are for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    /// How many nearest points of a pixel are asked for, 1 or 2.
    pub(super) nearest: usize,
    /// Whether no two points are known to lie in one place.
    pub(super) all_differ: bool,
}

/// For each tile of the image, the points that matter there.
#[derive(Debug)]
pub(super) struct Cells {
    /// Row by row.
    parts: Vec<Part>,
    /// Parts across the image.
    across: usize,
    /// Tiles along the side of a part.
    side: usize,
    /// Size of the image.
    size: [f32; 2],
}

impl Cells {
    /// The most groups of all lists together. Only strange placements come near it, such as a
    /// circle around the tile: then tiles share the list of the tile that they came from.
    fn most_groups(points: u64, tiles: u64) -> u64 {
        let members = 32 * tiles + 4 * points;
        (members / GROUP as u64).min(u64::from(u32::MAX / 2))
    }

    /// The most memory of the cells of `points` points, in bytes.
    pub(super) fn bytes_of(points: u64, width: u32, height: u32) -> u64 {
        let tiles = [width, height].map(|size| u64::from(size).div_ceil(SIDE as u64));
        let tiles = tiles[0] * tiles[1];
        // While they are made, each thread has the points near a square, and those of its quarters:
        // all of them five times, if they crowd.
        let lists = Self::most_groups(points, tiles)
            * (size_of::<Group>() + 2 * size_of::<[f32; GROUP]>()) as u64;
        let building = THREADS * 5 * points * size_of::<(u32, [f32; 2])>() as u64;
        points * size_of::<Point>() as u64 + lists + building + 12 * tiles
    }

    /// The cells of at least one point.
    pub(super) fn new<M: Measure>(
        points: &[Point],
        wanted: Wanted,
        cx: &Context<'_>,
    ) -> Result<Self, Error> {
        let needed = wanted.nearest;
        let tiles = [cx.width, cx.height].map(|size| (size as usize).div_ceil(SIDE));
        let distinct = match wanted.all_differ {
            true => (0..).take(points.len()).collect(),
            false => distinct(points, needed),
        };
        let candidates = Candidates::of(points, &distinct, needed == 1);
        let torus = Torus { size: [convert::pixels(cx.width), convert::pixels(cx.height)], needed };
        let buckets = Buckets::new(&candidates, tiles, torus);
        let most = Self::most_groups(points.len() as u64, (tiles[0] * tiles[1]) as u64);
        let mut parts = Part::all(tiles, most);
        cx.parallel_pieces(&mut parts, 1, |_, part| {
            part.iter_mut()
                .try_for_each(|part| cutting::cut::<M>(part, torus, points, &buckets, cx))
        })?;
        let side = Part::side(tiles);
        Ok(Self { parts, across: tiles[0].div_ceil(side), side, size: torus.size })
    }

    /// Writes `shown` of the comparison numbers and the shades of the nearest points of some pixels.
    #[inline(always)]
    pub(super) fn nearest<M: Measure>(
        &self,
        cx: &RowContext<'_>,
        out: &mut [f32],
        shown: impl Fn([f32; SIDE], [f32; SIDE]) -> [f32; SIDE],
    ) {
        for tile in self.tiles(cx, out) {
            let nearest = tile.list.nearest::<M>(tile.at, self.size);
            tile.write(&shown(nearest.compared, nearest.shades()));
        }
    }

    /// Writes `shown` of the comparison numbers of the two nearest points of some pixels; the second
    /// is infinite if there is but one.
    #[inline(always)]
    pub(super) fn nearest_two<M: Measure>(
        &self,
        cx: &RowContext<'_>,
        out: &mut [f32],
        shown: impl Fn([f32; SIDE], [f32; SIDE]) -> [f32; SIDE],
    ) {
        for tile in self.tiles(cx, out) {
            let (first, second) = tile.list.nearest_two::<M>(tile.at, self.size);
            tile.write(&shown(first, second));
        }
    }

    /// The tiles that `out` lies in, from left to right.
    #[inline(always)]
    fn tiles<'a>(&'a self, cx: &RowContext<'_>, out: &'a mut [f32]) -> Tiles<'a> {
        let (x, y) = (cx.x as usize, cx.y as usize / SIDE);
        let parts = &self.parts[y / self.side * self.across..][..self.across];
        let (part, later) = parts[x / SIDE / self.side..].split_first().unwrap_or((&parts[0], &[]));
        let spans = part.row(y)[x / SIDE % self.side..].iter();
        Tiles { part, spans, later: later.iter(), x, y: cx.y, out }
    }
}

/// Gives the tiles that a part of a row lies in.
struct Tiles<'a> {
    part: &'a Part,
    /// The tiles of `part` that come next.
    spans: slice::Iter<'a, Span>,
    /// The parts that follow.
    later: slice::Iter<'a, Part>,
    x: usize,
    y: u32,
    out: &'a mut [f32],
}

impl<'a> Iterator for Tiles<'a> {
    type Item = Tile<'a>;

    #[inline(always)]
    fn next(&mut self) -> Option<Tile<'a>> {
        if self.out.is_empty() {
            return None;
        }
        let span = match self.spans.next() {
            Some(span) => span,
            None => {
                self.part = self.later.next()?;
                self.spans = self.part.row(self.y as usize / SIDE).iter();
                self.spans.next()?
            }
        };
        let skipped = self.x % SIDE;
        let start = self.x - skipped;
        let out = mem::take(&mut self.out);
        let (out, after) = out.split_at_mut((SIDE - skipped).min(out.len()));
        (self.x, self.out) = (start + SIDE, after);
        let at = [convert::position(start), convert::pixels(self.y)];
        Some(Tile { list: self.part.list(*span), at, skipped, out })
    }
}

/// The part of a tile that lies in a row.
struct Tile<'a> {
    /// The points that matter there.
    list: List<'a>,
    /// Where the row of the tile starts.
    at: [f32; 2],
    /// So many of its pixels are not asked for.
    skipped: usize,
    /// Those that are.
    out: &'a mut [f32],
}

impl Tile<'_> {
    /// Writes what is asked for of the values of a row of the tile.
    #[inline(always)]
    fn write(self, values: &[f32; SIDE]) {
        // All but the first and the last tile are whole.
        match <&mut [f32; SIDE]>::try_from(&mut *self.out) {
            Ok(out) => *out = *values,
            Err(_) => {
                let values = values.iter().skip(self.skipped);
                self.out.iter_mut().zip(values).for_each(|(out, value)| *out = *value);
            }
        }
    }
}

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
