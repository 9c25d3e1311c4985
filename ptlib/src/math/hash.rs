//! The engine's hash of whole numbers: random bits by place, not by order.
//!
//! PCG4D of Jarzynski and Olano ("Hash Functions for GPU Rendering", Journal of Computer Graphics
//! Techniques 9(3), 2020): four rounds of a linear congruential generator that mix four words. It
//! passes TestU01's BigCrush on each word, and vectorises. (The blocks of PT Designer draw from
//! [`elias`](super::elias), which their files are tuned to.)

/// 32 random bits of a seed and three numbers, such as an item, a part of it and a channel.
#[inline(always)]
#[must_use]
pub fn hash(seed: u64, item: u32, part: u32, channel: u32) -> u32 {
    let [low, high] = super::convert::words(seed);
    // The upper half of the seed goes where it meets the lower one only after multiplications.
    let mixed = pcg4d([item, part, channel.wrapping_add(high.wrapping_mul(0x9E37_79B9)), low]);
    mixed[0] ^ mixed[3].rotate_left(16)
}

/// A number of [0, 1): the upper 24 bits of [`hash`].
#[inline(always)]
#[must_use]
pub fn uniform(seed: u64, item: u32, part: u32, channel: u32) -> f32 {
    (hash(seed, item, part, channel) >> 8) as f32 * (1.0 / 16_777_216.0)
}

#[inline(always)]
fn pcg4d(words: [u32; 4]) -> [u32; 4] {
    let [mut x, mut y, mut z, mut w] =
        words.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for round in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(w));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        w = w.wrapping_add(y.wrapping_mul(z));
        if round == 0 {
            [x, y, z, w] = [x, y, z, w].map(|word| word ^ (word >> 16));
        }
    }
    [x, y, z, w]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_spread_evenly_and_differ_by_every_argument() {
        let mut buckets = [0_u32; 64];
        let mut sum = 0.0;
        for item in 0..64_000 {
            let value = uniform(7, item, 1, 2);
            assert!((0.0..1.0).contains(&value));
            sum += f64::from(value);
            buckets[(hash(7, item, 1, 2) >> 26) as usize] += 1;
        }
        assert!((sum / 64_000.0 - 0.5).abs() < 0.005, "{sum}");
        let deviations = buckets.iter().map(|count| f64::from(*count) - 1000.0);
        let squares: f64 = deviations.map(|deviation| deviation * deviation).sum();
        // Chi-square of 63 degrees of freedom: 99.9 % lie below 103.
        assert!(squares / 1000.0 < 103.0, "{squares}");
        let base = hash(1, 2, 3, 4);
        let others = [
            hash(2, 2, 3, 4),
            hash(1 << 40, 2, 3, 4),
            hash(1, 3, 3, 4),
            hash(1, 2, 4, 4),
            hash(1, 2, 3, 5),
        ];
        for other in others {
            let changed = (base ^ other).count_ones();
            assert!((6..=26).contains(&changed), "{changed} bits changed");
        }
    }

    #[test]
    fn the_hash_never_changes() {
        let found = [hash(0, 0, 0, 0), hash(1, 2, 3, 4), hash(u64::MAX, 9, 0, u32::MAX)];
        assert_eq!(found, [1_206_397_708, 3_431_045_924, 2_118_274_231]);
    }
}
