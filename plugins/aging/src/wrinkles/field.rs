//! All muscles of a map together: the sum of their heights at any place.
//!
//! Each muscle repeats with period 1 in both texture coordinates. A place gets the heights of the
//! muscles one after the other in canonical order, and of each from its copies row by row, so that
//! the sum has the same bits whatever the order of the file and whatever part of an image is
//! asked for.

use ptlib_plugin::BlockError;

use super::{
    fibre::{Fibre, Row, in_two},
    grammar::Muscle,
    kernels::{Places, Style},
};

/// Rows of places are sorted into so many bands, each with the muscles that reach into it.
const BANDS: usize = 64;

/// Places along a side of the grid where the greatest sum is looked for.
const GRID: u32 = 512;

/// The most places on a fibre where the greatest sum is looked for.
const ON_FIBRE: u32 = 64;

/// Places that are looked at between two questions whether to stop: about a millisecond.
const PACE: usize = 1 << 18;

/// The muscles of a map.
#[derive(Debug)]
pub(super) struct Field {
    fibres: Vec<Fibre>,
    /// Wrinkles on each.
    wrinkles: Vec<f64>,
    /// The fibres that reach into each band.
    bands: Vec<Vec<u32>>,
    proportion: f64,
    style: Style,
}

/// Asks now and then whether to stop.
pub(super) struct Pace<'a> {
    seen: usize,
    check: &'a dyn Fn() -> Result<(), BlockError>,
}

impl<'a> Pace<'a> {
    pub(super) fn new(check: &'a dyn Fn() -> Result<(), BlockError>) -> Self {
        Self { seen: 0, check }
    }

    #[inline]
    fn add(&mut self, places: usize) -> Result<(), BlockError> {
        // What is not a place takes time as well.
        self.seen += places + 16;
        if self.seen < PACE {
            return Ok(());
        }
        self.seen = 0;
        (self.check)()
    }
}

/// Horizontal coordinates of the columns of an image.
#[derive(Debug)]
pub(super) struct Columns {
    near: Vec<f32>,
    rest: Vec<f32>,
    step: f64,
}

impl Columns {
    /// Of an image of that width and proportion.
    pub(super) fn new(width: u32, proportion: f64) -> Self {
        let at = |x: u32| in_two((f64::from(x) + 0.5) / f64::from(width) * proportion);
        let (near, rest) = (0..width).map(at).map(|[near, rest]| (near, rest)).unzip();
        Self { near, rest, step: proportion / f64::from(width) }
    }

    /// The places of a row from a column on.
    pub(super) fn row(&self, v: f64, x: usize, len: usize) -> Row<'_> {
        let places = Places { near: &self.near, rest: &self.rest };
        let first = (x as f64 + 0.5) * self.step;
        Row { v, first, step: self.step, places: places.part(x..x.saturating_add(len)) }
    }
}

impl Field {
    /// Of an image that is `proportion` times as wide as high.
    pub(super) fn new(muscles: &[Muscle], proportion: f64, style: Style) -> Self {
        let fibres: Vec<_> = muscles.iter().map(|muscle| Fibre::new(muscle, proportion)).collect();
        let mut bands = vec![Vec::new(); BANDS];
        for (fibre, number) in fibres.iter().zip(0_u32..) {
            let [least, most] = fibre.bounds.map(|bound| (bound[1] * BANDS as f64).floor());
            // From band to band, with one more at each end, up to all of them.
            let mut band = least - 1.0;
            for _ in 0..BANDS {
                if band > most + 1.0 {
                    break;
                }
                if let Some(band) = bands.get_mut(band_of(band)) {
                    band.push(number);
                }
                band += 1.0;
            }
        }
        let wrinkles = muscles.iter().map(|muscle| muscle.wrinkles).collect();
        Self { fibres, wrinkles, bands, proportion, style }
    }

    /// The most memory that a field takes.
    pub(super) fn memory(muscles: usize) -> u64 {
        let each = size_of::<Fibre>() + size_of::<f64>() + 2 * BANDS * size_of::<u32>();
        u64::try_from(muscles.saturating_mul(each)).unwrap_or(u64::MAX)
    }

    /// Adds the heights of all muscles to those of a row.
    pub(super) fn add(
        &self,
        row: &Row<'_>,
        sums: &mut [f32],
        pace: &mut Pace<'_>,
    ) -> Result<(), BlockError> {
        let Some(band) = self.bands.get(band_of((row.v * BANDS as f64).floor())) else {
            return Ok(());
        };
        let last = row.first + row.step * (sums.len() as f64 - 1.0);
        for fibre in band.iter().filter_map(|number| self.fibres.get(*number as usize)) {
            let [least, most] = fibre.bounds;
            let mut seen = 0;
            // The copies that reach the row, shifted by whole numbers of periods.
            let (mut j, end) = ((row.v - most[1]).ceil(), (row.v - least[1]).floor());
            while j <= end {
                let mut i = ((row.first - most[0]) / self.proportion).ceil();
                let end = ((last - least[0]) / self.proportion).floor();
                while i <= end {
                    seen += fibre.add([i * self.proportion, j], self.style, row, sums);
                    pace.add(seen)?;
                    seen = 0;
                    i += 1.0;
                }
                j += 1.0;
            }
            pace.add(0)?;
        }
        Ok(())
    }

    /// The sum at a place of texture coordinates, whose horizontal one is isotropic.
    pub(super) fn at(&self, [x, v]: [f64; 2], pace: &mut Pace<'_>) -> Result<f32, BlockError> {
        let [near, rest] = in_two(x);
        let places = Places { near: &[near], rest: &[rest] };
        let mut sum = [0.0];
        self.add(&Row { v, first: x, step: 1.0, places }, &mut sum, pace)?;
        Ok(sum[0])
    }

    /// The greatest sum of a fixed set of places, so that no resolution changes it: a grid, and
    /// the crests of wrinkles on the fibres, at most 64 of each.
    pub(super) fn greatest(&self, pace: &mut Pace<'_>) -> Result<f32, BlockError> {
        let columns = Columns::new(GRID, self.proportion);
        let mut greatest = 0.0_f32;
        let mut sums = [0.0; GRID as usize];
        for y in 0..GRID {
            sums.fill(0.0);
            let v = (f64::from(y) + 0.5) / f64::from(GRID);
            self.add(&columns.row(v, 0, sums.len()), &mut sums, pace)?;
            greatest = sums.iter().fold(greatest, |most, sum| most.max(*sum));
        }
        for (fibre, wrinkles) in self.fibres.iter().zip(&self.wrinkles) {
            let crests = wrinkles.min(f64::from(ON_FIBRE));
            for i in (0..ON_FIBRE).map(f64::from).take_while(|i| *i < crests) {
                // All crests, or the nearest before evenly spaced places.
                let crest = ((i + 0.5) * wrinkles / crests).floor();
                let sum = self.at(fibre.at((crest + 0.5) / wrinkles), pace)?;
                greatest = greatest.max(sum);
            }
        }
        Ok(greatest)
    }
}

/// The band of that number, which wraps around.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to before BANDS")]
fn band_of(number: f64) -> usize {
    number.rem_euclid(BANDS as f64) as usize
}

#[cfg(test)]
mod tests;
