//! Cells of one byte that wrap around, and generations of them.

use std::ops::Range;

use crate::math::simd::{Kernel, SimdLevel};

/// How many cells a rule writes at a time.
pub const SIDE: usize = 64;

/// W × H cells with a margin all around that repeats the opposite side.
#[derive(Debug, Clone)]
pub struct Grid {
    cells: Vec<u8>,
    width: usize,
    height: usize,
    margin: usize,
    stride: usize,
}

impl Grid {
    /// A grid of zeros.
    #[must_use]
    pub fn new(width: u32, height: u32, margin: usize) -> Self {
        let (width, height) = (width as usize, height as usize);
        let stride = stride(width, margin);
        Self { cells: vec![0; stride * (height + 2 * margin)], width, height, margin, stride }
    }

    /// The memory of a grid in bytes.
    #[must_use]
    pub fn bytes(width: u32, height: u32, margin: usize) -> u64 {
        stride(width as usize, margin) as u64 * (u64::from(height) + 2 * margin as u64)
    }

    /// The cells of row `y`, without the margin.
    #[must_use]
    pub fn row(&self, y: usize) -> &[u8] {
        &self.cells[self.place(0, y)..][..self.width]
    }

    /// Where the cell in column `x` of row `y` is in [`cells`](Self::cells).
    #[inline(always)]
    #[must_use]
    pub fn place(&self, x: usize, y: usize) -> usize {
        (self.margin + y) * self.stride + self.margin + x
    }

    /// All cells, margins included.
    #[inline(always)]
    #[must_use]
    pub fn cells(&self) -> &[u8] {
        &self.cells
    }

    /// What to add to the place of a cell for the one `dx` columns to the right and `dy` rows
    /// below. Neither is more than the margin.
    #[must_use]
    pub fn offset(&self, dx: isize, dy: isize) -> isize {
        dy * self.stride.cast_signed() + dx
    }

    /// [`SIDE`] cells from a place on, moved by an offset.
    #[inline(always)]
    #[must_use]
    pub fn side(&self, place: usize, offset: isize) -> &[u8; SIDE] {
        let side = self.cells[place.wrapping_add_signed(offset)..].first_chunk();
        side.expect("rows are long enough for whole sides")
    }

    /// The grid with `change` applied to each cell.
    #[must_use]
    pub fn map(mut self, change: impl Fn(u8) -> u8) -> Self {
        self.cells.iter_mut().for_each(|cell| *cell = change(*cell));
        self
    }

    /// `count` cells of row `y` from column `x` on, all of them perhaps in the margin.
    #[inline(always)]
    #[must_use]
    pub fn stretch(&self, x: isize, y: isize, count: usize) -> &[u8] {
        &self.cells[self.place(0, 0).wrapping_add_signed(self.offset(x, y))..][..count]
    }

    /// The work of writing all cells: write `rows` rows at a time, in any order, wrap the columns
    /// of each band, and then the [rows](Self::wrap_rows) of the grid.
    #[must_use]
    pub fn bands_mut(&mut self, rows: usize) -> Vec<Band<'_>> {
        let Self { width, height, margin, stride, .. } = *self;
        let inner = &mut self.cells[margin * stride..][..height * stride];
        let bands = inner.chunks_mut(rows * stride).zip((0..).step_by(rows));
        bands.map(|(cells, first)| Band { cells, first, width, margin, stride }).collect()
    }

    /// Writes the margins above and below.
    pub fn wrap_rows(&mut self) {
        let Self { height, margin, .. } = *self;
        for i in 0..margin {
            self.copy_row(margin + i % height, margin + height + i);
            self.copy_row(margin + height - 1 - i % height, margin - 1 - i);
        }
    }

    fn copy_row(&mut self, from: usize, to: usize) {
        let from = from * self.stride;
        self.cells.copy_within(from..from + self.stride, to * self.stride);
    }

    /// Whether all cells are those of another grid of this size.
    #[must_use]
    pub fn has_cells_of(&self, other: &Self) -> bool {
        (0..self.height).all(|y| self.row(y) == other.row(y))
    }
}

/// Cells from one row to the next: the margins, and whole sides of cells with a margin behind.
fn stride(width: usize, margin: usize) -> usize {
    width.next_multiple_of(SIDE) + 2 * margin
}

/// Some rows of a grid that is being written.
#[derive(Debug)]
pub struct Band<'a> {
    cells: &'a mut [u8],
    first: usize,
    width: usize,
    margin: usize,
    stride: usize,
}

impl Band<'_> {
    /// The numbers of its rows.
    #[must_use]
    pub fn rows(&self) -> Range<usize> {
        self.first..self.first + self.cells.len() / self.stride
    }

    /// Row `y` of the grid, a multiple of [`SIDE`] cells: what is written behind the last column
    /// does not count.
    #[inline(always)]
    #[must_use]
    pub fn row_mut(&mut self, y: usize) -> &mut [u8] {
        let start = (y - self.first) * self.stride + self.margin;
        &mut self.cells[start..][..self.width.next_multiple_of(SIDE)]
    }

    /// Writes what becomes of the cells of `old`.
    pub fn apply(&mut self, simd: SimdLevel, rule: &impl Rule, old: &Grid) {
        for y in self.rows() {
            simd.run(Row { rule, old, y, out: self.row_mut(y) });
        }
    }

    /// Writes the margins left and right.
    pub fn wrap_columns(&mut self) {
        for row in self.cells.chunks_mut(self.stride) {
            wrap_columns(row, self.width, self.margin);
        }
    }
}

/// A rule that says what becomes of cells: compiled for each SIMD level.
pub trait Rule: Sync {
    /// What [`SIDE`] cells of row `y` become, from column `x` on. Mark it `#[inline(always)]`, and
    /// what it calls: the rest is compiled for the lowest level.
    fn side(&self, grid: &Grid, x: usize, y: usize) -> [u8; SIDE];
}

struct Row<'a, R> {
    rule: &'a R,
    old: &'a Grid,
    y: usize,
    out: &'a mut [u8],
}

impl<R: Rule> Kernel for Row<'_, R> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (sides, _) = self.out.as_chunks_mut::<SIDE>();
        for (side, x) in sides.iter_mut().zip((0..).step_by(SIDE)) {
            *side = self.rule.side(self.old, x, self.y);
        }
    }
}

/// Writes the margins left and right of a row.
fn wrap_columns(row: &mut [u8], width: usize, margin: usize) {
    for i in 0..margin {
        row[margin + width + i] = row[margin + i % width];
        row[margin - 1 - i] = row[margin + width - 1 - i % width];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::convert;

    #[test]
    fn margins_repeat_the_opposite_side() {
        for (width, height, margin) in [(5, 4, 2), (1, 1, 3), (3, 70, 10), (130, 2, 1)] {
            let mut grid = Grid::new(width, height, margin);
            assert_eq!(Grid::bytes(width, height, margin), grid.cells().len() as u64);
            let cell = |x: i64, y: i64| {
                let (x, y) = (convert::wrap(x, width), convert::wrap(y, height));
                (y * width + x).to_le_bytes()[0]
            };
            for band in &mut grid.bands_mut(3) {
                for y in band.rows() {
                    let row = &mut band.row_mut(y)[..width as usize];
                    row.iter_mut().zip(0..).for_each(|(out, x)| *out = cell(x, y as i64));
                }
                band.wrap_columns();
            }
            grid.wrap_rows();
            let reach = margin.cast_signed();
            for y in 0..height as usize {
                for x in 0..width as usize {
                    for (dx, dy) in [(-reach, -reach), (reach, -reach), (0, reach), (reach, 0)] {
                        let place = grid.place(x, y).wrapping_add_signed(grid.offset(dx, dy));
                        let expected = cell(x as i64 + dx as i64, y as i64 + dy as i64);
                        assert_eq!(grid.cells()[place], expected, "{x},{y} and {dx},{dy}");
                        let stretch = grid.stretch(x.cast_signed() + dx, y.cast_signed() + dy, 1);
                        assert_eq!(stretch, [expected], "{x},{y} and {dx},{dy}");
                    }
                }
            }
        }
    }
}
