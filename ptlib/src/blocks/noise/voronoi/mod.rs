//! Points on a torus, and the ones that are nearest to a pixel.
//!
//! The image is cut into tiles. A tile knows the points that are nearest or second nearest to one
//! of its pixels, so that a pixel looks at a handful of points, however many there are. Which
//! these are follows from the triangle inequality: if the second nearest point of a tile's middle
//! is at distance d, and no pixel of the tile is farther than h from the middle, then the two
//! nearest points of every pixel are within d + 2h of the middle. Tiles are halved in both
//! directions from the whole image down, and each looks only at the points of the one it came from.

pub(super) mod placement;

use std::{marker::PhantomData, ops::Range};

use crate::block::prelude::*;

/// Width and height of the smallest tile in pixels: one 256-bit register.
const SIDE: usize = 8;

/// A tile with at most this many points is not cut further.
const FEW: usize = 3;

/// A point in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    x: f32,
    y: f32,
    /// The shade of its cell.
    shade: f32,
}

impl Point {
    pub(super) fn new(x: u32, y: u32, shade: f32) -> Self {
        Self { x: convert::pixels(x), y: convert::pixels(y), shade }
    }
}

/// A way to measure distances. Points are compared by a number that grows with the distance.
pub(super) trait Measure {
    /// A number that grows with the distance, for distances across and down.
    fn compare(across: f32, down: f32) -> f32;
    /// The distance, from what [`compare`](Self::compare) gave.
    fn distance(compared: f32) -> f32;
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
    /// Numbers of points, in rising order in each list, so that the first of several equally near
    /// points is found first.
    members: Vec<u32>,
}

/// A square of tiles that is being cut.
#[derive(Debug, Clone, Copy)]
struct Square {
    /// The first tile.
    x: usize,
    y: usize,
    /// Tiles along its side, a power of 2.
    side: usize,
}

/// Points that may be among the nearest ones of the pixels of squares that are being cut, each
/// square's behind those of the square that it came from.
#[derive(Debug, Default)]
struct Candidates {
    numbers: Vec<u32>,
    x: Vec<f32>,
    y: Vec<f32>,
    /// Memory for comparison numbers.
    compared: Vec<f32>,
}

impl Candidates {
    fn of(points: &[Point], numbers: Vec<u32>) -> Self {
        let chosen = numbers.iter().map(|i| &points[*i as usize]);
        let (x, y) = chosen.map(|point| (point.x, point.y)).unzip();
        Self { compared: vec![0.0; numbers.len()], numbers, x, y }
    }

    fn resize(&mut self, len: usize) {
        self.numbers.resize(len, 0);
        self.x.resize(len, 0.0);
        self.y.resize(len, 0.0);
    }
}

/// Copies the candidates that are among the `needed` nearest points of a pixel of a square behind
/// all others.
struct Nearby<'a, M> {
    candidates: &'a mut Candidates,
    /// Those to pick from.
    from: Range<usize>,
    /// The square's middle.
    middle: (f32, f32),
    /// The image's size.
    size: (f32, f32),
    /// The greatest distance of a pixel of the square from its middle.
    extent: f32,
    needed: usize,
    measure: PhantomData<M>,
}

impl<'a, M: Measure> Nearby<'a, M> {
    fn new(
        cells: &Cells,
        square: Square,
        candidates: &'a mut Candidates,
        from: Range<usize>,
        needed: usize,
    ) -> Self {
        // The square's middle and half its extent, without what lies beyond the image.
        let span = |first: usize, size: f32| {
            let first = convert::position(first * SIDE);
            let last = lesser(first + convert::position(square.side * SIDE), size) - 1.0;
            ((first + last) * 0.5, (last - first) * 0.5)
        };
        let (x, half_width) = span(square.x, cells.width);
        let (y, half_height) = span(square.y, cells.height);
        Self {
            candidates,
            from,
            middle: (x, y),
            size: (cells.width, cells.height),
            extent: M::distance(M::compare(half_width, half_height)),
            needed,
            measure: PhantomData,
        }
    }
}

impl<M: Measure> Kernel for Nearby<'_, M> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let all = self.candidates;
        let compared = &mut all.compared[..self.from.len()];
        let places = all.x[self.from.clone()].iter().zip(&all.y[self.from.clone()]);
        for (compared, (x, y)) in compared.iter_mut().zip(places) {
            let across = around((self.middle.0 - x).abs(), self.size.0);
            *compared = M::compare(across, around((self.middle.1 - y).abs(), self.size.1));
        }
        let [nearest, second] = least_two(compared);
        let needed = M::distance(if self.needed == 1 { nearest } else { second });
        // A little farther, because distances are rounded to 24 bits.
        let reach = (needed + 2.0 * self.extent) * (1.0 + 1e-5) + 1e-3;
        let reach = M::compare(reach, 0.0);
        let start = all.numbers.len();
        all.resize(start + self.from.len());
        let (numbers, near_numbers) = all.numbers.split_at_mut(start);
        let (x, near_x) = all.x.split_at_mut(start);
        let (y, near_y) = all.y.split_at_mut(start);
        let mut count = 0;
        for (from, compared) in self.from.zip(&all.compared) {
            // Copied in any case, which is faster than to guess which ones are near.
            near_numbers[count] = numbers[from];
            near_x[count] = x[from];
            near_y[count] = y[from];
            count += usize::from(*compared <= reach);
        }
        all.resize(start + count);
    }
}

/// The least two of some numbers; infinity where there are fewer.
#[inline(always)]
fn least_two(numbers: &[f32]) -> [f32; 2] {
    let (chunks, rest) = numbers.as_chunks::<SIDE>();
    let (mut least, mut second) = ([f32::INFINITY; SIDE], [f32::INFINITY; SIDE]);
    for chunk in chunks {
        for lane in 0..SIDE {
            second[lane] = lesser(second[lane], greater(least[lane], chunk[lane]));
            least[lane] = lesser(least[lane], chunk[lane]);
        }
    }
    let mut both = [f32::INFINITY; 2];
    for number in least.iter().chain(&second).chain(rest) {
        both[1] = lesser(both[1], greater(both[0], *number));
        both[0] = lesser(both[0], *number);
    }
    both
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
        // While they are built, lists of one tile of each size exist besides the finished ones.
        let members = Self::most_members(points, tiles) + 32 * points;
        points * size_of::<Point>() as u64 + (members + 2 * tiles) * size_of::<u32>() as u64
    }

    /// The cells of at least one point, prepared to find the `needed` (1 or 2) nearest ones.
    pub(super) fn new<M: Measure>(
        points: Vec<Point>,
        needed: usize,
        cx: &Context<'_>,
    ) -> Result<Self, Error> {
        let across = (cx.width as usize).div_ceil(SIDE);
        let down = (cx.height as usize).div_ceil(SIDE);
        let mut all = Candidates::of(&points, distinct(&points, needed));
        let mut cells = Self {
            points,
            width: convert::pixels(cx.width),
            height: convert::pixels(cx.height),
            across,
            tiles: vec![0; across * down],
            starts: vec![0],
            members: Vec::new(),
        };
        let whole = Square { x: 0, y: 0, side: across.max(down).next_power_of_two() };
        cells.cut::<M>(whole, &mut all, 0, needed, cx)?;
        Ok(cells)
    }

    /// Cuts a square, whose pixels have their nearest points among the candidates from `first` on.
    fn cut<M: Measure>(
        &mut self,
        square: Square,
        candidates: &mut Candidates,
        first: usize,
        needed: usize,
        cx: &Context<'_>,
    ) -> Result<(), Error> {
        let down = self.tiles.len() / self.across;
        if square.x >= self.across || square.y >= down {
            return Ok(());
        }
        let end = candidates.numbers.len();
        let count = end - first;
        let tiles = self.tiles.len() as u64;
        let room = Self::most_members(self.points.len() as u64, tiles) - self.members.len() as u64;
        // What is left must do for the lists of squares that are not cut yet, too.
        let is_tight = count as u64 * 8 > room;
        if square.side == 1 || count <= FEW || is_tight {
            self.keep(square, &candidates.numbers[first..]);
            return Ok(());
        }
        cx.check()?;
        let side = square.side / 2;
        for (x, y) in [(0, 0), (side, 0), (0, side), (side, side)] {
            let quarter = Square { x: square.x + x, y: square.y + y, side };
            let from = Nearby::<M>::new(self, quarter, candidates, first..end, needed);
            cx.simd.run(from);
            self.cut::<M>(quarter, candidates, end, needed, cx)?;
            candidates.resize(end);
        }
        Ok(())
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
    let mut order: Vec<u32> = (0..).take(points.len()).collect();
    let place = |i: u32| {
        let point = &points[i as usize];
        (point.y.to_bits(), point.x.to_bits())
    };
    order.sort_by_key(|i| (place(*i), *i));
    let mut kept: Vec<u32> = order
        .chunk_by(|a, b| place(*a) == place(*b))
        .flat_map(|same| same.iter().copied().take(needed))
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
