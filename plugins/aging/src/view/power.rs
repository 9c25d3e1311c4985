//! Powers of numbers from 0 to 1, as highlights take them.
//!
//! Most people leave the exponent a whole number: then a few products do, side by side, and these
//! are the same on every platform. Others come from the host's mathematics.

use ptlib_plugin::math;

use super::texture::{LANES, Lanes};

/// An exponent from 1 to 1000.
#[derive(Debug, Clone, Copy)]
pub struct Power {
    exponent: f64,
    /// It, if it is a whole number.
    whole: Option<u16>,
}

impl Power {
    /// Powers of this exponent.
    pub fn new(exponent: f64) -> Self {
        let whole = (1..=1000_u16).find(|whole| f64::from(*whole) == exponent);
        Self { exponent, whole }
    }

    /// The power of one number; 0 for what is not above 0.
    pub fn of(self, base: f64) -> f64 {
        match self.whole {
            Some(whole) => product([base.max(0.0)], whole)[0],
            None if base > 0.0 => math::pow(base, self.exponent),
            None => 0.0,
        }
    }

    /// The powers of some numbers.
    #[inline(always)]
    pub fn each(self, base: &Lanes) -> Lanes {
        let base = base.map(|base| f64::from(base.max(0.0)));
        match self.whole {
            Some(whole) => product::<LANES>(base, whole).map(math::single),
            None => base.map(|base| math::single(self.of(base))),
        }
    }
}

/// Squares, of which those are multiplied that the exponent has in its binary digits.
#[inline(always)]
fn product<const N: usize>(mut square: [f64; N], mut exponent: u16) -> [f64; N] {
    let mut product = [1.0; N];
    loop {
        if exponent & 1 == 1 {
            (0..N).for_each(|i| product[i] *= square[i]);
        }
        exponent >>= 1;
        if exponent == 0 {
            return product;
        }
        (0..N).for_each(|i| square[i] *= square[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_powers() {
        let _host = crate::testing::engine();
        for exponent in [1.0, 2.0, 19.0, 20.0, 333.0, 1000.0, 20.5] {
            for base in [0.0, 1e-30, 0.3, 0.97, 0.999, 1.0] {
                let expected = if base > 0.0 { math::pow(base, exponent) } else { 0.0 };
                let power = Power::new(exponent);
                assert!((power.of(base) - expected).abs() < 1e-12, "{base}^{exponent}");
                let lanes = power.each(&[math::single(base); LANES]);
                assert!((f64::from(lanes[5]) - expected).abs() < 2e-5, "{base}^{exponent}");
            }
            assert_eq!(Power::new(exponent).of(-0.5), 0.0);
        }
    }
}
