//! Sums along the lines of whole images, made on all threads for blocks that prepare themselves.

use super::Context;
use crate::{
    error::Error,
    math::{levels::Levels, simd::Kernel},
    value::{
        Image,
        box_sum::{FixedPoint, LinePlan, LineSums, SlidingSum, SquareSums, Window},
    },
};

/// Rows that are summed in one go.
const ROWS: usize = 16;

impl Context<'_> {
    /// The sums of `plan` in the first `planes` planes of `image`. Announce their memory, which is
    /// that of as many planes.
    ///
    /// # Errors
    /// [`NoMemory`](crate::ErrorKind::NoMemory) or [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn line_sums<const K: usize>(
        &self,
        plan: &LinePlan<K>,
        image: &Image,
        planes: usize,
    ) -> Result<LineSums, Error> {
        let mut sums = self.unwritten_sums(image, planes)?;
        let mut bands = plan.bands(self.progress.threads(), image, &mut sums);
        self.parallel_pieces(&mut bands, 1, |_, bands| {
            bands.iter_mut().try_for_each(|band| band.fill(self.simd, || self.check()))
        })?;
        Ok(sums)
    }

    /// The sums of the squares of that radius around all pixels, in each plane of `image`. Announce
    /// their memory, which is that of the image.
    ///
    /// # Errors
    /// As [`line_sums`](Self::line_sums).
    pub fn square_sums<L: Levels>(&self, radius: u32, image: &Image) -> Result<SquareSums, Error> {
        let fixed = FixedPoint::new::<L>(2 * radius + 1);
        let size = (image.width(), image.height());
        let plan = LinePlan::new(size, 0, [Window::around(radius)], fixed);
        let columns = self.line_sums(&plan, image, image.planes())?;
        Ok(SquareSums::new(columns, radius, fixed))
    }

    /// The sums of `sliding` in each row of each plane of `image`, which must fit 32 bits.
    /// Announce their memory, which is that of the image.
    ///
    /// # Errors
    /// As [`line_sums`](Self::line_sums).
    pub fn row_sums<const K: usize>(
        &self,
        sliding: &SlidingSum<K>,
        image: &Image,
        fixed: FixedPoint,
    ) -> Result<LineSums, Error> {
        let width = image.width() as usize;
        let mut sums = self.unwritten_sums(image, image.planes())?;
        for (channel, plane) in sums.planes_mut().enumerate() {
            let source = image.channel(channel);
            self.parallel_pieces(plane, width * ROWS, |piece, sums| {
                let rows = &source[piece * width * ROWS..][..sums.len()];
                let rows = rows.chunks_exact(width).zip(sums.chunks_exact_mut(width));
                rows.into_iter().try_for_each(|(row, sums)| {
                    self.check()?;
                    self.simd.run(SumRow { sliding, row, fixed, sums });
                    Ok(())
                })
            })?;
        }
        Ok(sums)
    }

    fn unwritten_sums(&self, image: &Image, planes: usize) -> Result<LineSums, Error> {
        Ok(LineSums::new(self.new_image_sized(image.width(), image.height(), planes)?))
    }
}

struct SumRow<'a, const K: usize> {
    sliding: &'a SlidingSum<K>,
    row: &'a [f32],
    fixed: FixedPoint,
    sums: &'a mut [i32],
}

impl<const K: usize> Kernel for SumRow<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let store = |sum: i64| crate::math::convert::low_bits(sum.cast_unsigned());
        self.sliding.along(self.row, |value| self.fixed.integer(value), self.sums, store);
    }
}
