//! Counts in squares.

use super::{COLUMNS, Turn};
use crate::block::prelude::*;
use cells::{Band, SIDE};

/// Counts of columns, with those left and right of the columns of a turn, and then of whole sides.
type Counts = [u8; COLUMNS + 2 * SIDE];

/// How many sums of three columns are added first: those of the largest square are at most
/// 4 · 3 · 21 = 252, which fits a byte, as what is added then does by itself.
const FIRST: usize = 4;

/// A turn in squares, which are at least three columns wide.
pub(super) struct Square<'a, 'b, 'c> {
    pub(super) turn: Turn<'a>,
    pub(super) band: &'b mut Band<'c>,
}

impl Kernel for Square<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { turn, band } = self;
        let reach = turn.reach.cast_signed();
        let width = turn.columns + 2 * turn.reach;
        let row = |y| turn.cells(-reach, y, width);
        let mut columns: Counts = [0; _];
        let mut triples: Counts = [0; _];
        let first = band.rows().start.cast_signed();
        for y in first - reach - 1..first + reach {
            turn.add(&mut columns[..width], row(y));
        }
        for y in band.rows() {
            let (gained, lost) = (row(y.cast_signed() + reach), row(y.cast_signed() - reach - 1));
            for ((count, gained), lost) in columns[..width].iter_mut().zip(gained).zip(lost) {
                *count = count.wrapping_add(turn.counts(*gained));
                *count = count.wrapping_sub(turn.counts(*lost));
            }
            let neighbours = columns.iter().zip(&columns[1..]).zip(&columns[2..]);
            for (triple, ((left, middle), right)) in triples[..width].iter_mut().zip(neighbours) {
                *triple = left + middle + right;
            }
            let (sides, _) = band.row_mut(y)[turn.left..].as_chunks_mut::<SIDE>();
            for (out, x) in sides.iter_mut().zip((0..COLUMNS).step_by(SIDE)) {
                let cells = turn.cells(x.cast_signed(), y.cast_signed(), SIDE);
                let (counts, limit) = turn.squares(&triples[x..], &columns[x..]);
                turn.eat(cells, &counts, limit, out);
            }
        }
    }
}

impl Turn<'_> {
    /// Counts in [`SIDE`] squares, and the limit for them. Their threshold may be larger than a
    /// byte: then what it is above the largest byte is taken from the first sums instead, and the
    /// last ones saturate. (If the first sums are smaller than that, the others cannot make up for
    /// it.)
    #[inline(always)]
    fn squares(self, triples: &[u8], columns: &[u8]) -> ([u8; SIDE], u8) {
        let side = 2 * self.reach + 1;
        let limit = u8::try_from(self.threshold).unwrap_or(u8::MAX);
        let excess = u8::try_from(self.threshold - u16::from(limit)).unwrap_or(u8::MAX);
        let mut counts = [0; SIDE];
        for i in 0..FIRST.min(side / 3) {
            add(&mut counts, &triples[3 * i..]);
        }
        for count in &mut counts {
            *count = count.saturating_sub(excess);
        }
        for i in FIRST..side / 3 {
            add(&mut counts, &triples[3 * i..]);
        }
        for i in side / 3 * 3..side {
            add(&mut counts, &columns[i..]);
        }
        (counts, limit)
    }
}

#[inline(always)]
fn add(sums: &mut [u8; SIDE], counts: &[u8]) {
    for (sum, count) in sums.iter_mut().zip(&counts[..SIDE]) {
        *sum = sum.saturating_add(*count);
    }
}
