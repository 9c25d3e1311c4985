//! Texts, colour transitions and images from outside: always copied.

use ptlib_plugin_abi::values::{
    ptl_gradient_data, ptl_gradient_stop, ptl_image_data, ptl_text_data,
};

use super::{Import, check_array, read, wrong, zero};
use crate::{
    error::{Error, ErrorKind},
    value::{BufferPool, Format, Gradient, GradientStop, Image, check_bytes},
};

impl Import<'_> {
    /// A text, copied.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    pub(crate) unsafe fn text(&self, raw: *const ptl_text_data) -> Result<String, Error> {
        // SAFETY: the same promise.
        let data = unsafe { read(raw, "text") }?;
        zero(data.flags, "text.flags")?;
        if data.size as u64 > u64::from(self.limits.text_symbols) {
            let (size, limit) = (data.size, self.limits.text_symbols);
            let message = format!("the text has {size} bytes, allowed {limit}");
            return Err(Error::new(ErrorKind::Limit, message));
        }
        if data.size == 0 {
            // A text is usually not NULL when it is empty.
            return Ok(String::new());
        }
        check_array(data.text.cast::<u8>(), data.size, "text.text")?;
        // SAFETY: not null, few bytes, and `size` of them (the caller's promise).
        let bytes = unsafe { std::slice::from_raw_parts(data.text.cast::<u8>(), data.size) };
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(text.to_owned()),
            Err(error) => {
                wrong(format!("`text.text` is not UTF-8 from byte {}", error.valid_up_to()))
            }
        }
    }

    /// A colour transition, copied.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    pub(crate) unsafe fn gradient(&self, raw: *const ptl_gradient_data) -> Result<Gradient, Error> {
        // SAFETY: the same promise.
        let data = unsafe { read(raw, "gradient") }?;
        let count = data.stop_count;
        if count > self.limits.gradient_stops {
            let message =
                format!("{count} stops are given, allowed {}", self.limits.gradient_stops);
            return Err(Error::new(ErrorKind::Limit, message));
        }
        check_array(data.stops, count as usize, "gradient.stops")?;
        let stops = match count {
            0 => &[],
            // SAFETY: not null, aligned, few, and `count` stops (the caller's promise).
            _ => unsafe { std::slice::from_raw_parts(data.stops, count as usize) },
        };
        let number = |stop: &ptl_gradient_stop| {
            let [r, g, b] = stop.color;
            [stop.position, r, g, b].into_iter().find(|number| !(0.0..=1.0).contains(number))
        };
        let mut offenders =
            stops.iter().enumerate().filter_map(|(i, stop)| Some((i, number(stop)?)));
        if let Some((first, number)) = offenders.next() {
            let such = offenders.count() + 1;
            let message =
                format!("stop {first} of {count} has {number}, allowed 0 to 1; {such} such stops");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let stop =
            |stop: &ptl_gradient_stop| GradientStop { position: stop.position, color: stop.color };
        Ok(Gradient::new(stops.iter().map(stop).collect()))
    }

    /// An image, copied into planes.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    pub(crate) unsafe fn image(&self, raw: *const ptl_image_data) -> Result<Image, Error> {
        // SAFETY: the same promise.
        let data = unsafe { read(raw, "image") }?;
        let (width, height, side) = (data.width, data.height, self.limits.image_side);
        if width == 0 || height == 0 {
            return wrong(format!("`image` has size {width} x {height}, allowed from 1 x 1"));
        }
        if width.max(height) > side {
            let message = format!("`image` has size {width} x {height}, allowed sides of {side}");
            return Err(Error::new(ErrorKind::Limit, message));
        }
        let Some(format) = Format::ALL.into_iter().find(|format| *format as u32 == data.format)
        else {
            return wrong(format!(
                "`image.format` {:#x} is none of PTL_FORMAT_..., AUTO not allowed",
                data.format
            ));
        };
        check_bytes(Image::bytes_of(width, height, format.channels()), self.limits)?;
        let row = width as usize * format.bytes_per_pixel();
        let stride = if data.row_stride == 0 { row } else { data.row_stride };
        if stride < row {
            return wrong(format!("`image.row_stride` is {stride}, but rows have {row} bytes"));
        }
        let extent = (height as usize - 1).checked_mul(stride).and_then(|b| b.checked_add(row));
        let Some(extent) = extent.filter(|extent| isize::try_from(*extent).is_ok()) else {
            return wrong("`image` is larger than memory can be".into());
        };
        check_array(data.pixels.cast::<u8>(), extent, "image.pixels")?;
        // SAFETY: not null, no larger than memory, and `extent` bytes (the caller's promise).
        let bytes = unsafe { std::slice::from_raw_parts(data.pixels.cast::<u8>(), extent) };
        Image::from_pixels(&BufferPool::new(), (width, height), format, (bytes, stride))
    }
}
