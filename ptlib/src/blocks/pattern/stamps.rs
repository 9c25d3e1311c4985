//! A mosaic tile as a stamp, and pictures of many of them.
//!
//! Specification 2.34. A stamp is a square of twice the side of a tile, so that the tile may reach
//! into its neighbours; around the tile it is transparent. PT Designer stamps tile after tile, a
//! later one over an earlier one. Here a pixel looks which of the stamps over it, from the last one
//! on, is not transparent there. So rows do not depend on each other.

use super::outline::{Point, Transformation};
use crate::block::prelude::*;
use ray::{Position, Segment};

/// A pixel of a stamp: the border of the tile.
pub(super) const BORDER: u8 = 2;
/// What is around the tile.
const TRANSPARENT: u8 = 1;
/// What is inside. 0, because memory of zeros is there at once: painting gigabytes of anything else
/// could not be cancelled.
pub(super) const TILE: u8 = 0;

/// A tile to be stamped.
pub(super) struct Stamp {
    /// The side of a tile in the grid; a stamp's is twice that.
    tile: u32,
    /// Where the tile's place in the grid begins in the stamp, to the right and down.
    margin: u32,
    pixels: Vec<u8>,
}

/// Which pixel of a stamp is seen at a pixel of the picture.
#[derive(Clone, Copy)]
pub(super) enum Turn {
    None,
    Half,
    Quarter,
    Upwards,
    Sideways,
}

/// For each pixel along a side of the picture, which stamps are over it: their column (or row) in
/// the grid, and the pixel of the stamp. The last one comes first.
pub(super) struct Covers {
    stamps: Vec<(u32, u32)>,
    /// For each pixel, its first one; then their number.
    starts: Vec<usize>,
}

impl Stamp {
    /// A tile of that outline, with sides of `tile` pixels, at least 1.
    pub(super) fn new(outline: &[Point], tile: u32, cx: &WholeContext<'_>) -> Result<Self, Error> {
        let (side, margin) = (2 * tile, tile / 2);
        let mut pixels = vec![TILE; side as usize * side as usize];
        let place = |point: &Point| {
            let (tile, margin) = (f64::from(tile), f64::from(margin));
            Position::new(
                convert::truncate64(margin + tile * point.x),
                convert::truncate64(margin + tile - tile * point.y),
            )
        };
        for (first, last) in outline.iter().zip(outline.iter().cycle().skip(1)) {
            for pixel in Segment::new(place(first), place(last)).pixels() {
                let (x, y) = (convert::wrap(pixel.x, side), convert::wrap(pixel.y, side));
                pixels[y as usize * side as usize + x as usize] = BORDER;
            }
        }
        fill::Canvas::new(&mut pixels, side).fill(0, TRANSPARENT, || cx.check())?;
        Ok(Self { tile, margin, pixels })
    }

    /// What is over each pixel of a side of `length` pixels with `count` tiles.
    pub(super) fn covers(&self, length: u32, count: u32) -> Covers {
        let mut covers = Covers { stamps: Vec::new(), starts: vec![0] };
        for pixel in 0..length {
            let here = covers.stamps.len();
            // Stamps that pass an edge go on at the opposite one.
            let place = pixel + self.margin;
            let places = [place.checked_sub(length), Some(place), Some(place + length)];
            for place in places.into_iter().flatten() {
                let last = place / self.tile;
                for number in [Some(last), last.checked_sub(1)].into_iter().flatten() {
                    if number < count {
                        covers.stamps.push((number, place - number * self.tile));
                    }
                }
            }
            covers.stamps[here..].sort_unstable_by(|a, b| b.cmp(a));
            covers.starts.push(covers.stamps.len());
        }
        covers
    }

    /// Pixel (u, v) of the stamp after it was turned, if it is not transparent.
    #[inline]
    pub(super) fn pixel(&self, turn: Turn, u: u32, v: u32) -> Option<u8> {
        let side = 2 * self.tile;
        let back = |place: u32| if place == 0 { 0 } else { side - place };
        let (u, v) = match turn {
            Turn::None => (u, v),
            Turn::Half => (back(u), back(v)),
            Turn::Quarter => (back(v), u),
            Turn::Upwards => (u, back(v)),
            Turn::Sideways => (back(u), v),
        };
        let pixel = self.pixels[v as usize * side as usize + u as usize];
        (pixel != TRANSPARENT).then_some(pixel)
    }

    /// The memory that a stamp for tiles of that side takes, in bytes.
    pub(super) fn bytes_of(tile: u32) -> u64 {
        4 * u64::from(tile) * u64::from(tile)
    }
}

impl Covers {
    /// The stamps over a pixel, the last one first.
    #[inline]
    pub(super) fn over(&self, pixel: usize) -> &[(u32, u32)] {
        &self.stamps[self.starts[pixel]..self.starts[pixel + 1]]
    }
}

impl Turn {
    /// How the tile is turned in a column and row of the grid; `across` is how it comes from the
    /// one before in an odd column, `down` in an odd row.
    pub(super) fn of(across: Transformation, down: Transformation) -> Self {
        use Transformation::{Glide, HalfTurn, QuarterTurn, Shift};
        match (across, down) {
            // BUG of the original: two glides turned it by 90 degrees, which leaves gaps.
            (Shift, HalfTurn) | (HalfTurn, Shift) | (Glide, Glide) => Self::Half,
            (Shift, QuarterTurn) | (QuarterTurn, Shift) => Self::Quarter,
            (Shift, Glide) | (Glide, HalfTurn) => Self::Sideways,
            (Glide, Shift) | (HalfTurn, Glide) => Self::Upwards,
            (Shift, Shift) | (HalfTurn, HalfTurn) | (QuarterTurn, _) | (_, QuarterTurn) => {
                Self::None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_knows_the_stamps_over_it() {
        for (length, tiles) in [(12, 1), (13, 2), (20, 4), (23, 4), (31, 7), (9, 9)] {
            let tile = length / tiles;
            let stamp = Stamp { tile, margin: tile / 2, pixels: Vec::new() };
            let covers = stamp.covers(length, tiles);
            for x in 0..length {
                let mut expected = Vec::new();
                for (number, place) in (0..tiles).flat_map(|i| (0..2 * tile).map(move |u| (i, u))) {
                    let start = i64::from(number * tile) - i64::from(tile / 2);
                    if convert::wrap(start + i64::from(place), length) == x {
                        expected.push((number, place));
                    }
                }
                expected.reverse();
                assert_eq!(covers.over(x as usize), expected, "{x} of {length}, {tiles} tiles");
            }
        }
    }
}
