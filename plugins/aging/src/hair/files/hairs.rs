//! What a file of hair holds: points, or strands, as the formats see them.

use std::ops::Range;

use ptlib_plugin::{
    AnyStream, Points, Strands, Stream,
    prelude::*,
    stream::{DIRECTION, LOSS_AGE, RADIUS, RANDOM, TEXCOORD},
};

/// Points or strands.
#[derive(Debug, Clone, Copy)]
pub struct Hairs<'a> {
    /// Where the points are.
    pub positions: Stream<'a, [f32; 3]>,
    /// The first point of each strand, and the number of points; `None` for points.
    pub first: Option<&'a [u32]>,
    /// The smallest and the largest coordinates.
    pub bounds: [[f32; 3]; 2],
    /// Of each point of a strand: half of its thickness.
    pub radii: Option<Stream<'a, f32>>,
    /// Of each hair: when it is lost.
    pub ages: Option<Stream<'a, f32>>,
    /// Of each hair, 3 or 4 numbers.
    pub colors: Option<AnyStream<'a>>,
    /// Of each point.
    pub directions: Option<Stream<'a, [f32; 3]>>,
    /// Of each point.
    pub texcoords: Option<Stream<'a, [f32; 2]>>,
    /// Of each point.
    pub randoms: Option<Stream<'a, f32>>,
    /// The seed of the block, for comments.
    pub seed: u64,
}

impl<'a> Hairs<'a> {
    /// Roots.
    ///
    /// # Errors
    /// If the host breaks the contract.
    pub fn of_points(points: Points<'a>, seed: u64) -> Result<Self, BlockError> {
        let streams = points.streams();
        Ok(Self {
            positions: points.positions()?,
            first: None,
            bounds: points.bounds(),
            radii: None,
            ages: streams.get(LOSS_AGE),
            colors: streams.find(c"color"),
            directions: streams.get(DIRECTION),
            texcoords: streams.get(TEXCOORD),
            randoms: streams.get(RANDOM),
            seed,
        })
    }

    /// Strands.
    ///
    /// # Errors
    /// If the host breaks the contract.
    pub fn of_strands(strands: Strands<'a>, seed: u64) -> Result<Self, BlockError> {
        let streams = strands.strand_streams();
        let first = if strands.count() == 0 { &[0] } else { strands.first_points() };
        Ok(Self {
            positions: strands.positions()?,
            first: Some(first),
            bounds: strands.bounds(),
            radii: strands.point_streams().get(RADIUS),
            ages: streams.get(LOSS_AGE),
            colors: streams.find(c"color"),
            directions: None,
            texcoords: None,
            randoms: None,
            seed,
        })
    }

    /// How many points or strands.
    pub fn count(&self) -> usize {
        self.first.map_or(self.positions.len(), |first| first.len() - 1)
    }

    /// How many pieces between two points.
    pub fn edge_count(&self) -> usize {
        self.first.map_or(0, |_| self.positions.len() - self.count())
    }

    /// The number of points of a strand.
    pub fn points_of(&self, strand: usize) -> usize {
        self.first.map_or(1, |first| (first[strand + 1] - first[strand]) as usize)
    }

    /// The age of loss of a hair; 1, never lost, if nobody knows.
    #[inline]
    pub fn age(&self, hair: usize) -> f32 {
        self.ages.map_or(1.0, |ages| ages.get(hair))
    }

    /// The colour of a hair; white, if it has none.
    #[inline]
    pub fn color(&self, hair: usize) -> [f32; 3] {
        self.colors.map_or([1.0; 3], |colors| {
            let bits = colors.bits(hair);
            [0, 1, 2].map(|channel| f32::from_bits(bits[channel]))
        })
    }

    /// Points, each with the number of its hair.
    pub fn points(&self, points: Range<usize>) -> impl Iterator<Item = (usize, usize)> + '_ {
        let mut strand = self.first.map_or(0, |first| {
            first.partition_point(|first| *first as usize <= points.start).saturating_sub(1)
        });
        points.map(move |point| match self.first {
            None => (point, point),
            Some(first) => {
                // Each strand has points, so the next one is at most one further.
                strand += usize::from(first[strand + 1] as usize <= point);
                (point, strand)
            }
        })
    }

    /// The first point of each piece between two points.
    pub fn edges(&self, edges: Range<usize>) -> impl Iterator<Item = u32> + '_ {
        let first = self.first.unwrap_or(&[0]);
        // Before a strand lie as many pieces as points, less one for each strand.
        let start = |strand: usize| first[strand] as usize - strand;
        let (mut low, mut high) = (0, self.count());
        while high - low > 1 {
            let middle = low.midpoint(high);
            if start(middle) <= edges.start { low = middle } else { high = middle }
        }
        let mut strand = low;
        edges.map(move |edge| {
            strand += usize::from(start(strand + 1) <= edge);
            u32::try_from(edge + strand).unwrap_or(u32::MAX)
        })
    }
}

/// A channel of a colour as a byte.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "colours are 0..1")]
pub fn byte(channel: f32) -> u8 {
    (channel * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_rounded() {
        assert_eq!([0.0, 0.001, 0.002, 0.5, 0.999, 1.0].map(byte), [0, 0, 1, 128, 255, 255]);
    }
}
