//! A picture seen through uneven glass.
//!
//! Specification 2.31. Each pixel is taken from where a straight line along the normal, seen from
//! that height, meets the picture; there is no index of refraction. The normal map is read at the
//! same position only, so it need not exist as a whole.

// Pictured: `height` `0.2`.
// Pictured: `height` `2`.

use crate::block::prelude::*;

const IMAGE: usize = 0;
const NORMALS: usize = 1;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How high the glass is above the picture; more shifts the picture more.
        height: float [hard 0.0..=1000.0 soft 0.0..=20.0 unit "% of the width"] = 1.0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<Glass>(About {
    id: "glass",
    summary: "Shows a picture through glass whose surface is a normal map.",
    inputs: &[input("image", Kind::Image).anywhere(), input("normals", Kind::Image)],
    outputs: &[output("image", Planes::As(IMAGE))],
    ..About::DEFAULT
});

/// Pixels whose sources are found before they are read: the first is vectorised, the second not.
const PIECE: usize = 256;

struct Glass {
    image: Image,
    /// Height above the picture in pixels.
    height: f32,
}

impl GatherBlock for Glass {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let height = (params.height * f64::from(cx.width) * 0.01).trunc();
        Ok(Self { image: cx.image(IMAGE)?.clone(), height: convert::single(height) })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let [nx, ny, nz] = inputs.rgb(NORMALS);
        let count = out.plane(0).len();
        let mut sources = [0; PIECE];
        for start in (0..count).step_by(PIECE) {
            let end = count.min(start + PIECE);
            let normals = nx[start..end].iter().zip(&ny[start..end]).zip(&nz[start..end]);
            let mut offsets = [(0, 0); PIECE];
            for (offset, ((nx, ny), nz)) in offsets.iter_mut().zip(normals) {
                *offset = self.offset(*nx, *ny, *nz);
            }
            let first = i64::from(cx.x) + start as i64;
            for ((source, (dx, dy)), x) in sources.iter_mut().zip(offsets).zip(first..) {
                let x = convert::wrap_near(x + i64::from(dx), self.image.width());
                let y = convert::wrap_near(i64::from(cx.y) + i64::from(dy), self.image.height());
                *source = y as usize * self.image.width() as usize + x as usize;
            }
            for (channel, out) in out.iter_mut().enumerate() {
                let plane = self.image.channel(channel);
                for (out, source) in out[start..end].iter_mut().zip(sources) {
                    *out = plane[source];
                }
            }
        }
    }
}

impl Glass {
    /// How far away the source of a pixel with that normal lies.
    #[inline(always)]
    fn offset(&self, nx: f32, ny: f32, nz: f32) -> (i32, i32) {
        let [nx, ny, nz] = [nx, ny, nz].map(|value| value * 255.0 - 127.0);
        // A surface that stands upright shows what is below it. Levels miss 127 by rounding.
        let scale = if nz.abs() < 1e-3 { 0.0 } else { self.height / nz };
        (convert::truncate(nx * scale), convert::truncate(ny * scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    /// What (x, 1) of a 20 × 3 picture shows if the normal there is `normal`.
    fn seen(normal: [u8; 3], height: f64, x: usize) -> u8 {
        let picture: Vec<u8> = (0..60).collect();
        let normals = normal.map(|level| [level; 60]);
        let normals = image_of_levels(20, &normals.each_ref().map(<[u8; 60]>::as_slice));
        let trial = Trial::of(&BLOCK)
            .size(20, 3)
            .input(IMAGE, image_of_levels(20, &[&picture]))
            .input(NORMALS, normals)
            .float("height", height);
        trial.assert_same_bits();
        trial.levels(0)[20 + x]
    }

    #[test]
    fn pixels_come_from_along_the_normal() {
        assert_eq!(seen([127, 127, 255], 10.0, 5), 25);
        // Two pixels high, 1:1 to the right, 1:2 upward: truncated toward zero.
        assert_eq!(seen([191, 127, 191], 10.0, 5), 27);
        assert_eq!(seen([191, 95, 191], 14.9, 5), 7);
        assert_eq!(seen([127, 96, 191], 14.9, 5), 25);
        // Around the edges.
        assert_eq!(seen([191, 127, 191], 10.0, 19), 21);
        assert_eq!(seen([63, 63, 191], 10.0, 0), 58);
    }

    #[test]
    fn upright_surfaces_and_huge_offsets_are_harmless() {
        assert_eq!(seen([255, 0, 127], 10.0, 5), 25);
        // 1000 % of 20 px, 128 times to the right: 25,600 = 0 modulo 20.
        assert_eq!(seen([255, 127, 128], 1000.0, 5), 25);
        assert_eq!(seen([255, 127, 126], 1000.0, 5), 25);
    }
}
