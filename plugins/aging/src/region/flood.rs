//! Regions that grow pixel by pixel on an image that wraps around.
//!
//! A grid has a label for each pixel, and a frame of one more pixel all around, so that neighbours
//! are found without a question where the border is: a pixel of the frame is the *twin* of one at
//! the opposite side. A flood grows from all pixels of one label into those that are *open*: a
//! generation is all open neighbours of the one before. Pixels are visited once, in a queue, so the
//! time does not depend on how many generations there are.
//!
//! *Parts* are what hangs together, over 8 neighbours, of the pixels with a label: they are found
//! by a flood from any pixel of theirs.

use std::sync::atomic::{AtomicUsize, Ordering};

use ptlib_plugin::{BlockError, Scratch, Work, math};

use super::distance::Rows;

/// The label of pixels outside of the region, or done with.
pub const OUTSIDE: u32 = 0;
/// The label of pixels that nothing has reached yet.
pub const OPEN: u32 = u32::MAX;
/// The label of a pixel of the frame whose twin is or was not outside.
const TWIN: u32 = u32::MAX - 1;
/// Added to the label of a pixel whose part is being looked at.
const SEEN: u32 = 1 << 31;

/// Pixels between two questions whether to stop.
const CHECK: usize = 1 << 16;

/// How a front moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Steps {
    /// To all 8 neighbours: fronts become squares.
    Eight,
    /// To 4 and to 8 neighbours by turns: fronts become octagons, which are nearly round.
    Octagon,
}

/// A label for each pixel.
pub struct Grid<'a> {
    work: Work<'a>,
    width: usize,
    height: usize,
    /// Pixels of a row, frame included.
    stride: usize,
    labels: Scratch<'a, u32>,
    /// Pixels in the order in which they were reached. It never grows beyond what it was made for;
    /// memory that is not reached costs no time, which zeroed memory would.
    queue: Vec<u32>,
    /// How many pixels are open.
    open: usize,
    /// Pixels until the next question whether to stop.
    rest: usize,
}

impl<'a> Grid<'a> {
    /// Bytes of a grid's queue; all else is memory of the host.
    pub fn bytes(width: u32, height: u32) -> u64 {
        u64::from(width) * u64::from(height) * size_of::<u32>() as u64
    }

    /// A grid whose rows `label` writes, with what `begin` gives for some rows at a time.
    pub fn new<T>(
        work: Work<'a>,
        [width, height]: [usize; 2],
        begin: impl Fn() -> Result<T, BlockError> + Sync,
        label: impl Fn(&mut T, usize, &mut [u32]) + Sync,
    ) -> Result<Self, BlockError> {
        let cells =
            (width + 2).checked_mul(height + 2).filter(|cells| u32::try_from(*cells).is_ok());
        let cells = cells.ok_or_else(|| {
            BlockError::limit(format!("{width} × {height} pixels are too many: 2³² are allowed"))
        })?;
        let labels = work.scratch(cells)?;
        let mut queue = Vec::new();
        let reserved = queue.try_reserve_exact(width * height);
        reserved
            .map_err(|_| BlockError::no_memory("there is no memory for the queue of pixels"))?;
        let stride = width + 2;
        let (open, rest) = (0, CHECK);
        let mut grid = Self { work, width, height, stride, labels, queue, open, rest };
        let open = AtomicUsize::new(0);
        let inner = &mut grid.labels[stride..stride * (height + 1)];
        work.for_each(inner.chunks_mut(stride * Rows::CHUNK).enumerate(), |(chunk, rows)| {
            let mut with = begin()?;
            for (row, y) in rows.chunks_exact_mut(stride).zip(chunk * Rows::CHUNK..) {
                label(&mut with, y, &mut row[1..=width]);
                let open_here =
                    row[1..=width].iter().map(|label| u32::from(*label == OPEN)).sum::<u32>();
                open.fetch_add(open_here as usize, Ordering::Relaxed);
                (row[0], row[width + 1]) = (twin_of(row[width]), twin_of(row[1]));
            }
            work.check()
        })?;
        for (from, to) in [(height, 0), (1, height + 1)] {
            for x in 0..stride {
                grid.labels[to * stride + x] = twin_of(grid.labels[from * stride + x]);
            }
        }
        grid.open = open.into_inner();
        Ok(grid)
    }

    /// The labels of a row.
    pub fn row(&self, y: usize) -> &[u32] {
        &self.labels[(y + 1) * self.stride + 1..][..self.width]
    }

    /// How many pixels are open.
    pub fn open(&self) -> usize {
        self.open
    }

    /// Makes all pixels outside that are not open, which the flood did not reach.
    pub fn leave_open(&mut self) {
        for label in self.labels.iter_mut().filter(|label| **label < TWIN) {
            *label = OUTSIDE;
        }
    }

    /// Lets the pixels of the label `seed` grow into the open ones. Those of generation g get the
    /// label `seed` + g. Returns the last generation.
    pub fn flood(&mut self, seed: u32, steps: Steps) -> Result<u32, BlockError> {
        self.plant(seed)?;
        let (mut older, mut start) = (0, 0);
        let (mut generation, mut last) = (0, 0);
        while self.open > 0 {
            generation += 1;
            let end = self.queue.len();
            match steps {
                Steps::Eight => self.grow(start..end, seed + generation, self.eight())?,
                Steps::Octagon if generation % 2 == 1 => {
                    self.grow(start..end, seed + generation, self.four())?;
                }
                // The generation before the last has moved to 4 neighbours only.
                Steps::Octagon => self.grow(older..end, seed + generation, self.eight())?,
            }
            (older, start) = (start, end);
            if self.queue.len() > end {
                last = generation;
            } else if steps == Steps::Eight || generation - last == 2 {
                break;
            }
        }
        Ok(last)
    }

    /// Begins the queue with the pixels of a label that have an open neighbour.
    fn plant(&mut self, seed: u32) -> Result<(), BlockError> {
        self.queue.clear();
        let eight = self.eight();
        for y in 1..=self.height {
            self.count(self.width)?;
            let row = y * self.stride;
            let has_seeds = self.row(y - 1).iter().fold(false, |has, label| has | (*label == seed));
            if !has_seeds {
                continue;
            }
            for at in row + 1..=row + self.width {
                let is_open = |step: &isize| self.labels[at.wrapping_add_signed(*step)] >= TWIN;
                if self.labels[at] == seed && eight.iter().any(is_open) {
                    self.push(at);
                }
            }
        }
        Ok(())
    }

    /// Gives a label to all open pixels that lie `steps` from a part of the queue.
    fn grow<const STEPS: usize>(
        &mut self,
        from: std::ops::Range<usize>,
        label: u32,
        steps: [isize; STEPS],
    ) -> Result<(), BlockError> {
        for start in from.clone().step_by(CHECK) {
            let end = from.end.min(start + CHECK);
            self.count(end - start)?;
            for i in start..end {
                let at = self.queue[i] as usize;
                for step in steps {
                    let to = at.wrapping_add_signed(step);
                    if self.labels[to] >= TWIN {
                        self.claim(to, label);
                    }
                }
            }
        }
        Ok(())
    }

    fn claim(&mut self, at: usize, label: u32) {
        let at = self.home(at);
        if self.labels[at] == OPEN {
            self.labels[at] = label;
            self.open -= 1;
            self.push(at);
        }
    }

    fn push(&mut self, at: usize) {
        // The constructor checked that all places fit.
        self.queue.push(u32::try_from(at).unwrap_or(u32::MAX));
    }

    /// Where a pixel is whose twin may be in the frame.
    fn home(&self, at: usize) -> usize {
        if self.labels[at] != TWIN {
            return at;
        }
        let within = |place: usize, length: usize| match place {
            0 => length,
            place if place > length => 1,
            place => place,
        };
        let (x, y) = (at % self.stride, at / self.stride);
        within(y, self.height) * self.stride + within(x, self.width)
    }

    /// Finds all parts, and writes each pixel with `write` (column, row, value), the value being
    /// `rule` of its label and of the highest label of its part. Then all is outside.
    pub fn parts(
        &mut self,
        rule: impl Fn(u32, u32) -> f32,
        mut write: impl FnMut(usize, usize, f32),
    ) -> Result<(), BlockError> {
        for y in 1..=self.height {
            self.count(self.width)?;
            let row = y * self.stride;
            for at in row + 1..=row + self.width {
                if (1..SEEN).contains(&self.labels[at]) {
                    let highest = self.gather(at)?;
                    for i in 0..self.queue.len() {
                        let at = self.queue[i] as usize;
                        let value = rule(self.labels[at] - SEEN, highest);
                        write(at % self.stride - 1, at / self.stride - 1, value);
                        self.labels[at] = OUTSIDE;
                    }
                }
            }
        }
        Ok(())
    }

    /// Fills the queue with the part that a pixel belongs to. Returns its highest label.
    fn gather(&mut self, first: usize) -> Result<u32, BlockError> {
        let (eight, mut highest, mut next) = (self.eight(), 0, 0);
        self.queue.clear();
        self.see(first);
        while next < self.queue.len() {
            let at = self.queue[next] as usize;
            next += 1;
            self.count(1)?;
            highest = highest.max(self.labels[at] - SEEN);
            for step in eight {
                let to = self.home(at.wrapping_add_signed(step));
                if (1..SEEN).contains(&self.labels[to]) {
                    self.see(to);
                }
            }
        }
        Ok(highest)
    }

    fn see(&mut self, at: usize) {
        self.labels[at] += SEEN;
        self.push(at);
    }

    fn count(&mut self, pixels: usize) -> Result<(), BlockError> {
        self.rest = self.rest.saturating_sub(pixels + 1);
        if self.rest == 0 {
            self.rest = CHECK;
            self.work.check()?;
        }
        Ok(())
    }

    fn four(&self) -> [isize; 4] {
        let down = self.stride.cast_signed();
        [-down, -1, 1, down]
    }

    fn eight(&self) -> [isize; 8] {
        let down = self.stride.cast_signed();
        [-down - 1, -down, -down + 1, -1, 1, down - 1, down, down + 1]
    }
}

fn twin_of(label: u32) -> u32 {
    if label == OUTSIDE { OUTSIDE } else { TWIN }
}

/// How far a pixel of a part has come on the way to its middle: generation `own` of `highest`,
/// counted from the rim.
pub fn inward(own: u32, highest: u32) -> f32 {
    math::single(f64::from(own) / (f64::from(highest) + 1.0))
}
