//! The triangles of a tile: which of them is nearest at each pixel.
//!
//! Depth is 1 through the distance, which is linear in the picture. The nearer triangle wins, of
//! equally near ones that of the lower number; so the order of drawing does not matter.

use crate::{
    grid::{Rect, SIDE},
    number::{single, word},
    piece::Setup,
    solid::Solid,
};

/// No triangle.
const NONE: u32 = u32::MAX;

/// Triangles between two looks at whether to go on.
const CHUNK: usize = 256;

/// What is nearest at each pixel of a tile.
#[derive(Debug, Clone)]
pub struct Tile {
    rect: Rect,
    depth: Vec<f32>,
    owner: Vec<u32>,
}

/// A pixel to shade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// Its column in the tile.
    pub x: usize,
    /// The triangle that is seen.
    pub triangle: u32,
    /// What part each of its corners has there, in perspective; they sum to 1.
    pub weights: [f32; 3],
}

impl Default for Tile {
    fn default() -> Self {
        let pixels = SIDE * SIDE;
        Self { rect: Rect::default(), depth: vec![0.0; pixels], owner: vec![NONE; pixels] }
    }
}

impl Tile {
    /// The memory of a tile.
    pub const BYTES: u64 = (SIDE * SIDE * (size_of::<f32>() + size_of::<u32>())) as u64;

    /// Makes it empty, and that of other pixels: [`Grid::tile`](crate::Grid::tile).
    pub fn start(&mut self, rect: Rect) {
        self.rect = rect;
        self.depth.fill(0.0);
        self.owner.fill(NONE);
    }

    /// Its pixels.
    #[must_use]
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// 1 through the distance of what is nearest in a row of the tile; 0 where nothing is.
    #[inline]
    #[must_use]
    pub fn depth(&self, y: usize) -> &[f32] {
        &self.depth[y * SIDE..(y + 1) * SIDE]
    }

    /// Draws some triangles.
    ///
    /// # Errors
    /// That of `check`, which is asked now and then whether to go on.
    pub fn draw<P: Fn(u32) -> [f64; 3], E>(
        &mut self,
        solid: &Solid<'_, P>,
        triangles: &[u32],
        mut check: impl FnMut() -> Result<(), E>,
    ) -> Result<(), E> {
        for chunk in triangles.chunks(CHUNK) {
            check()?;
            for triangle in chunk {
                solid.pieces(*triangle as usize, |piece| {
                    if let Some(setup) = Setup::new(&piece) {
                        self.cover(&setup, *triangle);
                    }
                });
            }
        }
        Ok(())
    }

    fn cover(&mut self, setup: &Setup, triangle: u32) {
        let rect = setup.pixels(self.rect);
        if rect.is_empty() {
            return;
        }
        let columns = rect.x0 - self.rect.x0..rect.x1 - self.rect.x0;
        for y in rect.y0..rect.y1 {
            let ([mut a, mut b, mut c], steps) = setup.row(rect.x0, y);
            // All pixels of the row are on the outer side of one edge.
            let last = i64::from(word(columns.len() - 1));
            let ends = [a, b, c].iter().zip(steps).any(|(e, step)| *e < 0 && e + step * last < 0);
            if ends {
                continue;
            }
            let (depth, depth_step) = setup.depth(rect.x0, y);
            let row = (y - self.rect.y0) * SIDE;
            let pixels = row + columns.start..row + columns.end;
            let (depths, owners) = (&mut self.depth[pixels.clone()], &mut self.owner[pixels]);
            for (i, (nearest, owner)) in depths.iter_mut().zip(owners).enumerate() {
                let here = single(depth + i as f64 * depth_step);
                let is_inside = (a | b | c) >= 0;
                let is_nearer = here > *nearest || here == *nearest && triangle < *owner;
                if is_inside && is_nearer {
                    (*nearest, *owner) = (here, triangle);
                }
                (a, b, c) = (a + steps[0], b + steps[1], c + steps[2]);
            }
        }
    }

    /// Gives the pixels of a row of the tile where there is a triangle, from left to right.
    pub fn fragments<P: Fn(u32) -> [f64; 3]>(
        &self,
        solid: &Solid<'_, P>,
        y: usize,
        mut give: impl FnMut(Fragment),
    ) {
        let (mut last, mut pieces) = (NONE, Vec::with_capacity(8));
        for (x, triangle) in self.owner[y * SIDE..(y + 1) * SIDE].iter().enumerate() {
            if *triangle == NONE {
                continue;
            }
            if *triangle != last {
                pieces.clear();
                solid.pieces(*triangle as usize, |piece| pieces.extend(Setup::new(&piece)));
                last = *triangle;
            }
            let (column, row) = (self.rect.x0 + x, self.rect.y0 + y);
            let setup = match &pieces[..] {
                [one] => Some(one),
                many => many.iter().find(|setup| setup.covers(column, row)),
            };
            if let Some(setup) = setup {
                let weights = setup.weights(column, row).map(single);
                give(Fragment { x, triangle: *triangle, weights });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Grid};

    fn camera() -> Camera {
        Camera {
            eye: [0.0; 3],
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
            scale: 50.0,
            size: [100, 100],
            near: 0.1,
        }
    }

    /// The triangle and the weights at each pixel of a picture; the tiles in any order.
    fn picture(
        points: &[[f64; 3]],
        triangles: &[[u32; 3]],
        backwards: bool,
    ) -> Vec<Option<(u32, [f32; 3])>> {
        let camera = camera();
        let places: Vec<_> = points.iter().map(|point| camera.place(*point)).collect();
        let at: Vec<_> = places.iter().map(|place| place.at).collect();
        let inverse: Vec<_> = places.iter().map(|place| place.inverse).collect();
        let position = |vertex: u32| points[vertex as usize];
        let solid = Solid { camera: &camera, triangles, at: &at, inverse: &inverse, position };
        let grid = Grid::new(100, 100);
        let go = || Ok::<_, ()>(());
        let (total, mut bins) = solid.count(&grid, go).unwrap();
        let mut list = vec![0; total];
        solid.fill(&grid, &mut bins, &mut list, go).unwrap();
        let mut seen = vec![None; 10_000];
        let mut tiles: Vec<_> = (0..grid.count()).collect();
        if backwards {
            tiles.reverse();
        }
        for number in tiles {
            let mut tile = Tile::default();
            tile.start(grid.tile(number));
            let mut both = [number, grid.count()].map(|bin| &list[bins.range(bin)]);
            if backwards {
                both.reverse();
            }
            both.iter().for_each(|list| tile.draw(&solid, list, go).unwrap());
            let rect = tile.rect();
            for y in 0..rect.y1 - rect.y0 {
                tile.fragments(&solid, y, |f| {
                    seen[(rect.y0 + y) * 100 + rect.x0 + f.x] = Some((f.triangle, f.weights));
                });
            }
        }
        seen
    }

    #[test]
    fn the_nearer_one_wins_and_of_equals_the_lower_one() {
        let far = [[-9.0, -9.0, -3.0], [9.0, -9.0, -3.0], [0.0, 9.0, -3.0]];
        let near = [[-0.2, -0.2, -1.0], [0.2, -0.2, -1.0], [0.0, 0.2, -1.0]];
        let points: Vec<_> = far.iter().chain(&near).copied().collect();
        let triangles = [[0, 1, 2], [3, 4, 5], [0, 1, 2], [5, 4, 3]];
        for backwards in [false, true] {
            let seen = picture(&points, &triangles, backwards);
            assert_eq!(seen[50 * 100 + 50].unwrap().0, 1);
            assert_eq!(seen[80 * 100 + 50].unwrap().0, 0);
            assert!(seen.iter().flatten().all(|(triangle, _)| *triangle < 2));
        }
    }

    #[test]
    fn a_floor_from_below_the_eye_to_the_horizon_is_whole() {
        // The corners are behind the camera, and 10¹⁵ away.
        let e = 1e15;
        let points = [[-e, -1.0, e], [e, -1.0, e], [e, -1.0, -e], [-e, -1.0, -e]];
        let seen = picture(&points, &[[0, 1, 2], [0, 2, 3]], false);
        for y in 0..100 {
            let row = &seen[y * 100..][..100];
            assert!(row.iter().all(|pixel| pixel.is_some() == (y >= 50)), "row {y}");
            let whole = |w: [f32; 3]| (w[0] + w[1] + w[2] - 1.0).abs() < 1e-5;
            assert!(row.iter().flatten().all(|(_, w)| whole(*w)), "row {y}");
        }
    }

    #[test]
    fn weights_lead_back_to_the_place_on_the_triangle() {
        let points = [[-3.0, -1.0, -1.2], [4.0, -2.0, -6.0], [0.0, 3.0, -3.0], [0.5, 0.2, 0.6]];
        // The second is cut by the near plane.
        for triangle in [[0, 1, 2], [1, 2, 3]] {
            let seen = picture(&points, &[triangle], false);
            assert!(seen.iter().flatten().count() > 500);
            for (i, (_, weights)) in seen.iter().enumerate().filter_map(|(i, p)| Some((i, (*p)?))) {
                let point: [f64; 3] = std::array::from_fn(|axis| {
                    (0..3).map(|c| f64::from(weights[c]) * points[triangle[c] as usize][axis]).sum()
                });
                let [x, y, w] = camera().homogeneous(point);
                assert!((x / w + 49.5 - (i % 100) as f64).abs() < 0.02, "{i}: {weights:?}");
                assert!((y / w + 49.5 - (i / 100) as f64).abs() < 0.02, "{i}: {weights:?}");
            }
        }
    }

    #[test]
    fn nothing_comes_of_triangles_without_area_or_not_in_sight() {
        let points = [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 1.0, 2.0]];
        let triangles = [[0, 0, 1], [0, 1, 0], [2, 3, 2], [2, 2, 2]];
        assert!(picture(&points, &triangles, false).iter().all(Option::is_none));
    }
}
