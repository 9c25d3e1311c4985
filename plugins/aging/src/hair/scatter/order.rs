//! Puts hairs in the order in which they are lost, the last ones first: a radix sort, which keeps
//! those of one age in their order of triangle and place.

use std::mem;

use ptlib_plugin::{Scratch, prelude::*};

use super::candidates::Hair;

/// Keys have 30 bits: three digits of ten.
const DIGIT_BITS: u32 = 10;
const DIGITS: usize = 3;
const BUCKETS: usize = 1 << DIGIT_BITS;

/// Hairs between two questions whether to go on.
const PIECE: usize = 1 << 16;

#[inline(always)]
fn digit(key: u32, place: usize) -> usize {
    (key >> [0, DIGIT_BITS, 2 * DIGIT_BITS][place]) as usize & (BUCKETS - 1)
}

/// The first `count` hairs, sorted by their keys.
///
/// # Errors
/// Those of the host.
pub fn sorted<'a>(
    mut hairs: Scratch<'a, Hair>,
    count: usize,
    work: Work<'a>,
) -> Result<Scratch<'a, Hair>, BlockError> {
    let mut counts = [[0_u32; BUCKETS]; DIGITS];
    for piece in hairs[..count].chunks(PIECE) {
        work.check()?;
        for [key, ..] in piece {
            for (place, counts) in counts.iter_mut().enumerate() {
                counts[digit(*key, place)] += 1;
            }
        }
    }
    let mut other = work.scratch::<Hair>(count)?;
    for (place, counts) in counts.iter_mut().enumerate() {
        if counts.iter().any(|in_one| *in_one as usize == count) {
            // All have the same digit.
            continue;
        }
        let mut first = 0;
        for counted in counts.iter_mut() {
            first += mem::replace(counted, first);
        }
        for piece in hairs[..count].chunks(PIECE) {
            work.check()?;
            for hair in piece {
                let next = &mut counts[digit(hair[0], place)];
                other[*next as usize] = *hair;
                *next += 1;
            }
        }
        mem::swap(&mut hairs, &mut other);
    }
    Ok(hairs)
}
