//! Resampling: a source of a × b pixels seen at another size, with wrap-around.
//!
//! Specification 2.0, RESAMPLE. Target pixel x of W looks at position u = x/W · a of the source: at
//! pixel ⌊u⌋ and its right neighbour, weighted by the fraction of u; the same down the image. There
//! is no averaging when the target is smaller than the source.
//!
//! An [`Axis`] is one direction of that; [`Resampling`] is both, for whole images.

use std::ops::Range;

use crate::math::{convert, elementary, levels::Levels};

/// How the two neighbours of a position are weighted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// The nearer one counts alone.
    Nearest,
    /// By the distances.
    Linear,
    /// By the sine of a quarter turn: steep after a source pixel, flat before the next one, which
    /// leaves visible creases.
    Sine,
}

impl Interpolation {
    /// The weight of the right neighbour at `fraction` (0..1) of the way to it.
    fn weight(self, fraction: f64) -> f64 {
        match self {
            Self::Nearest if fraction < 0.5 => 0.0,
            Self::Nearest => 1.0,
            Self::Linear => fraction,
            Self::Sine => elementary::sin64(fraction * std::f64::consts::FRAC_PI_2),
        }
    }
}

/// Where the pixels along one side of a target lie in a source.
#[derive(Debug, Clone)]
pub struct Axis {
    source: u32,
    /// The target pixels in runs that have the same left neighbour, by position.
    runs: Vec<Run>,
    /// For each target pixel, its run.
    run_of: Vec<u32>,
    weights: Vec<f32>,
}

#[derive(Debug, Clone, Copy)]
struct Run {
    /// The target pixel after its last.
    end: u32,
    /// The source pixel at or before all its positions.
    left: u32,
}

/// Target pixels that lie between the same two source pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Span {
    /// The target pixels.
    pub pixels: Range<usize>,
    /// The source pixel at or before them.
    pub left: usize,
    /// The source pixel after that, with wrap-around.
    pub right: usize,
}

impl Axis {
    /// Weights are there for this many pixels beyond the last, so that loops may run on to a whole
    /// SIMD register.
    pub const PADDING: usize = 16;

    /// `target` pixels over `source` pixels.
    #[must_use]
    pub fn new(source: u32, target: u32, interpolation: Interpolation) -> Self {
        let mut axis = Self {
            source,
            runs: Vec::new(),
            run_of: Vec::with_capacity(target as usize),
            weights: Vec::with_capacity(target as usize + Self::PADDING),
        };
        for x in 0..target {
            // In this order of operations, which decides what lies exactly on a source pixel.
            let position = f64::from(x) / f64::from(target) * f64::from(source);
            let whole = position.floor();
            let left = convert::wrap(convert::truncate64(whole), source);
            match axis.runs.last_mut() {
                Some(run) if run.left == left => run.end = x + 1,
                _ => axis.runs.push(Run { end: x + 1, left }),
            }
            axis.run_of.push(u32::try_from(axis.runs.len() - 1).unwrap_or(u32::MAX));
            axis.weights.push(convert::single(interpolation.weight(position - whole)));
        }
        axis.weights.resize(target as usize + Self::PADDING, 0.0);
        axis
    }

    /// The memory that an axis of `target` pixels takes at most, in bytes.
    #[must_use]
    pub fn bytes_of(target: u32) -> u64 {
        u64::from(target) * (size_of::<Run>() + size_of::<u32>() + size_of::<f32>()) as u64
    }

    /// The weights of the right neighbours of target pixels from `x` on, and
    /// [`PADDING`](Self::PADDING) unspecified numbers more.
    #[inline(always)]
    #[must_use]
    pub fn weights(&self, x: usize) -> &[f32] {
        &self.weights[x..]
    }

    /// Target pixel `x`: its left and right neighbour, and the weight of the right one.
    #[inline]
    #[must_use]
    pub fn at(&self, x: u32) -> (usize, usize, f32) {
        let left = self.runs[self.run_of[x as usize] as usize].left;
        (left as usize, self.right_of(left), self.weights[x as usize])
    }

    /// Target pixels `x`..`x + len` in spans between the same neighbours, from left to right.
    #[inline(always)]
    pub fn spans(&self, x: usize, len: usize) -> impl Iterator<Item = Span> {
        let first = self.run_of.get(x).map_or(0, |run| *run as usize);
        let mut start = x;
        self.runs[first..].iter().map_while(move |run| {
            let pixels = start..(run.end as usize).min(x + len);
            start = pixels.end;
            let left = run.left as usize;
            (!pixels.is_empty()).then(|| Span { pixels, left, right: self.right_of(run.left) })
        })
    }

    #[inline(always)]
    fn right_of(&self, left: u32) -> usize {
        if left + 1 == self.source { 0 } else { left as usize + 1 }
    }
}

/// A source image of one size seen at another.
#[derive(Debug, Clone)]
pub struct Resampling {
    columns: Axis,
    rows: Axis,
}

impl Resampling {
    /// From a source of `from` = (width, height) pixels to a target of `to`.
    #[must_use]
    pub fn new(from: (u32, u32), to: (u32, u32), interpolation: Interpolation) -> Self {
        Self {
            columns: Axis::new(from.0, to.0, interpolation),
            rows: Axis::new(from.1, to.1, interpolation),
        }
    }

    /// The memory that a resampling to `to` = (width, height) pixels takes at most, in bytes.
    #[must_use]
    pub fn bytes_of(to: (u32, u32)) -> u64 {
        Axis::bytes_of(to.0) + Axis::bytes_of(to.1)
    }

    /// Writes target row `y` from column `x` on; `source` is the whole plane, row by row. The
    /// values of both source rows are stored, then those between them: in 8-bit precision each
    /// is truncated.
    #[inline(always)]
    pub fn row<L: Levels>(&self, source: &[f32], x: u32, y: u32, out: &mut [f32]) {
        let x = x as usize;
        let (top, bottom, down) = self.rows.at(y);
        let width = self.columns.source as usize;
        let (top, bottom) = (&source[top * width..][..width], &source[bottom * width..][..width]);
        for Span { pixels, left, right } in self.columns.spans(x, out.len()) {
            let (top, top_step) = (top[left], top[right] - top[left]);
            let (bottom, bottom_step) = (bottom[left], bottom[right] - bottom[left]);
            let weights = &self.columns.weights[pixels.clone()];
            for (out, weight) in out[pixels.start - x..pixels.end - x].iter_mut().zip(weights) {
                let above = L::store(top + top_step * weight);
                let below = L::store(bottom + bottom_step * weight);
                *out = L::store(above + (below - above) * down);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::levels::{Continuous, EightBit, from_level};

    fn resampled<L: Levels>(
        source: &[f32],
        from: (u32, u32),
        to: (u32, u32),
        interpolation: Interpolation,
    ) -> Vec<f32> {
        let resampling = Resampling::new(from, to, interpolation);
        let mut out = vec![f32::NAN; (to.0 * to.1) as usize];
        for y in 0..to.1 {
            // In two pieces, as the engine may ask.
            let row = &mut out[(y * to.0) as usize..][..to.0 as usize];
            let (left, right) = row.split_at_mut(to.0 as usize / 3);
            resampling.row::<L>(source, 0, y, left);
            resampling.row::<L>(source, to.0 / 3, y, right);
        }
        out
    }

    #[test]
    fn the_same_size_changes_nothing() {
        let source: Vec<f32> = (0..35_u8).map(|level| from_level(f32::from(7 * level))).collect();
        for interpolation in [Interpolation::Nearest, Interpolation::Linear, Interpolation::Sine] {
            assert_eq!(resampled::<EightBit>(&source, (7, 5), (7, 5), interpolation), source);
        }
    }

    #[test]
    fn linear_weights_are_distances_and_wrap_around() {
        let out = resampled::<Continuous>(&[0.0, 1.0], (2, 1), (8, 1), Interpolation::Linear);
        assert_eq!(out, [0.0, 0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25]);
        let out = resampled::<Continuous>(&[0.0, 1.0], (1, 2), (1, 4), Interpolation::Linear);
        assert_eq!(out, [0.0, 0.5, 1.0, 0.5]);
    }

    #[test]
    fn nearest_takes_the_right_neighbour_from_the_middle_on() {
        let out = resampled::<Continuous>(&[0.0, 1.0], (2, 1), (8, 1), Interpolation::Nearest);
        assert_eq!(out, [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn sine_weights_rise_steeply_first() {
        let out = resampled::<Continuous>(&[0.0, 1.0], (2, 1), (4, 1), Interpolation::Sine);
        let half = convert::single(std::f64::consts::FRAC_1_SQRT_2);
        assert_eq!(out, [0.0, half, 1.0, 1.0 - half]);
    }

    #[test]
    fn both_rows_are_truncated_before_the_values_between_them() {
        // Halfway: (0+255)/2 → 127 above, (0+1)/2 → 0 below, then (127+0)/2 → 63; real numbers
        // would give 64.
        let source = [0.0, 255.0, 0.0, 1.0].map(from_level);
        let out = resampled::<EightBit>(&source, (2, 2), (4, 4), Interpolation::Linear);
        assert_eq!(out[1], from_level(127.0));
        assert_eq!(out[5], from_level(63.0));
    }

    #[test]
    fn a_smaller_target_takes_the_pixels_at_its_positions() {
        let source: Vec<f32> = (0..10_u8).map(f32::from).collect();
        let out = resampled::<Continuous>(&source, (10, 1), (4, 1), Interpolation::Linear);
        assert_eq!(out, [0.0, 2.5, 5.0, 7.5]);
    }

    #[test]
    fn spans_cover_every_pixel_once() {
        let axis = Axis::new(6, 47, Interpolation::Linear);
        for (x, len) in [(0, 47), (5, 1), (5, 20), (46, 1), (47, 0), (12, 0)] {
            let mut next = x;
            for span in axis.spans(x, len) {
                assert_eq!(span.pixels.start, next);
                for pixel in span.pixels.clone() {
                    let (left, right, _) = axis.at(u32::try_from(pixel).unwrap());
                    assert_eq!((left, right), (span.left, span.right));
                }
                next = span.pixels.end;
            }
            assert_eq!(next, x + len);
        }
    }
}
