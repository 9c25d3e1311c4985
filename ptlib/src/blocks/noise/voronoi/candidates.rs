//! Points that may matter to a square of tiles, and how those of its quarters are picked.
//!
//! The four quarters of a square are looked at together, each in its own lane, so that a point is
//! read once, and nothing has to be gathered from the lanes in the end.

use std::ops::Range;

use super::{
    Measure, Point, SIDE, around,
    cutting::{Square, Torus},
    greater, lesser,
    lists::GROUP,
};
use crate::block::prelude::*;

/// Something of each quarter of a square, row by row.
pub(super) type Quarters<T> = [T; 4];

/// Points that may be among the nearest ones of the pixels of a square.
#[derive(Debug, Default)]
pub(super) struct Candidates {
    pub(super) count: usize,
    /// Empty where nobody asks for them.
    pub(super) numbers: Vec<u32>,
    /// Across and down. There are more places than points, so that some can be written at once:
    /// at least a group at infinity, where they have been picked.
    pub(super) places: Vec<[f32; 2]>,
    /// Whether from each pixel of the square these places are the nearest ones that the points
    /// have on the torus, so that nothing needs to look the other way around.
    pub(super) is_straight: bool,
}

impl Candidates {
    /// Those of these numbers, which are kept if `numbered`.
    pub(super) fn of(points: &[Point], numbers: &[u32], numbered: bool) -> Self {
        let mut all = Self { count: numbers.len(), ..Self::default() };
        all.make_room(numbers.len(), numbered);
        for (place, number) in all.places.iter_mut().zip(numbers) {
            let point = points[*number as usize];
            *place = [point.x, point.y];
        }
        if numbered {
            all.numbers[..numbers.len()].copy_from_slice(numbers);
        }
        all
    }

    /// Those at these positions.
    pub(super) fn ordered(&self, order: &[usize]) -> Self {
        let mut all = Self { count: order.len(), ..Self::default() };
        all.make_room(order.len(), self.is_numbered());
        for (place, position) in all.places.iter_mut().zip(order) {
            *place = self.places[*position];
        }
        for (number, position) in all.numbers.iter_mut().zip(order) {
            *number = self.numbers[*position];
        }
        all
    }

    #[inline(always)]
    fn is_numbered(&self) -> bool {
        !self.numbers.is_empty()
    }

    /// Makes room for so many, and some more.
    #[inline(always)]
    fn make_room(&mut self, count: usize, numbered: bool) {
        if self.places.len() < count + SIDE {
            self.places.resize(count + SIDE, [0.0; 2]);
            self.numbers.resize(if numbered { count + SIDE } else { 0 }, 0);
        }
    }

    /// Appends those at some positions of `other`, moved by a distance.
    #[inline(always)]
    pub(super) fn append(&mut self, other: &Self, positions: Range<usize>, by: [f32; 2]) {
        self.make_room(self.count + positions.len(), other.is_numbered());
        let mut to = self.count;
        self.count += positions.len();
        for from in positions.step_by(SIDE) {
            // Some at a time: mostly once is enough.
            let (places, others) = (&mut self.places[to..to + SIDE], &other.places[from..]);
            for (place, other) in places.iter_mut().zip(&others[..SIDE]) {
                *place = [other[0] + by[0], other[1] + by[1]];
            }
            if other.is_numbered() {
                self.numbers[to..to + SIDE].copy_from_slice(&other.numbers[from..from + SIDE]);
            }
            to += SIDE;
        }
    }

    /// Moves the points to the places where they are nearest to all pixels of a square, if there
    /// are such places for all of them.
    fn straighten(&mut self, area: &Area) {
        let places = &mut self.places[..self.count];
        self.is_straight = places.iter().all(|place| area.nearest(*place).1);
        if self.is_straight {
            places.iter_mut().for_each(|place| *place = area.nearest(*place).0);
        }
    }

    /// Sorts them by their numbers. They are few.
    pub(super) fn sort(&mut self) {
        for end in 1..self.count {
            let mut i = end;
            while i > 0 && self.numbers[i - 1] > self.numbers[i] {
                self.numbers.swap(i - 1, i);
                self.places.swap(i - 1, i);
                i -= 1;
            }
        }
    }
}

/// The pixels of a square.
struct Area {
    middle: [f32; 2],
    /// Half the extent.
    half: [f32; 2],
    /// Size of the image.
    size: [f32; 2],
}

impl Area {
    fn of(square: Square, size: [f32; 2]) -> Self {
        let sides = [(square.x, size[0]), (square.y, size[1])].map(|(first, size)| {
            let first = convert::position(first * SIDE);
            let last = lesser(first + convert::position(square.side * SIDE), size) - 1.0;
            ((first + last) * 0.5, (last - first) * 0.5)
        });
        Self { middle: sides.map(|side| side.0), half: sides.map(|side| side.1), size }
    }

    /// The place where a point is nearest to all pixels of the square, and whether there is such a
    /// place.
    fn nearest(&self, place: [f32; 2]) -> ([f32; 2], bool) {
        let both = [0, 1].map(|axis| {
            let (at, size) = (place[axis], self.size[axis]);
            let (middle, half) = (self.middle[axis], self.half[axis]);
            let distance = (middle - at).abs();
            let is_here = distance + half <= size * 0.5;
            let is_around = distance - half >= size * 0.5 && distance + half <= size;
            let moved = if at < middle { at + size } else { at - size };
            (if is_here { at } else { moved }, is_here | is_around)
        });
        (both.map(|axis| axis.0), both[0].1 & both[1].1)
    }
}

/// Picks the candidates of the quarters of a square.
pub(super) struct Picking<'a, M> {
    pub(super) from: &'a Candidates,
    pub(super) to: &'a mut Quarters<Candidates>,
    /// Memory.
    pub(super) least: &'a mut Vec<Quarters<f32>>,
    pub(super) quarters: Quarters<Square>,
    pub(super) torus: Torus,
    pub(super) measure: std::marker::PhantomData<M>,
}

impl<M: Measure> Kernel for Picking<'_, M> {
    /// The comparison numbers that those of each quarter have at most.
    type Output = Quarters<f32>;

    #[inline(always)]
    fn run(self) -> Quarters<f32> {
        let Torus { size, needed } = self.torus;
        let from = self.from;
        let places = &from.places[..from.count];
        if self.least.len() < places.len() {
            self.least.resize(places.len(), [0.0; 4]);
        }
        let least = &mut self.least[..places.len()];
        let areas = self.quarters.map(|quarter| Area::of(quarter, size));
        let [first, second] = if from.is_straight {
            distances::<M>(places, least, &areas, |distance, _| distance)
        } else {
            distances::<M>(places, least, &areas, |distance, axis| around(distance, size[axis]))
        };
        let reach = if needed == 1 { first } else { second };
        // A little farther, because comparison numbers are rounded to 24 bits.
        let reach = reach.map(|reach| reach + reach.abs() * 1e-5 + 1e-3);
        let numbered = from.is_numbered();
        self.to.iter_mut().for_each(|to| to.make_room(places.len(), numbered));
        let counts = pick(places, least, reach, self.to.each_mut().map(|to| &mut to.places[..]));
        if numbered {
            let to = self.to.each_mut().map(|to| &mut to.numbers[..]);
            pick(&from.numbers[..from.count], least, reach, to);
        }
        for ((to, count), area) in self.to.iter_mut().zip(counts).zip(&areas) {
            (to.count, to.is_straight) = (count, from.is_straight);
            if !to.is_straight {
                to.straighten(area);
            }
            to.places[count..count + GROUP].fill([f32::INFINITY; 2]);
        }
        reach
    }
}

/// Writes comparison numbers of a distance that points at least keep to all pixels of each quarter.
/// Returns the least ones of those that they at most have, and the second ones. On a torus too,
/// going h pixels changes the distance along that direction by h at most.
#[inline(always)]
fn distances<M: Measure>(
    places: &[[f32; 2]],
    least: &mut [Quarters<f32>],
    areas: &Quarters<Area>,
    way: impl Fn(f32, usize) -> f32,
) -> [Quarters<f32>; 2] {
    let middle = [0, 1].map(|axis: usize| areas.each_ref().map(|area| area.middle[axis]));
    let half = [0, 1].map(|axis: usize| areas.each_ref().map(|area| area.half[axis]));
    let (mut first, mut second) = ([f32::INFINITY; 4], [f32::INFINITY; 4]);
    for (least, [x, y]) in least.iter_mut().zip(places) {
        // With copies, in one loop: or else the compiler mixes lanes.
        let (x, y, mut own) = (*x, *y, [0.0; 4]);
        for lane in 0..4 {
            let across = way((middle[0][lane] - x).abs(), 0);
            let down = way((middle[1][lane] - y).abs(), 1);
            let least_across = M::least(across, half[0][lane]);
            own[lane] = M::compare(least_across, M::least(down, half[1][lane]));
            let most_across = M::most(across, half[0][lane]);
            let most = M::compare(most_across, M::most(down, half[1][lane]));
            second[lane] = lesser(second[lane], greater(first[lane], most));
            first[lane] = lesser(first[lane], most);
        }
        *least = own;
    }
    [first, second]
}

/// Copies to each quarter what has at most its `reach` in `least`. Returns how many these are.
#[inline(always)]
fn pick<T: Copy>(
    from: &[T],
    least: &[Quarters<f32>],
    reach: Quarters<f32>,
    to: Quarters<&mut [T]>,
) -> Quarters<usize> {
    let mut counts = [0; 4];
    let to = to.map(|to| &mut to[..from.len()]);
    for (item, least) in from.iter().zip(least) {
        for lane in 0..4 {
            // The others are copied too, which is faster than to guess which ones they are.
            to[lane][counts[lane]] = *item;
            counts[lane] += usize::from(least[lane] <= reach[lane]);
        }
    }
    counts
}
