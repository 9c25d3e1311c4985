//! The stateless integer noise that the blocks of PT Designer draw from.
//!
//! Specification, appendix A (the hash is Hugo Elias's, from his page "Perlin Noise"). Files are
//! tuned by eye to these very sequences, so the constants are part of the format. New blocks use
//! another hash: this one repeats every 2³¹ and neighbouring seeds are correlated.

/// The number at index `k`, uniform on (-1, 1].
#[inline(always)]
#[must_use]
pub fn noise(k: i32) -> f32 {
    // The hash has 31 bits; f32 rounds it to 24 of them.
    1.0 - hash(k) as f32 * (1.0 / 1_073_741_824.0)
}

/// The number at index `k` in double precision, for positions.
#[inline(always)]
#[must_use]
pub fn noise64(k: i32) -> f64 {
    1.0 - f64::from(hash(k)) / 1_073_741_824.0
}

/// The whole number from 0 to `last` at index `k`; the two ends have half the weight of the others
/// (specification 0, `UI`).
#[inline(always)]
#[must_use]
pub fn integer(k: i32, last: u16) -> i32 {
    // Exact: 31 bits of the hash times 16. Not negative, so that adding a half rounds.
    let unit = (noise64(k) + 1.0) * 0.5;
    super::convert::truncate64_to_i32(unit * f64::from(last) + 0.5)
}

#[inline(always)]
fn hash(k: i32) -> i32 {
    let k = k.wrapping_shl(13) ^ k;
    let inner = k.wrapping_mul(k).wrapping_mul(15_731).wrapping_add(789_221);
    k.wrapping_mul(inner).wrapping_add(1_376_312_589) & 0x7fff_ffff
}

/// Successive draws: index by index, as the blocks that place things one after another do it.
#[derive(Debug, Clone)]
pub struct Draws {
    index: i32,
}

impl Draws {
    /// Draws from `index` on.
    #[must_use]
    pub fn from_index(index: i32) -> Self {
        Self { index }
    }

    /// The next number, uniform on (-1, 1].
    pub fn next_noise(&mut self) -> f64 {
        let number = noise64(self.index);
        self.index = self.index.wrapping_add(1);
        number
    }

    /// The next whole number from `low` to `high`; the two ends have half the weight of the others
    /// (specification 0, `UI`).
    pub fn next_integer(&mut self, low: i64, high: i64) -> i64 {
        let unit = f64::midpoint(self.next_noise(), 1.0);
        let span = high - low;
        #[expect(clippy::cast_precision_loss, reason = "spans are image sizes and counts")]
        let scaled = unit * span as f64;
        super::convert::round64(scaled) + low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_number_is_the_one_of_the_specification() {
        assert!((noise64(0) + 0.28179).abs() < 1e-5);
        assert!((noise(0) + 0.28179).abs() < 1e-5);
    }

    #[test]
    fn integers_are_those_of_successive_draws() {
        for last in [0, 1, 2, 119, 255, u16::MAX] {
            let mut draws = Draws::from_index(-500);
            for k in -500..500 {
                let expected = draws.next_integer(0, last.into());
                assert_eq!(i64::from(integer(k, last)), expected, "draw {k} up to {last}");
            }
        }
    }

    #[test]
    fn numbers_are_uniform() {
        let (mut sum, mut squares) = (0.0, 0.0);
        for k in 0..100_000 {
            let number = noise64(k);
            assert!(number > -1.0 && number <= 1.0);
            sum += number;
            squares += number * number;
        }
        assert!((sum / 1e5).abs() < 0.01);
        assert!(((squares / 1e5).sqrt() - 0.5773).abs() < 0.003);
    }
}
