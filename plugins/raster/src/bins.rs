//! Things sorted into bins, in the order in which they come: count, then fill.

use std::ops::Range;

/// How many things each bin gets: the first pass.
#[derive(Debug)]
pub struct Count {
    starts: Vec<usize>,
}

/// Where the things of each bin lie in one list: the second pass fills it.
#[derive(Debug)]
pub struct Bins {
    /// The place of the next thing of each bin; behind its last one when all are there.
    cursors: Vec<usize>,
}

impl Count {
    /// Empty bins.
    #[must_use]
    pub fn new(bins: usize) -> Self {
        Self { starts: vec![0; bins] }
    }

    /// The memory of that many bins, without the list.
    #[must_use]
    pub fn bytes(bins: usize) -> u64 {
        (bins * size_of::<usize>()) as u64
    }

    /// One thing more for a bin.
    #[inline]
    pub fn add(&mut self, bin: usize) {
        self.starts[bin] += 1;
    }

    /// Entries of the list, and the bins to fill it with.
    #[must_use]
    pub fn finish(mut self) -> (usize, Bins) {
        let mut total = 0;
        for start in &mut self.starts {
            (*start, total) = (total, total + *start);
        }
        (total, Bins { cursors: self.starts })
    }
}

impl Bins {
    /// The place in the list for the next thing of a bin.
    #[inline]
    pub fn next(&mut self, bin: usize) -> usize {
        let cursor = &mut self.cursors[bin];
        *cursor += 1;
        *cursor - 1
    }

    /// Where the things of a bin are, once all have been put in.
    #[must_use]
    pub fn range(&self, bin: usize) -> Range<usize> {
        let start = bin.checked_sub(1).map_or(0, |before| self.cursors[before]);
        start..self.cursors[bin]
    }
}
