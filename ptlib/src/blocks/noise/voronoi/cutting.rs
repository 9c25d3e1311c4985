//! Which points matter for which pixels: cutting the image into tiles.
//!
//! A square has a distance that each point keeps for certain to all of its pixels, and one that it
//! stays within for certain. The two nearest points of every pixel then are among those that may
//! come as near as the second least of the latter. The image is cut into parts, which are made on
//! all threads; in a part, squares are halved in both directions down to a single tile, and each
//! looks only at the points of the one it came from. Where points are spread out, the largest
//! squares are small already, and get their points from the [`Buckets`] around them.

use std::{array, marker::PhantomData};

use super::{
    Measure, Point,
    buckets::Buckets,
    candidates::{Candidates, Picking, Quarters},
    lists::{GROUP, Part},
};
use crate::block::prelude::*;

/// A square with at most this many points is not cut further.
const FEW: usize = GROUP;

/// Nor is one of four tiles with at most this many: making four lists takes longer than looking at
/// some points more in each tile.
const FEW_OF_FOUR_TILES: usize = 6 * GROUP;

/// Candidates of a square come from so many rings of buckets around it at first.
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
    /// The squares of that side, a power of 2, that it consists of, row by row. If it is smaller,
    /// the one that has its corner.
    fn pieces(self, side: usize) -> impl Iterator<Item = Self> {
        let (Self { x, y, side: whole }, step) = (self, side.trailing_zeros());
        let count = (whole >> step).max(1);
        let places = (0..count).flat_map(move |row| (0..count).map(move |column| (row, column)));
        places.map(move |(row, column)| Self {
            x: x + (column << step),
            y: y + (row << step),
            side,
        })
    }

    fn quarters(self) -> Quarters<Self> {
        let side = self.side / 2;
        array::from_fn(|i| Self { x: self.x + i % 2 * side, y: self.y + i / 2 * side, side })
    }
}

/// Makes the lists of a part, of the points of `buckets`.
pub(super) fn cut<M: Measure>(
    part: &mut Part,
    torus: Torus,
    points: &[Point],
    buckets: &Buckets,
    cx: &Context<'_>,
) -> Result<(), Error> {
    // Neighbours start with the same points, which takes less time than to collect them for each.
    let side = (2 * buckets.side).min(part.square.side).max(2);
    let mut sizes = Vec::new();
    sizes.resize_with(side.ilog2() as usize, Quarters::default);
    let square = part.square;
    part.start();
    let (mut near, least) = (Candidates::default(), Vec::new());
    let mut cutting = Cutting { part, torus, points, cx, least, measure: PhantomData::<M> };
    square.pieces(side).try_for_each(|square| cutting.start(square, buckets, &mut near, &mut sizes))
}

/// A part that is being cut.
struct Cutting<'a, M> {
    part: &'a mut Part,
    torus: Torus,
    points: &'a [Point],
    cx: &'a Context<'a>,
    /// Comparison numbers of the least distances of candidates.
    least: Vec<Quarters<f32>>,
    measure: PhantomData<M>,
}

impl<M: Measure> Cutting<'_, M> {
    /// Cuts a square, with points from so many rings of buckets around it that none outside of
    /// them matters. There is memory for these points, and for the candidates of its quarters and
    /// of each smaller size of squares.
    fn start(
        &mut self,
        square: Square,
        buckets: &Buckets,
        near: &mut Candidates,
        sizes: &mut [Quarters<Candidates>],
    ) -> Result<(), Error> {
        if self.is_outside(square) {
            return Ok(());
        }
        let Some(quarters) = sizes.first_mut() else { return Ok(()) };
        let mut rings = FIRST_RINGS;
        loop {
            self.cx.check()?;
            let known = buckets.around(square, rings, self.torus, near);
            let reach = self.pick(square, near, quarters);
            let known = M::compare(known, 0.0);
            let mut known_of = square.quarters().into_iter().zip(reach);
            if known_of.all(|(quarter, reach)| reach <= known || self.is_outside(quarter)) {
                return self.settle(square, sizes);
            }
            rings += rings.div_ceil(2);
        }
    }

    /// Whether a square has no pixel in this part of the image.
    fn is_outside(&self, square: Square) -> bool {
        let Square { x, y, side } = self.part.square;
        let [across, down] = self.part.tiles;
        square.x >= across.min(x + side) || square.y >= down.min(y + side)
    }

    /// Picks the candidates of the quarters of a square; returns how far they are at most.
    fn pick(
        &mut self,
        square: Square,
        from: &Candidates,
        to: &mut Quarters<Candidates>,
    ) -> Quarters<f32> {
        let (quarters, torus, least) = (square.quarters(), self.torus, &mut self.least);
        self.cx.simd.run(Picking { from, to, least, quarters, torus, measure: self.measure })
    }

    /// Keeps the quarters of a square as they are, or cuts them further.
    fn settle(&mut self, square: Square, sizes: &mut [Quarters<Candidates>]) -> Result<(), Error> {
        let Some((quarters, smaller)) = sizes.split_first_mut() else { return Ok(()) };
        for (quarter, own) in square.quarters().into_iter().zip(quarters) {
            if self.is_outside(quarter) {
                continue;
            }
            let few = if quarter.side == 2 { FEW_OF_FOUR_TILES } else { FEW };
            match smaller.first_mut() {
                Some(to) if own.count > few && !self.part.is_tight(own.count) => {
                    self.cx.check()?;
                    self.pick(quarter, own, to);
                    self.settle(quarter, smaller)?;
                }
                _ => self.keep(quarter, own),
            }
        }
        Ok(())
    }

    fn keep(&mut self, square: Square, own: &mut Candidates) {
        if self.torus.needed == 1 {
            // Of equally near points, the first one gives the shade.
            own.sort();
        }
        let points = if self.torus.needed == 1 { self.points } else { &[] };
        self.part.keep(square, own, points);
    }
}
