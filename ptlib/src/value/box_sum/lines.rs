//! Sums along the columns or the diagonals of an image.

use std::ops::Range;

use super::{FixedPoint, RingWindow, Runs, Window, index};
use crate::{
    error::Error,
    math::{
        convert,
        simd::{Kernel, SimdLevel},
    },
    value::Image,
};

/// Sums along the columns of an image, or along its diagonals, over windows around each pixel.
///
/// With a `slope` of 1 the lines go down to the right, with -1 down to the left. Then the sums are
/// stored *sheared*: place (d, y) belongs to the line that passes (d, 0), so it is the sum at
/// column d + slope · y. That way a band of places needs no other band, whatever the slope.
#[derive(Debug, Clone, Copy)]
pub struct LinePlan<const K: usize> {
    width: u32,
    height: u32,
    slope: i64,
    length: u64,
    windows: [RingWindow; K],
    fixed: FixedPoint,
}

/// The sums of a [`LinePlan`], one plane of integers for each plane of the image.
#[derive(Debug)]
pub struct LineSums {
    sums: Image,
    slope: i64,
}

impl LineSums {
    /// Sums that are still to be made, in the memory of `image`.
    #[must_use]
    pub fn new(image: Image) -> Self {
        Self { sums: image, slope: 0 }
    }

    /// The width of the image.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.sums.width()
    }

    /// The planes to write, for sums that lie upright and that no [`LinePlan`] makes.
    pub fn planes_mut(&mut self) -> impl Iterator<Item = &mut [i32]> {
        self.slope = 0;
        self.sums.planes_mut().map(bytemuck::cast_slice_mut)
    }

    /// Row `y` of the sums of channel `channel`, and the place in it that belongs to column 0: the
    /// following columns have the following places, around the end of the row.
    #[must_use]
    pub fn row(&self, channel: usize, y: u32) -> (&[i32], usize) {
        let start = convert::wrap(-self.slope * i64::from(y), self.sums.width());
        (bytemuck::cast_slice(self.sums.row(channel, y)), start as usize)
    }
}

/// Some columns of the sums of one plane.
pub struct Band<'a, const K: usize> {
    plan: LinePlan<K>,
    source: &'a [f32],
    first: usize,
    rows: Vec<&'a mut [i32]>,
}

/// How many rows of a band are made between two questions whether to go on.
const ROWS_PER_CHECK: usize = 64;

impl<const K: usize> LinePlan<K> {
    /// A plan for images of `width` × `height` pixels.
    #[must_use]
    pub fn new(
        (width, height): (u32, u32),
        slope: i64,
        windows: [Window; K],
        fixed: FixedPoint,
    ) -> Self {
        // A diagonal comes back to its start after as many rows as both sides divide.
        let (rows, columns) = (u64::from(height), u64::from(width));
        let length = if slope == 0 { rows } else { rows / gcd(rows, columns) * columns };
        let windows = windows.map(|window| window.on_ring(length));
        Self { width, height, slope, length, windows, fixed }
    }

    /// The work for that many threads: fill every band, in any order, then read `sums`.
    pub fn bands<'a>(
        &self,
        threads: usize,
        image: &'a Image,
        sums: &'a mut LineSums,
    ) -> Vec<Band<'a, K>> {
        let width = self.width as usize;
        // As wide as can be: a CPU fetches ahead along rows, and not from one row to the next.
        let columns = width.div_ceil(threads.max(1)).clamp(512, 4096).next_multiple_of(16);
        sums.slope = self.slope;
        let mut bands = Vec::new();
        for (channel, plane) in sums.sums.planes_mut().enumerate() {
            let start = bands.len();
            let source = image.channel(channel);
            bands.extend((0..width).step_by(columns).map(|first| {
                let rows = Vec::with_capacity(self.height as usize);
                Band { plan: *self, source, first, rows }
            }));
            for row in bytemuck::cast_slice_mut::<f32, i32>(plane).chunks_exact_mut(width) {
                for (band, piece) in bands[start..].iter_mut().zip(row.chunks_mut(columns)) {
                    band.rows.push(piece);
                }
            }
        }
        bands
    }

    /// The row of `source` at place `place` of the lines, which may be some turns on, and there the
    /// column of line `first`.
    #[inline(always)]
    fn at<'a>(&self, source: &'a [f32], place: u64, first: usize) -> (&'a [f32], usize) {
        let width = self.width as usize;
        let row = index(place % u64::from(self.height));
        let shift = self.slope * place.cast_signed() + first as i64;
        (&source[row * width..][..width], convert::wrap(shift, self.width) as usize)
    }
}

impl<const K: usize> Band<'_, K> {
    /// Makes the sums of the band.
    ///
    /// # Errors
    /// What `check` returns; it is asked often.
    pub fn fill(
        &mut self,
        simd: SimdLevel,
        check: impl Fn() -> Result<(), Error>,
    ) -> Result<(), Error> {
        if let Some(top) = self.rows.first_mut() {
            top.fill(0);
        }
        for window in self.plan.windows {
            // Without a whole turn, nothing needs to be read a second time.
            let turn = if window.turns == 0 { 0 } else { self.plan.length };
            for (start, count, factor) in [(0, turn, window.turns), (window.start, window.rest, 1)]
            {
                let factor = i32::try_from(factor).expect("a window counts at most 2³¹ places");
                let factor = if window.is_negative { -factor } else { factor };
                for done in (0..count).step_by(ROWS_PER_CHECK) {
                    check()?;
                    let end = count.min(done + ROWS_PER_CHECK as u64);
                    let places = start + done..start + end;
                    simd.run(FirstRow { band: self, places, factor });
                }
            }
        }
        for y in (1..self.rows.len()).step_by(ROWS_PER_CHECK) {
            check()?;
            let end = self.rows.len().min(y + ROWS_PER_CHECK);
            simd.run(NextRows { band: self, rows: y..end });
        }
        Ok(())
    }
}

/// Adds the numbers at some places of the lines, times `factor`, to the first row of a band.
struct FirstRow<'b, 'a, const K: usize> {
    band: &'b mut Band<'a, K>,
    places: Range<u64>,
    factor: i32,
}

impl<const K: usize> Kernel for FirstRow<'_, '_, K> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Band { plan, source, first, rows } = self.band;
        let (width, fixed) = (plan.width as usize, plan.fixed);
        for place in self.places {
            let (row, column) = plan.at(source, place, *first);
            let count = rows[0].len();
            for (places, [[column], _]) in Runs::new([[column], [column]], width, count) {
                let row = &row[column..][..places.len()];
                for (sum, value) in rows[0][places].iter_mut().zip(row) {
                    *sum = sum.wrapping_add(fixed.integer(*value).wrapping_mul(self.factor));
                }
            }
        }
    }
}

/// Makes rows of a band from the rows above them.
struct NextRows<'b, 'a, const K: usize> {
    band: &'b mut Band<'a, K>,
    rows: Range<usize>,
}

impl<const K: usize> Kernel for NextRows<'_, '_, K> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Band { plan, source, first, rows } = self.band;
        let (width, fixed) = (plan.width as usize, plan.fixed);
        for y in self.rows {
            // The windows were at y - 1: their taps there say what they gain and lose now.
            let place = |tap: u64| plan.at(source, tap + y as u64 - 1, *first);
            let plus = plan.windows.map(|window| place(window.plus));
            let minus = plan.windows.map(|window| place(window.minus));
            let (above, below) = rows.split_at_mut(y);
            let (above, below) = (&*above[y - 1], &mut *below[0]);
            let taps = [plus.map(|(_, column)| column), minus.map(|(_, column)| column)];
            for (places, taps) in Runs::new(taps, width, above.len()) {
                let count = places.len();
                let plus: [_; K] = std::array::from_fn(|k| &plus[k].0[taps[0][k]..][..count]);
                let minus: [_; K] = std::array::from_fn(|k| &minus[k].0[taps[1][k]..][..count]);
                let above = &above[places.clone()];
                for (i, below) in below[places].iter_mut().enumerate() {
                    let mut sum = above[i];
                    for k in 0..K {
                        sum = sum.wrapping_add(fixed.integer(plus[k][i]));
                        sum = sum.wrapping_sub(fixed.integer(minus[k][i]));
                    }
                    *below = sum;
                }
            }
        }
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::{math::levels::EightBit, value::BufferPool};

    pub(in super::super) fn image(width: u32, height: u32) -> Image {
        let mut image = Image::new(&BufferPool::new(), width, height, 1).unwrap();
        let mut number = 1_u32;
        for value in image.planes_mut().next().unwrap() {
            number = number.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            *value = (number >> 24) as f32 / 255.0;
        }
        image
    }

    /// Σ over `window` of the levels along the line of that slope through (x, y).
    fn naive(image: &Image, slope: i64, window: Window, (x, y): (u32, u32)) -> i64 {
        let sum = (0..i64::from(window.count)).map(|i| {
            let step = window.first + i;
            let row = convert::wrap(i64::from(y) + step, image.height());
            let column = convert::wrap(i64::from(x) + slope * step, image.width());
            let value = image.row(0, row)[column as usize];
            i64::from(FixedPoint::new::<EightBit>(1).integer(value))
        });
        if window.is_negative { -sum.sum::<i64>() } else { sum.sum() }
    }

    #[test]
    fn line_sums_are_those_of_the_definition() {
        // One band and several; windows shorter and longer than the lines.
        for (width, height) in [(1, 1), (3, 5), (6, 4), (300, 7), (530, 2)] {
            let image = image(width, height);
            for (slope, windows) in [
                (0, [Window::around(2), Window::new(0, 0)]),
                (0, [Window::new(-3, 3), Window::new(1, 3).negative()]),
                (1, [Window::around(1), Window::new(5, 70).negative()]),
                (-1, [Window::around(40), Window::new(0, 1)]),
            ] {
                let plan =
                    LinePlan::new((width, height), slope, windows, FixedPoint::new::<EightBit>(99));
                let memory = Image::new(&BufferPool::new(), width, height, 1).unwrap();
                let mut sums = LineSums::new(memory);
                for band in plan.bands(3, &image, &mut sums).iter_mut().rev() {
                    band.fill(SimdLevel::best(), || Ok(())).unwrap();
                }
                for y in 0..height {
                    let (row, start) = sums.row(0, y);
                    for x in 0..width {
                        let sum = row[(start + x as usize) % width as usize];
                        let expected: i64 =
                            windows.iter().map(|w| naive(&image, slope, *w, (x, y))).sum();
                        assert_eq!(i64::from(sum), expected, "{width}×{height} {slope} {x},{y}");
                    }
                }
            }
        }
    }
}
