//! Where hairs may grow: so many places on each triangle as its area asks for, of which those stay
//! that lie where hair grows.
//!
//! A triangle of area A gets ⌊D·A⌋ places, and one more with the probability of the rest, so that
//! triangles too small for a hair keep their share. Work is shared out by places, not by triangles:
//! one triangle may have them all, and a million may have one.

use ptlib_plugin::{Scratch, prelude::*};

use super::{
    batch::{BATCH, Batch},
    ground::Ground,
};
use crate::hair::{random, vector::between};

/// A hair that stays: a key that rises as the age of loss falls, the triangle, the place on it.
pub type Hair = [u32; 3];

/// The most hairs of one block: the most points that the library gives.
pub const MOST: u32 = 64 << 20;

const TRIANGLES_OF_A_TASK: usize = 4096;
const PLACES_OF_A_TASK: usize = 8192;

/// Channels of the random numbers of a place. They are part of the format: another number gives
/// other hair.
mod channel {
    /// Of a triangle: whether it gets one hair more.
    pub const ONE_MORE: u32 = 0;
    pub const WEIGHTS: [u32; 2] = [0, 1];
    pub const DENSITY: u32 = 2;
}

/// How dense hairs are.
#[derive(Debug, Clone, Copy)]
pub enum Amount {
    /// So many on the whole mesh.
    Hairs(f64),
    /// So many on a square unit.
    PerArea(f64),
}

/// The weights of the second and the third corner: even on the triangle, because those of the other
/// half of the parallelogram are folded back.
#[inline(always)]
pub fn weights(seed: u64, triangle: u32, place: u32) -> [f64; 2] {
    fold(channel::WEIGHTS.map(|channel| random::uniform(seed, triangle, place, channel)))
}

#[inline(always)]
fn fold(r: [f64; 2]) -> [f64; 2] {
    if r[0] + r[1] > 1.0 { r.map(|r| 1.0 - r) } else { r }
}

/// How many places a triangle gets that asks for `wanted`.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the sum of all is below 2^27, and none is negative"
)]
fn count(wanted: f64, chance: f64) -> u32 {
    let whole = wanted as u32;
    whole + u32::from(chance < wanted - f64::from(whole))
}

/// The key of an age of loss in 0..1: the bits of such numbers rise with them.
fn key(loss_age: f32) -> u32 {
    1.0_f32.to_bits() - loss_age.to_bits()
}

/// The age of loss of a key.
#[inline(always)]
pub fn loss_age(key: u32) -> f32 {
    f32::from_bits(1.0_f32.to_bits() - key)
}

/// The first place of each triangle, and the number of all.
///
/// # Errors
/// A mesh without an area, more places than points may be.
pub fn first_places<'a>(
    (ground, seed): (&Ground<'_>, u64),
    amount: Amount,
    work: Work<'a>,
) -> Result<Scratch<'a, u32>, BlockError> {
    let density = density(amount, total_area(ground, work)?)?;
    let mut first = work.scratch::<u32>(ground.triangles.len() + 1)?;
    work.for_each(first[1..].chunks_mut(TRIANGLES_OF_A_TASK).enumerate(), |(task, counts)| {
        for (i, places) in counts.iter_mut().enumerate() {
            let triangle = task * TRIANGLES_OF_A_TASK + i;
            let item = u32::try_from(triangle).unwrap_or(u32::MAX);
            let chance = random::uniform(seed, item, u32::MAX, channel::ONE_MORE);
            *places = count(density * ground.area(triangle), chance);
        }
        Ok(())
    })?;
    let mut sum = 0_u32;
    for first in first.iter_mut() {
        sum = sum.saturating_add(*first);
        *first = sum;
    }
    Ok(first)
}

/// Hairs on a square unit.
fn density(amount: Amount, area: f64) -> Result<f64, BlockError> {
    if area <= 0.0 {
        let message = "the mesh has no area: it has no triangles, or none that is not degenerate";
        return Err(BlockError::invalid(message));
    }
    let density = match amount {
        // Its range is the limit.
        Amount::Hairs(hairs) => return Ok(hairs / area),
        Amount::PerArea(hairs) => hairs,
    };
    if density * area > f64::from(MOST) {
        return Err(BlockError::limit(format!(
            "`per area` {density} on an area of {area} makes about {:.0} hairs, allowed {MOST}: \
             lower it, or set it to 0 and use `hairs`",
            density * area
        )));
    }
    Ok(density)
}

/// The area of all triangles. Sums of ranges of them are added in order.
fn total_area(ground: &Ground<'_>, work: Work<'_>) -> Result<f64, BlockError> {
    let count = ground.triangles.len();
    let mut sums = work.scratch::<f64>(count.div_ceil(TRIANGLES_OF_A_TASK))?;
    work.for_each(sums.iter_mut().enumerate(), |(task, sum)| {
        let first = task * TRIANGLES_OF_A_TASK;
        let triangles = first..(first + TRIANGLES_OF_A_TASK).min(count);
        *sum = triangles.map(|triangle| ground.area(triangle)).sum();
        Ok(())
    })?;
    // Of no numbers, that is -0.
    Ok(sums.iter().sum::<f64>() + 0.0)
}

/// The hairs that stay, by triangle and place, and their number. Behind them lies unused memory.
///
/// # Errors
/// Those of the host.
pub fn hairs_that_stay<'a>(
    (ground, seed): (&Ground<'_>, u64),
    first: &[u32],
    work: Work<'a>,
) -> Result<(Scratch<'a, Hair>, usize), BlockError> {
    let places = first.last().copied().unwrap_or_default() as usize;
    let mut hairs = work.scratch::<Hair>(places)?;
    let mut counts = work.scratch::<u32>(places.div_ceil(PLACES_OF_A_TASK))?;
    let tasks = hairs.chunks_mut(PLACES_OF_A_TASK).zip(counts.iter_mut()).enumerate();
    work.for_each(tasks, |(task, (hairs, count))| {
        let start = u32::try_from(task * PLACES_OF_A_TASK).unwrap_or(u32::MAX);
        *count = stay((ground, seed), first, start, hairs);
        Ok(())
    })?;
    let mut all = 0;
    for (task, count) in counts.iter().enumerate() {
        let start = task * PLACES_OF_A_TASK;
        // As long as all stay, they lie where they belong.
        if all < start {
            hairs.copy_within(start..start + *count as usize, all);
        }
        all += *count as usize;
    }
    Ok((hairs, all))
}

/// Writes those of the places from `start` on that stay, and counts them.
fn stay((ground, seed): (&Ground<'_>, u64), first: &[u32], start: u32, hairs: &mut [Hair]) -> u32 {
    let end = start.saturating_add(u32::try_from(hairs.len()).unwrap_or(u32::MAX));
    // The triangle of the first place: the last one that begins no later.
    let mut triangle = first.partition_point(|first| *first <= start).saturating_sub(1);
    let mut next_id = |next: u32| {
        while first[triangle + 1] <= next {
            triangle += 1;
        }
        [u32::try_from(triangle).unwrap_or(u32::MAX), next - first[triangle]]
    };
    let (mut batch, mut kept) = (Batch::new(seed), 0_u32);
    for start in (start..end).step_by(BATCH) {
        batch.fill((start..end).map(&mut next_id));
        for ([item, place], weights) in batch.hairs() {
            let texcoord = between(ground.texcoords(item as usize), weights);
            let age = ground.loss_age(texcoord);
            let stays = age > 0.0
                && ground.density(texcoord).is_none_or(|density| {
                    random::uniform(seed, item, place, channel::DENSITY) < density
                });
            // Written whether it stays or not: the next one overwrites it.
            hairs[kept as usize] = [key(age), item, place];
            kept += u32::from(stays);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_folded_back_into_the_triangle() {
        let folded = fold([0.7, 0.6]);
        assert!((folded[0] - 0.3).abs() < 1e-12 && (folded[1] - 0.4).abs() < 1e-12);
        assert_eq!(fold([0.25, 0.75]), [0.25, 0.75]);
        for place in 0..10_000 {
            let [b, c] = weights(3, 5, place);
            assert!(b >= 0.0 && c >= 0.0 && b + c <= 1.0);
        }
    }

    #[test]
    fn the_rest_of_a_count_is_a_probability() {
        assert_eq!([0.0, 0.79, 0.81, 0.999].map(|chance| count(13.8, chance)), [14, 14, 13, 13]);
        assert_eq!([count(0.0, 0.0), count(2.0, 0.0)], [0, 2]);
    }

    #[test]
    fn weights_are_spread_evenly() {
        // 8 × 8 cells of the square that folding undone gives; 63 degrees of freedom.
        let mut cells = [[0.0_f64; 8]; 8];
        let cell = |x: f64| (0..8).rfind(|cell| x * 8.0 >= f64::from(*cell)).unwrap_or(0);
        for place in 0..64_000 {
            let [b, c] = weights(11, 2, place);
            // Two triangles make a square: every second hair is put into the other one.
            let [x, y] = if place % 2 == 0 { [b, c] } else { [1.0 - b, 1.0 - c] };
            cells[usize::try_from(cell(x)).unwrap()][usize::try_from(cell(y)).unwrap()] += 1.0;
        }
        let chi: f64 = cells.iter().flatten().map(|n| (n - 1000.0) * (n - 1000.0) / 1000.0).sum();
        assert!(chi < 103.0, "{chi}");
    }

    #[test]
    fn keys_fall_with_ages_and_tell_them_exactly() {
        let ages = [1.0, 0.9999, 0.5, 0.1, 1e-30, f32::from_bits(1)];
        assert!(ages.windows(2).all(|pair| key(pair[0]) < key(pair[1])));
        assert!(ages.iter().all(|age| loss_age(key(*age)).to_bits() == age.to_bits()));
    }

    #[test]
    fn too_many_hairs_are_refused_before_anything_is_allocated() {
        let error = density(Amount::PerArea(1e12), 2.0).unwrap_err().message();
        assert!(error.contains("`per area`") && error.contains("2000000000000 hairs"), "{error}");
        assert!(error.contains("allowed 67108864"), "{error}");
        assert!(density(Amount::Hairs(5.0), 0.0).unwrap_err().message().contains("no area"));
        assert_eq!(density(Amount::Hairs(64.0 * 1_048_576.0), 2.0).unwrap(), 33_554_432.0);
    }
}
