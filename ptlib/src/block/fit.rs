//! Pictures from outside, brought to the size of the graph.

use super::{Context, Interpolation};
use crate::{
    error::Error,
    math::levels::Levels,
    value::{Image, Resampling},
};

/// Rows that one task makes.
const ROWS: usize = 16;

impl Context<'_> {
    /// The first `planes` planes of a picture, stretched to the size to make.
    ///
    /// # Errors
    /// [`NoMemory`](crate::ErrorKind::NoMemory), [`Cancelled`](crate::ErrorKind::Cancelled).
    pub fn stretched<L: Levels>(
        &self,
        picture: &Image,
        planes: usize,
        interpolation: Interpolation,
    ) -> Result<Image, Error> {
        let from = (picture.width(), picture.height());
        let resampling = Resampling::new(from, (self.width, self.height), interpolation.into());
        let mut image = self.new_image(planes)?;
        for (channel, plane) in image.planes_mut().enumerate() {
            let source = picture.channel(channel);
            let width = self.width as usize;
            self.parallel_pieces(plane, ROWS * width, |piece, rows| {
                self.check()?;
                for (row, y) in rows.chunks_exact_mut(width).zip(piece * ROWS..) {
                    resampling.row::<L>(source, 0, u32::try_from(y).unwrap_or(u32::MAX), row);
                }
                Ok(())
            })?;
        }
        Ok(image)
    }
}
