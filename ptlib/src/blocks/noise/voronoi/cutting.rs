//! Which points matter for which pixels: cutting the image into tiles.
//!
//! A square has a distance that each point keeps for certain to all of its pixels, and one that it
//! stays within for certain. The two nearest points of every pixel then are among those that may
//! come as near as the second least of the latter. The image is cut into parts, which are made on
//! all threads; in a part, squares are halved in both directions down to a single tile, and each
//! looks only at the points of the one it came from. Where points are spread out, the largest
//! squares are small already, and get their points from the [`Buckets`] around them.

use std::{marker::PhantomData, ops::Range};

use super::{Measure, Point, SIDE, around, buckets::Buckets, greater, lesser};
use crate::block::prelude::*;

/// A square with at most this many points is not cut further.
const FEW: usize = 3;

/// The image is cut into this many parts in each direction, and up to the square of it in all.
const PARTS_ACROSS: usize = 4;

/// The most parts.
pub(super) const PARTS: u64 = (PARTS_ACROSS * PARTS_ACROSS) as u64;

/// What all squares have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Torus {
    /// Width and height of the image.
    pub(super) size: [f32; 2],
    /// How many nearest points are needed, 1 or 2.
    pub(super) needed: usize,
}

/// A square of tiles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Square {
    /// The first tile.
    pub(super) x: usize,
    /// The first tile.
    pub(super) y: usize,
    /// Tiles along its side, a power of 2.
    pub(super) side: usize,
}

impl Square {
    fn quarters(self) -> [Self; 4] {
        let side = self.side / 2;
        [(0, 0), (side, 0), (0, side), (side, side)].map(|(x, y)| Self {
            x: self.x + x,
            y: self.y + y,
            side,
        })
    }

    /// Its pixels in an image of that size.
    fn area(self, size: [f32; 2]) -> Area {
        let sides = [(self.x, size[0]), (self.y, size[1])].map(|(first, size)| {
            let first = convert::position(first * SIDE);
            let last = lesser(first + convert::position(self.side * SIDE), size) - 1.0;
            ((first + last) * 0.5, (last - first) * 0.5)
        });
        Area { middle: sides.map(|side| side.0), half: sides.map(|side| side.1), size }
    }
}

/// The pixels of a square.
#[derive(Debug, Clone, Copy)]
struct Area {
    middle: [f32; 2],
    /// Half the extent.
    half: [f32; 2],
    /// Size of the image.
    size: [f32; 2],
}

/// Points that may be among the nearest ones of the pixels of a square.
#[derive(Debug, Default)]
pub(super) struct Candidates {
    pub(super) numbers: Vec<u32>,
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
}

impl Candidates {
    /// Those of these numbers.
    pub(super) fn of(points: &[Point], numbers: &[u32]) -> Self {
        let chosen = numbers.iter().map(|i| &points[*i as usize]);
        let (x, y) = chosen.map(|point| (point.x, point.y)).unzip();
        Self { numbers: numbers.to_vec(), x, y }
    }

    pub(super) fn append(&mut self, other: &Self, range: Range<usize>) {
        self.numbers.extend_from_slice(&other.numbers[range.clone()]);
        self.x.extend_from_slice(&other.x[range.clone()]);
        self.y.extend_from_slice(&other.y[range]);
    }

    pub(super) fn clear(&mut self) {
        self.numbers.clear();
        self.x.clear();
        self.y.clear();
    }
}

/// A part of the image: its squares that are not cut further, and the points that matter there.
#[derive(Debug)]
pub(super) struct Part {
    square: Square,
    /// Tiles of the image across and down.
    tiles: [usize; 2],
    /// How many members its lists may have together.
    room: usize,
    /// Squares, and where their lists in `members` end; each starts where the one before ends.
    pub(super) lists: Vec<(Square, usize)>,
    /// Numbers of points; where only the nearest one is needed, in rising order in each list.
    pub(super) members: Vec<u32>,
}

impl Part {
    /// All parts of an image of that many tiles, with room for `most` members in all.
    pub(super) fn all(across: usize, down: usize, most: usize) -> Vec<Self> {
        let whole = across.max(down).next_power_of_two();
        let side = (whole / PARTS_ACROSS).max(1);
        let first = |count: usize| (0..count).step_by(side);
        let places = first(down).flat_map(|y| first(across).map(move |x| (x, y)));
        let squares: Vec<_> = places.map(|(x, y)| Square { x, y, side }).collect();
        let room = most / squares.len().max(1);
        let part = |square| Self {
            square,
            tiles: [across, down],
            room,
            lists: Vec::new(),
            members: Vec::new(),
        };
        squares.into_iter().map(part).collect()
    }

    /// Makes the lists.
    pub(super) fn cut<M: Measure>(
        &mut self,
        torus: Torus,
        points: &Buckets,
        cx: &Context<'_>,
    ) -> Result<(), Error> {
        let mut sizes = Vec::new();
        sizes.resize_with(self.square.side.ilog2() as usize + 1, Candidates::default);
        let measure = PhantomData::<M>;
        let square = self.square;
        let mut cutting = Cutting { part: self, torus, cx, scratch: Scratch::default(), measure };
        let mut near = Candidates::default();
        let step = |first: usize| (first..first + square.side).step_by(points.side);
        for (x, y) in step(square.y).flat_map(|y| step(square.x).map(move |x| (x, y))) {
            let square = Square { x, y, side: points.side.min(square.side) };
            cutting.start(square, points, &mut near, &mut sizes)?;
        }
        Ok(())
    }
}

/// Memory of [`Nearby`].
#[derive(Debug, Default)]
struct Scratch {
    /// Comparison numbers of the least distances.
    least: Vec<f32>,
    /// All places of candidates.
    places: Vec<u32>,
    /// Places of candidates, or their numbers.
    picked: Vec<u32>,
}

/// A part that is being cut.
struct Cutting<'a, M> {
    part: &'a mut Part,
    torus: Torus,
    cx: &'a Context<'a>,
    scratch: Scratch,
    measure: PhantomData<M>,
}

impl<M: Measure> Cutting<'_, M> {
    /// Cuts a square in a bucket, with points from the buckets around. There is memory for its own
    /// candidates and those of each smaller size of squares.
    fn start(
        &mut self,
        square: Square,
        points: &Buckets,
        near: &mut Candidates,
        sizes: &mut [Candidates],
    ) -> Result<(), Error> {
        if self.is_outside(square) {
            return Ok(());
        }
        let mut rings = 1;
        loop {
            self.cx.check()?;
            let known = points.around([square.x, square.y], rings, self.torus, near);
            let reach = self.pick(square, near, sizes);
            if reach <= M::compare(known, 0.0) {
                return self.settle(square, sizes);
            }
            rings *= 2;
        }
    }

    /// Cuts a square, whose pixels have their nearest points among `candidates`.
    fn cut(
        &mut self,
        square: Square,
        candidates: &Candidates,
        sizes: &mut [Candidates],
    ) -> Result<(), Error> {
        if self.is_outside(square) {
            return Ok(());
        }
        self.pick(square, candidates, sizes);
        self.settle(square, sizes)
    }

    fn is_outside(&self, square: Square) -> bool {
        square.x >= self.part.tiles[0] || square.y >= self.part.tiles[1]
    }

    /// Picks the candidates of a square; returns how far they are at most.
    fn pick(&mut self, square: Square, from: &Candidates, sizes: &mut [Candidates]) -> f32 {
        self.cx.simd.run(Nearby {
            from,
            to: &mut sizes[0],
            scratch: &mut self.scratch,
            area: square.area(self.torus.size),
            needed: self.torus.needed,
            is_last: square.side == 1,
            measure: self.measure,
        })
    }

    /// Keeps a square as it is, or cuts it further.
    fn settle(&mut self, square: Square, sizes: &mut [Candidates]) -> Result<(), Error> {
        let part = &mut *self.part;
        let Some((own, smaller)) = sizes.split_first_mut() else { return Ok(()) };
        let count = own.numbers.len();
        // What is left must do for the lists of squares that are not cut yet, too.
        let is_tight = count * 8 > part.room.saturating_sub(part.members.len());
        if square.side == 1 || count <= FEW || is_tight {
            let start = part.members.len();
            part.members.extend_from_slice(&own.numbers);
            if self.torus.needed == 1 {
                // Of equally near points, the first one gives the shade.
                part.members[start..].sort_unstable();
            }
            part.lists.push((square, part.members.len()));
            return Ok(());
        }
        square.quarters().into_iter().try_for_each(|quarter| self.cut(quarter, own, smaller))
    }
}

/// Copies the candidates that are among the nearest points of a pixel of a square.
struct Nearby<'a, M> {
    from: &'a Candidates,
    to: &'a mut Candidates,
    scratch: &'a mut Scratch,
    area: Area,
    needed: usize,
    /// Whether only the numbers are wanted.
    is_last: bool,
    measure: PhantomData<M>,
}

impl<M: Measure> Kernel for Nearby<'_, M> {
    /// The comparison number that those that were copied have at most.
    type Output = f32;

    #[inline(always)]
    fn run(self) -> f32 {
        let count = self.from.numbers.len();
        let Scratch { least, places, picked } = &mut *self.scratch;
        if least.len() < count {
            least.resize(count, 0.0);
            places.extend((0..).skip(places.len()).take(count - places.len()));
            picked.resize(count, 0);
        }
        let (least, picked) = (&mut least[..count], &mut picked[..count]);
        let (x, x_rest) = self.from.x.as_chunks::<SIDE>();
        let (y, y_rest) = self.from.y.as_chunks::<SIDE>();
        let (chunks, least_rest) = least.as_chunks_mut::<SIDE>();
        let mut most = LeastTwo::default();
        for (least, (x, y)) in chunks.iter_mut().zip(x.iter().zip(y)) {
            let farthest;
            (*least, farthest) = self.area.distances::<M>(x, y);
            most.add(&farthest);
        }
        if !x_rest.is_empty() {
            let (mut x, mut y) = ([0.0; SIDE], [0.0; SIDE]);
            x[..x_rest.len()].copy_from_slice(x_rest);
            y[..y_rest.len()].copy_from_slice(y_rest);
            let (nearest, mut farthest) = self.area.distances::<M>(&x, &y);
            farthest[x_rest.len()..].fill(f32::INFINITY);
            most.add(&farthest);
            least_rest.copy_from_slice(&nearest[..least_rest.len()]);
        }
        let [first, second] = most.all();
        let reach = if self.needed == 1 { first } else { second };
        // A little farther, because comparison numbers are rounded to 24 bits.
        let reach = reach + reach.abs() * 1e-5 + 1e-3;
        let names = if self.is_last { &self.from.numbers } else { &*places };
        let mut found = 0;
        for (name, least) in names.iter().zip(&*least) {
            // Written in any case, which is faster than to guess which ones are near.
            picked[found] = *name;
            found += usize::from(*least <= reach);
        }
        let picked = &picked[..found];
        self.to.clear();
        if self.is_last {
            self.to.numbers.extend_from_slice(picked);
        } else {
            let places = || picked.iter().map(|place| *place as usize);
            self.to.numbers.extend(places().map(|place| self.from.numbers[place]));
            self.to.x.extend(places().map(|place| self.from.x[place]));
            self.to.y.extend(places().map(|place| self.from.y[place]));
        }
        reach
    }
}

impl Area {
    /// Comparison numbers of a distance that points at least keep to all pixels of the square, and
    /// of one that they at most have. On a torus too, going h pixels changes the distance along
    /// that direction by h at most.
    #[inline(always)]
    fn distances<M: Measure>(
        &self,
        x: &[f32; SIDE],
        y: &[f32; SIDE],
    ) -> ([f32; SIDE], [f32; SIDE]) {
        let (mut least, mut most) = ([0.0; SIDE], [0.0; SIDE]);
        let [half_width, half_height] = self.half;
        for lane in 0..SIDE {
            let across = around((self.middle[0] - x[lane]).abs(), self.size[0]);
            let down = around((self.middle[1] - y[lane]).abs(), self.size[1]);
            let [least_across, most_across] = M::range(across, half_width);
            let [least_down, most_down] = M::range(down, half_height);
            least[lane] = M::compare(least_across, least_down);
            most[lane] = M::compare(most_across, most_down);
        }
        (least, most)
    }
}

/// The least two numbers in each lane; infinity where there are fewer.
struct LeastTwo {
    first: [f32; SIDE],
    second: [f32; SIDE],
}

impl Default for LeastTwo {
    fn default() -> Self {
        Self { first: [f32::INFINITY; SIDE], second: [f32::INFINITY; SIDE] }
    }
}

impl LeastTwo {
    #[inline(always)]
    fn add(&mut self, numbers: &[f32; SIDE]) {
        for (lane, number) in numbers.iter().enumerate() {
            let greater_one = greater(self.first[lane], *number);
            self.second[lane] = lesser(self.second[lane], greater_one);
            self.first[lane] = lesser(self.first[lane], *number);
        }
    }

    /// The least two of all lanes.
    #[inline(always)]
    fn all(mut self) -> [f32; 2] {
        let mut lanes = SIDE;
        while lanes > 1 {
            lanes /= 2;
            for lane in 0..lanes {
                let other = lane + lanes;
                let greater_one = greater(self.first[lane], self.first[other]);
                let lesser_second = lesser(self.second[lane], self.second[other]);
                self.second[lane] = lesser(lesser_second, greater_one);
                self.first[lane] = lesser(self.first[lane], self.first[other]);
            }
        }
        [self.first[0], self.second[0]]
    }
}
