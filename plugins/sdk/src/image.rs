//! Images as a block sees them: rows of floats, one plane a channel.

use std::marker::PhantomData;

use ptlib_plugin_abi::ptlp_tile;

/// A rectangle of an image at an input, to be read. Columns and rows count from the left upper
/// corner of the rectangle, which lies at ([`x`](Self::x), [`y`](Self::y)) of the image.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    tile: &'a ptlp_tile,
}

/// A rectangle of an image at an output, to be written as a whole.
#[derive(Debug)]
pub struct ImageMut<'a> {
    tile: &'a ptlp_tile,
    unique: PhantomData<&'a mut [f32]>,
}

/// A row of an output in all channels, to be written on a thread of its own.
#[derive(Debug)]
pub struct Row<'a> {
    /// The row's number in the rectangle.
    pub y: u32,
    /// One slice a channel.
    pub channels: Vec<&'a mut [f32]>,
}

// SAFETY: planes are memory that is only read while inputs live, by the contract.
unsafe impl Send for Image<'_> {}
// SAFETY: as above.
unsafe impl Sync for Image<'_> {}
// SAFETY: planes of an output are only reached through this object, by the contract.
unsafe impl Send for ImageMut<'_> {}
// SAFETY: through a shared reference, nothing of the planes can be reached.
unsafe impl Sync for ImageMut<'_> {}

impl<'a> Image<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    pub(crate) unsafe fn new(tile: &'a ptlp_tile) -> Self {
        Self { tile }
    }

    /// Planes: 1 (grey), 3 (red, green, blue) or 4 (and alpha).
    #[inline]
    #[must_use]
    pub fn channels(&self) -> usize {
        self.tile.channels as usize
    }

    /// Width of the rectangle.
    #[inline]
    #[must_use]
    pub fn width(&self) -> u32 {
        self.tile.width
    }

    /// Height of the rectangle.
    #[inline]
    #[must_use]
    pub fn height(&self) -> u32 {
        self.tile.height
    }

    /// Column of its left edge in the whole image.
    #[inline]
    #[must_use]
    pub fn x(&self) -> u32 {
        self.tile.x
    }

    /// Row of its upper edge in the whole image.
    #[inline]
    #[must_use]
    pub fn y(&self) -> u32 {
        self.tile.y
    }

    /// Width of the whole image.
    #[inline]
    #[must_use]
    pub fn image_width(&self) -> u32 {
        self.tile.image_width
    }

    /// Height of the whole image.
    #[inline]
    #[must_use]
    pub fn image_height(&self) -> u32 {
        self.tile.image_height
    }

    /// Whether there are pixels here; not in `prepare`, for an image that comes row by row.
    #[inline]
    #[must_use]
    pub fn is_there(&self) -> bool {
        !self.tile.planes[0].is_null()
    }

    /// A row of a channel. A grey image has its one plane as red, green and blue.
    ///
    /// # Panics
    /// If there is no such row or channel.
    #[inline]
    #[must_use]
    pub fn row(&self, channel: usize, y: u32) -> &'a [f32] {
        let start = self.plane(channel, y);
        // SAFETY: a row of the rectangle has as many floats as it is wide, and is only read while
        // inputs live.
        unsafe { std::slice::from_raw_parts(start, self.tile.width as usize) }
    }

    #[inline]
    fn plane(&self, channel: usize, y: u32) -> *const f32 {
        let plane = self.tile.planes.get(channel).copied().unwrap_or(std::ptr::null_mut());
        assert!(!plane.is_null(), "the image has no channel {channel}");
        assert!(y < self.tile.height, "row {y} of {}", self.tile.height);
        // SAFETY: inside of the plane, which has as many rows as the rectangle is high.
        unsafe { plane.add(y as usize * self.tile.row_stride) }
    }

    /// The sample at a column and a row of a whole image, which wraps around.
    #[inline]
    #[must_use]
    pub fn wrapped(&self, channel: usize, x: i64, y: i64) -> f32 {
        let y = wrap(y, self.tile.height);
        self.row(channel, y)[wrap(x, self.tile.width) as usize]
    }
}

/// A column or a row of an image of that width or height, which wraps around.
#[inline]
fn wrap(place: i64, length: u32) -> u32 {
    u32::try_from(place.rem_euclid(i64::from(length.max(1)))).unwrap_or_default()
}

impl<'a> ImageMut<'a> {
    /// # Safety
    /// The contract, for as long as `'a`, and nobody else makes one of the same output meanwhile.
    pub(crate) unsafe fn new(tile: &'a ptlp_tile) -> Self {
        Self { tile, unique: PhantomData }
    }

    /// Planes: 1 (grey), 3 (red, green, blue) or 4 (and alpha).
    #[inline]
    #[must_use]
    pub fn channels(&self) -> usize {
        self.tile.channels as usize
    }

    /// Width of the rectangle.
    #[inline]
    #[must_use]
    pub fn width(&self) -> u32 {
        self.tile.width
    }

    /// Height of the rectangle.
    #[inline]
    #[must_use]
    pub fn height(&self) -> u32 {
        self.tile.height
    }

    /// Column of its left edge in the whole image.
    #[inline]
    #[must_use]
    pub fn x(&self) -> u32 {
        self.tile.x
    }

    /// Row of its upper edge in the whole image.
    #[inline]
    #[must_use]
    pub fn y(&self) -> u32 {
        self.tile.y
    }

    /// Width of the whole image.
    #[inline]
    #[must_use]
    pub fn image_width(&self) -> u32 {
        self.tile.image_width
    }

    /// Height of the whole image.
    #[inline]
    #[must_use]
    pub fn image_height(&self) -> u32 {
        self.tile.image_height
    }

    /// A row of a channel, to be written.
    ///
    /// # Panics
    /// If there is no such row or channel.
    #[inline]
    pub fn row_mut(&mut self, channel: usize, y: u32) -> &mut [f32] {
        assert!(channel < self.channels() && y < self.tile.height, "no row {y}, {channel}");
        // SAFETY: inside of the plane.
        let start = unsafe { self.tile.planes[channel].add(y as usize * self.tile.row_stride) };
        // SAFETY: a row of the rectangle has as many floats as it is wide; `self` is borrowed, and
        // the only way to it.
        unsafe { std::slice::from_raw_parts_mut(start, self.tile.width as usize) }
    }

    /// All rows, each to be written by whoever holds it: for work on several threads.
    #[must_use]
    pub fn rows(self) -> Vec<Row<'a>> {
        let row = |y: u32| {
            let plane = |channel: usize| {
                // SAFETY: inside of the plane; each row and channel is handed out once.
                unsafe {
                    let start = self.tile.planes[channel].add(y as usize * self.tile.row_stride);
                    std::slice::from_raw_parts_mut(start, self.tile.width as usize)
                }
            };
            Row { y, channels: (0..self.channels()).map(plane).collect() }
        };
        (0..self.tile.height).map(row).collect()
    }
}
