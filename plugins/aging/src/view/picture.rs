//! A tile of the picture: from triangles that are seen to the output.

use ptlib_plugin::ImageMut;
use ptlib_raster::{Grid, SIDE, Solid, Tile, line::Canvas};

use super::{
    skin::Skin,
    surface::{Batch, Corners, Surface},
    texture::LANES,
};

/// A row of a tile of the output, in red, green, blue and alpha.
pub type TargetRow<'a> = [&'a mut [f32]; 4];

/// The rows of each tile of the output.
pub fn targets<'a>(out: ImageMut<'a>, grid: &Grid) -> Vec<Vec<TargetRow<'a>>> {
    let mut tiles: Vec<_> = (0..grid.count()).map(|_| vec![]).collect();
    for row in out.rows() {
        let first = row.y as usize / SIDE * grid.across();
        let mut pieces = row.channels.into_iter().map(|row| row.chunks_mut(SIDE));
        let mut next = || pieces.next().into_iter().flatten();
        let (red, green, blue, alpha) = (next(), next(), next(), next());
        let pieces = red.zip(green).zip(blue.zip(alpha));
        for (tile, ((red, green), (blue, alpha))) in tiles[first..].iter_mut().zip(pieces) {
            tile.push([red, green, blue, alpha]);
        }
    }
    tiles
}

/// Shades what is seen of the head in a tile.
pub fn paint<P: Fn(u32) -> [f64; 3]>(
    canvas: &mut Canvas,
    tile: &Tile,
    (solid, surface): (&Solid<'_, P>, &Surface<'_>),
    skin: &Skin<'_>,
) {
    let (mut batch, mut corners) = (Batch::default(), Corners::default());
    let rect = tile.rect();
    for y in 0..rect.y1 - rect.y0 {
        let row = &mut canvas.pixels[y * SIDE..(y + 1) * SIDE];
        let mut put = |batch: &mut Batch| {
            let [red, green, blue] = skin.shade(batch);
            for i in 0..batch.count {
                row[batch.x[i]] = [red[i], green[i], blue[i], 1.0];
            }
            batch.count = 0;
        };
        tile.fragments(solid, y, |fragment| {
            surface.add(&mut batch, &mut corners, fragment);
            if batch.count == LANES {
                put(&mut batch);
            }
        });
        if batch.count > 0 {
            put(&mut batch);
        }
    }
}

/// Writes a tile, its colours no longer times alpha.
pub fn write(canvas: &Canvas, target: Vec<TargetRow<'_>>) {
    for (pixels, row) in canvas.pixels.chunks(SIDE).zip(target) {
        for (channel, values) in row.into_iter().enumerate() {
            for (value, pixel) in values.iter_mut().zip(pixels) {
                let alpha = pixel[3];
                *value = match channel {
                    3 => alpha.min(1.0),
                    _ if alpha > 0.0 => (pixel[channel] / alpha).min(1.0),
                    _ => 0.0,
                };
            }
        }
    }
}
