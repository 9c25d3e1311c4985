//! The regions of hair as two masks.

use std::sync::atomic::{AtomicUsize, Ordering};

use ptlib_plugin::Image;

/// The two masks, and how many pixels were found to be outer, sources, and inner but not outer.
pub struct Masks<'a> {
    pub images: [Image<'a>; 2],
    pub threshold: f32,
    pub counts: [AtomicUsize; 3],
}

impl Masks<'_> {
    /// Width and height.
    pub fn size(&self) -> [usize; 2] {
        [self.images[0].width() as usize, self.images[0].height() as usize]
    }

    /// Writes a number for each pixel of a row, from whether it is outer and whether inner.
    #[inline(always)]
    pub fn write<T>(&self, y: usize, row: &mut [T], number: impl Fn(bool, bool) -> T) {
        let y = u32::try_from(y).unwrap_or(u32::MAX);
        let [outer, inner] = self.images.map(|image| &image.row(0, y)[..row.len()]);
        for i in 0..row.len() {
            row[i] = number(outer[i] >= self.threshold, inner[i] >= self.threshold);
        }
    }

    /// Counts a row. Sums do not depend on who comes first.
    pub fn count(&self, y: usize) {
        let y = u32::try_from(y).unwrap_or(u32::MAX);
        let [outer, inner] = self.images.map(|image| image.row(0, y));
        let mut counts = [0_u32; 3];
        for (outer, inner) in outer.iter().zip(inner) {
            let [outer, inner] = [outer, inner].map(|value| *value >= self.threshold);
            counts[0] += u32::from(outer);
            counts[1] += u32::from(outer & inner);
            counts[2] += u32::from(inner & !outer);
        }
        for (sum, count) in self.counts.iter().zip(counts) {
            sum.fetch_add(count as usize, Ordering::Relaxed);
        }
    }

    /// What has been counted.
    pub fn counted(&self) -> [usize; 3] {
        [0, 1, 2].map(|place| self.counts[place].load(Ordering::Relaxed))
    }

    /// Whether there is a pixel that is not outer.
    pub fn has_outside(&self) -> bool {
        let [width, height] = self.size();
        self.counted()[0] < width * height
    }
}
