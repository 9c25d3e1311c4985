//! Blurred octaves in 8-bit levels, as an image.
//!
//! An octave is truncated to levels before its box blur, and the blur truncates again
//! (specification 2.0, BOX), so it cannot be folded into the weights. The sums of the box are whole
//! numbers that slide from pixel to pixel ([`LevelBox`]): a pixel costs the same for every radius.

use super::octave::{CHUNK, Octave, Scratch};
use crate::{block::prelude::*, math::levels::EightBit};
use box_sum::LevelBox;

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
    let boxes = LevelBox::new(radius, cx.width);
    let mut sums = vec![0_u16; image.len()];
    cx.parallel_pieces(&mut sums, BAND * width, |band, sums| {
        cx.check()?;
        cx.simd.run(Across { octave, boxes, y: band * BAND, width, sums });
        Ok(())
    })?;
    let sums = &sums;
    cx.parallel_pieces(image, BAND * width, |band, image| {
        cx.check()?;
        cx.simd.run(Down { sums, boxes, y: band * BAND, image });
        Ok(())
    })
}

/// Writes the sums of an octave's levels over 2r + 1 pixels of their row.
struct Across<'a> {
    octave: &'a Octave,
    boxes: LevelBox,
    /// The first row.
    y: usize,
    width: usize,
    sums: &'a mut [u16],
}

impl Kernel for Across<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut scratch = Scratch::new();
        let mut levels = vec![0; self.width];
        for (sums, y) in self.sums.chunks_exact_mut(self.width).zip(self.y..) {
            for x in (0..self.width).step_by(CHUNK) {
                let len = CHUNK.min(self.width - x);
                self.octave.write::<EightBit>(x, row_number(y), len, &mut scratch);
                for (level, value) in levels[x..][..len].iter_mut().zip(&scratch.values) {
                    *level = convert::to_byte((value + 128.0) * (1.0 / 255.0));
                }
            }
            self.boxes.across(&levels, sums);
        }
    }
}

/// Adds the means of boxes to levels, and clamps.
struct Down<'a> {
    sums: &'a [u16],
    boxes: LevelBox,
    /// The first row.
    y: usize,
    image: &'a mut [u8],
}

impl Kernel for Down<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.boxes.down(self.sums, self.y, self.image, |level, mean| {
            let added = i32::from(*level) + mean - i32::from(super::MIDDLE);
            *level = convert::clamped_byte(added);
        });
    }
}

/// A number of rows as 32 bits, which images never exceed.
fn row_number(y: usize) -> u32 {
    u32::try_from(y).unwrap_or(u32::MAX)
}
