//! Counts of neighbours that slide: what a generation costs does not grow with their number.
//!
//! The states take turns. For one of them, a count of the cells that have it slides down the rows,
//! for many columns at once, in bytes: the square's is made of sums over columns, which gain a
//! cell and lose one ([`Square`]); the diamond's gains its new lower edges and loses its old upper
//! ones, which are sums over diagonals ([`Diamond`]). Where the count is high enough, cells of the
//! state before are eaten. A band of rows is finished, state by state, before the next one starts.
//!
//! Rejected, all measured in squares with AVX2, where a state takes 0.10 to 0.17 ns a cell here:
//! counts of all states at once, kept per column and read for the one state that a cell asks for
//! (2.6 to 9 ns a cell, most of it for keeping them, one byte at a time); counts for 64 columns
//! at once (0.4 to 0.75 ns a state and cell); planes of bits (no fewer instructions a cell, as a
//! count takes up to nine planes).

mod diamond;
mod square;

use diamond::Diamond;
use square::Square;

use super::neighbourhood::Neighbourhood;
use crate::block::prelude::*;
use cells::{Grid, SIDE};

/// Rows that are finished together: enough of them that the first counts cost little.
const ROWS: usize = 64;

/// Columns that are finished together: few enough of them that their counts stay in the nearest
/// cache. Whole sides of cells.
const COLUMNS: usize = 16 * SIDE;

/// How a cell of a state is eaten by the next one: by at least `threshold` of its neighbours, which
/// has to be possible.
pub(super) struct Sliding {
    pub(super) shape: Neighbourhood,
    /// How far neighbours are away. The margins of grids are one more.
    pub(super) reach: usize,
    pub(super) states: u8,
    pub(super) threshold: u16,
}

impl Sliding {
    /// Writes the generation after `old` to `new`.
    pub(super) fn generation(
        &self,
        cx: &WholeContext<'_>,
        old: &Grid,
        new: &mut Grid,
    ) -> Result<(), Error> {
        let width = cx.width as usize;
        cx.write_cells(new, ROWS, |band| {
            for y in band.rows() {
                band.row_mut(y)[..width].copy_from_slice(old.row(y));
            }
            for left in (0..width).step_by(COLUMNS) {
                for eater in 0..self.states {
                    cx.check()?;
                    let prey = if eater == 0 { self.states - 1 } else { eater - 1 };
                    let (reach, threshold) = (self.reach, self.threshold);
                    let columns = COLUMNS.min(width - left);
                    let turn = Turn { old, reach, threshold, left, columns, eater, prey };
                    match self.shape {
                        Neighbourhood::Moore => cx.simd.run(Square { turn, band }),
                        Neighbourhood::VonNeumann => cx.simd.run(Diamond { turn, band }),
                    }
                }
            }
            Ok(())
        })
    }
}

/// The turn of one state, in some columns. Its methods take copies, which stay in registers: bytes
/// behind a reference might change with each byte that is written.
#[derive(Clone, Copy)]
struct Turn<'a> {
    old: &'a Grid,
    reach: usize,
    threshold: u16,
    left: usize,
    columns: usize,
    eater: u8,
    /// The state before.
    prey: u8,
}

impl<'a> Turn<'a> {
    /// What a cell adds to a count.
    #[inline(always)]
    fn counts(self, cell: u8) -> u8 {
        u8::from(cell == self.eater)
    }

    /// `count` cells of row `y`, from `x` columns right of the first one on.
    #[inline(always)]
    fn cells(self, x: isize, y: isize, count: usize) -> &'a [u8] {
        self.old.stretch(self.left.cast_signed() + x, y, count)
    }

    /// Adds the cells to counts.
    #[inline(always)]
    fn add(self, counts: &mut [u8], cells: &[u8]) {
        for (count, cell) in counts.iter_mut().zip(cells) {
            *count += self.counts(*cell);
        }
    }

    /// Lets the prey among `cells` be eaten where counts have reached a limit.
    #[inline(always)]
    fn eat(self, cells: &[u8], counts: &[u8], limit: u8, out: &mut [u8]) {
        for ((out, cell), count) in out.iter_mut().zip(cells).zip(counts) {
            // All bits or none: nobody can foretell a branch here.
            let is_eaten =
                (u8::from(*count >= limit) & u8::from(*cell == self.prey)).wrapping_neg();
            *out = (self.eater & is_eaten) | (*out & !is_eaten);
        }
    }
}
