//! The engine's random numbers, inline: by place, not by order.
//!
//! PCG4D of Jarzynski and Olano ("Hash Functions for GPU Rendering", Journal of Computer Graphics
//! Techniques 9(3), 2020), the same bits as `ptlib_plugin::noise`. That one asks the host for its
//! table by name at every call, which takes longer than everything else about a hair.

/// The upper 24 bits of the hash of a seed and three numbers: an item, a part of it and a channel.
#[inline(always)]
pub fn bits24(seed: u64, item: u32, part: u32, channel: u32) -> u32 {
    let (low, high) = (half(seed), half(seed >> 32));
    let channel = channel.wrapping_add(high.wrapping_mul(0x9E37_79B9));
    let [mut x, mut y, mut z, mut w] = [item, part, channel, low]
        .map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for round in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(w));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        w = w.wrapping_add(y.wrapping_mul(z));
        if round == 0 {
            [x, y, z, w] = [x, y, z, w].map(|word| word ^ (word >> 16));
        }
    }
    (x ^ w.rotate_left(16)) >> 8
}

/// A number of [0, 1), a multiple of 2⁻²⁴: without a rounding.
#[inline(always)]
pub fn uniform(seed: u64, item: u32, part: u32, channel: u32) -> f64 {
    unit(bits24(seed, item, part, channel))
}

/// The number of [0, 1) that 24 random bits make.
#[inline(always)]
pub fn unit(bits: u32) -> f64 {
    // The same number with a sign, which more processors convert fast.
    f64::from(bits.cast_signed()) * (1.0 / 16_777_216.0)
}

/// The lower half of a number.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn half(number: u64) -> u32 {
    number as u32
}

#[cfg(test)]
mod tests {
    use ptlib::math::hash;

    use super::*;

    #[test]
    fn the_numbers_are_those_of_the_engine() {
        for seed in [0, 1, 77, 1 << 40, u64::MAX] {
            for item in [0, 1, 2, 1000, u32::MAX] {
                for (part, channel) in [(0, 0), (1, 0), (0, 5), (u32::MAX, 3), (9, u32::MAX)] {
                    let engine = hash::uniform(seed, item, part, channel);
                    assert_eq!(uniform(seed, item, part, channel), f64::from(engine));
                }
            }
        }
    }
}
