//! Counts in diamonds.

use super::Turn;
use crate::block::prelude::*;
use cells::Band;

/// A turn in diamonds. The largest has 221 cells, which fits a byte.
pub(super) struct Diamond<'a, 'b, 'c> {
    pub(super) turn: Turn<'a>,
    pub(super) band: &'b mut Band<'c>,
}

impl Kernel for Diamond<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { turn, band } = self;
        let limit = u8::try_from(turn.threshold).unwrap_or(u8::MAX);
        let (first, reach) = (band.rows().start.cast_signed(), turn.reach.cast_signed());
        let mut counts = turn.diamonds(first);
        let mut edges = Edges::new(turn, first);
        for y in first + 1..first + reach {
            edges.advance(y);
        }
        for row in band.rows() {
            let y = row.cast_signed();
            edges.advance(y + reach);
            if y > first {
                edges.slide(&mut counts, y);
            }
            let cells = turn.cells(0, y, turn.columns);
            turn.eat(cells, &counts, limit, &mut band.row_mut(row)[turn.left..]);
        }
    }
}

impl Turn<'_> {
    /// Counts in the diamonds around the cells of row `y`. A diamond is columns of cells, which
    /// are lower the further they are from its middle.
    #[inline(always)]
    fn diamonds(self, y: isize) -> Vec<u8> {
        let reach = self.reach.cast_signed();
        let width = self.columns + 2 * self.reach;
        let mut heights = vec![0; width];
        let mut counts = vec![0_u8; self.columns];
        for (height, dy) in (0..=self.reach).zip(0..) {
            self.add(&mut heights, self.cells(-reach, y - dy, width));
            if dy > 0 {
                self.add(&mut heights, self.cells(-reach, y + dy, width));
            }
            let (left, right) = (height, 2 * self.reach - height);
            let sums = counts.iter_mut().zip(&heights[left..]).zip(&heights[right..]);
            for ((count, left_column), right_column) in sums {
                *count += left_column + if left < right { *right_column } else { 0 };
            }
        }
        counts
    }
}

/// The edges of diamonds: counts of cells along the two diagonals that lead up from a cell, of as
/// many cells as the edge of a diamond. Rows of them are kept for as long as the lower edges of a
/// diamond take to become upper ones.
struct Edges<'a> {
    turn: Turn<'a>,
    /// Up to the left: from the first column on, to `reach` columns behind the last one.
    to_left: Rows,
    /// Up to the right: from `reach` columns before the first one on, to the last one.
    to_right: Rows,
}

impl<'a> Edges<'a> {
    /// The edges that start in row `y`.
    #[inline(always)]
    fn new(turn: Turn<'a>, y: isize) -> Self {
        let (length, reach) = (turn.columns + turn.reach, turn.reach.cast_signed());
        let mut edges = Self {
            turn,
            to_left: Rows::new(length, turn.reach),
            to_right: Rows::new(length, turn.reach),
        };
        for up in 0..=reach {
            turn.add(edges.to_left.row_mut(y), turn.cells(-up, y - up, length));
            turn.add(edges.to_right.row_mut(y), turn.cells(up - reach, y - up, length));
        }
        edges
    }

    /// Makes the edges that start in row `y`, after those of the row above it. Where they start
    /// one column on, they gain a cell and lose one; those in the first or the last column are
    /// counted.
    #[inline(always)]
    fn advance(&mut self, y: isize) {
        let Self { turn, to_left, to_right } = self;
        let (turn, reach) = (*turn, turn.reach.cast_signed());
        let lost_row = y - reach - 1;
        let count = turn.columns + turn.reach - 1;

        let (above, edges) = to_left.above_and_row(y);
        edges[0] = turn.edge(0, y, -1);
        let (gained, lost) = (turn.cells(1, y, count), turn.cells(-reach, lost_row, count));
        turn.slide(&above[..count], gained, lost, &mut edges[1..]);

        let (above, edges) = to_right.above_and_row(y);
        edges[count] = turn.edge(turn.columns - 1, y, 1);
        let (gained, lost) = (turn.cells(-reach, y, count), turn.cells(1, lost_row, count));
        turn.slide(&above[1..], gained, lost, &mut edges[..count]);
    }

    /// Makes counts in the diamonds around row `y` from those in the diamonds around the row above.
    #[inline(always)]
    fn slide(&self, counts: &mut [u8], y: isize) {
        let Self { turn, to_left, to_right } = self;
        let (turn, reach, columns) = (*turn, turn.reach, turn.columns);
        let (top, bottom) = (y - 1 - reach.cast_signed(), y + reach.cast_signed());
        // Lower edges lead up from the lowest cell, upper ones from the leftmost and rightmost to
        // the topmost cell. Both count where they meet twice.
        let lower_left = &to_left.row(bottom)[..columns];
        let lower_right = &to_right.row(bottom)[reach..][..columns];
        let upper_left = &to_right.row(y - 1)[..columns];
        let upper_right = &to_left.row(y - 1)[reach..][..columns];
        let (lowest, topmost) = (turn.cells(0, bottom, columns), turn.cells(0, top, columns));
        for (i, count) in counts[..columns].iter_mut().enumerate() {
            let gained = lower_left[i].wrapping_add(lower_right[i]);
            let gained = gained.wrapping_sub(turn.counts(lowest[i]));
            let lost = upper_left[i].wrapping_add(upper_right[i]);
            let lost = lost.wrapping_sub(turn.counts(topmost[i]));
            *count = count.wrapping_add(gained).wrapping_sub(lost);
        }
    }
}

impl Turn<'_> {
    /// The edge that leads up from a cell, `step` columns in each row.
    #[inline(always)]
    fn edge(self, x: usize, y: isize, step: isize) -> u8 {
        let mut place = self.old.place(self.left + x, y.cast_unsigned());
        let mut count = 0;
        for _ in 0..=self.reach {
            count += self.counts(self.old.cells()[place]);
            place = place.wrapping_add_signed(self.old.offset(step, -1));
        }
        count
    }

    /// Sums that have moved from where `sums` belong to.
    #[inline(always)]
    fn slide(self, sums: &[u8], gained: &[u8], lost: &[u8], out: &mut [u8]) {
        for (((out, sum), gained), lost) in out.iter_mut().zip(sums).zip(gained).zip(lost) {
            *out = sum.wrapping_add(self.counts(*gained)).wrapping_sub(self.counts(*lost));
        }
    }
}

/// The last `kept` rows of counts.
struct Rows {
    counts: Vec<u8>,
    length: usize,
    kept: usize,
}

impl Rows {
    /// Rows of zeros: one for each from a row to `reach` below the next one.
    #[inline(always)]
    fn new(length: usize, reach: usize) -> Self {
        let kept = reach + 2;
        Self { counts: vec![0; length * kept], length, kept }
    }

    #[inline(always)]
    fn start(&self, y: isize) -> usize {
        y.cast_unsigned() % self.kept * self.length
    }

    #[inline(always)]
    fn row(&self, y: isize) -> &[u8] {
        &self.counts[self.start(y)..][..self.length]
    }

    #[inline(always)]
    fn row_mut(&mut self, y: isize) -> &mut [u8] {
        let start = self.start(y);
        &mut self.counts[start..][..self.length]
    }

    /// The row above row `y`, to be read, and row `y`, to be written.
    #[inline(always)]
    fn above_and_row(&mut self, y: isize) -> (&[u8], &mut [u8]) {
        let (above, row) = (self.start(y - 1), self.start(y));
        let (before, after) = self.counts.split_at_mut(above.max(row));
        if above < row {
            (&before[above..][..self.length], &mut after[..self.length])
        } else {
            (&after[..self.length], &mut before[row..][..self.length])
        }
    }
}
