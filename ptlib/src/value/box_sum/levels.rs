//! Means of boxes of levels, for images of bytes that a block makes on its way.

use super::{SlidingSum, Window};
use crate::math::convert;

/// The box of (2r+1)² pixels around each pixel of an image of bytes. First sum each row
/// [across](Self::across); then go [down](Self::down) the rows of sums.
#[derive(Debug, Clone, Copy)]
pub struct LevelBox {
    radius: usize,
    width: usize,
    sliding: SlidingSum<1>,
}

impl LevelBox {
    /// The largest radius: sums across fit 16 bits, and means are exact in single precision.
    pub const MAX_RADIUS: u32 = 60;

    /// Boxes in rows of `width` pixels.
    ///
    /// # Panics
    /// If the radius is larger than [`MAX_RADIUS`](Self::MAX_RADIUS).
    #[must_use]
    pub fn new(radius: u32, width: u32) -> Self {
        assert!(radius <= Self::MAX_RADIUS, "sums of larger boxes do not fit");
        let sliding = SlidingSum::new([Window::around(radius)], width);
        Self { radius: radius as usize, width: width as usize, sliding }
    }

    /// Writes the sums of the boxes' rows along one row of the image.
    #[inline(always)]
    pub fn across(&self, levels: &[u8], sums: &mut [u16]) {
        let store = |sum: i64| {
            let [low, high, ..] = sum.to_le_bytes();
            u16::from_le_bytes([low, high])
        };
        self.sliding.along(levels, i32::from, sums, store);
    }

    /// Hands ⌊mean⌋ of the box around each pixel to `store`, with what belongs to the pixel in
    /// `out`: rows of the image from `first` on. `sums` are those of all rows.
    #[inline(always)]
    pub fn down<T>(&self, sums: &[u16], first: usize, out: &mut [T], store: impl Fn(&mut T, i32)) {
        let height = sums.len() / self.width;
        let side = 2 * self.radius + 1;
        // Row `y` of the image with wrap-around; `y` counts from the first row of the first box.
        let row = |y: usize| {
            let y = (y + first + height * side - self.radius) % height;
            &sums[y * self.width..][..self.width]
        };
        let mut boxes = vec![0_u32; self.width];
        for y in 0..side - 1 {
            boxes.iter_mut().zip(row(y)).for_each(|(sum, row)| *sum += u32::from(*row));
        }
        let share = 1.0 / convert::position(side * side);
        for (y, out) in out.chunks_exact_mut(self.width).enumerate() {
            let (entering, leaving) = (row(y + side - 1), row(y));
            for (((sum, out), entering), leaving) in
                boxes.iter_mut().zip(out).zip(entering).zip(leaving)
            {
                *sum += u32::from(*entering);
                // Half a unit more, so that rounding never moves an exact quotient below itself.
                store(out, convert::truncate((convert::pixels(*sum) + 0.5) * share));
                *sum -= u32::from(*leaving);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(levels: &[u8], width: i64, radius: i64, pixel: i64) -> i32 {
        let height = levels.len() as i64 / width;
        let square = (-radius..=radius).flat_map(|j| (-radius..=radius).map(move |i| (i, j)));
        let sum: i64 = square
            .map(|(i, j)| {
                let (x, y) = (pixel % width + i, pixel / width + j);
                let place = y.rem_euclid(height) * width + x.rem_euclid(width);
                i64::from(levels[convert::index(place)])
            })
            .sum();
        i32::try_from(sum / (2 * radius + 1).pow(2)).unwrap()
    }

    #[test]
    fn means_are_those_of_the_definition() {
        for (width, height) in [(1, 1), (3, 5), (40, 7), (9, 30)] {
            let level = |i: u32| (i.wrapping_mul(747_796_405) >> 24).to_le_bytes()[0];
            let noise: Vec<u8> = (0..width * height).map(level).collect();
            let flat = vec![255; noise.len()];
            for (levels, radius) in [(&noise, 0), (&noise, 2), (&noise, 9), (&flat, 3), (&flat, 60)]
            {
                let boxes = LevelBox::new(radius, width);
                let mut sums = vec![0; levels.len()];
                let rows = levels.chunks(width as usize).zip(sums.chunks_mut(width as usize));
                rows.into_iter().for_each(|(levels, sums)| boxes.across(levels, sums));
                // From the second row on, if there is one.
                let first = usize::from(height > 1);
                let start = first * width as usize;
                let mut found = vec![0; levels.len() - start];
                boxes.down(&sums, first, &mut found, |out, mean| *out = mean);
                for (found, pixel) in found.into_iter().zip(start as i64..) {
                    let expected = mean(levels, width.into(), radius.into(), pixel);
                    assert_eq!(found, expected, "{width}×{height}, radius {radius}, {pixel}");
                }
            }
        }
    }
}
