//! Cells of one byte that wrap around, and generations of them.

use crate::block::prelude::*;

/// How many cells a rule writes at a time.
pub(in super::super) const SIDE: usize = 64;

/// How many cells a thread takes at a time.
const CELLS_PER_TASK: usize = 1 << 14;

/// W × H cells with a margin all around that repeats the opposite side.
#[derive(Debug, Clone)]
pub(in super::super) struct Grid {
    cells: Vec<u8>,
    width: usize,
    height: usize,
    margin: usize,
    stride: usize,
}

impl Grid {
    /// A grid of zeros.
    pub(super) fn new(width: u32, height: u32, margin: usize) -> Self {
        let (width, height) = (width as usize, height as usize);
        let stride = stride(width, margin);
        Self { cells: vec![0; stride * (height + 2 * margin)], width, height, margin, stride }
    }

    /// The memory of a grid in bytes.
    pub(in super::super) fn bytes(width: u32, height: u32, margin: usize) -> u64 {
        stride(width as usize, margin) as u64 * (u64::from(height) + 2 * margin as u64)
    }

    /// The cells of row `y`, without the margin.
    pub(in super::super) fn row(&self, y: usize) -> &[u8] {
        &self.cells[self.place(0, y)..][..self.width]
    }

    /// Where the cell in column `x` of row `y` is in [`cells`](Self::cells).
    #[inline(always)]
    pub(in super::super) fn place(&self, x: usize, y: usize) -> usize {
        (self.margin + y) * self.stride + self.margin + x
    }

    /// All cells, margins included.
    #[inline(always)]
    pub(in super::super) fn cells(&self) -> &[u8] {
        &self.cells
    }

    /// What to add to the place of a cell for the one `dx` columns to the right and `dy` rows
    /// below. Neither is more than the margin.
    pub(in super::super) fn offset(&self, dx: isize, dy: isize) -> isize {
        dy * self.stride.cast_signed() + dx
    }

    /// [`SIDE`] cells from a place on, moved by an offset.
    #[inline(always)]
    pub(in super::super) fn side(&self, place: usize, offset: isize) -> &[u8; SIDE] {
        let side = self.cells[place.wrapping_add_signed(offset)..].first_chunk();
        side.expect("rows are long enough for whole sides")
    }

    /// The grid with `change` applied to each cell.
    pub(in super::super) fn map(mut self, change: impl Fn(u8) -> u8) -> Self {
        self.cells.iter_mut().for_each(|cell| *cell = change(*cell));
        self
    }

    /// Writes all cells, row by row on all threads. `row` gets the number of a row and its cells,
    /// a multiple of [`SIDE`] of them: what it writes behind the last column does not count.
    pub(super) fn fill(
        &mut self,
        cx: &WholeContext<'_>,
        row: impl Fn(usize, &mut [u8]) + Sync,
    ) -> Result<(), Error> {
        let Self { width, height, margin, stride, .. } = *self;
        let rows = CELLS_PER_TASK.div_ceil(width);
        let inner = &mut self.cells[margin * stride..][..height * stride];
        cx.parallel_pieces(inner, rows * stride, |piece, cells| {
            for (cells, y) in cells.chunks_mut(stride).zip(piece * rows..) {
                row(y, &mut cells[margin..][..width.next_multiple_of(SIDE)]);
                wrap_columns(cells, width, margin);
            }
            Ok(())
        })?;
        self.wrap_rows();
        Ok(())
    }

    /// Writes the margins above and below.
    fn wrap_rows(&mut self) {
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

    fn has_cells_of(&self, other: &Self) -> bool {
        (0..self.height).all(|y| self.row(y) == other.row(y))
    }
}

/// Cells from one row to the next: the margins, and whole sides of cells with a margin behind.
fn stride(width: usize, margin: usize) -> usize {
    width.next_multiple_of(SIDE) + 2 * margin
}

/// Writes the margins left and right of a row.
fn wrap_columns(row: &mut [u8], width: usize, margin: usize) {
    for i in 0..margin {
        row[margin + width + i] = row[margin + i % width];
        row[margin - 1 - i] = row[margin + width - 1 - i % width];
    }
}

/// A rule that says what becomes of cells: compiled for each SIMD level.
pub(in super::super) trait Rule: Sync {
    /// What [`SIDE`] cells of row `y` become, from column `x` on. Mark it `#[inline(always)]`, and
    /// what it calls: the rest is compiled for the lowest level.
    fn side(&self, grid: &Grid, x: usize, y: usize) -> [u8; SIDE];
}

/// Writes the generation after `old` to `new`.
pub(in super::super) fn generation(
    cx: &WholeContext<'_>,
    old: &Grid,
    new: &mut Grid,
    rule: &impl Rule,
) -> Result<(), Error> {
    new.fill(cx, |y, out| cx.simd.run(Row { rule, old, y, out }))
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

/// The grid after that many generations of a rule that knows neither time nor chance.
///
/// There are only so many grids: sooner or later one comes back, often soon. From there on
/// everything repeats, and whole periods can be left out. One earlier grid is enough to notice it,
/// if it is replaced after 1, 2, 4, 8 … generations (Brent, "An improved Monte Carlo factorization
/// algorithm", 1980).
pub(in super::super) fn evolve(
    cx: &WholeContext<'_>,
    mut grid: Grid,
    generations: u32,
    rule: &impl Rule,
) -> Result<Grid, Error> {
    let (mut next, mut earlier) = (grid.clone(), grid.clone());
    let (mut age, mut patience) = (0, 1);
    let mut left = generations;
    while left > 0 {
        generation(cx, &grid, &mut next, rule)?;
        std::mem::swap(&mut grid, &mut next);
        left -= 1;
        age += 1;
        cx.report(1.0 - f64::from(left) / f64::from(generations));
        cx.check()?;
        if grid.has_cells_of(&earlier) {
            left %= age;
        } else if age == patience {
            earlier.clone_from(&grid);
            (age, patience) = (0, 2 * patience);
        }
    }
    Ok(grid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_repeat_the_opposite_side() {
        for (width, height, margin) in [(5, 4, 2), (1, 1, 3), (3, 70, 10), (130, 2, 1)] {
            let mut grid = Grid::new(width, height, margin);
            assert_eq!(Grid::bytes(width, height, margin), grid.cells().len() as u64);
            let cell = |x: i64, y: i64| {
                let (x, y) = (convert::wrap(x, width), convert::wrap(y, height));
                (y * width + x).to_le_bytes()[0]
            };
            let (columns, stride) = (width as usize, grid.stride);
            let rows = grid.cells.chunks_mut(stride).skip(margin).take(height as usize);
            for (row, y) in rows.zip(0..) {
                for (out, x) in row[margin..][..columns].iter_mut().zip(0..) {
                    *out = cell(x, y);
                }
                wrap_columns(row, columns, margin);
            }
            grid.wrap_rows();
            let reach = margin.cast_signed();
            for y in 0..height as usize {
                for x in 0..width as usize {
                    for (dx, dy) in [(-reach, -reach), (reach, -reach), (0, reach), (reach, 0)] {
                        let place = grid.place(x, y).wrapping_add_signed(grid.offset(dx, dy));
                        let expected = cell(x as i64 + dx as i64, y as i64 + dy as i64);
                        assert_eq!(grid.cells()[place], expected, "{x},{y} and {dx},{dy}");
                    }
                }
            }
        }
    }
}
