//! The store at the end of each block: every value that leaves a block passes here.
//!
//! Architecture, 3: an output of range *unit* is clamped to 0..1, and truncated to levels in 8-bit
//! precision; a number that is not finite becomes 0 and is counted.

use crate::math::{
    levels::{Continuous, EightBit, Levels, Precision},
    simd::{Kernel, SimdLevel},
};

/// How the values of an output are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Store {
    /// 0..1, as they are.
    Unit,
    /// 0..1, truncated to levels.
    Levels,
    /// Any finite number.
    Free,
}

impl Store {
    /// How an output of that precision is stored.
    pub(crate) fn of(precision: Precision, is_free: bool) -> Self {
        match (is_free, precision) {
            (true, _) => Self::Free,
            (false, Precision::Float) => Self::Unit,
            (false, Precision::EightBit) => Self::Levels,
        }
    }

    /// Stores `values`; returns how many were not finite.
    pub(crate) fn apply(self, simd: SimdLevel, values: &mut [f32]) -> u32 {
        simd.run(Apply(self, values))
    }

    /// Stores `change` of each value in its place; returns how many were not finite. For code that
    /// runs inside of a [`Kernel`].
    #[inline(always)]
    pub(crate) fn change(self, values: &mut [f32], change: impl Fn(f32) -> f32) -> u32 {
        match self {
            Self::Unit => in_place(values, change, unit::<Continuous>),
            Self::Levels => in_place(values, change, unit::<EightBit>),
            Self::Free => in_place(values, change, finite),
        }
    }

    /// Stores `value` of each input; returns how many were not finite. For code that runs inside
    /// of a [`Kernel`]: what is stored as it is made is not read and written once more.
    #[inline(always)]
    pub(crate) fn map(self, inputs: &[f32], out: &mut [f32], value: impl Fn(f32) -> f32) -> u32 {
        match self {
            Self::Unit => map(inputs, out, &value, unit::<Continuous>),
            Self::Levels => map(inputs, out, &value, unit::<EightBit>),
            Self::Free => map(inputs, out, &value, finite),
        }
    }
}

/// Written so that NaN becomes 0.
#[inline(always)]
fn unit<L: Levels>(value: f32) -> f32 {
    let positive = if value > 0.0 { value } else { 0.0 };
    L::store(if positive < 1.0 { positive } else { 1.0 })
}

#[inline(always)]
fn finite(value: f32) -> f32 {
    if value.is_finite() { value } else { 0.0 }
}

/// The largest magnitude tells whether any value is not finite, at half the price of counting: they
/// are only counted if there are some.
#[inline(always)]
fn map(
    inputs: &[f32],
    out: &mut [f32],
    value: &impl Fn(f32) -> f32,
    store: impl Fn(f32) -> f32,
) -> u32 {
    let mut largest = 0;
    for (out, input) in out.iter_mut().zip(inputs) {
        let value = value(*input);
        largest = value.abs().to_bits().max(largest);
        *out = store(value);
    }
    if largest < f32::INFINITY.to_bits() {
        return 0;
    }
    inputs.iter().map(|input| u32::from(!value(*input).is_finite())).sum()
}

struct Apply<'a>(Store, &'a mut [f32]);

impl Kernel for Apply<'_> {
    type Output = u32;

    #[inline(always)]
    fn run(self) -> u32 {
        self.0.change(self.1, |value| value)
    }
}

#[inline(always)]
fn in_place(values: &mut [f32], change: impl Fn(f32) -> f32, store: impl Fn(f32) -> f32) -> u32 {
    let mut strange = 0;
    for value in values {
        let changed = change(*value);
        strange += u32::from(!changed.is_finite());
        *value = store(changed);
    }
    strange
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stored(store: Store, values: [f32; 5]) -> ([f32; 5], u32) {
        let in_place = SimdLevel::available().into_iter().map(|simd| {
            let mut values = values;
            let strange = store.apply(simd, &mut values);
            (values, strange)
        });
        let mut mapped = [f32::NAN; 5];
        let strange = store.map(&values.map(|value| value * 0.5), &mut mapped, |half| half * 2.0);
        let results = in_place.chain([(mapped, strange)]);
        results
            .reduce(|a, b| if a == b { a } else { panic!("levels differ: {a:?} {b:?}") })
            .unwrap()
    }

    #[test]
    fn unit_values_are_clamped_and_strange_ones_counted() {
        let values = [-0.5, 0.5, 1.5, f32::NAN, f32::NEG_INFINITY];
        assert_eq!(stored(Store::Unit, values), ([0.0, 0.5, 1.0, 0.0, 0.0], 2));
        let (levels, strange) = stored(Store::Levels, values);
        assert_eq!((levels[1], strange), (127.0 / 255.0, 2));
    }

    #[test]
    fn free_values_stay_unless_they_are_not_finite() {
        let values = [-7.5, 1e30, f32::INFINITY, f32::NAN, 0.0];
        assert_eq!(stored(Store::Free, values), ([-7.5, 1e30, 0.0, 0.0, 0.0], 2));
    }
}
