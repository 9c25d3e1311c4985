//! Lines with a width: hair, wire.
//!
//! A line is a capsule: all pixels within half the width of a segment. A pixel is covered by how
//! far it is inside: ½ + half width − distance, from 0 to 1. A line thinner than a pixel is drawn
//! one pixel wide, and fades instead: so thin hair neither thickens nor twinkles. Where two
//! segments of a strand meet, the line that halves their angle tells which of them a pixel belongs
//! to; otherwise joints would be drawn twice, and show as dots.
//!
//! Lines are blended one over the other from far to near, by the depth of the middle, and of
//! equally deep ones in their order. What is behind the triangles of a tile is hidden there.

use std::ops::Range;

use crate::{
    camera::Camera,
    grid::{Grid, Rect, SIDE},
    number::{dot, signed, single, truncate, word},
    tile::Tile,
};

/// The numbers of a line, as they lie in memory: what [`Line::pack`] makes.
pub type Packed = [f32; 14];

/// Memory of a line in an array of [`Packed`].
pub const BYTES: u64 = size_of::<Packed>() as u64;

/// Memory of an entry in the list of a tile: depth, and the number of a line.
pub const ENTRY_BYTES: u64 = size_of::<u64>() as u64;

/// Lines between two looks at whether to go on.
const CHUNK: usize = 1024;

/// How far behind a surface a line may lie and still be seen, as a part of its distance: the roots
/// of hairs are in the surface.
const BIAS: f32 = 1e-5;

/// A line in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Line {
    /// Ends in pixels, cut to where the line is near the picture.
    pub ends: [[f32; 2]; 2],
    /// 1 through the distance of the ends. 0: the line is not seen.
    pub inverse: [f32; 2],
    /// 1 through the distance of the middle.
    pub depth: f32,
    /// Its colour.
    pub color: [f32; 3],
    /// Directions at the start and at the end, of which only pixels ahead, or behind, belong to the
    /// line; 0, 0 where it does not meet another.
    pub joints: [[f32; 2]; 2],
}

impl Line {
    /// What is seen of a segment, if anything, with lines up to `width` pixels wide.
    #[must_use]
    pub fn new(camera: &Camera, ends: [[f64; 3]; 2], width: f32) -> Option<Self> {
        let ends = ends.map(|end| camera.homogeneous(end));
        let half = camera.half();
        let margin = f64::from(width.max(1.0)) + 2.0;
        let [right, below] = half.map(|half| half + margin);
        let planes = [
            ([0.0, 0.0, 1.0], -camera.near),
            ([1.0, 0.0, right], 0.0),
            ([-1.0, 0.0, right], 0.0),
            ([0.0, 1.0, below], 0.0),
            ([0.0, -1.0, below], 0.0),
        ];
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (factors, constant) in planes {
            let [a, b] = ends.map(|end| dot(factors, end) + constant);
            if a < 0.0 && b < 0.0 {
                return None;
            }
            if a < 0.0 {
                start = start.max(a / (a - b));
            } else if b < 0.0 {
                end = end.min(a / (a - b));
            }
        }
        if start > end {
            return None;
        }
        let at = |t: f64| {
            let [x, y, w] = [0, 1, 2].map(|i| ends[0][i] + (ends[1][i] - ends[0][i]) * t);
            // Ends 10¹⁸ away leave rounding errors of any size.
            let w = w.max(camera.near);
            let place = [(x, half[0]), (y, half[1])]
                .map(|(x, half)| single((x / w).clamp(-half - margin, half + margin) + half));
            (place, w)
        };
        let [(a, near), (b, far)] = [start, end].map(at);
        Some(Self {
            ends: [a, b],
            inverse: [near, far].map(|w| single(1.0 / w)),
            depth: single(2.0 / (near + far)),
            ..Self::default()
        })
    }

    /// Joins it to the line that starts where it ends.
    pub fn join(&mut self, next: &mut Self) {
        let [a, b] = [self.direction(), next.direction()];
        let half = [a[0] + b[0], a[1] + b[1]];
        let is_cut = self.ends[1] != next.ends[0];
        // A line that turns back has no middle direction.
        if !is_cut && half[0] * half[0] + half[1] * half[1] > 1e-3 {
            (self.joints[1], next.joints[0]) = (half, half);
        }
    }

    fn direction(&self) -> [f32; 2] {
        let [a, b] = self.ends;
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        if length > 1e-6 { along.map(|x| x / length) } else { [0.0; 2] }
    }

    /// Its numbers.
    #[must_use]
    pub fn pack(&self) -> Packed {
        let Self { ends: [a, b], inverse, depth, color, joints: [from, to] } = *self;
        let [red, green, blue] = color;
        [
            a[0], a[1], b[0], b[1], inverse[0], inverse[1], depth, red, green, blue, from[0],
            from[1], to[0], to[1],
        ]
    }

    /// The line of these numbers.
    #[inline(always)]
    #[must_use]
    pub fn unpack(numbers: &Packed) -> Self {
        let [ax, ay, bx, by, near, far, depth, red, green, blue, fx, fy, tx, ty] = *numbers;
        Self {
            ends: [[ax, ay], [bx, by]],
            inverse: [near, far],
            depth,
            color: [red, green, blue],
            joints: [[fx, fy], [tx, ty]],
        }
    }
}

/// The tiles that a line of some width meets, a row of tiles after the other.
pub fn tiles(line: &Packed, width: f32, grid: &Grid, mut give: impl FnMut(usize)) {
    if line[4] <= 0.0 {
        return;
    }
    let (line, reach) = (Line::unpack(line), reach(width));
    let rows = span([line.ends[0][1], line.ends[1][1]], reach, grid.picture().y1);
    let tiles = grid.tiles(Rect { x0: 0, y0: rows.start, x1: 1, y1: rows.end });
    for row in tiles.y0..tiles.y1 {
        let band = (row * SIDE) as f32;
        let columns = columns(&line, [band, band + SIDE as f32], reach, grid.picture().x1);
        if !columns.is_empty() {
            let (first, last) = (columns.start / SIDE, (columns.end - 1) / SIDE);
            (first..=last).for_each(|column| give(row * grid.across() + column));
        }
    }
}

/// The entry of a line in the lists of tiles: these sort from far to near.
#[must_use]
pub fn entry(line: &Packed, number: usize) -> u64 {
    u64::from(Line::unpack(line).depth.to_bits()) << 32 | u64::from(word(number))
}

/// Pixels from the axis to where a line ends.
fn reach(width: f32) -> f32 {
    width.max(1.0) / 2.0 + 0.5
}

/// The pixels whose middles are within `reach` of a range, from 0 to before `end`.
#[inline(always)]
fn span(range: [f32; 2], reach: f32, end: usize) -> Range<usize> {
    let low = (range[0].min(range[1]) - reach - 0.5).max(0.0);
    let high = (range[0].max(range[1]) + reach + 0.5).max(0.0);
    let whole = truncate(low);
    let first = whole + usize::from((whole as f32) < low);
    first..truncate(high).min(end).max(first)
}

/// The columns that a line may cover between two heights.
#[inline(always)]
fn columns(line: &Line, [top, bottom]: [f32; 2], reach: f32, end: usize) -> Range<usize> {
    let [a, b] = line.ends;
    let along = [b[0] - a[0], b[1] - a[1]];
    // Where the axis is within reach of these heights.
    let [mut from, mut to] = [0.0_f32, 1.0];
    if along[1] != 0.0 {
        let at = [top - reach, bottom + reach].map(|y| (y - a[1]) / along[1]);
        (from, to) = (at[0].min(at[1]).max(0.0), at[0].max(at[1]).min(1.0));
        if from > to {
            return 0..0;
        }
    }
    span([a[0] + along[0] * from, a[0] + along[0] * to], reach, end)
}

/// A tile's pixels with the parts of red, green and blue that are covered, and the coverage.
#[derive(Debug, Clone)]
pub struct Canvas {
    /// Red, green, blue, each times alpha, and alpha of each pixel.
    pub pixels: Vec<[f32; 4]>,
}

impl Default for Canvas {
    fn default() -> Self {
        Self { pixels: vec![[0.0; 4]; SIDE * SIDE] }
    }
}

impl Canvas {
    /// The memory of a canvas.
    pub const BYTES: u64 = (SIDE * SIDE * size_of::<[f32; 4]>()) as u64;

    /// Makes it clear.
    pub fn clear(&mut self) {
        self.pixels.fill([0.0; 4]);
    }
}

/// Draws lines over a tile, in the order of the entries; sort these before.
///
/// # Errors
/// That of `check`, which is asked now and then whether to go on.
pub fn draw<E>(
    canvas: &mut Canvas,
    tile: &Tile,
    (lines, entries): (&[Packed], &[u64]),
    width: f32,
    mut check: impl FnMut() -> Result<(), E>,
) -> Result<(), E> {
    for chunk in entries.chunks(CHUNK) {
        check()?;
        for entry in chunk {
            let number = usize::try_from(entry & u64::from(u32::MAX)).unwrap_or_default();
            stroke(canvas, tile, &Line::unpack(&lines[number]), width);
        }
    }
    Ok(())
}

/// The pen of a line: what its pixels need.
struct Pen {
    from: [f32; 2],
    along: [f32; 2],
    /// `along` through the square of its length.
    across: [f32; 2],
    to: [f32; 2],
    joints: [[f32; 2]; 2],
    inverse: [f32; 2],
    reach: f32,
    alpha: f32,
}

impl Pen {
    fn new(line: &Line, width: f32) -> Self {
        let [from, to] = line.ends;
        let along = [to[0] - from[0], to[1] - from[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let across = if square > 1e-12 { along.map(|x| x / square) } else { [0.0; 2] };
        let [near, far] = line.inverse.map(|inverse| inverse * (1.0 + BIAS));
        let inverse = [near, far - near];
        let alpha = width / width.max(1.0);
        Self { from, along, across, to, joints: line.joints, inverse, reach: reach(width), alpha }
    }

    /// Depth and alpha at a place; alpha 0 outside.
    #[inline(always)]
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        let (dx, dy) = (x - self.from[0], y - self.from[1]);
        let t = (dx * self.across[0] + dy * self.across[1]).clamp(0.0, 1.0);
        let (ex, ey) = (dx - self.along[0] * t, dy - self.along[1] * t);
        let coverage = (self.reach - (ex * ex + ey * ey).sqrt()).clamp(0.0, 1.0);
        let [from, to] = self.joints;
        let is_ahead = dx * from[0] + dy * from[1] >= 0.0;
        let beyond = (x - self.to[0]) * to[0] + (y - self.to[1]) * to[1];
        let is_before = beyond < 0.0 || to == [0.0; 2];
        let alpha = if is_ahead && is_before { coverage * self.alpha } else { 0.0 };
        (self.inverse[0] + self.inverse[1] * t, alpha)
    }
}

fn stroke(canvas: &mut Canvas, tile: &Tile, line: &Line, width: f32) {
    let (rect, pen) = (tile.rect(), Pen::new(line, width));
    let nearest_end = pen.inverse[0].max(pen.inverse[0] + pen.inverse[1]) * (1.0 + BIAS);
    let rows = span([line.ends[0][1], line.ends[1][1]], pen.reach, rect.y1);
    let [red, green, blue] = line.color;
    for y in rows.start.max(rect.y0)..rows.end {
        let middle = signed(y) as f32 + 0.5;
        let columns = columns(line, [middle; 2], pen.reach, rect.x1);
        let (first, last) = (columns.start.max(rect.x0), columns.end);
        if first >= last {
            continue;
        }
        let depths = &tile.depth(y - rect.y0)[first - rect.x0..last - rect.x0];
        let row = (y - rect.y0) * SIDE + first - rect.x0;
        let pixels = &mut canvas.pixels[row..row + depths.len()];
        for ((pixel, nearest), x) in pixels.iter_mut().zip(depths).zip(first..) {
            // What is hidden as a whole is soon done with.
            if nearest_end < *nearest {
                continue;
            }
            let (depth, alpha) = pen.at(signed(x) as f32 + 0.5, middle);
            let alpha = if depth >= *nearest { alpha } else { 0.0 };
            let rest = 1.0 - alpha;
            let over = [red * alpha, green * alpha, blue * alpha, alpha];
            *pixel = std::array::from_fn(|c| over[c] + pixel[c] * rest);
        }
    }
}

#[cfg(test)]
#[path = "line_tests.rs"]
mod tests;
