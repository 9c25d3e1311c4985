//! Exact distances to the nearest pixel of a set, on an image that wraps around.
//!
//! In two passes, as P. F. Felzenszwalb and D. P. Huttenlocher ("Distance Transforms of Sampled
//! Functions", Theory of Computing 8, 2012): the first finds, for each pixel, how many rows away
//! the nearest pixel of the set in its column is. The second takes these numbers of a row: the
//! square of the distance at x is the least, over all columns p, of (x - p)² + steps(p)². Each p
//! gives a parabola, and the least of them all is their lower envelope, found from left to right.
//!
//! A row is a circle. It is cut open at its lowest parabola, which stands at both ends then: at any
//! x between, no parabola beyond an end is lower than that of the end. Pixels of the set cut the
//! row in the same way, into short pieces. All numbers are whole, so a picture and its mirror image
//! have the same distances.

use ptlib_plugin::{BlockError, Scratch, Work};

/// Rows to the nearest pixel of the set, where its column has none.
pub const FAR: u16 = u16::MAX;
/// A square of [`FAR`].
const NEVER: u32 = u32::MAX;

/// The longest side: a square of a distance then fits into 31 bits.
pub const LONGEST: usize = 65_535;

/// A number for each pixel.
pub struct Rows<'a> {
    pub width: usize,
    pub steps: Scratch<'a, u16>,
}

impl<'a> Rows<'a> {
    /// Rows that a task takes at a time.
    pub const CHUNK: usize = 16;

    pub fn new(work: Work<'a>, [width, height]: [usize; 2]) -> Result<Self, BlockError> {
        Ok(Self { width, steps: work.scratch(width * height)? })
    }

    /// The numbers of a row.
    pub fn row(&self, y: usize) -> &[u16] {
        &self.steps[y * self.width..][..self.width]
    }

    /// From 0 for pixels of the set and [`FAR`] for all others, to the number of rows to the
    /// nearest pixel of the set in the same column.
    pub fn spread(&mut self, work: Work<'_>) -> Result<(), BlockError> {
        let (width, start) = (self.width, self.steps.len() - self.width);
        let mut last = work.scratch::<u16>(width)?;
        // Down and up, each a second time as far as something comes across the border.
        for is_second in [false, true] {
            last.copy_from_slice(&self.steps[start..]);
            let mut rows = self.steps.chunks_exact_mut(width);
            rows.all(|row| relax(row, &mut last) || !is_second);
            work.check()?;
        }
        for is_second in [false, true] {
            last.copy_from_slice(&self.steps[..width]);
            let mut rows = self.steps.chunks_exact_mut(width).rev();
            rows.all(|row| relax(row, &mut last) || !is_second);
            work.check()?;
        }
        Ok(())
    }
}

/// Goes on to the next row: what was near to the last row is one step farther from this. Whether
/// that changes anything.
fn relax(row: &mut [u16], last: &mut [u16]) -> bool {
    let mut changed = 0;
    for (own, last) in row.iter_mut().zip(last) {
        let near = (*own).min(last.saturating_add(1));
        changed |= *own ^ near;
        (*own, *last) = (near, near);
    }
    changed != 0
}

/// The lower envelope of a row, and the memory to find it.
pub struct Envelope<'a> {
    /// The lowest values of the parabolas, from the cut on; the first again at the end.
    lowest: Scratch<'a, u32>,
    /// Squares of distances, from the cut on.
    squares: Scratch<'a, u32>,
    /// The parabolas of the envelope: where they stand, and from where on they are the lowest.
    stack: Scratch<'a, [u32; 2]>,
}

impl<'a> Envelope<'a> {
    pub fn new(work: Work<'a>, width: usize) -> Result<Self, BlockError> {
        Ok(Self {
            lowest: work.scratch(width + 1)?,
            squares: work.scratch(width)?,
            stack: work.scratch(width + 1)?,
        })
    }

    /// The squares of distances, from the steps of a row. The set has a pixel somewhere.
    pub fn write(&mut self, steps: &[u16], squares: &mut [u32]) {
        let width = steps.len();
        let lowest = steps.iter().copied().min().unwrap_or(FAR);
        let cut = steps.iter().position(|own| *own == lowest).unwrap_or_default();
        let (before, after) = steps.split_at(cut);
        for (own, steps) in self.lowest.iter_mut().zip(after.iter().chain(before)) {
            *own = if *steps == FAR { NEVER } else { u32::from(*steps) * u32::from(*steps) };
        }
        self.lowest[width] = self.lowest[0];
        let mut start = 0;
        for end in 1..=width {
            if self.lowest[end] == 0 || end == width {
                self.piece(start, end);
                start = end;
            }
        }
        squares[cut..].copy_from_slice(&self.squares[..width - cut]);
        squares[..cut].copy_from_slice(&self.squares[width - cut..]);
    }

    /// The piece from a parabola that is the lowest of it to another one.
    fn piece(&mut self, start: usize, end: usize) {
        self.squares[start] = self.lowest[start];
        if end - start == 1 {
            return;
        }
        let [first, last] = [start, end].map(|place| u32::try_from(place).unwrap_or(u32::MAX));
        self.stack[0] = [first, first];
        let mut top = 0;
        for place in first + 1..=last {
            let own = self.lowest[place as usize];
            if own == NEVER {
                continue;
            }
            let from = loop {
                let [other, from] = self.stack[top];
                // Lower than the other beyond `above / below`.
                let above = height(place, own) - height(other, self.lowest[other as usize]);
                let below = 2 * i64::from(place - other);
                if top > 0 && above < i64::from(from) * below {
                    top -= 1;
                } else {
                    break u64::try_from(above).unwrap_or_default() / below.unsigned_abs() + 1;
                }
            };
            if from <= u64::from(last) {
                top += 1;
                self.stack[top] = [place, u32::try_from(from).unwrap_or(last)];
            }
        }
        self.draw(top, last);
    }

    /// Writes the squares below the parabolas of the stack.
    fn draw(&mut self, top: usize, end: u32) {
        for i in 0..=top {
            let [place, from] = self.stack[i];
            let to = if i < top { self.stack[i + 1][1] } else { end };
            let lowest = self.lowest[place as usize];
            for (square, x) in self.squares[from as usize..to as usize].iter_mut().zip(from..) {
                let away = x.abs_diff(place);
                *square = away * away + lowest;
            }
        }
    }
}

/// What a parabola is at 0.
fn height(place: u32, lowest: u32) -> i64 {
    i64::from(place) * i64::from(place) + i64::from(lowest)
}
