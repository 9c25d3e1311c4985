//! Pictures of tests: reading references, comparing, writing what differs.

use std::path::{Path, PathBuf};

use ptlib::{Format, Image};

/// A folder of this package.
pub fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// An 8-bit colour picture.
pub struct Levels {
    pub width: u32,
    pub height: u32,
    pub samples: Vec<u8>,
}

impl Levels {
    /// Reads a PNG.
    pub fn read(path: &Path) -> Self {
        let picture = image::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let picture = picture.to_rgb8();
        let (width, height) = picture.dimensions();
        Self { width, height, samples: picture.into_raw() }
    }

    /// The levels of an image of ptlib.
    pub fn of(image: &Image) -> Self {
        let pixels = image.to_pixels(Format::Rgb8);
        Self { width: pixels.width, height: pixels.height, samples: pixels.data }
    }

    /// Writes a PNG below the target folder and returns its path.
    pub fn write(&self, name: &str) -> PathBuf {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures");
        std::fs::create_dir_all(&folder).expect("the target folder can be written");
        let path = folder.join(format!("{name}.png"));
        image::save_buffer(
            &path,
            &self.samples,
            self.width,
            self.height,
            image::ExtendedColorType::Rgb8,
        )
        .expect("the target folder can be written");
        path
    }

    /// How far two pictures of one size are apart.
    pub fn difference(&self, other: &Self, tolerance: u8) -> Difference {
        assert_eq!((self.width, self.height), (other.width, other.height), "sizes");
        let steps = self.samples.iter().zip(&other.samples).map(|(a, b)| a.abs_diff(*b));
        let (mut sum, mut far) = (0_u64, 0_u64);
        for step in steps {
            sum += u64::from(step);
            far += u64::from(step > tolerance);
        }
        let count = self.samples.len() as f64;
        Difference { mean: sum as f64 / count, far: far as f64 / count }
    }

    /// Where two pictures differ, eight times amplified.
    pub fn contrast(&self, other: &Self) -> Self {
        let steps = self.samples.iter().zip(&other.samples);
        let samples = steps.map(|(a, b)| a.abs_diff(*b).saturating_mul(8)).collect();
        Self { samples, ..*self }
    }
}

/// How far two pictures are apart.
#[derive(Debug, Clone, Copy)]
pub struct Difference {
    /// Mean absolute difference in levels.
    pub mean: f64,
    /// The share of samples that are further apart than the tolerance.
    pub far: f64,
}
