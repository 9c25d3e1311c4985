//! Which points matter for which pixels: cutting the image into tiles.
//!
//! A square has a distance that each point keeps for certain to all of its pixels, and one that it
//! stays within for certain. The two nearest points of every pixel then are among those that may
//! come as near as the second least of the latter. The image is cut into parts, which are made on
//! all threads; in a part, squares are halved in both directions down to a single tile, and each
//! looks only at the points of the one it came from. Where points are spread out, the largest
//! squares are small already, and get their points from the [`Buckets`] around them.

use std::{marker::PhantomData, ops::Range};

use super::{
    Measure, Point, SIDE, around,
    buckets::Buckets,
    lesser,
    lists::{GROUP, LANES, Part, add, least_two},
};
use crate::block::prelude::*;

/// A square with at most this many points is not cut further.
const FEW: usize = GROUP;

/// Nor is one of four tiles with at most this many: making four lists takes longer than looking at
/// some points more in each tile.
const FEW_OF_FOUR_TILES: usize = 6 * GROUP;

/// Candidates of a square come from so many rings of buckets around its own at first.
const FIRST_RINGS: usize = 2;

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
    /// The squares of that side that it consists of, row by row.
    fn pieces(self, side: usize) -> impl Iterator<Item = Self> {
        let Self { x, y, side: whole } = self;
        let step = move |first: usize| (first..first + whole).step_by(side);
        step(y).flat_map(move |y| step(x).map(move |x| Self { x, y, side }))
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

/// Points that may be among the nearest ones of the pixels of a square. What its vectors hold after
/// the points has no meaning, but is there, so that registers can be filled.
#[derive(Debug, Default)]
pub(super) struct Candidates {
    pub(super) count: usize,
    /// Empty where nobody asks for them.
    pub(super) numbers: Vec<u32>,
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// Whether from each pixel of the square these places are the nearest ones that the points
    /// have on the torus, so that nothing needs to look the other way around.
    pub(super) is_straight: bool,
}

impl Candidates {
    /// Those of these numbers, which are kept if `numbered`.
    pub(super) fn of(points: &[Point], numbers: &[u32], numbered: bool) -> Self {
        let mut all = Self { count: numbers.len(), ..Self::default() };
        all.make_room(numbers.len(), numbered);
        for (i, number) in numbers.iter().enumerate() {
            let point = points[*number as usize];
            (all.x[i], all.y[i]) = (point.x, point.y);
        }
        if numbered {
            all.numbers[..numbers.len()].copy_from_slice(numbers);
        }
        all
    }

    /// Those at these places.
    pub(super) fn ordered(&self, places: &[usize]) -> Self {
        let mut all = Self { count: places.len(), ..Self::default() };
        all.make_room(places.len(), self.is_numbered());
        for (i, place) in places.iter().enumerate() {
            (all.x[i], all.y[i]) = (self.x[*place], self.y[*place]);
        }
        for (number, place) in all.numbers.iter_mut().zip(places) {
            *number = self.numbers[*place];
        }
        all
    }

    #[inline(always)]
    fn is_numbered(&self) -> bool {
        !self.numbers.is_empty()
    }

    /// Makes room for so many, and for a register more.
    #[inline(always)]
    fn make_room(&mut self, count: usize, numbered: bool) {
        if self.x.len() < count + SIDE {
            self.x.resize(count + SIDE, 0.0);
            self.y.resize(count + SIDE, 0.0);
            self.numbers.resize(if numbered { count + SIDE } else { 0 }, 0);
        }
    }

    /// Appends those at some places of `other`, moved by a distance.
    #[inline(always)]
    pub(super) fn append(&mut self, other: &Self, places: Range<usize>, by: [f32; 2]) {
        self.make_room(self.count + places.len(), other.is_numbered());
        let mut to = self.count;
        self.count += places.len();
        for from in places.step_by(SIDE) {
            // A register at a time: mostly one is enough.
            let (to_x, from_x) = (&mut self.x[to..to + SIDE], &other.x[from..from + SIDE]);
            let (to_y, from_y) = (&mut self.y[to..to + SIDE], &other.y[from..from + SIDE]);
            for i in 0..SIDE {
                to_x[i] = from_x[i] + by[0];
            }
            for i in 0..SIDE {
                to_y[i] = from_y[i] + by[1];
            }
            if other.is_numbered() {
                self.numbers[to..to + SIDE].copy_from_slice(&other.numbers[from..from + SIDE]);
            }
            to += SIDE;
        }
    }

    /// Becomes those of `other` that have at most `reach` in `least`.
    #[inline(always)]
    fn pick(&mut self, other: &Self, least: &[f32], reach: f32) {
        let count = other.count;
        self.make_room(count, other.is_numbered());
        let least = &least[..count];
        let (from_x, from_y) = (&other.x[..count], &other.y[..count]);
        let (x, y) = (&mut self.x[..count], &mut self.y[..count]);
        let found =
            positions(least, reach, |from, to| (x[to], y[to]) = (from_x[from], from_y[from]));
        if other.is_numbered() {
            let (numbers, all) = (&mut self.numbers[..count], &other.numbers[..count]);
            positions(least, reach, |from, to| numbers[to] = all[from]);
        }
        self.count = found;
        self.is_straight = other.is_straight;
    }

    /// Moves the points to the places where they are nearest to all pixels of an area, if there
    /// are such places for all of them.
    #[inline(always)]
    fn straighten(&mut self, area: &Area) {
        let places = [&mut self.x[..self.count], &mut self.y[..self.count]];
        self.is_straight = places.iter().enumerate().all(|(axis, places)| {
            // Without a way out, so that it is done for several at a time.
            places.iter().fold(true, |are, at| are & area.nearest(axis, *at).1)
        });
        if self.is_straight {
            for (axis, places) in places.into_iter().enumerate() {
                places.iter_mut().for_each(|at| *at = area.nearest(axis, *at).0);
            }
        }
    }

    /// Sorts them by their numbers. They are few.
    fn sort(&mut self) {
        for end in 1..self.count {
            let mut i = end;
            while i > 0 && self.numbers[i - 1] > self.numbers[i] {
                self.numbers.swap(i - 1, i);
                self.x.swap(i - 1, i);
                self.y.swap(i - 1, i);
                i -= 1;
            }
        }
    }
}

/// Tells where the numbers are that are not greater than `reach`, and how many were before them.
/// Returns how many there are.
#[inline(always)]
fn positions(numbers: &[f32], reach: f32, mut found: impl FnMut(usize, usize)) -> usize {
    let mut count = 0;
    for (i, number) in numbers.iter().enumerate() {
        // Told of the others too, which is faster than to guess which ones they are.
        found(i, count);
        count += usize::from(*number <= reach);
    }
    count
}

/// Makes the lists of a part, of the points of `buckets`.
pub(super) fn cut<M: Measure>(
    part: &mut Part,
    torus: Torus,
    points: &[Point],
    buckets: &Buckets,
    cx: &Context<'_>,
) -> Result<(), Error> {
    let mut sizes = Vec::new();
    sizes.resize_with(part.square.side.ilog2() as usize + 1, Candidates::default);
    let (square, measure) = (part.square, PhantomData::<M>);
    part.start();
    let (mut near, least) = ([Candidates::default(), Candidates::default()], Vec::new());
    let mut cutting = Cutting { part, torus, points, cx, least, measure };
    // Neighbours start with the same points, which takes less time than to collect them for each.
    let side = (2 * buckets.side).min(square.side);
    square.pieces(side).try_for_each(|square| cutting.start(square, buckets, &mut near, &mut sizes))
}

/// A part that is being cut.
struct Cutting<'a, M> {
    part: &'a mut Part,
    torus: Torus,
    points: &'a [Point],
    cx: &'a Context<'a>,
    /// Comparison numbers of the least distances of candidates.
    least: Vec<f32>,
    measure: PhantomData<M>,
}

impl<M: Measure> Cutting<'_, M> {
    /// Cuts the buckets in a square, with points from the buckets around. There is memory for these
    /// points and for those farther away, and for the candidates of a bucket and of each smaller
    /// size of squares.
    fn start(
        &mut self,
        square: Square,
        buckets: &Buckets,
        [near, farther]: &mut [Candidates; 2],
        sizes: &mut [Candidates],
    ) -> Result<(), Error> {
        if self.is_outside(square) {
            return Ok(());
        }
        let known = buckets.around(square, FIRST_RINGS, self.torus, near);
        for square in square.pieces(buckets.side.min(square.side)) {
            if self.is_outside(square) {
                continue;
            }
            self.cx.check()?;
            if self.pick(square, near, sizes) > M::compare(known, 0.0) {
                self.look_farther(square, buckets, farther, sizes)?;
            }
            self.settle(square, sizes)?;
        }
        Ok(())
    }

    /// Picks the candidates of a square in a bucket, of the points in so many rings of buckets that
    /// none outside of them matters.
    fn look_farther(
        &mut self,
        square: Square,
        points: &Buckets,
        near: &mut Candidates,
        sizes: &mut [Candidates],
    ) -> Result<(), Error> {
        let mut rings = FIRST_RINGS;
        loop {
            self.cx.check()?;
            rings += rings.div_ceil(2);
            let known = points.around(square, rings, self.torus, near);
            if self.pick(square, near, sizes) <= M::compare(known, 0.0) {
                return Ok(());
            }
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
            least: &mut self.least,
            area: square.area(self.torus.size),
            needed: self.torus.needed,
            measure: self.measure,
        })
    }

    /// Keeps a square as it is, or cuts it further.
    fn settle(&mut self, square: Square, sizes: &mut [Candidates]) -> Result<(), Error> {
        let Some((own, smaller)) = sizes.split_first_mut() else { return Ok(()) };
        let count = own.count;
        let few = if square.side == 2 { FEW_OF_FOUR_TILES } else { FEW };
        if square.side == 1 || count <= few || self.part.is_tight(count) {
            if self.torus.needed == 1 {
                // Of equally near points, the first one gives the shade.
                own.sort();
            }
            let points = if self.torus.needed == 1 { self.points } else { &[] };
            self.part.keep(square, own, points);
            return Ok(());
        }
        square.pieces(square.side / 2).try_for_each(|quarter| self.cut(quarter, own, smaller))
    }
}

/// Copies the candidates that are among the nearest points of a pixel of a square.
struct Nearby<'a, M> {
    from: &'a Candidates,
    to: &'a mut Candidates,
    /// Memory.
    least: &'a mut Vec<f32>,
    area: Area,
    needed: usize,
    measure: PhantomData<M>,
}

impl<M: Measure> Kernel for Nearby<'_, M> {
    /// The comparison number that those that were copied have at most.
    type Output = f32;

    #[inline(always)]
    fn run(self) -> f32 {
        let count = self.from.count;
        if self.least.len() < count + SIDE {
            self.least.resize(count + SIDE, 0.0);
        }
        let size = self.area.size;
        let [first, second] = if self.from.is_straight {
            self.area.distances::<M>(self.from, self.least, |distance, _| distance)
        } else {
            let way = |distance, axis: usize| around(distance, size[axis]);
            self.area.distances::<M>(self.from, self.least, way)
        };
        let reach = if self.needed == 1 { first } else { second };
        // A little farther, because comparison numbers are rounded to 24 bits.
        let reach = reach + reach.abs() * 1e-5 + 1e-3;
        self.to.pick(self.from, self.least, reach);
        if !self.to.is_straight {
            self.to.straighten(&self.area);
        }
        reach
    }
}

impl Area {
    /// The place where a point is nearest to all pixels of the square along one direction, and
    /// whether there is such a place.
    #[inline(always)]
    fn nearest(&self, axis: usize, at: f32) -> (f32, bool) {
        let (middle, half, size) = (self.middle[axis], self.half[axis], self.size[axis]);
        let distance = (middle - at).abs();
        let is_here = distance + half <= size * 0.5;
        let is_around = distance - half >= size * 0.5 && distance + half <= size;
        let moved = if at < middle { at + size } else { at - size };
        (if is_here { at } else { moved }, is_here | is_around)
    }

    /// Writes comparison numbers of a distance that points at least keep to all pixels of the
    /// square. Returns the least two of those that they at most have. On a torus too, going h
    /// pixels changes the distance along that direction by h at most.
    #[inline(always)]
    fn distances<M: Measure>(
        &self,
        points: &Candidates,
        least: &mut [f32],
        way: impl Fn(f32, usize) -> f32,
    ) -> [f32; 2] {
        let (x, y) = (points.x.as_chunks::<SIDE>().0, points.y.as_chunks::<SIDE>().0);
        let chunks = least.as_chunks_mut::<SIDE>().0.iter_mut().zip(x).zip(y);
        let (mut first, mut second) = ([f32::INFINITY; SIDE], [f32::INFINITY; SIDE]);
        for (number, ((least, x), y)) in chunks.take(points.count.div_ceil(SIDE)).enumerate() {
            let mut most;
            (*least, most) = self.eight_distances::<M>(x, y, &way);
            let left = convert::position(points.count - number * SIDE);
            for lane in 0..SIDE {
                // By bits: a choice between numbers would become a branch for each.
                let is_one = 0_u32.wrapping_sub(u32::from(LANES[lane] < left));
                let bits = most[lane].to_bits() & is_one | f32::INFINITY.to_bits() & !is_one;
                most[lane] = f32::from_bits(bits);
            }
            add(&mut first, &mut second, &most);
        }
        least_two(first, second)
    }

    /// The comparison numbers of the least and of the greatest distance of points.
    #[inline(always)]
    fn eight_distances<M: Measure>(
        &self,
        x: &[f32; SIDE],
        y: &[f32; SIDE],
        way: &impl Fn(f32, usize) -> f32,
    ) -> ([f32; SIDE], [f32; SIDE]) {
        let (mut least, mut most) = ([0.0; SIDE], [0.0; SIDE]);
        let (mut across, mut down) = ([0.0; SIDE], [0.0; SIDE]);
        let [half_width, half_height] = self.half;
        // A loop for each step, or else the compiler mixes lanes.
        for lane in 0..SIDE {
            across[lane] = way((self.middle[0] - x[lane]).abs(), 0);
        }
        for lane in 0..SIDE {
            down[lane] = way((self.middle[1] - y[lane]).abs(), 1);
        }
        for lane in 0..SIDE {
            let least_across = M::least(across[lane], half_width);
            least[lane] = M::compare(least_across, M::least(down[lane], half_height));
        }
        for lane in 0..SIDE {
            let most_across = M::most(across[lane], half_width);
            most[lane] = M::compare(most_across, M::most(down[lane], half_height));
        }
        (least, most)
    }
}
