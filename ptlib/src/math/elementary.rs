//! Elementary functions with the same bits on every platform.
//!
//! The `f32` functions are polynomials without branches, so that a loop over a row vectorises.
//! Their error is a few units in the last place, far below the 16-bit steps of a picture. The
//! `f64` functions are those of the `libm` crate (a port of musl's), for numbers that are computed
//! once per block.

use std::f32::consts::{FRAC_PI_2, LN_2, LOG2_E, PI};

/// Sine of `turns` full turns: `sin(2π · turns)`. Any finite number of turns; the error is below
/// 4·10⁻⁷ for |turns| < 2¹⁶.
#[inline(always)]
#[must_use]
pub fn sin_turns(turns: f32) -> f32 {
    // To -0.5..0.5 turns, then folded to -0.25..0.25 by sin(π - x) = sin x.
    let turns = turns - (turns + 0.5).floor();
    let folded = if turns > 0.25 {
        0.5 - turns
    } else if turns < -0.25 {
        -0.5 - turns
    } else {
        turns
    };
    sin_quarter(folded)
}

/// Cosine of `turns` full turns.
#[inline(always)]
#[must_use]
pub fn cos_turns(turns: f32) -> f32 {
    let turns = turns - (turns + 0.5).floor();
    sin_quarter(0.25 - turns.abs())
}

/// Sine of `turns` full turns for |turns| ≤ 0.25.
///
/// Minimax polynomial of sin(2πx)/x in x², degree 5 in x².
#[inline(always)]
#[must_use]
pub fn sin_quarter(turns: f32) -> f32 {
    let x = turns * (2.0 * PI);
    let s = x * x;
    // Taylor coefficients with the last one adjusted for the interval; the error at π/2 is
    // below 2⁻²⁵.
    let p = -2.505_210_8e-8 + s * 1.591_8e-10;
    let p = 2.755_731_9e-6 + s * p;
    let p = -1.984_127e-4 + s * p;
    let p = 8.333_333e-3 + s * p;
    let p = -1.666_666_7e-1 + s * p;
    x + x * s * p
}

/// `2` to the power `x`, for -126 ≤ x ≤ 127; results outside the normal range are clamped to it.
#[inline(always)]
#[must_use]
pub fn exp2(x: f32) -> f32 {
    let x = x.clamp(-126.0, 127.0);
    let whole = (x + 0.5).floor();
    let t = (x - whole) * LN_2;
    // exp on ±ln2/2 by its Taylor series; the eighth term is below 2⁻²⁶.
    let p = 1.388_888_9e-3 + t * 1.984_127e-4;
    let p = 8.333_333e-3 + t * p;
    let p = 4.166_666_7e-2 + t * p;
    let p = 1.666_666_7e-1 + t * p;
    let p = 0.5 + t * p;
    let p = 1.0 + t * p;
    let p = 1.0 + t * p;
    let exponent = super::convert::truncate(whole) + 127;
    p * f32::from_bits(exponent.cast_unsigned() << 23)
}

/// Logarithm of `x` to the base 2, for positive normal `x`; 0 and smaller numbers count as the
/// smallest normal number.
#[inline(always)]
#[must_use]
pub fn log2(x: f32) -> f32 {
    let bits = x.max(f32::MIN_POSITIVE).to_bits().cast_signed();
    // Mantissa to √½..√2, so that the series is short on both sides of 1.
    let shifted = bits - 0x3f35_04f3;
    let exponent = shifted >> 23;
    let mantissa = f32::from_bits((bits - (exponent << 23)).cast_unsigned());
    // ln m = 2 artanh((m - 1)/(m + 1)).
    let r = (mantissa - 1.0) / (mantissa + 1.0);
    let s = r * r;
    let p = 0.142_857_15 + s * 0.111_111_11;
    let p = 0.2 + s * p;
    let p = 0.333_333_34 + s * p;
    let ln = 2.0 * (r + r * s * p);
    exponent as f32 + ln * LOG2_E
}

/// `base` to the power `exponent` for 0 ≤ base; the error grows with the exponent, about
/// 10⁻⁶ · |exponent · log2 base| of the result. 0⁰ is 1, 0 to a positive power is 0.
#[inline(always)]
#[must_use]
pub fn power(base: f32, exponent: f32) -> f32 {
    let result = exp2(exponent * log2(base));
    if base > 0.0 || exponent == 0.0 {
        result
    } else if exponent > 0.0 {
        0.0
    } else {
        f32::MAX
    }
}

/// Arc cosine of `x` in radians, 0..π; `x` outside -1..1 is clamped.
///
/// Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.46: error below 3·10⁻⁸ plus
/// rounding.
#[inline(always)]
#[must_use]
pub fn acos(x: f32) -> f32 {
    let x = x.clamp(-1.0, 1.0);
    let a = x.abs();
    let p = 6.670_09e-3 + a * -1.262_491_1e-3;
    let p = -1.708_812_6e-2 + a * p;
    let p = 3.089_188e-2 + a * p;
    let p = -5.017_43e-2 + a * p;
    let p = 8.897_899e-2 + a * p;
    let p = -2.145_988e-1 + a * p;
    let p = FRAC_PI_2 + a * p;
    let result = (1.0 - a).sqrt() * p;
    if x < 0.0 { PI - result } else { result }
}

/// Sine in double precision, `x` in radians.
#[must_use]
pub fn sin64(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine in double precision, `x` in radians.
#[must_use]
pub fn cos64(x: f64) -> f64 {
    libm::cos(x)
}

/// Tangent in double precision, `x` in radians.
#[must_use]
pub fn tan64(x: f64) -> f64 {
    libm::tan(x)
}

/// Angle of the vector (`x`, `y`) in radians, -π..π.
#[must_use]
pub fn atan2_64(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// `base` to the power `exponent` in double precision.
#[must_use]
pub fn power64(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// Angle in radians whose sine is `x`, -π/2..π/2.
#[must_use]
pub fn asin64(x: f64) -> f64 {
    libm::asin(x)
}

/// Angle in radians whose cosine is `x`, 0..π.
#[must_use]
pub fn acos64(x: f64) -> f64 {
    libm::acos(x)
}

/// Angle in radians whose tangent is `x`, -π/2..π/2.
#[must_use]
pub fn atan64(x: f64) -> f64 {
    libm::atan(x)
}

/// e to the power `x`.
#[must_use]
pub fn exp64(x: f64) -> f64 {
    libm::exp(x)
}

/// 2 to the power `x`.
#[must_use]
pub fn exp2_64(x: f64) -> f64 {
    libm::exp2(x)
}

/// Natural logarithm of `x`.
#[must_use]
pub fn log64(x: f64) -> f64 {
    libm::log(x)
}

/// Logarithm of `x` to the base 2.
#[must_use]
pub fn log2_64(x: f64) -> f64 {
    libm::log2(x)
}

/// Hyperbolic tangent of `x`.
#[must_use]
pub fn tanh64(x: f64) -> f64 {
    libm::tanh(x)
}

/// Cube root of `x`.
#[must_use]
pub fn cbrt64(x: f64) -> f64 {
    libm::cbrt(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_follow_the_exact_ones() {
        for i in -20_000..=20_000_i16 {
            let turns = f32::from(i) / 4096.0;
            let exact = libm::sin(f64::from(turns) * std::f64::consts::TAU);
            assert!((f64::from(sin_turns(turns)) - exact).abs() < 4e-7, "sin of {turns} turns");
            let exact = libm::cos(f64::from(turns) * std::f64::consts::TAU);
            assert!((f64::from(cos_turns(turns)) - exact).abs() < 4e-7, "cos of {turns} turns");
        }
    }

    #[test]
    fn powers_follow_the_exact_ones() {
        for i in 1..=1000_u16 {
            let base = f32::from(i) / 1000.0;
            for exponent in [0.0, 0.5, 1.0, 2.0, 3.5, 10.0, -2.0] {
                let exact = libm::pow(f64::from(base), f64::from(exponent));
                let error = (f64::from(power(base, exponent)) - exact).abs();
                assert!(error <= 2e-5 * exact.max(1e-3), "{base} to {exponent}: off by {error}");
            }
        }
        assert_eq!(power(0.0, 2.0), 0.0);
        assert_eq!(power(0.0, 0.0), 1.0);
        assert_eq!(power(0.0, -1.0), f32::MAX);
    }

    #[test]
    fn arc_cosine_follows_the_exact_one() {
        for i in -1000..=1000_i16 {
            let x = f32::from(i) / 1000.0;
            let exact = libm::acos(f64::from(x));
            assert!((f64::from(acos(x)) - exact).abs() < 1e-6, "acos of {x}");
        }
        assert_eq!(acos(2.0), acos(1.0));
    }
}
