//! How normals lie in the channels of an image.
//!
//! x and y always lie in red and green, as n/2 + ½. Of z there are two customs, which readers have
//! to be told.

use ptlib_plugin::prelude::*;

/// Pixels that are computed before they are written: into memory of their own, for only where
/// nothing overlaps does the compiler compute several pixels at once.
pub const LANES: usize = 128;

choice! {
    /// How the third component of a normal lies in the blue channel.
    ZRange {
        /// As it is: 0 for a normal that lies in the surface, 1 for one straight up.
        Positive = "positive",
        /// Halved and raised by one half as the other two, as most programs expect it.
        Signed = "signed",
    }
}

/// From a component to its channel and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packing {
    scale: f32,
    offset: f32,
    /// 1 / `scale`.
    inverse: f32,
}

impl ZRange {
    /// The packing of z.
    pub fn packing(self) -> Packing {
        match self {
            Self::Positive => Packing { scale: 1.0, offset: 0.0, inverse: 1.0 },
            Self::Signed => Packing::HALVED,
        }
    }
}

impl Packing {
    /// That of x and y.
    pub const HALVED: Self = Self { scale: 0.5, offset: 0.5, inverse: 2.0 };

    /// The channel's value, in 0..1 although components of a unit vector may be rounded to more.
    #[inline(always)]
    pub fn packed(self, component: f32) -> f32 {
        (component * self.scale + self.offset).clamp(0.0, 1.0)
    }

    /// The component.
    #[inline(always)]
    pub fn unpacked(self, value: f32) -> f32 {
        (value - self.offset) * self.inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_comes_back() {
        for packing in [ZRange::Positive.packing(), ZRange::Signed.packing()] {
            for component in [0.0, 0.25, 0.8, 1.0] {
                assert!((packing.unpacked(packing.packed(component)) - component).abs() < 1e-6);
            }
        }
        assert_eq!(ZRange::Signed.packing().packed(-0.5), 0.25);
        assert_eq!(Packing::HALVED.packed(1.000_001), 1.0);
    }
}
