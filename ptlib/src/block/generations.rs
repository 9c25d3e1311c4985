//! Generations of cells, made on all threads for blocks that let pictures live.

use super::Context;
use crate::{
    error::Error,
    math::{convert, levels::Levels},
    value::{
        Image,
        cells::{self, Band, Grid, Rule},
    },
};

/// How many cells a thread takes at a time.
const CELLS_PER_TASK: usize = 1 << 14;

impl Context<'_> {
    /// The grid whose cells have the states of an image's pixels: see [`cells::write_states`].
    /// Announce its memory: see [`Grid::bytes`].
    ///
    /// # Errors
    /// [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn states_of<L: Levels>(
        &self,
        image: &Image,
        states: u8,
        margin: usize,
    ) -> Result<Grid, Error> {
        let mut grid = Grid::new(self.width, self.height, margin);
        self.write_cells(&mut grid, self.rows_per_task(), |band| {
            for y in band.rows() {
                let row = convert::wrap(y as i64, self.height);
                cells::write_states::<L>(image, row, states, band.row_mut(y));
            }
            Ok(())
        })?;
        Ok(grid)
    }

    /// Writes all cells of a grid of the size to make, `rows` rows at a time.
    ///
    /// # Errors
    /// What `write` returns, or [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn write_cells(
        &self,
        grid: &mut Grid,
        rows: usize,
        write: impl Fn(&mut Band<'_>) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        self.parallel_pieces(&mut grid.bands_mut(rows), 1, |_, bands| {
            bands.iter_mut().try_for_each(|band| {
                write(band)?;
                band.wrap_columns();
                Ok(())
            })
        })?;
        grid.wrap_rows();
        Ok(())
    }

    /// Writes the generation after `old` to `new`.
    ///
    /// # Errors
    /// [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn generation(&self, old: &Grid, new: &mut Grid, rule: &impl Rule) -> Result<(), Error> {
        self.write_cells(new, self.rows_per_task(), |band| {
            band.apply(self.simd, rule, old);
            Ok(())
        })
    }

    fn rows_per_task(&self) -> usize {
        CELLS_PER_TASK.div_ceil(self.width as usize)
    }

    /// The grid after that many generations of a rule that knows neither time nor chance.
    /// `generation` writes the one after its first grid to its second. Announce the memory of
    /// three grids.
    ///
    /// There are only so many grids: sooner or later one comes back, often soon. From there on
    /// everything repeats, and whole periods can be left out. One earlier grid is enough to notice
    /// it, if it is replaced after 1, 2, 4, 8 … generations (Brent, "An improved Monte Carlo
    /// factorization algorithm", 1980).
    ///
    /// # Errors
    /// What `generation` returns, or [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn evolve(
        &self,
        mut grid: Grid,
        generations: u32,
        generation: impl Fn(&Grid, &mut Grid) -> Result<(), Error>,
    ) -> Result<Grid, Error> {
        let (mut next, mut earlier) = (grid.clone(), grid.clone());
        let (mut age, mut patience) = (0, 1);
        let mut left = generations;
        while left > 0 {
            generation(&grid, &mut next)?;
            std::mem::swap(&mut grid, &mut next);
            left -= 1;
            age += 1;
            self.report(1.0 - f64::from(left) / f64::from(generations));
            self.check()?;
            if grid.has_cells_of(&earlier) {
                left %= age;
            } else if age == patience {
                earlier.clone_from(&grid);
                (age, patience) = (0, 2 * patience);
            }
        }
        Ok(grid)
    }

    /// The picture, of one plane, whose pixels have the values of the cells of a grid.
    ///
    /// # Errors
    /// [`NoMemory`](crate::ErrorKind::NoMemory) or [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn picture_of(&self, grid: &Grid, value: impl Fn(u8) -> f32) -> Result<Image, Error> {
        let mut values = [0.0; 256];
        for (cell, entry) in (0..=255).zip(&mut values) {
            *entry = value(cell);
        }
        let mut image = self.new_image(1)?;
        for plane in image.planes_mut() {
            self.parallel_pieces(plane, self.width as usize, |y, out| {
                for (out, cell) in out.iter_mut().zip(grid.row(y)) {
                    *out = values[usize::from(*cell)];
                }
                Ok(())
            })?;
        }
        Ok(image)
    }
}
