//! Pixels as other programs want them: interleaved, in the number format they asked for.

use std::sync::Arc;

use super::{BufferPool, Image};
use crate::{
    error::{Error, ErrorKind},
    math::convert::{to_byte, to_word},
};

/// How the pixels of a result are laid out: interleaved channels, rows from the top. The numbers
/// are those of the C ABI: channels in the low byte, bytes per channel in the next, then whether
/// channels are floating-point numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Format {
    /// One byte, 0..255.
    Grey8 = 0x0101,
    /// Three bytes.
    Rgb8 = 0x0103,
    /// Four bytes.
    Rgba8 = 0x0104,
    /// One 16-bit number, 0..65535, in the machine's byte order.
    Grey16 = 0x0201,
    /// Three 16-bit numbers.
    Rgb16 = 0x0203,
    /// Four 16-bit numbers.
    Rgba16 = 0x0204,
    /// One 32-bit floating-point number.
    GreyF32 = 0x1_0401,
    /// Three 32-bit floating-point numbers.
    RgbF32 = 0x1_0403,
    /// Four 32-bit floating-point numbers.
    RgbaF32 = 0x1_0404,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 9] = [
        Self::Grey8,
        Self::Rgb8,
        Self::Rgba8,
        Self::Grey16,
        Self::Rgb16,
        Self::Rgba16,
        Self::GreyF32,
        Self::RgbF32,
        Self::RgbaF32,
    ];

    /// The number of channels: 1, 3 or 4.
    #[must_use]
    pub fn channels(self) -> usize {
        match self {
            Self::Grey8 | Self::Grey16 | Self::GreyF32 => 1,
            Self::Rgb8 | Self::Rgb16 | Self::RgbF32 => 3,
            Self::Rgba8 | Self::Rgba16 | Self::RgbaF32 => 4,
        }
    }

    /// Bytes of one channel of one pixel: 1, 2 or 4.
    #[must_use]
    pub fn bytes_per_channel(self) -> usize {
        match self {
            Self::Grey8 | Self::Rgb8 | Self::Rgba8 => 1,
            Self::Grey16 | Self::Rgb16 | Self::Rgba16 => 2,
            Self::GreyF32 | Self::RgbF32 | Self::RgbaF32 => 4,
        }
    }

    /// Bytes of one pixel.
    #[must_use]
    pub fn bytes_per_pixel(self) -> usize {
        self.channels() * self.bytes_per_channel()
    }

    /// Writes one row of pixels. `rows` are 1, 3 or 4 rows of equal length; `out` has
    /// [`bytes_per_pixel`](Self::bytes_per_pixel) times that many bytes. Integers are clamped to
    /// their range and rounded to nearest. A colour becomes grey by its mean; a missing alpha is 1.
    pub(crate) fn write_row(self, rows: &[&[f32]], out: &mut [u8]) {
        match self.bytes_per_channel() {
            1 => self.interleave(rows, out, |value| [to_byte(value)]),
            2 => self.interleave(rows, out, |value| to_word(value).to_ne_bytes()),
            _ => self.interleave(rows, out, f32::to_ne_bytes),
        }
    }

    #[inline(always)]
    fn interleave<const N: usize>(
        self,
        rows: &[&[f32]],
        out: &mut [u8],
        convert: impl Fn(f32) -> [u8; N],
    ) {
        let (channels, _) = out.as_chunks_mut::<N>();
        match (self.channels(), rows) {
            (1, [red, green, blue, ..]) => {
                for (((out, r), g), b) in channels.iter_mut().zip(*red).zip(*green).zip(*blue) {
                    *out = convert((r + g + b) * (1.0 / 3.0));
                }
            }
            (count, _) => {
                for channel in 0..count {
                    let targets = channels.iter_mut().skip(channel).step_by(count);
                    match rows.get(if rows.len() == 1 && channel < 3 { 0 } else { channel }) {
                        Some(row) => {
                            targets.zip(*row).for_each(|(out, value)| *out = convert(*value));
                        }
                        None => targets.for_each(|out| *out = convert(1.0)),
                    }
                }
            }
        }
    }
}

impl Format {
    /// Reads one channel of a row of pixels.
    fn read_row(self, pixels: &[u8], channel: usize, targets: &mut [f32]) {
        let size = self.bytes_per_channel();
        let pixels = pixels.chunks_exact(self.bytes_per_pixel());
        for (target, pixel) in targets.iter_mut().zip(pixels) {
            *target = match pixel[channel * size..][..size] {
                [byte] => f32::from(byte) / 255.0,
                [a, b] => f32::from(u16::from_ne_bytes([a, b])) / 65535.0,
                [a, b, c, d] => f32::from_ne_bytes([a, b, c, d]),
                _ => 0.0,
            };
        }
    }
}

/// A finished picture in one [`Format`]: rows follow each other without gaps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pixels {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The format of a pixel.
    pub format: Format,
    /// width · height · [`Format::bytes_per_pixel`] bytes.
    pub data: Vec<u8>,
}

impl Image {
    /// A picture of pixels in `format`: `bytes` are rows from the top, `stride` bytes from one to
    /// the next. Integers become k/255 and k/65535.
    ///
    /// # Errors
    /// [`ErrorKind::BufferTooSmall`] if they are too few, [`ErrorKind::OutOfRange`] if a number is
    /// not finite, [`ErrorKind::NoMemory`].
    pub fn from_pixels(
        pool: &Arc<BufferPool>,
        (width, height): (u32, u32),
        format: Format,
        (bytes, stride): (&[u8], usize),
    ) -> Result<Self, Error> {
        let row = width as usize * format.bytes_per_pixel();
        let needed = (height as usize)
            .checked_sub(1)
            .and_then(|rows| rows.checked_mul(stride)?.checked_add(row));
        if stride < row || needed.is_none_or(|needed| needed > bytes.len()) {
            let message = format!(
                "{} bytes are given, rows of {stride}; too few for {width} × {height} of {row}",
                bytes.len()
            );
            return Err(Error::new(ErrorKind::BufferTooSmall, message));
        }
        let mut image = Self::new(pool, width, height, format.channels())?;
        for (channel, plane) in image.planes_mut().enumerate() {
            let rows = plane.chunks_exact_mut((width as usize).max(1));
            for (targets, pixels) in rows.zip(bytes.chunks(stride.max(1))) {
                format.read_row(&pixels[..row], channel, targets);
            }
        }
        image.check_finite()?;
        Ok(image)
    }

    fn check_finite(&self) -> Result<(), Error> {
        let planes = (0..self.planes()).map(|channel| self.channel(channel));
        let numbers = planes.flat_map(|plane| plane.iter().enumerate());
        let mut strange = numbers.filter(|(_, number)| !number.is_finite());
        let Some((first, number)) = strange.next() else { return Ok(()) };
        let width = self.width() as usize;
        let message = format!(
            "the pixel at ({}, {}) has {number}, allowed finite numbers; {} such numbers",
            first % width,
            first / width,
            strange.count() + 1
        );
        Err(Error::new(ErrorKind::OutOfRange, message))
    }

    /// The picture in `format`.
    #[must_use]
    pub fn to_pixels(&self, format: Format) -> Pixels {
        let stride = self.width() as usize * format.bytes_per_pixel();
        let mut data = vec![0; stride * self.height() as usize];
        if stride > 0 {
            for (y, out) in (0..self.height()).zip(data.chunks_exact_mut(stride)) {
                self.write_row(y, format, out);
            }
        }
        Pixels { width: self.width(), height: self.height(), format, data }
    }

    /// Writes row `y` in `format`; `out` has W · [`Format::bytes_per_pixel`] bytes.
    pub fn write_row(&self, y: u32, format: Format, out: &mut [u8]) {
        let mut rows: [&[f32]; super::MAX_PLANES] = [&[]; super::MAX_PLANES];
        for (channel, row) in rows.iter_mut().enumerate().take(self.planes()) {
            *row = self.row(channel, y);
        }
        format.write_row(&rows[..self.planes()], out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_a_format_tells_its_layout() {
        for format in Format::ALL {
            let number = format as u32;
            assert_eq!(number as usize & 0xff, format.channels());
            assert_eq!(number as usize >> 8 & 0xff, format.bytes_per_channel());
        }
    }

    #[test]
    fn pixels_come_back_as_they_were() {
        let pool = BufferPool::new();
        let bytes: Vec<u8> = (0..28).map(|i| i * 9).collect();
        for format in [Format::Grey8, Format::Rgb8, Format::Rgba8, Format::Rgb16] {
            let (row, stride) = (2 * format.bytes_per_pixel(), 14);
            let image = Image::from_pixels(&pool, (2, 2), format, (&bytes, stride)).unwrap();
            assert_eq!(image.planes(), format.channels());
            let expected = [&bytes[..row], &bytes[stride..stride + row]].concat();
            assert_eq!(image.to_pixels(format).data, expected, "{format:?}");
        }
        let error = Image::from_pixels(&pool, (2, 3), Format::Grey8, (&bytes, 14)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BufferTooSmall);
        let floats = [0.5, f32::NAN, 2.0, f32::INFINITY].map(f32::to_ne_bytes).concat();
        let error = Image::from_pixels(&pool, (2, 2), Format::GreyF32, (&floats, 8)).unwrap_err();
        let expected = "the pixel at (1, 0) has NaN, allowed finite numbers; 2 such numbers";
        assert_eq!(error.to_string(), expected);
    }

    #[test]
    fn rows_are_interleaved_rounded_and_clamped() {
        let rows: [&[f32]; 3] = [&[0.0, 2.0], &[0.5, 0.25], &[-1.0, f32::NAN]];
        let mut out = [0; 6];
        Format::Rgb8.write_row(&rows, &mut out);
        assert_eq!(out, [0, 128, 0, 255, 64, 0]);
        let mut out = [0; 8];
        Format::Rgba8.write_row(&rows[..1], &mut out);
        assert_eq!(out, [0, 0, 0, 255, 255, 255, 255, 255]);
        let mut out = [0; 4];
        Format::Grey16.write_row(&[&[1.0, 0.5]], &mut out);
        assert_eq!(out, [0xff, 0xff, 0x00, 0x80]);
        let mut out = [0; 2];
        Format::Grey8.write_row(&[&[0.0, 1.0], &[0.0, 1.0], &[0.3, 1.0]], &mut out);
        assert_eq!(out, [26, 255]);
    }
}
