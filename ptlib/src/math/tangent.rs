//! The arc tangent of a quotient and the tangent of that, to the last bit.
//!
//! PT Designer gets the slope of a line as the tangent of its angle. A line that rises 1 in 2 ends
//! half-way between two pixels at every other step; which one is drawn follows from the last bit of
//! that tangent, on which libraries differ. Here both functions are rounded correctly, as by the
//! library that files were made with: once in double precision, then corrected by the residual in
//! twice that precision.

/// An unevaluated sum of two numbers, the second below the last bit of the first (T. J. Dekker, "A
/// floating-point technique for extending the available precision", 1971).
#[derive(Debug, Clone, Copy)]
struct Sum(f64, f64);

impl Sum {
    /// The exact sum of two numbers.
    fn of(a: f64, b: f64) -> Self {
        let sum = a + b;
        let part = sum - a;
        Self(sum, (a - (sum - part)) + (b - part))
    }

    /// The exact product of two numbers.
    fn product(a: f64, b: f64) -> Self {
        let split = |x: f64| {
            let high = 134_217_729.0 * x;
            let high = high - (high - x);
            (high, x - high)
        };
        let (product, (a1, a2), (b1, b2)) = (a * b, split(a), split(b));
        Self(product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
    }

    fn plus(self, other: Self) -> Self {
        let sum = Self::of(self.0, other.0);
        Self::of(sum.0, sum.1 + self.1 + other.1)
    }

    fn times(self, other: Self) -> Self {
        let product = Self::product(self.0, other.0);
        Self::of(product.0, product.1 + (self.0 * other.1 + self.1 * other.0))
    }

    fn divided_by(self, divisor: f64) -> Self {
        let quotient = self.0 / divisor;
        let product = Self::product(quotient, divisor);
        Self::of(quotient, ((self.0 - product.0) - product.1 + self.1) / divisor)
    }
}

/// Sine and cosine of `angle`, 0..=π/2, by their series.
fn sine_and_cosine(angle: f64) -> (Sum, Sum) {
    let square = Sum::product(-angle, angle);
    let (mut sine_term, mut cosine_term) = (Sum(angle, 0.0), Sum(1.0, 0.0));
    let (mut sine, mut cosine) = (sine_term, cosine_term);
    let mut n = 1.0;
    while cosine_term.0.abs() > 1e-34 {
        cosine_term = cosine_term.times(square).divided_by(n * (n + 1.0));
        sine_term = sine_term.times(square).divided_by((n + 1.0) * (n + 2.0));
        cosine = cosine.plus(cosine_term);
        sine = sine.plus(sine_term);
        n += 2.0;
    }
    (sine, cosine)
}

/// The arc tangent of a finite `quotient` ≥ 0, rounded correctly, and by how much that is too
/// large.
pub(super) fn arc_tangent(quotient: f64) -> (f64, f64) {
    let near = libm::atan(quotient);
    let (sine, cosine) = sine_and_cosine(near);
    // sin(near - exact) = (sin near - quotient · cos near) / √(1 + quotient²)
    let product = cosine.times(Sum(-quotient, 0.0));
    let excess = sine.plus(product).0 / (1.0 + quotient * quotient).sqrt();
    let rounded = near - excess;
    (rounded, excess + (rounded - near))
}

/// The tangent of an angle that is `excess` larger than the arc tangent of `quotient`, rounded
/// correctly.
pub(super) fn tangent_near(quotient: f64, excess: f64) -> f64 {
    quotient + (1.0 + quotient * quotient) * excess
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arc_tangents_and_their_tangents_are_rounded_correctly() {
        // As glibc gives them, which rounds nearly all of them correctly.
        for (quotient, arc, tangent) in [
            (0.5, 0.463_647_609_000_806_1, 0.499_999_999_999_999_94),
            (0.1, 0.099_668_652_491_162_04, 0.1),
            (2.0, 1.107_148_717_794_090_4, 1.999_999_999_999_999_6),
            (0.3, 0.291_456_794_477_867_1, 0.3),
            (1.0, std::f64::consts::FRAC_PI_4, 0.999_999_999_999_999_9),
            (0.0, 0.0, 0.0),
        ] {
            let (found, excess) = arc_tangent(quotient);
            assert_eq!(found, arc, "arc tangent of {quotient}");
            assert_eq!(tangent_near(quotient, excess), tangent, "tangent of {found}");
        }
    }
}
