//! Blurred octaves in 8-bit levels, as an image.
//!
//! An octave is truncated to levels before its box blur, and the blur truncates again
//! (specification 2.0, BOX), so it cannot be folded into the weights. The sums of the box are whole
//! numbers that slide from pixel to pixel: a pixel costs the same for every radius.

use super::octave::{CHUNK, Octave, Scratch};
use crate::{block::prelude::*, math::levels::EightBit};

/// Rows that one task computes: enough to outweigh the rows around them that it needs as well.
const BAND: usize = 64;

/// The most memory of [`add`] and of the image that it adds to, in bytes.
pub(super) fn bytes_of(width: u32, height: u32) -> u64 {
    let pixels = u64::from(width) * u64::from(height);
    pixels * (size_of::<u8>() + size_of::<u16>()) as u64 + u64::from(width) * 1024
}

/// Adds an octave, blurred by a box of `radius`, to the levels in `image` and clamps the sums.
pub(super) fn add(
    octave: &Octave,
    radius: u32,
    image: &mut [u8],
    cx: &Context<'_>,
) -> Result<(), Error> {
    let width = cx.width as usize;
    // The sums of 2r + 1 levels, r ≤ 9, are below 2¹⁶.
    let mut sums = vec![0_u16; image.len()];
    cx.parallel_pieces(&mut sums, BAND * width, |band, sums| {
        cx.check()?;
        cx.simd.run(Across { octave, radius, y: band * BAND, width, sums });
        Ok(())
    })?;
    let sums = &sums;
    cx.parallel_pieces(image, BAND * width, |band, image| {
        cx.check()?;
        cx.simd.run(Down { sums, radius, y: band * BAND, width, image });
        Ok(())
    })
}

/// Writes the sums of an octave's levels over 2r + 1 pixels of their row.
struct Across<'a> {
    octave: &'a Octave,
    radius: u32,
    /// The first row.
    y: usize,
    width: usize,
    sums: &'a mut [u16],
}

impl Kernel for Across<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let radius = self.radius as usize;
        let mut scratch = Scratch::new();
        // The row with what lies beyond its edges: as far as the box reaches.
        let mut levels = vec![0_u16; self.width + 2 * radius];
        for (sums, y) in self.sums.chunks_exact_mut(self.width).zip(self.y..) {
            for x in (0..self.width).step_by(CHUNK) {
                let len = CHUNK.min(self.width - x);
                self.octave.write::<EightBit>(x, row_number(y), len, &mut scratch);
                let levels = &mut levels[radius + x..][..len];
                for (level, value) in levels.iter_mut().zip(&scratch.values) {
                    *level = u16::from(convert::to_byte((value + 128.0) * (1.0 / 255.0)));
                }
            }
            for i in 0..radius {
                let before = (i + self.width * radius - radius) % self.width;
                levels[i] = levels[radius + before];
                levels[radius + self.width + i] = levels[radius + i % self.width];
            }
            let mut sum: u16 = levels[..2 * radius].iter().sum();
            for (x, out) in sums.iter_mut().enumerate() {
                sum += levels[x + 2 * radius];
                *out = sum;
                sum -= levels[x];
            }
        }
    }
}

/// Adds the means over the 2r + 1 rows around each row to levels, and clamps.
struct Down<'a> {
    sums: &'a [u16],
    radius: u32,
    /// The first row.
    y: usize,
    width: usize,
    image: &'a mut [u8],
}

impl Kernel for Down<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let height = self.sums.len() / self.width;
        let side = 2 * self.radius as usize + 1;
        // Row `y` of the image with wrap-around; `y` counts from the first row of the first box.
        let row = |y: usize| {
            let y = (y + self.y + height * side - self.radius as usize) % height;
            &self.sums[y * self.width..][..self.width]
        };
        let mut boxes = vec![0_u32; self.width];
        for y in 0..side - 1 {
            boxes.iter_mut().zip(row(y)).for_each(|(sum, row)| *sum += u32::from(*row));
        }
        let share = 1.0 / convert::pixels(row_number(side * side));
        for (y, image) in self.image.chunks_exact_mut(self.width).enumerate() {
            let (entering, leaving) = (row(y + side - 1), row(y));
            for (((sum, level), entering), leaving) in
                boxes.iter_mut().zip(image).zip(entering).zip(leaving)
            {
                *sum += u32::from(*entering);
                // Half a unit more, so that rounding never moves an exact quotient below itself.
                let mean = convert::truncate((convert::pixels(*sum) + 0.5) * share);
                let added = i32::from(*level) + mean - i32::from(super::MIDDLE);
                *level = convert::clamped_byte(added);
                *sum -= u32::from(*leaving);
            }
        }
    }
}

/// A number of rows as 32 bits, which images never exceed.
fn row_number(y: usize) -> u32 {
    u32::try_from(y).unwrap_or(u32::MAX)
}
