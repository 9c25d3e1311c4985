//! The lists of the points that pixels look at: one for each tile.
//!
//! On a torus, the shorter way from a pixel to a point may go either way around. For nearly all
//! tiles it is the same way for all pixels: then the list has the place where that way ends, which
//! may be beyond the edge, and no pixel needs to ask again. Such a list is *straight*. It is filled
//! up with places at infinity, so that four points at a time are looked at without a remainder.

use super::{
    Measure, Point, SIDE, around, candidates::Candidates, cutting::Square, greater, lesser,
};
use crate::block::prelude::*;

/// So many points are looked at together. A power of 2.
pub(super) const GROUP: usize = 4;

/// The numbers of the lanes of a register.
const LANES: [f32; SIDE] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// The places of points of a list, across and down.
pub(super) type Group = [[f32; 2]; GROUP];

/// Where the list of a tile is.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Span {
    /// The first group.
    start: u32,
    /// How many points there are.
    count: u32,
    is_straight: bool,
}

/// The image is cut into this many parts in each direction, and up to the square of it in all.
const PARTS_ACROSS: usize = 4;

/// A part of the image, and the lists of its tiles. Parts are made on all threads.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) square: Square,
    /// Tiles of the image across and down.
    pub(super) tiles: [usize; 2],
    /// Its own tiles across.
    across: usize,
    /// Its own tiles down.
    down: usize,
    /// How many groups its lists may have together.
    room: usize,
    /// For each tile, row by row.
    spans: Vec<Span>,
    /// Where only the nearest point is needed, the numbers of points rise in each list, so that
    /// the first of several equally near points is found first.
    groups: Vec<Group>,
    /// Where only the nearest point is needed, the shades of the points of the groups.
    shades: Vec<[f32; GROUP]>,
}

impl Part {
    /// All parts of an image of that many tiles, row by row, with room for `most` groups in all.
    pub(super) fn all(tiles: [usize; 2], most: u64) -> Vec<Self> {
        let [across, down] = tiles;
        let side = Self::side(tiles);
        let first = |count: usize| (0..count).step_by(side);
        let places = first(down).flat_map(|y| first(across).map(move |x| (x, y)));
        let squares: Vec<_> = places.map(|(x, y)| Square { x, y, side }).collect();
        let room = convert::index(most.cast_signed()) / squares.len().max(1);
        let part = |square: Square| Self {
            square,
            tiles,
            across: side.min(across - square.x),
            down: side.min(down - square.y),
            room,
            spans: Vec::new(),
            groups: Vec::new(),
            shades: Vec::new(),
        };
        squares.into_iter().map(part).collect()
    }

    /// Tiles along the side of each part of an image of that many tiles.
    pub(super) fn side(tiles: [usize; 2]) -> usize {
        (tiles[0].max(tiles[1]).next_power_of_two() / PARTS_ACROSS).max(1)
    }

    /// Gets ready for [`keep`](Self::keep).
    pub(super) fn start(&mut self) {
        self.spans = vec![Span::default(); self.across * self.down];
        // Memory that is never written is never taken from the system.
        self.groups.reserve_exact(self.room);
    }

    /// Whether there is no room to cut a square of that many points further: what is left must do
    /// for the lists of squares that are not cut yet, too.
    pub(super) fn is_tight(&self, count: usize) -> bool {
        count.div_ceil(GROUP) * 8 > self.room.saturating_sub(self.groups.len())
    }

    /// Makes points the list of all tiles of a square; with the shades of `points`, if there are
    /// any.
    pub(super) fn keep(&mut self, square: Square, own: &Candidates, points: &[Point]) {
        let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        let start = number(self.groups.len());
        let span = Span { start, count: number(own.count), is_straight: own.is_straight };
        // The last group has places at infinity after the points.
        let groups = own.places.as_chunks::<GROUP>().0;
        self.groups.extend_from_slice(&groups[..own.count.div_ceil(GROUP)]);
        if !points.is_empty() {
            self.shades.extend(own.numbers[..own.count].chunks(GROUP).map(|numbers| {
                let mut shades = [0.0; GROUP];
                for (shade, number) in shades.iter_mut().zip(numbers) {
                    *shade = points[*number as usize].shade;
                }
                shades
            }));
        }
        let (x, y) = (square.x - self.square.x, square.y - self.square.y);
        let right = self.across.min(x + square.side);
        for y in y..self.down.min(y + square.side) {
            self.spans[y * self.across..][x..right].fill(span);
        }
    }

    /// The lists of its tiles in a row of tiles.
    #[inline(always)]
    pub(super) fn row(&self, y: usize) -> &[Span] {
        &self.spans[(y - self.square.y) * self.across..][..self.across]
    }

    #[inline(always)]
    pub(super) fn list(&self, span: Span) -> List<'_> {
        let count = span.count as usize;
        let (start, end) = (span.start as usize, span.start as usize + count.div_ceil(GROUP));
        let shades = self.shades.get(start..end).unwrap_or_default();
        List { groups: &self.groups[start..end], shades, count, is_straight: span.is_straight }
    }
}

/// The points that matter in a tile.
#[derive(Clone, Copy)]
pub(super) struct List<'a> {
    groups: &'a [Group],
    shades: &'a [[f32; GROUP]],
    count: usize,
    is_straight: bool,
}

impl List<'_> {
    /// The comparison numbers of the two nearest points of each pixel of a row of the tile, which
    /// starts at `at`; the second is infinite if there is but one. On a torus of that size.
    #[inline(always)]
    pub(super) fn nearest_two<M: Measure>(&self, at: [f32; 2], size: [f32; 2]) -> Two {
        let (mut first, mut second) = ([f32::INFINITY; SIDE], [f32::INFINITY; SIDE]);
        if self.is_straight {
            for group in self.groups {
                let down = group.map(|[_, y]| (at[1] - y).abs());
                for lane in 0..SIDE {
                    let x = at[0] + LANES[lane];
                    let [a, b, c, d] =
                        [0, 1, 2, 3].map(|i: usize| M::compare((x - group[i][0]).abs(), down[i]));
                    // By pairs, so that not each comparison waits for the one before.
                    let nearer = [lesser(a, b), lesser(c, d)];
                    let other = lesser(greater(a, b), greater(c, d));
                    let other = lesser(other, greater(nearer[0], nearer[1]));
                    let nearest = lesser(nearer[0], nearer[1]);
                    let other = lesser(other, greater(first[lane], nearest));
                    second[lane] = lesser(second[lane], other);
                    first[lane] = lesser(first[lane], nearest);
                }
            }
        } else {
            for i in 0..self.count {
                add(&mut first, &mut second, &self.compared::<M>(i, at, size));
            }
        }
        (first, second)
    }

    /// The comparison number and the shade of the nearest point of each pixel of a row of the tile,
    /// which starts at `at`. On a torus of that size.
    #[inline(always)]
    pub(super) fn nearest<M: Measure>(&self, at: [f32; 2], size: [f32; 2]) -> Nearest {
        let mut nearest = Nearest { compared: [f32::INFINITY; SIDE], shade: [0; SIDE] };
        if self.is_straight {
            for (group, shades) in self.groups.iter().zip(self.shades) {
                let down = group.map(|[_, y]| (at[1] - y).abs());
                for i in 0..GROUP {
                    let mut compared = [0.0; SIDE];
                    for lane in 0..SIDE {
                        let across = (at[0] + LANES[lane] - group[i][0]).abs();
                        compared[lane] = M::compare(across, down[i]);
                    }
                    nearest.add(shades[i], &compared);
                }
            }
        } else {
            let shades = self.shades.as_flattened().iter().take(self.count);
            for (i, shade) in shades.enumerate() {
                nearest.add(*shade, &self.compared::<M>(i, at, size));
            }
        }
        nearest
    }

    /// The comparison numbers of a point over the shorter way around.
    #[inline(always)]
    fn compared<M: Measure>(&self, i: usize, at: [f32; 2], size: [f32; 2]) -> [f32; SIDE] {
        let (group, i) = (&self.groups[i / GROUP], i % GROUP);
        let down = around((at[1] - group[i][1]).abs(), size[1]);
        let mut compared = [0.0; SIDE];
        for lane in 0..SIDE {
            let across = around((at[0] + LANES[lane] - group[i][0]).abs(), size[0]);
            compared[lane] = M::compare(across, down);
        }
        compared
    }
}

/// The nearest point in each lane.
pub(super) struct Nearest {
    pub(super) compared: [f32; SIDE],
    /// Bits of a number.
    shade: [u32; SIDE],
}

impl Nearest {
    #[inline(always)]
    fn add(&mut self, shade: f32, compared: &[f32; SIDE]) {
        let lanes = compared.iter().zip(&self.compared).zip(&mut self.shade);
        for ((compared, least), own) in lanes {
            // By bits: a choice between numbers would become a branch for each.
            let is_nearer = 0_u32.wrapping_sub(u32::from(compared < least));
            *own = *own & !is_nearer | shade.to_bits() & is_nearer;
        }
        for (least, compared) in self.compared.iter_mut().zip(compared) {
            *least = lesser(*compared, *least);
        }
    }

    #[inline(always)]
    pub(super) fn shades(&self) -> [f32; SIDE] {
        self.shade.map(f32::from_bits)
    }
}

/// The least numbers and the second ones in each lane; infinity where there are fewer. As one type
/// of two fields they would be kept in one register, with much moving.
pub(super) type Two = ([f32; SIDE], [f32; SIDE]);

/// Takes one more number in each lane into account.
#[inline(always)]
fn add(first: &mut [f32; SIDE], second: &mut [f32; SIDE], numbers: &[f32; SIDE]) {
    for lane in 0..SIDE {
        let greater_one = greater(first[lane], numbers[lane]);
        second[lane] = lesser(second[lane], greater_one);
        first[lane] = lesser(first[lane], numbers[lane]);
    }
}
