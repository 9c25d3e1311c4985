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
pub(super) enum Store {
    /// 0..1, as they are.
    Unit,
    /// 0..1, truncated to levels.
    Levels,
    /// Any finite number.
    Free,
}

impl Store {
    pub(super) fn of(precision: Precision, is_free: bool) -> Self {
        match (is_free, precision) {
            (true, _) => Self::Free,
            (false, Precision::Float) => Self::Unit,
            (false, Precision::EightBit) => Self::Levels,
        }
    }

    /// Stores `values`; returns how many were not finite.
    pub(super) fn apply(self, simd: SimdLevel, values: &mut [f32]) -> u32 {
        match self {
            Self::Unit => simd.run(StoreUnit::<Continuous>(values, Continuous)),
            Self::Levels => simd.run(StoreUnit::<EightBit>(values, EightBit)),
            Self::Free => simd.run(StoreFree(values)),
        }
    }
}

struct StoreUnit<'a, L>(&'a mut [f32], L);

impl<L: Levels> Kernel for StoreUnit<'_, L> {
    type Output = u32;

    #[inline(always)]
    fn run(self) -> u32 {
        let mut strange = 0;
        for value in self.0 {
            strange += u32::from(!value.is_finite());
            // Written so that NaN becomes 0.
            let positive = if *value > 0.0 { *value } else { 0.0 };
            *value = L::store(if positive < 1.0 { positive } else { 1.0 });
        }
        strange
    }
}

struct StoreFree<'a>(&'a mut [f32]);

impl Kernel for StoreFree<'_> {
    type Output = u32;

    #[inline(always)]
    fn run(self) -> u32 {
        let mut strange = 0;
        for value in self.0 {
            strange += u32::from(!value.is_finite());
            *value = if value.is_finite() { *value } else { 0.0 };
        }
        strange
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stored(store: Store, values: [f32; 5]) -> ([f32; 5], u32) {
        let results = SimdLevel::available().into_iter().map(|simd| {
            let mut values = values;
            let strange = store.apply(simd, &mut values);
            (values, strange)
        });
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
