//! Images: one, three or four planes.

use std::sync::Arc;

use super::{BufferPool, Plane};
use crate::error::Error;

/// The most planes an image has: red, green, blue, alpha.
pub const MAX_PLANES: usize = 4;

/// A picture of W × H pixels: 1 (grey), 3 (red, green, blue) or 4 (and alpha) planes of `f32`.
///
/// Values are sRGB-encoded as the user sees them, 0..1 where the output that made them is of range
/// *unit*, any finite number where it is *free*. Row 0 is the top row. Planes are shared: cloning
/// an image, or building one from planes of others, copies no pixel.
#[derive(Debug, Clone)]
pub struct Image {
    width: u32,
    height: u32,
    planes: Vec<Arc<Plane>>,
}

impl Image {
    /// An image of 1, 3 or 4 planes with unspecified contents (see [`BufferPool::plane`]).
    ///
    /// # Errors
    /// [`NoMemory`](crate::ErrorKind::NoMemory) if the system has no memory for it.
    pub fn new(
        pool: &Arc<BufferPool>,
        width: u32,
        height: u32,
        planes: usize,
    ) -> Result<Self, Error> {
        let len = width as usize * height as usize;
        let planes =
            (0..planes).map(|_| pool.plane(len).map(Arc::new)).collect::<Result<_, _>>()?;
        Ok(Self { width, height, planes })
    }

    /// Width in pixels.
    #[inline]
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    #[inline]
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The number of planes: 1, 3 or 4.
    #[inline]
    #[must_use]
    pub fn planes(&self) -> usize {
        self.planes.len()
    }

    /// Whether the image has one plane.
    #[inline]
    #[must_use]
    pub fn is_grey(&self) -> bool {
        self.planes.len() == 1
    }

    /// The numbers of channel `channel` (0 red, 1 green, 2 blue, 3 alpha), row by row. A grey image
    /// has its one plane as red, green and blue.
    #[inline]
    #[must_use]
    pub fn channel(&self, channel: usize) -> &[f32] {
        self.planes[if self.is_grey() { 0 } else { channel }].data()
    }

    /// Row `y` of channel `channel`.
    #[inline(always)]
    #[must_use]
    pub fn row(&self, channel: usize, y: u32) -> &[f32] {
        let width = self.width as usize;
        &self.channel(channel)[y as usize * width..][..width]
    }

    /// The planes to write, for the image's only owner.
    ///
    /// # Panics
    /// If a plane is shared. Whoever makes an image writes it before handing it out.
    pub fn planes_mut(&mut self) -> impl Iterator<Item = &mut [f32]> {
        self.planes.iter_mut().map(|plane| {
            Arc::get_mut(plane).expect("an image is written by its maker only").data_mut()
        })
    }

    /// The image with `change` applied to each plane: in place where nobody else holds the plane,
    /// otherwise to a copy. A plane that serves several channels is changed once.
    ///
    /// # Errors
    /// What `change` returns, or [`NoMemory`](crate::ErrorKind::NoMemory) for a copy.
    pub(crate) fn map_planes(
        mut self,
        pool: &Arc<BufferPool>,
        change: impl Fn(&mut [f32]) -> Result<(), Error>,
    ) -> Result<Self, Error> {
        let twins: Vec<Option<usize>> = (0..self.planes.len())
            .map(|i| (0..i).find(|&j| Arc::ptr_eq(&self.planes[i], &self.planes[j])))
            .collect();
        let mut changed: Vec<Arc<Plane>> = Vec::with_capacity(self.planes.len());
        let mut planes = std::mem::take(&mut self.planes);
        for (i, twin) in twins.iter().enumerate().rev() {
            if twin.is_some() {
                planes.remove(i);
            }
        }
        let mut distinct = planes.into_iter();
        for twin in twins {
            let plane = match twin {
                Some(twin) => Arc::clone(&changed[twin]),
                None => {
                    let mut plane = distinct.next().expect("one distinct plane for each");
                    if Arc::get_mut(&mut plane).is_none() {
                        let mut copy = pool.plane(plane.data().len())?;
                        copy.data_mut().copy_from_slice(plane.data());
                        plane = Arc::new(copy);
                    }
                    change(Arc::get_mut(&mut plane).expect("nobody else holds it").data_mut())?;
                    plane
                }
            };
            changed.push(plane);
        }
        Ok(Self { planes: changed, ..self })
    }

    /// The image with three planes or more: a grey one gives its plane as red, green and blue.
    #[must_use]
    pub fn into_colour(mut self) -> Self {
        if self.is_grey() {
            let grey = Arc::clone(&self.planes[0]);
            self.planes.resize(3, grey);
        }
        self
    }

    /// The memory of the planes in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        Self::bytes_of(self.width, self.height, self.planes.len())
    }

    /// The memory that an image of that size takes, in bytes.
    #[must_use]
    pub fn bytes_of(width: u32, height: u32, planes: usize) -> u64 {
        u64::from(width) * u64::from(height) * planes as u64 * size_of::<f32>() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_is_every_colour_channel() {
        let mut image = Image::new(&BufferPool::new(), 2, 2, 1).unwrap();
        image.planes_mut().next().unwrap().copy_from_slice(&[0.0, 0.25, 0.5, 1.0]);
        assert!(image.is_grey());
        assert_eq!(image.channel(2), image.channel(0));
        assert_eq!(image.row(1, 1), &[0.5, 1.0]);
        assert_eq!(image.bytes(), 16);
        let colour = image.clone().into_colour();
        assert_eq!((colour.planes(), colour.row(2, 1)), (3, image.row(0, 1)));
        assert_eq!(colour.channel(0).as_ptr(), colour.channel(2).as_ptr());
    }
}
