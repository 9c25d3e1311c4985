//! Ages of loss from Euclidean distances: the front `even`.
//!
//! Where there is no outside, T = 1 - in / (max in + 1); where there is no inner region, parts
//! recede: T = out / (max out + 1), with the maximum of the part.

use std::sync::atomic::{AtomicU32, Ordering};

use ptlib_plugin::{BlockError, ImageMut, Row, Work};

use super::{
    distance::{Envelope, FAR, LONGEST, Rows},
    flood::Grid,
    hair_transition::{HairTransition, Islands},
    masks::Masks,
};

impl HairTransition {
    /// Computes T from Euclidean distances.
    pub(super) fn by_distance(
        &self,
        masks: &Masks<'_>,
        mut out: ImageMut<'_>,
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let [width, height] = masks.size();
        if width.max(height) > LONGEST {
            let message = format!("`front` is `even`, for which a side may have {LONGEST} pixels");
            return Err(BlockError::limit(message));
        }
        let mut inside = Rows::new(work, [width, height])?;
        let mut outside = Rows::new(work, [width, height])?;
        let rows = inside.steps.chunks_mut(width * Rows::CHUNK);
        let rows = rows.zip(outside.steps.chunks_mut(width * Rows::CHUNK)).enumerate();
        work.for_each(rows, |(chunk, (inside, outside))| {
            let rows = inside.chunks_exact_mut(width).zip(outside.chunks_exact_mut(width));
            for ((inside, outside), y) in rows.zip(chunk * Rows::CHUNK..) {
                masks.count(y);
                masks.write(y, inside, |outer, inner| if outer & inner { 0 } else { FAR });
                masks.write(y, outside, |outer, _| if outer { FAR } else { 0 });
            }
            work.check()
        })?;
        work.for_each([&mut inside, &mut outside], |rows| rows.spread(work))?;
        work.report(0.4);
        match (masks.counted()[1] > 0, masks.has_outside()) {
            (true, true) => self.between(&inside, &outside, out, work),
            (true, false) => self.to_farthest(&inside, out, work),
            (false, _) if self.islands == Islands::Drop => {
                (0..out.height()).for_each(|y| out.row_mut(0, y).fill(0.0));
                Ok(())
            }
            (false, false) => self.all_rim(out),
            (false, true) => self.to_middles(&outside, out, work),
        }
    }

    /// Between the inner region and the outside.
    fn between(
        &self,
        inside: &Rows<'_>,
        outside: &Rows<'_>,
        out: ImageMut<'_>,
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let width = inside.width;
        let mut rows = out.rows();
        work.for_each(rows.chunks_mut(Rows::CHUNK), |rows| {
            let mut envelope = Envelope::new(work, width)?;
            let [mut near, mut far] = [work.scratch::<u32>(width)?, work.scratch::<u32>(width)?];
            for Row { y, channels } in rows {
                work.check()?;
                envelope.write(inside.row(*y as usize), &mut near);
                envelope.write(outside.row(*y as usize), &mut far);
                for (pixel, (near, far)) in channels[0].iter_mut().zip(near.iter().zip(&*far)) {
                    let [near, far] = [near, far].map(|square| root(*square));
                    let loss = far / (near + far);
                    *pixel = if far > 0.0 { loss.max(self.least) } else { 0.0 };
                }
            }
            Ok(())
        })
    }

    /// From the inner region on, until all is covered: there is no outside.
    fn to_farthest(
        &self,
        inside: &Rows<'_>,
        out: ImageMut<'_>,
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let width = inside.width;
        let (mut rows, farthest) = (out.rows(), AtomicU32::new(0));
        work.for_each(rows.chunks_mut(Rows::CHUNK), |rows| {
            let (mut envelope, mut near) = (Envelope::new(work, width)?, work.scratch(width)?);
            for Row { y, channels } in rows {
                work.check()?;
                envelope.write(inside.row(*y as usize), &mut near);
                let most = near.iter().fold(0, |most, square| most.max(*square));
                farthest.fetch_max(most, Ordering::Relaxed);
                for (pixel, square) in channels[0].iter_mut().zip(near.iter()) {
                    *pixel = root(*square);
                }
            }
            Ok(())
        })?;
        let all = root(farthest.into_inner()) + 1.0;
        for Row { channels, .. } in &mut rows {
            channels[0].iter_mut().for_each(|near| *near = (1.0 - *near / all).max(self.least));
        }
        Ok(())
    }

    /// From the rims to the middles of parts: there is no inner region.
    fn to_middles(
        &self,
        outside: &Rows<'_>,
        mut out: ImageMut<'_>,
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let size = [outside.width, out.height() as usize];
        let begin = || Envelope::new(work, outside.width);
        let mut grid = Grid::new(work, size, begin, |envelope, y, row| {
            envelope.write(outside.row(y), row);
        })?;
        (0..out.height()).for_each(|y| out.row_mut(0, y).fill(0.0));
        let rule = |own, highest| root(own) / (root(highest) + 1.0);
        grid.parts(rule, |x, y, loss| self.put(&mut out, [x, y], loss))
    }
}

/// The root of a square below 2³¹.
#[inline(always)]
fn root(square: u32) -> f32 {
    (square.cast_signed() as f32).sqrt()
}
