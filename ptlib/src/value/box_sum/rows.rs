//! Sums that slide along a row.

use std::ops::Range;

use super::{
    RingWindow, Runs, Window, index,
    scan::{MOST, Scan},
};
use crate::math::simd;

/// A sum over windows around each place of a row that wraps around.
#[derive(Debug, Clone, Copy)]
pub struct SlidingSum<const K: usize> {
    windows: [RingWindow; K],
    extent: Extent,
}

impl<const K: usize> SlidingSum<K> {
    /// The sum over all `windows`, on rows of `length` numbers, for sums that fit an `i32`.
    #[must_use]
    pub fn new(windows: [Window; K], length: u32) -> Self {
        let windows = windows.map(|window| window.on_ring(u64::from(length)));
        Self { windows, extent: Extent::Signed32 }
    }

    /// The same for sums that are as large as that.
    #[must_use]
    pub fn reaching(self, extent: Extent) -> Self {
        Self { extent, ..self }
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
        self.on(row, &load).along(load, out, |out, sum| *out = store(sum));
    }

    /// The sum on a row, before it runs.
    #[inline(always)]
    #[must_use]
    pub fn on<'a, T: Copy>(&self, row: &'a [T], load: impl Fn(T) -> i32) -> RunningSum<'a, T, K> {
        RunningSum {
            extent: self.extent,
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

/// How large the sums of a row may be. Those that fit 32 bits are made many at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// From 0 to below 2³².
    Unsigned32,
    /// From -2³¹ to below 2³¹.
    Signed32,
    /// Below 2⁵².
    Large,
}

impl Extent {
    /// That of sums that are at most so large, with either sign.
    #[must_use]
    pub fn of_signed(largest: f64) -> Self {
        if largest <= f64::from(i32::MAX) { Self::Signed32 } else { Self::Large }
    }
}

/// A sum that moves along rings of one length, together with its taps.
#[derive(Debug, Clone, Copy)]
pub struct RunningSum<'a, T, const K: usize> {
    /// Which sums there may be.
    pub extent: Extent,
    /// The sum at place 0.
    pub sum: i64,
    /// Where, for place 0, the numbers lie that the next sum has and this one has not.
    pub gained: [Tap<'a, T>; K],
    /// Where those lie that this one has and the next one has not.
    pub lost: [Tap<'a, T>; K],
}

impl<T: Copy, const K: usize> RunningSum<'_, T, K> {
    /// Hands the sum at each place to `store`, with what belongs to the place in `out`. `load` makes
    /// an integer of a number.
    #[inline(always)]
    pub fn along<O>(self, load: impl Fn(T) -> i32, out: &mut [O], store: impl Fn(&mut O, i64)) {
        match self.extent {
            Extent::Unsigned32 => {
                self.many_at_a_time(load, out, |out, sum| store(out, i64::from(sum)));
            }
            Extent::Signed32 => {
                let store = |out: &mut O, sum: u32| store(out, i64::from(sum.cast_signed()));
                self.many_at_a_time(load, out, store);
            }
            Extent::Large => self.one_by_one(load, out, store),
        }
    }

    #[inline(always)]
    fn one_by_one<O>(self, load: impl Fn(T) -> i32, out: &mut [O], store: impl Fn(&mut O, i64)) {
        let mut sum = self.sum;
        for (places, gained, lost) in self.runs(out.len()) {
            for (i, out) in out[places].iter_mut().enumerate() {
                store(out, sum);
                for k in 0..K {
                    sum += i64::from(load(gained[k][i])) - i64::from(load(lost[k][i]));
                }
            }
        }
    }

    /// The same in 32 bits: they are those of the sums, however far the numbers on the way leave
    /// that range.
    #[inline(always)]
    fn many_at_a_time<O>(
        self,
        load: impl Fn(T) -> i32,
        out: &mut [O],
        store: impl Fn(&mut O, u32),
    ) {
        let mut scan = Scan::new(self.sum);
        let (mut sums, mut rest) = (self, out);
        while !rest.is_empty() {
            let (out, behind) = rest.split_at_mut(rest.len().min(MOST));
            simd::fetch_to_write(&behind[..behind.len().min(MOST)]);
            let steps = scan.steps(out.len());
            for (places, gained, lost) in sums.runs(steps.len()) {
                for (i, step) in steps[places].iter_mut().enumerate() {
                    *step = 0;
                    for k in 0..K {
                        *step = step.wrapping_add(load(gained[k][i]).cast_unsigned());
                        *step = step.wrapping_sub(load(lost[k][i]).cast_unsigned());
                    }
                }
            }
            let count = out.len();
            for (out, sum) in out.iter_mut().zip(scan.sums(count)) {
                store(out, *sum);
            }
            sums = sums.moved(count);
            rest = behind;
        }
    }

    /// The taps, for the place that many places on.
    #[inline(always)]
    fn moved(self, places: usize) -> Self {
        let moved = |Tap { ring, place }| Tap { ring, place: (place + places) % ring.len() };
        Self { gained: self.gained.map(moved), lost: self.lost.map(moved), ..self }
    }

    /// Runs of the places 0..`count` in which no tap wraps, with what the taps pass there.
    #[inline(always)]
    fn runs(&self, count: usize) -> impl Iterator<Item = Passed<'_, T, K>> {
        let length = self.gained.first().map_or(count, |tap| tap.ring.len());
        let taps = [self.gained.map(|tap| tap.place), self.lost.map(|tap| tap.place)];
        Runs::new(taps, length, count).map(move |(places, taps)| {
            let count = places.len();
            let gained = std::array::from_fn(|k| &self.gained[k].ring[taps[0][k]..][..count]);
            let lost = std::array::from_fn(|k| &self.lost[k].ring[taps[1][k]..][..count]);
            (places, gained, lost)
        })
    }
}

/// A run of places, and the numbers that the sum gains and loses on it.
type Passed<'a, T, const K: usize> = (Range<usize>, [&'a [T]; K], [&'a [T]; K]);

#[cfg(test)]
mod tests {
    use super::{
        super::{FixedPoint, lines::tests::image},
        *,
    };
    use crate::math::{convert, levels::EightBit};

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
    fn many_sums_at_a_time_are_those_of_one_by_one() {
        for width in [31, 40, 255, 300, 1000] {
            let image = image(width, 1);
            let load = |value: f32| convert::truncate(value * 8e6);
            for radius in [0, 3, 100, 255] {
                let sliding = SlidingSum::new([Window::around(radius)], width);
                let found = |extent| {
                    let mut out = vec![0; width as usize];
                    let sum = sliding.reaching(extent).on(image.row(0, 0), load);
                    sum.along(load, &mut out, |out, sum| *out = sum);
                    out
                };
                let expected = found(Extent::Large);
                assert_eq!(found(Extent::Unsigned32), expected, "{width}, radius {radius}");
                if radius < 100 {
                    assert_eq!(found(Extent::Signed32), expected, "{width}, radius {radius}");
                }
            }
        }
    }
}
