//! Pictures: PNG and the other formats of the `image` crate.

use std::{
    fs::{self, File, OpenOptions},
    io::{BufWriter, Cursor, Write},
    path::{Path, PathBuf},
    process,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
};

use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageError, ImageFormat, ImageReader};

use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    math::levels::from_level,
    value::{BufferPool, Format, Image},
};

/// How many bits a channel of a saved picture has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BitDepth {
    /// 8 bits.
    #[default]
    Eight,
    /// 16 bits, where the format has them: PNG and TIFF.
    Sixteen,
}

/// What a file format can hold.
struct FileFormat {
    format: ImageFormat,
    extensions: &'static [&'static str],
    has_grey: bool,
    has_alpha: bool,
    has_sixteen_bits: bool,
    /// Whether channels are floating-point numbers.
    is_float: bool,
}

/// A format that holds whatever a picture has; the others say what they do not.
#[allow(dead_code, reason = "a build without formats has no other that refers to it")]
const PNG: FileFormat = FileFormat {
    format: ImageFormat::Png,
    extensions: &["png"],
    has_grey: true,
    has_alpha: true,
    has_sixteen_bits: true,
    is_float: false,
};

/// Of 100. Blocks of lower quality show when a texture is lit or magnified.
#[cfg(feature = "jpeg")]
const JPEG_QUALITY: u8 = 95;

/// The formats of this build: a feature each.
static FORMATS: &[FileFormat] = &[
    #[cfg(feature = "png")]
    PNG,
    #[cfg(feature = "exr")]
    FileFormat {
        format: ImageFormat::OpenExr,
        extensions: &["exr"],
        has_grey: false,
        has_sixteen_bits: false,
        is_float: true,
        ..PNG
    },
    #[cfg(feature = "tiff")]
    FileFormat { format: ImageFormat::Tiff, extensions: &["tiff", "tif"], ..PNG },
    #[cfg(feature = "jpeg")]
    FileFormat {
        format: ImageFormat::Jpeg,
        extensions: &["jpg", "jpeg"],
        has_alpha: false,
        has_sixteen_bits: false,
        ..PNG
    },
    #[cfg(feature = "webp")]
    FileFormat {
        format: ImageFormat::WebP,
        extensions: &["webp"],
        has_grey: false,
        has_sixteen_bits: false,
        ..PNG
    },
    #[cfg(feature = "bmp")]
    FileFormat { format: ImageFormat::Bmp, extensions: &["bmp"], has_sixteen_bits: false, ..PNG },
    #[cfg(feature = "tga")]
    FileFormat { format: ImageFormat::Tga, extensions: &["tga"], has_sixteen_bits: false, ..PNG },
    #[cfg(feature = "qoi")]
    FileFormat {
        format: ImageFormat::Qoi,
        extensions: &["qoi"],
        has_grey: false,
        has_sixteen_bits: false,
        ..PNG
    },
    #[cfg(feature = "pnm")]
    FileFormat {
        format: ImageFormat::Pnm,
        extensions: &["pnm"],
        has_alpha: false,
        has_sixteen_bits: false,
        ..PNG
    },
    #[cfg(feature = "pnm")]
    FileFormat {
        format: ImageFormat::Pnm,
        extensions: &["ppm"],
        has_grey: false,
        has_alpha: false,
        has_sixteen_bits: false,
        ..PNG
    },
];

/// Saves a picture in the format that the file's name tells: PNG, OpenEXR, TIFF, JPEG, WebP, BMP,
/// TGA, QOI and PNM, each if this build has the feature of that name.
///
/// A grey picture stays grey where the format has that. An alpha channel is left out where the
/// format has none. The file appears complete or not at all: what was there before is replaced in
/// one step.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a format that this build has not, [`ErrorKind::Io`].
pub fn save_image(image: &Image, path: &Path, depth: BitDepth) -> Result<(), Error> {
    let format = format_of(path)?;
    let layout = layout(image, format, depth);
    replace_file(path, |file| {
        let mut writer = BufWriter::new(file);
        encode(image, format.format, layout, &mut writer)?;
        writer.flush().map_err(ImageError::IoError)
    })
    .map_err(|error| {
        let message = format!("cannot write {}: {error}", path.display());
        match error {
            ImageError::IoError(_) => Error::new(ErrorKind::Io, message),
            _ => Error::new(ErrorKind::Unsupported, message),
        }
    })
}

/// Whether [`save_image`] can save a picture under that name, as far as the name tells: for those
/// who want to know before they compute it.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a format that this build has not, naming those that it has.
pub fn check_picture_name(path: &Path) -> Result<(), Error> {
    format_of(path).map(drop)
}

/// The format that a file's name tells.
fn format_of(path: &Path) -> Result<&'static FileFormat, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let has = |format: &&FileFormat| format.extensions.contains(&extension.as_str());
    FORMATS.iter().find(has).ok_or_else(|| {
        let message = format!("\"{}\" names no format of a picture", path.display());
        Error::new(ErrorKind::Unsupported, message).with_hint(known())
    })
}

/// A sentence with the file name extensions of this build's formats.
fn known() -> String {
    let extensions = FORMATS.iter().flat_map(|format| format.extensions);
    let extensions: Vec<_> = extensions.map(|extension| format!(".{extension}")).collect();
    if extensions.is_empty() {
        return "this build has no formats: none of the features of ptlib is on".to_owned();
    }
    format!("there are {}", extensions.join(", "))
}

/// How pixels go into a file.
fn layout(image: &Image, format: &FileFormat, depth: BitDepth) -> Format {
    let is_grey = image.is_grey() && format.has_grey;
    let has_alpha = image.planes() == 4 && format.has_alpha;
    let is_wide = depth == BitDepth::Sixteen && format.has_sixteen_bits;
    if format.is_float {
        return if has_alpha { Format::RgbaF32 } else { Format::RgbF32 };
    }
    match (is_grey, has_alpha, is_wide) {
        (true, _, false) => Format::Grey8,
        (true, _, true) => Format::Grey16,
        (false, false, false) => Format::Rgb8,
        (false, false, true) => Format::Rgb16,
        (false, true, false) => Format::Rgba8,
        (false, true, true) => Format::Rgba16,
    }
}

fn encode(
    image: &Image,
    format: ImageFormat,
    layout: Format,
    writer: &mut (impl Write + std::io::Seek),
) -> Result<(), ImageError> {
    let color = match layout {
        Format::Grey8 => ExtendedColorType::L8,
        Format::Rgb8 => ExtendedColorType::Rgb8,
        Format::Rgba8 => ExtendedColorType::Rgba8,
        Format::Grey16 => ExtendedColorType::L16,
        Format::Rgb16 => ExtendedColorType::Rgb16,
        Format::Rgba16 => ExtendedColorType::Rgba16,
        Format::GreyF32 | Format::RgbF32 => ExtendedColorType::Rgb32F,
        Format::RgbaF32 => ExtendedColorType::Rgba32F,
    };
    let pixels = image.to_pixels(layout);
    #[cfg(feature = "jpeg")]
    if format == ImageFormat::Jpeg {
        return image::codecs::jpeg::JpegEncoder::new_with_quality(writer, JPEG_QUALITY).encode(
            &pixels.data,
            pixels.width,
            pixels.height,
            color,
        );
    }
    image::write_buffer_with_format(
        writer,
        &pixels.data,
        pixels.width,
        pixels.height,
        color,
        format,
    )
}

/// Writes a file beside its place and then moves it there, so that a failure leaves what was there.
fn replace_file(
    path: &Path,
    write: impl FnOnce(File) -> Result<(), ImageError>,
) -> Result<(), ImageError> {
    let (file, unfinished) = unfinished_file(path)?;
    let written = write(file).and_then(|()| Ok(fs::rename(&unfinished, path)?));
    if written.is_err() {
        // The failure to write is what counts; a rest that cannot be removed changes nothing.
        let _ = fs::remove_file(&unfinished);
    }
    written
}

/// A new file in the folder of `path`.
fn unfinished_file(path: &Path) -> Result<(File, PathBuf), ImageError> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    loop {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!(".ptlib-{}-{number}.tmp", process::id());
        let unfinished = path.with_file_name(name);
        match OpenOptions::new().write(true).create_new(true).open(&unfinished) {
            Ok(file) => return Ok((file, unfinished)),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error.into()),
        }
    }
}

/// The picture in a file's bytes: one plane for a grey file, three for others; alpha is left out.
/// Its size is checked before memory is taken. `name` tells the format where the bytes do not.
///
/// # Errors
/// [`ErrorKind::Parse`], [`ErrorKind::Unsupported`], [`ErrorKind::Limit`], [`ErrorKind::NoMemory`].
pub(super) fn decode(
    bytes: &[u8],
    name: &Path,
    limits: &Limits,
    pool: &Arc<BufferPool>,
) -> Result<Image, Error> {
    let format = image::guess_format(bytes).ok();
    let format = format.or_else(|| ImageFormat::from_path(name).ok()).ok_or_else(|| {
        let error = Error::new(ErrorKind::Unsupported, "is no picture of a known format");
        error.with_hint(known())
    })?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut bounds = image::Limits::default();
    bounds.max_image_width = Some(limits.image_side);
    bounds.max_image_height = Some(limits.image_side);
    bounds.max_alloc = Some(limits.memory_bytes);
    reader.limits(bounds);
    let decoder = reader.into_decoder().map_err(|error| unreadable(&error, limits))?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        return Err(Error::new(ErrorKind::Parse, "the picture has no pixels"));
    }
    let planes = if decoder.color_type().has_color() { 3 } else { 1 };
    let needed = decoder.total_bytes().saturating_add(Image::bytes_of(width, height, planes));
    let is_large = width > limits.image_side || height > limits.image_side;
    if is_large || needed > limits.memory_bytes {
        return Err(too_large(limits));
    }
    let picture = DynamicImage::from_decoder(decoder).map_err(|e| unreadable(&e, limits))?;
    let mut image = Image::new(pool, width, height, planes)?;
    fill(&mut image, &picture);
    Ok(image)
}

/// Copies the samples of a picture into the planes of an image.
fn fill(image: &mut Image, picture: &DynamicImage) {
    let byte = |level: u8| from_level(f32::from(level));
    let word = |level: u16| f32::from(level) / 65535.0;
    let float = |value: f32| if value.is_finite() { value } else { 0.0 };
    match picture {
        DynamicImage::ImageLuma8(picture) => copy(image, picture, 1, byte),
        DynamicImage::ImageLumaA8(picture) => copy(image, picture, 2, byte),
        DynamicImage::ImageRgb8(picture) => copy(image, picture, 3, byte),
        DynamicImage::ImageRgba8(picture) => copy(image, picture, 4, byte),
        DynamicImage::ImageLuma16(picture) => copy(image, picture, 1, word),
        DynamicImage::ImageLumaA16(picture) => copy(image, picture, 2, word),
        DynamicImage::ImageRgb16(picture) => copy(image, picture, 3, word),
        DynamicImage::ImageRgba16(picture) => copy(image, picture, 4, word),
        DynamicImage::ImageRgb32F(picture) => copy(image, picture, 3, float),
        other => copy(image, &other.to_rgba32f(), 4, float),
    }
}

fn copy<T: Copy>(image: &mut Image, samples: &[T], channels: usize, value: impl Fn(T) -> f32) {
    for (channel, plane) in image.planes_mut().enumerate() {
        let samples = samples.iter().skip(channel).step_by(channels);
        plane.iter_mut().zip(samples).for_each(|(out, sample)| *out = value(*sample));
    }
}

fn unreadable(error: &ImageError, limits: &Limits) -> Error {
    match error {
        ImageError::Limits(_) => too_large(limits),
        ImageError::Unsupported(_) => Error::new(ErrorKind::Unsupported, error.to_string()),
        _ => Error::new(ErrorKind::Parse, error.to_string()),
    }
}

fn too_large(limits: &Limits) -> Error {
    let (side, memory) = (limits.image_side, limits.memory_bytes);
    let message = format!("the picture is too large, allowed {side} × {side} and {memory} bytes");
    Error::new(ErrorKind::Limit, message).with_hint(
        "the caller can raise that: `image_side` and `memory_bytes` of `EngineOptions::limits`",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::tests::Folder;

    /// 3 × 2 pixels of `planes` planes that differ everywhere.
    fn image(planes: usize) -> Image {
        let mut image = Image::new(&BufferPool::new(), 3, 2, planes).unwrap();
        for (channel, plane) in (0_u8..).zip(image.planes_mut()) {
            for (i, out) in (0_u8..).zip(plane) {
                *out = from_level(f32::from(i * 40 + channel * 17));
            }
        }
        image
    }

    fn read(folder: &Folder, name: &str) -> Result<Image, Error> {
        let bytes = fs::read(folder.path(name)).unwrap();
        decode(&bytes, Path::new(name), &Limits::default(), &BufferPool::new())
    }

    fn saved(image: &Image, name: &str, depth: BitDepth) -> Image {
        let folder = Folder::new();
        save_image(image, &folder.path(name), depth).unwrap();
        assert_eq!(fs::read_dir(folder.path("")).unwrap().count(), 1, "{name}");
        read(&folder, name).unwrap()
    }

    fn assert_near(a: &Image, b: &Image, tolerance: f32, name: &str) {
        assert_eq!((a.width(), a.height()), (b.width(), b.height()));
        for channel in 0..3 {
            for (a, b) in a.channel(channel).iter().zip(b.channel(channel)) {
                assert!((a - b).abs() <= tolerance, "{name}: {a} and {b}");
            }
        }
    }

    #[cfg(feature = "png")]
    #[test]
    fn a_png_is_read_as_it_was_saved() {
        for depth in [BitDepth::Eight, BitDepth::Sixteen] {
            for planes in [1, 3] {
                let saved = saved(&image(planes), "a.PNG", depth);
                assert_eq!(saved.planes(), planes);
                assert_near(&saved, &image(planes), 0.0, "png");
            }
        }
    }

    #[cfg(feature = "png")]
    #[test]
    fn sixteen_bits_are_finer_than_eight() {
        let mut fine = Image::new(&BufferPool::new(), 1, 1, 1).unwrap();
        fine.planes_mut().for_each(|plane| plane.fill(1000.0 / 65535.0));
        assert_near(&saved(&fine, "a.png", BitDepth::Sixteen), &fine, 1e-7, "16 bits");
        assert_eq!(saved(&fine, "a.png", BitDepth::Eight).channel(0), [from_level(4.0)]);
    }

    #[cfg(feature = "png")]
    #[test]
    fn alpha_is_saved_and_not_blended() {
        let saved = saved(&image(4), "a.png", BitDepth::Eight);
        assert_eq!(saved.planes(), 3);
        assert_near(&saved, &image(4), 0.0, "alpha");
    }

    #[test]
    fn every_format_is_read_as_it_was_saved() {
        for format in FORMATS {
            for extension in format.extensions {
                let name = format!("a.{extension}");
                for planes in [1, 3, 4] {
                    let saved = saved(&image(planes), &name, BitDepth::Sixteen);
                    // A grey BMP is a palette of greys, and palettes are read as colours.
                    let stays_grey = format.has_grey && format.format != ImageFormat::Bmp;
                    let expected = if planes == 1 && stays_grey { 1 } else { 3 };
                    assert_eq!(saved.planes(), expected, "{name} of {planes} planes");
                    let is_lossy = format.format == ImageFormat::Jpeg;
                    let tolerance = if is_lossy { 0.2 } else { 0.0 };
                    assert_near(&saved, &image(planes), tolerance, &name);
                }
            }
        }
    }

    #[cfg(feature = "exr")]
    #[test]
    fn floats_pass_and_non_finite_ones_are_zero() {
        let mut image = Image::new(&BufferPool::new(), 4, 1, 3).unwrap();
        let values = [-2.5, 7.0, f32::NAN, f32::INFINITY];
        image.planes_mut().for_each(|plane| plane.copy_from_slice(&values));
        let saved = saved(&image, "a.exr", BitDepth::Eight);
        assert_eq!(saved.channel(1), [-2.5, 7.0, 0.0, 0.0]);
    }

    #[test]
    fn an_unknown_format_is_named_and_leaves_no_file() {
        let folder = Folder::new();
        for name in ["a.xyz", "a", "png"] {
            let error = save_image(&image(1), &folder.path(name), BitDepth::Eight).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Unsupported);
            let hint = error.hint().unwrap();
            assert_eq!(hint.contains(".png"), cfg!(feature = "png"), "{hint}");
            assert_eq!(hint.contains("no formats"), FORMATS.is_empty(), "{hint}");
        }
        assert_eq!(fs::read_dir(folder.path("")).unwrap().count(), 0);
    }

    #[cfg(feature = "png")]
    #[test]
    fn a_failure_leaves_what_was_there() {
        let folder = Folder::new();
        fs::create_dir(folder.path("a.png")).unwrap();
        let error = save_image(&image(1), &folder.path("a.png"), BitDepth::Eight).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        assert_eq!(fs::read_dir(folder.path("")).unwrap().count(), 1);
        let missing = folder.path("missing/a.png");
        assert_eq!(
            save_image(&image(1), &missing, BitDepth::Eight).unwrap_err().kind(),
            ErrorKind::Io
        );
    }

    #[cfg(feature = "png")]
    #[test]
    fn what_is_no_picture_is_refused() {
        let kind = |bytes: &[u8], name: &str| {
            let limits = Limits::default();
            decode(bytes, Path::new(name), &limits, &BufferPool::new()).unwrap_err().kind()
        };
        assert_eq!(kind(b"hello", "a.txt"), ErrorKind::Unsupported);
        assert_eq!(kind(b"hello", "a.png"), ErrorKind::Parse);
        let folder = Folder::new();
        save_image(&image(3), &folder.path("a.png"), BitDepth::Eight).unwrap();
        let whole = fs::read(folder.path("a.png")).unwrap();
        assert_eq!(kind(&whole[..whole.len() / 2], "a.png"), ErrorKind::Parse);
    }

    #[cfg(feature = "png")]
    #[test]
    fn a_picture_that_is_too_large_is_refused_before_it_is_read() {
        // The head of a PNG that claims 60,000 × 60,000 pixels of 64 bits.
        let mut bytes =
            b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x10\x06\0\0\0".to_vec();
        bytes.extend([0xd0, 0x42, 0xa9, 0x01]);
        bytes.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
        let limits =
            |limits| decode(&bytes, Path::new(""), &limits, &BufferPool::new()).unwrap_err();
        let error = limits(Limits::default());
        assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
        let error = limits(Limits { image_side: 1000, ..Limits::default() });
        assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
    }
}
