//! Random numbers of many hairs at a time: most of what a hair costs, if they are taken one by one.

use ptlib_plugin::simd::{self, Kernel};

use super::candidates;
use crate::hair::random;

/// The most hairs of a batch.
pub const BATCH: usize = 128;

/// Some hairs.
#[derive(Debug)]
pub struct Batch {
    seed: u64,
    len: usize,
    items: [u32; BATCH],
    places: [u32; BATCH],
    weights: [[f64; BATCH]; 2],
}

impl Batch {
    /// A batch without hairs.
    pub fn new(seed: u64) -> Self {
        let (items, places, weights) = ([0; BATCH], [0; BATCH], [[0.0; BATCH]; 2]);
        Self { seed, len: 0, items, places, weights }
    }

    /// Takes other hairs, no more than [`BATCH`]: the triangle and the place of each.
    #[inline(always)]
    pub fn fill(&mut self, hairs: impl Iterator<Item = [u32; 2]>) {
        self.len = 0;
        let own = self.items.iter_mut().zip(&mut self.places);
        for ((own_item, own_place), [item, place]) in own.zip(hairs) {
            (*own_item, *own_place) = (item, place);
            self.len += 1;
        }
        let [second, third] = &mut self.weights;
        simd::run(Weights {
            seed: self.seed,
            hairs: (&self.items[..self.len], &self.places[..self.len]),
            weights: (&mut second[..self.len], &mut third[..self.len]),
        });
    }

    /// The hairs: triangle, place, and the weights of the triangle's second and third corner.
    #[inline(always)]
    pub fn hairs(&self) -> impl Iterator<Item = ([u32; 2], [f64; 2])> {
        let own = self.items[..self.len].iter().zip(&self.places[..self.len]);
        let [second, third] = &self.weights;
        let weights = second.iter().zip(third).map(|(second, third)| [*second, *third]);
        own.map(|(item, place)| [*item, *place]).zip(weights)
    }

    /// 24 random bits of each hair.
    pub fn bits24(&self, channel: u32) -> [u32; BATCH] {
        let mut bits = [0; BATCH];
        let hairs = (&self.items[..self.len], &self.places[..self.len]);
        simd::run(Bits { seed: self.seed, channel, hairs, bits: &mut bits[..self.len] });
        bits
    }
}

struct Weights<'a> {
    seed: u64,
    hairs: (&'a [u32], &'a [u32]),
    weights: (&'a mut [f64], &'a mut [f64]),
}

impl Kernel for Weights<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let hairs = self.hairs.0.iter().zip(self.hairs.1);
        let weights = self.weights.0.iter_mut().zip(self.weights.1);
        for ((second, third), (item, place)) in weights.zip(hairs) {
            [*second, *third] = candidates::weights(self.seed, *item, *place);
        }
    }
}

struct Bits<'a> {
    seed: u64,
    channel: u32,
    hairs: (&'a [u32], &'a [u32]),
    bits: &'a mut [u32],
}

impl Kernel for Bits<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let hairs = self.hairs.0.iter().zip(self.hairs.1);
        for (bits, (item, place)) in self.bits.iter_mut().zip(hairs) {
            *bits = random::bits24(self.seed, *item, *place, self.channel);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_batch_has_the_numbers_of_its_hairs() {
        let hair = |i: u32| [i / 7, i.wrapping_mul(0x9E37_79B9)];
        let mut batch = Batch::new(1 << 40);
        for count in [0, 1, 13, 100, 128] {
            batch.fill((0..count).map(hair));
            assert_eq!(batch.hairs().count(), count as usize);
            let bits = batch.bits24(4);
            for ((i, ([item, place], weights)), bits) in (0..).zip(batch.hairs()).zip(bits) {
                assert_eq!([item, place], hair(i));
                assert_eq!(weights, candidates::weights(1 << 40, item, place));
                assert_eq!(bits, random::bits24(1 << 40, item, place, 4));
            }
        }
    }
}
