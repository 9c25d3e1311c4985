//! Images as C reads them.

use std::{
    ffi::{c_char, c_void},
    path::Path,
    sync::OnceLock,
};

use super::{
    PTL_COLOR_SPACE_SRGB, PTL_ORIGIN_TOP_LEFT,
    argument::Size,
    compute::format_of,
    handle::{Handle, Opaque, give, tag},
    ptl_error, ptl_format, ptl_image_info, ptl_status,
    structs::InOut,
};
use crate::{
    error::{Error, ErrorKind},
    io::{BitDepth, save_image},
    run::PixelsMut,
    value::{Format, Image},
};

/// A finished picture. It is reference counted, never changes, and any thread may read it.
#[derive(Debug)]
pub struct ptl_image {
    _opaque: [u8; 0],
}

impl Opaque for ptl_image {
    type Object = ImageObject;
    const TAG: u32 = tag(b'i');
    const NAME: &'static str = "ptl_image";
}

/// A picture as planes, and as pixels once somebody asked for them. Copies into other formats and
/// files come from the planes, so they lose nothing that the first format does not have.
#[derive(Debug)]
pub(super) struct ImageObject {
    image: Image,
    format: Format,
    stride: usize,
    size: usize,
    pixels: OnceLock<Option<Box<[Line]>>>,
}

/// A piece of memory that starts where pixels should.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
struct Line([u8; 64]);

// SAFETY: all zeros are 64 bytes of 0.
unsafe impl bytemuck::Zeroable for Line {}
// SAFETY: 64 bytes without padding, and every pattern of bits is a value.
unsafe impl bytemuck::Pod for Line {}

impl ImageObject {
    pub(super) fn new(image: Image, format: Format) -> Result<Self, Error> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let stride = width.checked_mul(format.bytes_per_pixel());
        let size = stride.and_then(|stride| stride.checked_mul(height));
        let (Some(stride), Some(size)) = (stride, size) else {
            let message = format!("the pixels of {width} × {height} fit in no memory");
            return Err(Error::new(ErrorKind::NoMemory, message));
        };
        Ok(Self { image, format, stride, size, pixels: OnceLock::new() })
    }

    /// The pixels; `None` if the system has no memory for them.
    fn pixels(&self) -> Option<&[u8]> {
        if self.format == Format::GreyF32 && self.image.is_grey() {
            // The plane is what the caller wants to see.
            return Some(bytemuck::cast_slice(self.image.channel(0)));
        }
        let lines = self.pixels.get_or_init(|| self.converted()).as_deref()?;
        bytemuck::cast_slice(lines).get(..self.size)
    }

    fn converted(&self) -> Option<Box<[Line]>> {
        let count = self.size.div_ceil(size_of::<Line>());
        let mut lines = bytemuck::try_zeroed_slice_box::<Line>(count).ok()?;
        self.write(self.format, bytemuck::cast_slice_mut(&mut lines), self.stride);
        Some(lines)
    }

    fn write(&self, format: Format, pixels: &mut [u8], stride: usize) {
        let row = self.image.width() as usize * format.bytes_per_pixel();
        for (y, out) in (0..self.image.height()).zip(pixels.chunks_mut(stride.max(1))) {
            if let Some(out) = out.get_mut(..row) {
                self.image.write_row(y, format, out);
            }
        }
    }
}

/// Fills in what the image is.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT. On error `inout` is untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_image_get_info(
    image: *const ptl_image,
    inout: *mut ptl_image_info,
) -> ptl_status {
    pt_fn!(std::ptr::null_mut(); image: Handle<ptl_image>, inout: InOut<ptl_image_info> => {
        let count = |number| u32::try_from(number).unwrap_or_default();
        inout.set(&ptl_image_info {
            struct_size: 0,
            format: image.format as u32,
            width: image.image.width(),
            height: image.image.height(),
            channels: count(image.format.channels()),
            bytes_per_channel: count(image.format.bytes_per_channel()),
            color_space: PTL_COLOR_SPACE_SRGB,
            origin: PTL_ORIGIN_TOP_LEFT,
            row_stride: image.stride,
            size_bytes: image.size,
        });
        Ok(())
    })
}

/// The pixels in the format of the image, 64-byte aligned, rows without gaps. They are made by the
/// first call. `size` may be NULL. NULL and size 0 for NULL, or if there is no memory for them.
///
/// Ownership: they live as long as the image, and nobody may change them.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_image_pixels(
    image: *const ptl_image,
    size: *mut usize,
) -> *const c_void {
    pt_fn!(else std::ptr::null(); image: Handle<ptl_image>, size: Size => {
        match image.pixels() {
            Some(pixels) => {
                size.set(pixels.len());
                pixels.as_ptr().cast()
            }
            None => std::ptr::null(),
        }
    })
}

/// Copies the pixels in any format (PTL_FORMAT_AUTO: the image's own) to `dst`, which has `size`
/// bytes, rows of `row_stride` bytes (0: rows without gaps). A colour becomes grey by its mean, a
/// missing alpha is 1.
///
/// Ownership: `dst` stays the caller's; bytes between rows are not written.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_BUFFER_TOO_SMALL. On error `dst` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_image_copy(
    image: *const ptl_image,
    format: ptl_format,
    dst: *mut c_void,
    size: usize,
    row_stride: usize,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; image: Handle<ptl_image>, dst: &mut [u8] = (dst, size) => {
        let format = format_of(format)?.unwrap_or(image.format);
        let (width, height) = (image.image.width(), image.image.height());
        let stride = match row_stride {
            0 => width as usize * format.bytes_per_pixel(),
            stride => stride,
        };
        PixelsMut { format, pixels: dst, stride }.check(width, height)?;
        image.write(format, dst, stride);
        Ok(())
    })
}

/// Saves the image as a picture; `path` is UTF-8 and its ending tells the format: ".png" always,
/// others if ptl_has_feature("formats"). Images of 8 bits a channel are saved so, others with 16
/// bits or as floating-point numbers, where the format has them. An existing file is overwritten.
///
/// Threads: any.
/// Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_UNSUPPORTED, PTL_E_IO.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_image_save(
    image: *const ptl_image,
    path: *const c_char,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; image: Handle<ptl_image>, path: &str => {
        let depth = match image.format.bytes_per_channel() {
            1 => BitDepth::Eight,
            _ => BitDepth::Sixteen,
        };
        save_image(&image.image, Path::new(path), depth)
    })
}

/// One more reference to the same image; NULL for NULL.
///
/// Ownership: release each reference with ptl_image_release().
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_image_retain(image: *mut ptl_image) -> *mut ptl_image {
    // SAFETY: handles of this type are only made by `give`.
    pt_fn!(else std::ptr::null_mut(); image: Handle<ptl_image> => give(unsafe { image.retain() }))
}

/// Gives up one reference; NULL is fine.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_image_release(image: *mut ptl_image) {
    // SAFETY: the caller gives up its reference.
    pt_fn!(else (); image: Handle<ptl_image> => drop(unsafe { image.take() }));
}
