//! Sums over sliding windows: what box blurs, slopes and averages are made of.
//!
//! A window that moves by one place gains a number and loses one, so its sum costs the same for
//! every size. Floating-point numbers would make that sum drift; here values become integers
//! first ([`FixedPoint`]), and the sums are exact: they do not depend on where a run of additions
//! starts, and every split of the work gives the same bits.
//!
//! Everything wraps around, for any size of window: one that is longer than the ring counts whole
//! turns. [`SlidingSum`] sums along one row, a [`RunningSum`] may follow several; [`LinePlan`] sums
//! along all columns (or diagonals) of an image, in bands of columns that may be filled in any
//! order.
//!
//! Rejected: a summed-area table. It needs 64-bit numbers for every pixel, and a pass along the
//! columns and one along the rows with nothing in between is as cheap and stays in the cache.

use std::ops::Range;

use super::Image;
use crate::{
    error::Error,
    math::{
        convert,
        levels::Levels,
        simd::{Kernel, SimdLevel},
    },
};

/// How numbers 0..1 become integers whose sums are exact: levels 0..255 in 8-bit precision, else
/// the finest power of two that `summands` of them cannot overflow an `i32` with, up to 2²³.
#[derive(Debug, Clone, Copy)]
pub struct FixedPoint {
    factor: f32,
    offset: f32,
    one: f64,
}

impl FixedPoint {
    /// Integers of which `summands` can be added.
    #[must_use]
    pub fn new<L: Levels>(summands: u32) -> Self {
        if L::EIGHT_BIT {
            return Self { factor: 255.0, offset: 8_388_608.0, one: 255.0 };
        }
        let bits = (i32::MAX.cast_unsigned() / summands.max(1)).max(1).ilog2().min(23);
        Self { factor: 1.0, offset: (1_u32 << (23 - bits)) as f32, one: f64::from(1_u32 << bits) }
    }

    /// The integer that stands for 1.
    #[must_use]
    pub fn one(&self) -> f64 {
        self.one
    }

    /// The integer nearest to `value`, which is clamped to 0..1.
    #[inline(always)]
    #[must_use]
    pub fn integer(self, value: f32) -> i32 {
        // Comparisons instead of `clamp`: they are one instruction each, and turn NaN into 0.
        let value = if value > 0.0 { value } else { 0.0 };
        let value = if value < 1.0 { value } else { 1.0 };
        // In this binade the mantissa counts steps of 1/one: adding rounds, subtracting the bits
        // leaves the count.
        let rounded = value * self.factor + self.offset;
        rounded.to_bits().wrapping_sub(self.offset.to_bits()).cast_signed()
    }
}

/// The mean of a number of [`FixedPoint`] values, from their sum.
#[derive(Debug, Clone, Copy)]
pub struct Mean {
    per_level: f64,
    per_unit: f64,
}

/// From here to twice this, double-precision numbers are the integers.
const TWO_TO_52: f64 = 4_503_599_627_370_496.0;

impl Mean {
    /// The mean of `count` values.
    #[must_use]
    pub fn of(count: f64, fixed: FixedPoint) -> Self {
        Self { per_level: 1.0 / count, per_unit: 1.0 / (count * fixed.one) }
    }

    /// The mean whose sum is `sum` ≥ 0: in 8-bit precision the level ⌊sum/count⌋.
    #[inline(always)]
    #[must_use]
    pub fn store<L: Levels>(self, sum: i64) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "sums are below 2⁵²")]
        let sum = sum as f64;
        if L::EIGHT_BIT {
            // Half a summand more: the quotient is then at least 0.5/count away from any integer,
            // far more than its rounding error, and its floor is the nearest integer to what is
            // half below it. Adding 2⁵² rounds to that; converting would cost more.
            let rounded = (sum + 0.5) * self.per_level - 0.5 + TWO_TO_52 - TWO_TO_52;
            convert::single(rounded) * (1.0 / 255.0)
        } else {
            convert::single(sum * self.per_unit)
        }
    }
}

/// Places relative to the one that a sum is for.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    first: i64,
    count: u32,
    is_negative: bool,
}

impl Window {
    /// `count` places from `first` on.
    #[must_use]
    pub fn new(first: i64, count: u32) -> Self {
        Self { first, count, is_negative: false }
    }

    /// The 2 · `radius` + 1 places around the middle one.
    #[must_use]
    pub fn around(radius: u32) -> Self {
        Self::new(-i64::from(radius), 2 * radius + 1)
    }

    /// The window, subtracted instead of added.
    #[must_use]
    pub fn negative(mut self) -> Self {
        self.is_negative = true;
        self
    }

    /// The sum over the window around place 0 of a ring. `load` makes an integer of a number.
    #[must_use]
    pub fn sum<T: Copy>(self, ring: &[T], load: impl Fn(T) -> i32) -> i64 {
        self.on_ring(ring.len() as u64).sum(ring, &load)
    }

    /// Where the window lies on a ring of `length` places, for place 0.
    fn on_ring(self, length: u64) -> RingWindow {
        let count = u64::from(self.count);
        let start = self.first.rem_euclid(length.cast_signed()).cast_unsigned();
        let (turns, rest) = (count / length, count % length);
        let end = (start + rest) % length;
        let (plus, minus) = if self.is_negative { (start, end) } else { (end, start) };
        RingWindow { start, rest, turns, plus, minus, is_negative: self.is_negative }
    }
}

/// A [`Window`] on a ring: whole turns, and `rest` places from `start` on. When it moves by one
/// place, the sum gains the number at `plus` and loses that at `minus`.
#[derive(Debug, Clone, Copy)]
struct RingWindow {
    start: u64,
    rest: u64,
    turns: u64,
    plus: u64,
    minus: u64,
    is_negative: bool,
}

/// The places 0..`count` of a ring, cut into runs in which no tap wraps, with the taps for the
/// first place of each. (An iterator, because a closure would not be compiled for the SIMD level.)
struct Runs<const K: usize> {
    /// Positions on the ring for the next place.
    taps: [[usize; K]; 2],
    length: usize,
    done: usize,
    count: usize,
}

impl<const K: usize> Runs<K> {
    #[inline(always)]
    fn new(taps: [[usize; K]; 2], length: usize, count: usize) -> Self {
        Self { taps, length, done: 0, count }
    }
}

impl<const K: usize> Iterator for Runs<K> {
    type Item = (Range<usize>, [[usize; K]; 2]);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.done == self.count {
            return None;
        }
        let rest = self.count - self.done;
        let to_wrap = self.taps.iter().flatten().map(|tap| self.length - tap).min().unwrap_or(rest);
        let step = to_wrap.min(rest);
        let run = (self.done..self.done + step, self.taps);
        self.done += step;
        for tap in self.taps.iter_mut().flatten() {
            *tap = if *tap + step == self.length { 0 } else { *tap + step };
        }
        Some(run)
    }
}

/// A sum over windows around each place of a row that wraps around.
#[derive(Debug, Clone, Copy)]
pub struct SlidingSum<const K: usize> {
    windows: [RingWindow; K],
}

impl<const K: usize> SlidingSum<K> {
    /// The sum over all `windows`, on rows of `length` numbers.
    #[must_use]
    pub fn new(windows: [Window; K], length: u32) -> Self {
        Self { windows: windows.map(|window| window.on_ring(u64::from(length))) }
    }

    /// Writes `store` of the sum at each place. `load` makes an integer of a number of the row.
    #[inline(always)]
    pub fn along<T: Copy, O>(
        &self,
        row: &[T],
        load: impl Fn(T) -> i32,
        out: &mut [O],
        store: impl Fn(i64) -> O,
    ) {
        self.on(row, &load).along(load, out, |_, sum| store(sum));
    }

    /// The sum on a row, before it runs.
    #[inline(always)]
    #[must_use]
    pub fn on<'a, T: Copy>(&self, row: &'a [T], load: impl Fn(T) -> i32) -> RunningSum<'a, T, K> {
        RunningSum {
            sum: self.windows.iter().map(|window| window.sum(row, &load)).sum(),
            gained: self.windows.map(|window| Tap::at(row, window.plus)),
            lost: self.windows.map(|window| Tap::at(row, window.minus)),
        }
    }
}

/// A place of a ring of numbers.
#[derive(Debug, Clone, Copy)]
pub struct Tap<'a, T> {
    ring: &'a [T],
    place: usize,
}

impl<'a, T> Tap<'a, T> {
    /// Place `place`, which may be some turns on or back.
    #[inline(always)]
    #[must_use]
    pub fn new(ring: &'a [T], place: i64) -> Self {
        Self::at(ring, place.rem_euclid(ring.len() as i64).cast_unsigned())
    }

    #[inline(always)]
    fn at(ring: &'a [T], place: u64) -> Self {
        Self { ring, place: index(place) }
    }
}

/// A sum that moves along rings of one length, together with its taps.
#[derive(Debug, Clone, Copy)]
pub struct RunningSum<'a, T, const K: usize> {
    /// The sum at place 0.
    pub sum: i64,
    /// Where, for place 0, the numbers lie that the next sum has and this one has not.
    pub gained: [Tap<'a, T>; K],
    /// Where those lie that this one has and the next one has not.
    pub lost: [Tap<'a, T>; K],
}

impl<T: Copy, const K: usize> RunningSum<'_, T, K> {
    /// Writes `store` of each place and the sum there. `load` makes an integer of a number.
    #[inline(always)]
    pub fn along<O>(self, load: impl Fn(T) -> i32, out: &mut [O], store: impl Fn(usize, i64) -> O) {
        let Self { mut sum, gained, lost } = self;
        let length = gained.first().map_or(out.len(), |tap| tap.ring.len());
        let taps = [gained.map(|tap| tap.place), lost.map(|tap| tap.place)];
        for (places, taps) in Runs::new(taps, length, out.len()) {
            let (start, count) = (places.start, places.len());
            let gained: [_; K] = std::array::from_fn(|k| &gained[k].ring[taps[0][k]..][..count]);
            let lost: [_; K] = std::array::from_fn(|k| &lost[k].ring[taps[1][k]..][..count]);
            for (i, out) in out[places].iter_mut().enumerate() {
                *out = store(start + i, sum);
                for k in 0..K {
                    sum += i64::from(load(gained[k][i])) - i64::from(load(lost[k][i]));
                }
            }
        }
    }
}

impl RingWindow {
    /// The sum at place 0.
    fn sum<T: Copy>(&self, row: &[T], load: &impl Fn(T) -> i32) -> i64 {
        let load = |number| i64::from(load(number));
        let ring = row.iter().chain(row).skip(index(self.start)).take(index(self.rest));
        let mut sum: i64 = ring.map(|number| load(*number)).sum();
        if self.turns > 0 {
            let turn: i64 = row.iter().map(|number| load(*number)).sum();
            sum += self.turns.cast_signed() * turn;
        }
        if self.is_negative { -sum } else { sum }
    }
}

/// A place on a ring as an index.
fn index(place: u64) -> usize {
    usize::try_from(place).expect("a ring has as many places as an image has pixels")
}

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

    /// The work: fill every band, in any order, then read `sums`.
    pub fn bands<'a>(&self, image: &'a Image, sums: &'a mut LineSums) -> Vec<Band<'a, K>> {
        let width = self.width as usize;
        // Enough bands for many threads, but pieces of rows that are worth fetching.
        let columns = (width / 8).clamp(512, 2048).next_multiple_of(16);
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
mod tests {
    use super::*;
    use crate::{
        math::levels::{Continuous, EightBit},
        value::BufferPool,
    };

    fn image(width: u32, height: u32) -> Image {
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
                for band in plan.bands(&image, &mut sums).iter_mut().rev() {
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

    #[test]
    fn sliding_sums_are_those_of_the_definition() {
        for width in [1, 2, 7, 40] {
            let image = image(width, 1);
            let fixed = FixedPoint::new::<EightBit>(1);
            for window in
                [Window::around(0), Window::around(3), Window::around(45), Window::new(2, 5)]
            {
                let mut out = vec![0.0; width as usize];
                let sum = SlidingSum::new([window.negative()], width);
                sum.along(image.row(0, 0), |v| fixed.integer(v), &mut out, |sum| sum as f32);
                for (x, sum) in (0..width).zip(&out) {
                    let expected: i64 = (0..i64::from(window.count))
                        .map(|i| convert::wrap(i64::from(x) + window.first + i, width))
                        .map(|x| i64::from(fixed.integer(image.row(0, 0)[x as usize])))
                        .sum();
                    assert_eq!(*sum, -expected as f32, "{width} {window:?}");
                }
            }
        }
    }

    #[test]
    fn fixed_point_numbers_never_overflow_and_are_fine() {
        for summands in [1, 255, 256, 131_073, u32::MAX] {
            let fixed = FixedPoint::new::<Continuous>(summands);
            assert!(f64::from(fixed.integer(1.0)) == fixed.one());
            assert!(summands > 1 << 31 || fixed.one() * f64::from(summands) < 2_147_483_648.0);
        }
        let fixed = FixedPoint::new::<Continuous>(255);
        assert_eq!((fixed.integer(0.5), fixed.integer(-1.0)), (1 << 22, 0));
        assert_eq!((fixed.integer(9.0), fixed.integer(f32::NAN)), (1 << 23, 0));
    }

    #[test]
    fn an_eight_bit_mean_is_the_floor_of_the_quotient() {
        let fixed = FixedPoint::new::<EightBit>(1);
        for count in [3_i64, 441, 40_401, 131_073 * 131_073] {
            let mean = Mean::of(count as f64, fixed);
            for level in 1..=255_i64 {
                for (sum, floor) in [(level * count, level), (level * count - 1, level - 1)] {
                    let mean = crate::math::levels::to_level(mean.store::<EightBit>(sum));
                    assert_eq!(mean, floor as f32, "{sum}/{count}");
                }
            }
        }
    }
}
