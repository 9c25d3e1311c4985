//! The functions of the inner loops, in single precision and without branches, so that the loops
//! vectorise.
//!
//! They are sums and products in a fixed order, which have the same bits on every platform. The
//! polynomials interpolate at the nodes of Chebyshev; errors are a few units in the last place.

/// Added and taken away again, it rounds numbers of a size below 2²² to whole ones, ties to even:
/// the number's last bit then stands for 1.
const ROUNDER: f32 = 12_582_912.0;

/// The greater of `x` and 0.
#[inline(always)]
pub(super) fn positive(x: f32) -> f32 {
    if x > 0.0 { x } else { 0.0 }
}

/// The smaller of `x` and 1.
#[inline(always)]
pub(super) fn at_most_one(x: f32) -> f32 {
    if x < 1.0 { x } else { 1.0 }
}

/// The step x²(3 - 2x), without slope at 0 and 1. `x` lies in 0..1.
#[inline(always)]
pub(super) fn smooth(x: f32) -> f32 {
    x * x * (3.0 - 2.0 * x)
}

/// |sin πx|, for |x| below 2²².
#[inline(always)]
pub(super) fn bulge(x: f32) -> f32 {
    let r = x - ((x + ROUNDER) - ROUNDER);
    let s = r * r;
    let p = -5.982_913e-1 + s * 7.765_766e-2;
    let p = 2.550_077_4 + s * p;
    let p = -5.167_71 + s * p;
    let p = std::f32::consts::PI + s * p;
    (r * p).abs()
}

/// Angle in radians whose sine is `x`, for 0 ≤ x ≤ 1. Its relative error is small near 0 too.
#[inline(always)]
pub(super) fn asin(x: f32) -> f32 {
    let is_small = x <= 0.5;
    // Above a half by asin x = π/2 - 2 asin √((1 - x)/2).
    let s = if is_small { x * x } else { 0.5 - 0.5 * x };
    let root = if is_small { x } else { s.sqrt() };
    let p = 2.649_427_7e-2 + s * 3.820_645e-2;
    let p = 4.501_07e-2 + s * p;
    let p = 7.498_809e-2 + s * p;
    let p = 1.666_667_3e-1 + s * p;
    let angle = root + root * s * p;
    if is_small { angle } else { std::f32::consts::FRAC_PI_2 - 2.0 * angle }
}

/// `x` to the power `exponent`, for 0 ≤ x ≤ 1 and a positive exponent; 0 and 1 stay what they are.
#[inline(always)]
pub(super) fn power(x: f32, exponent: f32) -> f32 {
    let result = exp2(exponent * log2(x));
    if x > 0.0 { result } else { 0.0 }
}

/// 2 to the power `x`, for x ≤ 0; below -126 as at -126.
#[inline(always)]
fn exp2(x: f32) -> f32 {
    let x = if x > -126.0 { x } else { -126.0 };
    let shifted = x + ROUNDER;
    let t = (x - (shifted - ROUNDER)) * std::f32::consts::LN_2;
    // The series of exp on ±ln √2; its eighth term is below 2⁻²⁶.
    let p = 1.388_888_9e-3 + t * 1.984_127e-4;
    let p = 8.333_333e-3 + t * p;
    let p = 4.166_666_7e-2 + t * p;
    let p = 1.666_666_7e-1 + t * p;
    let p = 0.5 + t * p;
    let p = 1.0 + t * p;
    let p = 1.0 + t * p;
    // The last bits of `shifted` are the whole number, which becomes the exponent of a power of 2.
    p * f32::from_bits((shifted.to_bits() << 23).wrapping_add(0x3f80_0000))
}

/// Logarithm of `x` to the base 2; below the smallest normal number as there.
#[inline(always)]
fn log2(x: f32) -> f32 {
    let x = if x > f32::MIN_POSITIVE { x } else { f32::MIN_POSITIVE };
    let bits = x.to_bits().cast_signed();
    // The mantissa from √½ to √2, where the series of 2 artanh ((m - 1)/(m + 1)) is short.
    let exponent = (bits - 0x3f35_04f3) >> 23;
    let mantissa = f32::from_bits((bits - (exponent << 23)).cast_unsigned());
    let r = (mantissa - 1.0) / (mantissa + 1.0);
    let s = r * r;
    let p = 0.142_857_15 + s * 0.111_111_11;
    let p = 0.2 + s * p;
    let p = 0.333_333_34 + s * p;
    exponent as f32 + 2.0 * (r + r * s * p) * std::f32::consts::LOG2_E
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods, reason = "what they are compared with")]
    #![allow(clippy::approx_constant, reason = "numbers of the specification")]

    use super::*;

    fn near(x: f32, exact: f64, tolerance: f64) {
        assert!((f64::from(x) - exact).abs() <= tolerance, "{x} for {exact}");
    }

    #[test]
    fn profiles_and_the_step_have_the_values_of_the_specification() {
        let places = [0.0, 0.125, 0.25, 0.3, 0.5, 0.75];
        let bulges = [0.0, 0.382_683, 0.707_107, 0.809_017, 1.0, 0.707_107];
        let waves = [0.0, 0.146_447, 0.5, 0.654_508, 1.0, 0.5];
        for ((x, exact), wave) in places.into_iter().zip(bulges).zip(waves) {
            near(bulge(x), exact, 1e-6);
            near(bulge(x) * bulge(x), wave, 1e-6);
        }
        for (x, exact) in [(0.1, 0.028), (0.25, 0.15625), (0.9, 0.972)] {
            near(smooth(x), exact, 1e-7);
        }
        for (x, exact) in [(0.1, 0.398_107), (0.25, 0.574_349), (0.5, 0.757_858), (0.75, 0.891_301)]
        {
            near(power(x, 0.4), exact, 1e-6);
        }
    }

    #[test]
    fn all_are_as_near_as_single_precision_allows() {
        for i in 0..=10_000_u16 {
            let x = f32::from(i) / 10_000.0;
            let exact = f64::from(x);
            near(bulge(x), (exact * std::f64::consts::PI).sin().abs(), 3e-7);
            near(
                bulge(x + 1000.0),
                (f64::from(x + 1000.0) * std::f64::consts::PI).sin().abs(),
                3e-7,
            );
            near(asin(x), exact.asin(), 2.5e-7);
            for exponent in [0.05, 0.4, 1.0, 4.0] {
                near(power(x, exponent), exact.powf(f64::from(exponent)), 2e-6);
            }
        }
        near(asin(1e-6), 1e-6, 1e-12);
    }

    #[test]
    fn the_ends_are_exact() {
        for exponent in [0.05, 0.4, 4.0] {
            assert_eq!([0.0, 1.0].map(|x| power(x, exponent)), [0.0, 1.0]);
        }
        // Smaller than all normal numbers: as the smallest of these, and not 0.
        assert_eq!(power(1e-44, 0.05), power(f32::MIN_POSITIVE, 0.05));
        assert_eq!([bulge(0.0), bulge(1.0), bulge(1024.0), asin(0.0)], [0.0; 4]);
    }
}
