//! Which lattice points a pixel lies between along one side of the image, and with which weights.

use crate::block::prelude::*;

/// Loops over the pixels of a cell run on to a multiple of this: two 256-bit registers. The next
/// cell overwrites what they write too much.
pub(super) const BLOCK: usize = Axis::PADDING;

/// Cells narrower than this many pixels are not worth a loop each.
const NARROW: u32 = 5;

/// What lies between two lattice points that follow each other.
pub(super) trait Between {
    /// The value where the second point has that weight.
    fn at(&self, weight: f32) -> f32;
}

/// For each pixel along one side: a first lattice point, and weights of the points after it. What
/// is left of 1 is the weight of the first.
///
/// Without a blur that is one point after the first ([`Axis`]). A blurred pixel is the mean of the
/// pixels around it, so it lies between more points; all of them follow each other.
#[derive(Debug, Clone)]
pub(super) struct Footprint {
    /// For each pixel, the first lattice point. Not wrapped: those before the edge are negative.
    firsts: Vec<i32>,
    /// For each pixel, the pixel after the last that has the same first lattice point.
    ends: Vec<u32>,
    /// The weights of the points that follow the first: all pixels for the next, all for the one
    /// after it, …
    weights: Vec<Vec<f32>>,
    is_narrow: bool,
}

/// The most memory of a footprint of `pixels` pixels over `points` lattice points, blurred by a
/// box of `radius`, in bytes.
pub(super) fn bytes_of(points: u32, pixels: u32, radius: u32) -> u64 {
    let (points, pixels) = (u64::from(points), u64::from(pixels.max(1)));
    let followers = 2 + (2 * u64::from(radius) * points).div_ceil(pixels);
    let tables = size_of::<i32>() + size_of::<u32>();
    pixels * (tables as u64 + Axis::bytes_of(1)) + (pixels + BLOCK as u64) * followers * 4
}

impl Footprint {
    /// `pixels` pixels, which see `points` lattice points as `axis` does, blurred by a box of
    /// `radius`.
    pub(super) fn new(axis: &Axis, points: u32, pixels: u32, radius: u32) -> Self {
        let radius = i64::from(radius);
        let seen = |pixel: i64| {
            let turn = pixel.div_euclid(i64::from(pixels));
            let (left, _, weight) = axis.at(convert::wrap(pixel, pixels));
            (left as i64 + turn * i64::from(points), weight)
        };
        let first_of = |pixel| seen(pixel - radius).0;
        let last_of = |pixel| seen(pixel + radius).0 + 1;
        let all = 0..i64::from(pixels);
        let followers = all.clone().map(|pixel| last_of(pixel) - first_of(pixel)).max();
        let padded = pixels as usize + BLOCK;
        let mut weights = vec![vec![0.0; padded]; convert::index(followers.unwrap_or(1))];
        let share = 1.0 / convert::distance(2 * radius + 1);
        for (pixel, i) in all.clone().zip(0..) {
            let first = first_of(pixel);
            for around in pixel - radius..=pixel + radius {
                let (left, weight) = seen(around);
                let place = convert::index(left - first);
                weights[place][i] += weight * share;
                if place > 0 {
                    weights[place - 1][i] += (1.0 - weight) * share;
                }
            }
        }
        let firsts: Vec<i32> =
            all.map(|pixel| i32::try_from(first_of(pixel)).unwrap_or(i32::MAX)).collect();
        let ends = run_ends(&firsts);
        Self { firsts, ends, weights, is_narrow: points.saturating_mul(NARROW) > pixels }
    }

    /// The first lattice point of `pixel`.
    #[inline(always)]
    pub(super) fn first(&self, pixel: usize) -> i32 {
        self.firsts[pixel]
    }

    /// How many lattice points after the first a pixel depends on.
    #[inline(always)]
    pub(super) fn followers(&self) -> usize {
        self.weights.len()
    }

    /// The weight of the `n`-th lattice point after the first (from 0) at `pixel`.
    #[inline(always)]
    pub(super) fn weight(&self, n: usize, pixel: usize) -> f32 {
        self.weights[n][pixel]
    }

    /// Writes what is between the first lattice point and the next at pixels `x..x + len`, and
    /// unspecified numbers up to [`BLOCK`] pixels after them. `cell` gives what lies between points
    /// `k` and `k + 1`, counted from the first point of pixel `x`.
    #[inline(always)]
    pub(super) fn expand<B: Between>(
        &self,
        x: usize,
        len: usize,
        out: &mut [f32],
        cell: impl Fn(usize) -> B,
    ) {
        let origin = self.firsts[x];
        let (out, weights) = (&mut out[..len + BLOCK], &self.weights[0][x..][..len + BLOCK]);
        let firsts = &self.firsts[x..][..len];
        if self.is_narrow {
            for ((out, weight), first) in out.iter_mut().zip(weights).zip(firsts) {
                *out = cell(place(*first, origin)).at(*weight);
            }
            return;
        }
        let ends = &self.ends[x..][..len];
        let mut start = 0;
        while start < len {
            let cell = cell(place(firsts[start], origin));
            let end = (ends[start] as usize - x).min(len);
            while start < end {
                let weights = &weights[start..start + BLOCK];
                let mut values = [0.0; BLOCK];
                for i in 0..BLOCK {
                    values[i] = cell.at(weights[i]);
                }
                out[start..start + BLOCK].copy_from_slice(&values);
                start += BLOCK;
            }
            start = end;
        }
    }

    /// Adds what the `n`-th lattice point after the first contributes at pixels `x..x + len`.
    /// `step` gives how far it is from the first point `k`, counted as in
    /// [`expand`](Self::expand).
    #[inline(always)]
    pub(super) fn add(
        &self,
        x: usize,
        len: usize,
        n: usize,
        out: &mut [f32],
        step: impl Fn(usize) -> f32,
    ) {
        let origin = self.firsts[x];
        let mut start = 0;
        while start < len {
            let end = (self.ends[x + start] as usize - x).min(len);
            let step = step(place(self.firsts[x + start], origin));
            let weights = &self.weights[n][x + start..x + end];
            for (out, weight) in out[start..end].iter_mut().zip(weights) {
                *out += step * weight;
            }
            start = end;
        }
    }
}

/// For each place, the place after the last of the equal numbers that it is among.
fn run_ends(numbers: &[i32]) -> Vec<u32> {
    let mut ends = Vec::with_capacity(numbers.len());
    let mut end = 0;
    for run in numbers.chunk_by(|a, b| a == b) {
        end += run.len();
        ends.resize(end, u32::try_from(end).unwrap_or(u32::MAX));
    }
    ends
}

#[inline(always)]
fn place(first: i32, origin: i32) -> usize {
    convert::index(i64::from(first - origin))
}
