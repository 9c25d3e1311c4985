//! Images read between their pixels, at some places side by side.

use ptlib_plugin::{Image, Scratch, Work, prelude::BlockError};

/// How many pixels are shaded side by side.
pub const LANES: usize = 8;

/// A number for each of these pixels.
pub type Lanes = [f32; LANES];

/// Numbers for each pixel from those of others.
#[inline(always)]
pub fn each(compute: impl FnMut(usize) -> f32) -> Lanes {
    std::array::from_fn(compute)
}

/// An image whose left edge joins its right one, and its lower edge the upper one.
#[derive(Debug)]
pub struct Texture<'a> {
    /// The rows of each plane.
    planes: Vec<Vec<&'a [f32]>>,
    width: usize,
    height: usize,
}

/// Four pixels around each place, and how far the place is from the first to the others.
#[derive(Debug)]
pub struct Taps {
    columns: [[usize; LANES]; 2],
    rows: [[usize; LANES]; 2],
    across: Lanes,
    down: Lanes,
}

impl<'a> Texture<'a> {
    /// An image as a texture.
    pub fn new(image: &Image<'a>) -> Self {
        let plane = |channel| (0..image.height()).map(|y| image.row(channel, y)).collect();
        Self {
            planes: (0..image.channels()).map(plane).collect(),
            width: image.width() as usize,
            height: image.height() as usize,
        }
    }

    /// The pixels around texture coordinates, of which the second points up.
    #[inline(always)]
    pub fn taps(&self, u: &Lanes, v: &Lanes) -> Taps {
        let (columns, across) = axis(u, self.width);
        let (rows, down) = axis(&v.map(|v| 1.0 - v), self.height);
        Taps { columns, rows, across, down }
    }

    /// A plane between pixels; a grey image has its one plane as red, green and blue.
    #[inline(always)]
    pub fn read(&self, channel: usize, taps: &Taps) -> Lanes {
        let plane = &self.planes[channel.min(self.planes.len() - 1)];
        let corner =
            |row: usize, column: usize| each(|i| plane[taps.rows[row][i]][taps.columns[column][i]]);
        let corners = [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
        between(&corners, &taps.across, &taps.down)
    }

    /// Red, green and blue.
    #[inline(always)]
    pub fn color(&self, taps: &Taps) -> [Lanes; 3] {
        [0, 1, 2].map(|channel| self.read(channel, taps))
    }
}

/// One plane, stored for many reads: with one more column and row at each edge, so that the four
/// pixels around a place lie next to each other.
#[derive(Debug)]
pub struct Heights<'a> {
    values: Scratch<'a, f32>,
    width: usize,
    height: usize,
}

impl<'a> Heights<'a> {
    /// A plane of an image.
    ///
    /// # Errors
    /// If memory does not suffice, or the host asks to stop.
    pub fn new(image: &Image<'_>, channel: usize, work: Work<'a>) -> Result<Self, BlockError> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let mut values = work.scratch::<f32>((width + 2) * (height + 2))?;
        let rows = values.chunks_exact_mut(width + 2).zip(-1_i64..);
        work.for_each(rows, |(row, y)| {
            let line = y.rem_euclid(i64::from(image.height()));
            let line = image.row(channel, u32::try_from(line).unwrap_or_default());
            (row[0], row[width + 1]) = (line[width - 1], line[0]);
            row[1..=width].copy_from_slice(line);
            Ok(())
        })?;
        Ok(Self { values, width, height })
    }

    /// The height at texture coordinates, to the bit what a [`Texture`] gives.
    #[inline(always)]
    pub fn at(&self, u: &Lanes, v: &Lanes) -> Lanes {
        let (columns, across) = place(u, self.width);
        let (rows, down) = place(&v.map(|v| 1.0 - v), self.height);
        let stride = self.width + 2;
        let mut corners = [[0.0; LANES]; 4];
        for i in 0..LANES {
            let first = rows[i] * stride + columns[i];
            let four = &self.values[first..first + stride + 2];
            (corners[0][i], corners[1][i]) = (four[0], four[1]);
            (corners[2][i], corners[3][i]) = (four[stride], four[stride + 1]);
        }
        between(&corners, &across, &down)
    }
}

/// Twice 2²²: added, it leaves no bits behind the point.
const WHOLE: f32 = 12_582_912.0;

/// The part of a number behind the point, 0 to 1, of any number; not of what is none.
#[inline(always)]
fn part(x: f32) -> f32 {
    let near = (x + WHOLE) - WHOLE;
    let whole = near - f32::from(u8::from(near > x));
    // Far outside of the texture the rounding is coarser; and max takes 0 in place of what is no
    // number, which clamp does not.
    #[expect(clippy::manual_clamp, reason = "see above")]
    (x - whole).max(0.0).min(1.0)
}

/// Between four numbers: from the first to the second, and from these to the others.
#[inline(always)]
fn between([a, b, c, d]: &[Lanes; 4], across: &Lanes, down: &Lanes) -> Lanes {
    each(|i| {
        let upper = a[i] + (b[i] - a[i]) * across[i];
        let lower = c[i] + (d[i] - c[i]) * across[i];
        upper + (lower - upper) * down[i]
    })
}

/// The pixel behind whose middle places lie, counted from 1, and how far behind; 0 is the last one
/// of the image before.
#[inline(always)]
fn place(places: &Lanes, length: usize) -> ([usize; LANES], Lanes) {
    #[expect(clippy::cast_precision_loss, reason = "at most 65,536")]
    let size = length as f32;
    // From half a pixel before the first.
    let at = places.map(|place| part(place) * size + 0.5);
    #[expect(clippy::cast_possible_truncation, reason = "0 to the length")]
    #[expect(clippy::cast_sign_loss, reason = "0 to the length")]
    let after = at.map(|at| at as u32);
    #[expect(clippy::cast_precision_loss, reason = "at most 65,536")]
    let along = each(|i| at[i] - after[i] as f32);
    (after.map(|after| (after as usize).min(length)), along)
}

/// The two pixels along an axis between whose middles places lie, and how far from the first.
#[inline(always)]
fn axis(places: &Lanes, length: usize) -> ([[usize; LANES]; 2], Lanes) {
    let (after, along) = place(places, length);
    let first = after.map(|after| if after == 0 { length - 1 } else { after - 1 });
    let second = after.map(|after| if after == length { 0 } else { after });
    ([first, second], along)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture<'a>(rows: &'a [&'a [f32]]) -> Texture<'a> {
        Texture { planes: vec![rows.to_vec()], width: rows[0].len(), height: rows.len() }
    }

    fn at(texture: &Texture<'_>, u: f32, v: f32) -> f32 {
        texture.read(0, &texture.taps(&[u; LANES], &[v; LANES]))[3]
    }

    #[test]
    fn middles_of_pixels_are_exact_and_edges_join() {
        let texture = texture(&[&[0.0, 0.25, 0.5, 0.75], &[1.0, 1.0, 1.0, 1.0]]);
        assert_eq!(at(&texture, 0.125, 0.75), 0.0);
        assert_eq!(at(&texture, 0.625, 0.75), 0.5);
        assert_eq!(at(&texture, 0.625, 0.25), 1.0, "the second coordinate points up");
        assert_eq!(at(&texture, 0.5, 0.75), 0.375);
        assert_eq!(at(&texture, 0.0, 0.75), 0.375, "between the last and the first");
        assert_eq!(at(&texture, 1.0, 0.75), 0.375);
        assert_eq!(at(&texture, -3.375, -4.25), at(&texture, 0.625, 0.75));
        assert_eq!(at(&texture, 0.625, 0.0), 0.75, "between the lower and the upper row");
    }

    #[test]
    fn no_place_is_outside() {
        let texture = texture(&[&[0.5; 3], &[0.5; 3], &[0.5; 3]]);
        let places = [1e18, -1e18, 1e38, f32::NAN, f32::INFINITY, -1e-30, 8_388_609.5, -0.000_001];
        for place in places {
            assert_eq!(at(&texture, place, place), 0.5, "{place}");
        }
    }
}
