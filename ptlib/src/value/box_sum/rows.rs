//! Sums that slide along a row.

use super::{RingWindow, Runs, Window, index};

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
}
