//! Flood fill: what the specification calls FILL4 (2.0).
//!
//! The region of a pixel is what can be reached from it over neighbours of the same colour in the
//! same row or column, around the edges of the picture. It is filled run by run: a run is as many
//! such pixels of a row as follow each other; those above and below it that are to be filled wait
//! on a stack.

use std::ops::Range;

use crate::error::Error;

/// A picture of one number a pixel, which can be filled.
#[derive(Debug)]
pub struct Canvas<'a, T> {
    pixels: &'a mut [T],
    width: usize,
    /// Places that are to be filled, kept from fill to fill for its memory.
    waiting: Vec<usize>,
}

impl<'a, T: Copy + PartialEq> Canvas<'a, T> {
    /// A canvas over pixels in rows of `width`.
    ///
    /// # Panics
    /// If the pixels are not whole rows.
    #[must_use]
    pub fn new(pixels: &'a mut [T], width: u32) -> Self {
        let width = width as usize;
        assert!(width > 0 && pixels.len().is_multiple_of(width), "a canvas has whole rows");
        Self { pixels, width, waiting: Vec::new() }
    }

    /// The pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[T] {
        self.pixels
    }

    /// Gives `color` to the region of the pixel at place `start` of the rows. Asks `check` whether
    /// to go on at each run.
    ///
    /// # Errors
    /// What `check` returns; the region is filled in part then.
    pub fn fill(
        &mut self,
        start: usize,
        color: T,
        mut check: impl FnMut() -> Result<(), Error>,
    ) -> Result<(), Error> {
        let old = self.pixels[start];
        if old == color {
            return Ok(());
        }
        self.waiting.clear();
        self.waiting.push(start);
        while let Some(place) = self.waiting.pop() {
            if self.pixels[place] != old {
                continue;
            }
            check()?;
            let (row, run) = self.run_around(place);
            // A run that passes the right edge goes on at the left one.
            let parts = [run.start..run.end.min(self.width), 0..run.end.saturating_sub(self.width)];
            for part in parts.iter().filter(|part| !part.is_empty()) {
                self.pixels[row + part.start..row + part.end].fill(color);
            }
            let last_row = self.pixels.len() - self.width;
            let above = if row == 0 { last_row } else { row - self.width };
            let below = if row == last_row { 0 } else { row + self.width };
            for part in parts {
                self.wait(above, part.clone(), old);
                self.wait(below, part, old);
            }
        }
        Ok(())
    }

    /// The start of the row of a place, and the columns from the first to the last one of its run:
    /// those from the width on are further around the edge.
    fn run_around(&self, place: usize) -> (usize, Range<usize>) {
        let (width, column) = (self.width, place % self.width);
        let row = place - column;
        let pixels = &self.pixels[row..row + width];
        let is_same = |pixel: &&T| **pixel == pixels[column];
        let right = pixels[column..].iter().chain(&pixels[..column]).take_while(is_same).count();
        if right == width {
            return (row, 0..width);
        }
        let before = pixels[..column].iter().rev().chain(pixels[column..].iter().rev());
        let left = before.take_while(is_same).count();
        let first = (column + width - left) % width;
        (row, first..first + left + right)
    }

    /// Puts one place of each run of color `old` in these columns of a row on the stack.
    fn wait(&mut self, row: usize, columns: Range<usize>, old: T) {
        let mut is_inside = false;
        for place in row + columns.start..row + columns.end {
            let is_old = self.pixels[place] == old;
            if is_old && !is_inside {
                self.waiting.push(place);
            }
            is_inside = is_old;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixel by pixel, as the definition tells it.
    fn naive(pixels: &mut [u8], width: usize, start: usize, color: u8) {
        let (old, height) = (pixels[start], pixels.len() / width);
        if old == color {
            return;
        }
        let mut waiting = vec![start];
        while let Some(place) = waiting.pop() {
            if pixels[place] == old {
                pixels[place] = color;
                let (x, y) = (place % width, place / width);
                waiting.extend([
                    y * width + (x + 1) % width,
                    y * width + (x + width - 1) % width,
                    (y + 1) % height * width + x,
                    (y + height - 1) % height * width + x,
                ]);
            }
        }
    }

    #[test]
    fn regions_are_those_of_the_definition() {
        let mut number = 1_u32;
        for (width, height) in [(1_u32, 1), (1, 9), (9, 1), (2, 2), (13, 7), (40, 31)] {
            for share in [2, 3, 5, 100] {
                let mut random = || {
                    number = number.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
                    u8::from((number >> 16).is_multiple_of(share))
                };
                let mut pixels: Vec<u8> = (0..width * height).map(|_| random()).collect();
                for (start, color) in (0..pixels.len()).step_by(3).zip((2..50).cycle()) {
                    let mut expected = pixels.clone();
                    naive(&mut expected, width as usize, start, color);
                    let mut canvas = Canvas::new(&mut pixels, width);
                    canvas.fill(start, color, || Ok(())).unwrap();
                    assert_eq!(pixels, expected, "{width} × {height} from {start}");
                }
            }
        }
    }

    #[test]
    fn a_fill_can_be_stopped() {
        let mut pixels = vec![0; 100];
        let mut canvas = Canvas::new(&mut pixels, 10);
        let stop = || Err(Error::new(crate::ErrorKind::Cancelled, "stopped"));
        assert!(canvas.fill(5, 1, stop).is_err());
    }
}
