//! Triangles, seen by a camera.

use crate::{
    bins::{Bins, Count},
    camera::{Camera, Place},
    clip,
    grid::{Grid, Rect},
    number::word,
    piece::{self, Piece},
};

/// A triangle in more tiles than this is not sorted into them: every tile looks at it. So the list
/// has at most as many entries for each triangle.
const FEW: usize = 16;

/// Triangles between two looks at whether to go on.
const CHUNK: usize = 4096;

/// Triangles, seen by a camera.
#[derive(Debug, Clone, Copy)]
pub struct Solid<'a, P> {
    /// What sees them.
    pub camera: &'a Camera,
    /// Three vertices each.
    pub triangles: &'a [[u32; 3]],
    /// What [`Camera::place`] gives for each vertex: where it is.
    pub at: &'a [[i32; 2]],
    /// And 1 through its distance.
    pub inverse: &'a [f32],
    /// The position of a vertex, which is asked for where a triangle is clipped.
    pub position: P,
}

impl<P: Fn(u32) -> [f64; 3]> Solid<'_, P> {
    /// The most entries that the list of that many triangles has.
    #[must_use]
    pub fn most_entries(triangles: usize) -> u64 {
        triangles as u64 * FEW as u64
    }

    /// Counts the triangles of each tile, and of the bin behind those, for triangles that are in
    /// many. Stops when `check` fails.
    ///
    /// # Errors
    /// That of `check`.
    pub fn count<E>(
        &self,
        grid: &Grid,
        check: impl FnMut() -> Result<(), E>,
    ) -> Result<(usize, Bins), E> {
        let mut count = Count::new(grid.count() + 1);
        self.each(grid, check, |bin, _| count.add(bin))?;
        Ok(count.finish())
    }

    /// Puts the triangles into a list that has as many entries as were counted, in their order.
    ///
    /// # Errors
    /// That of `check`.
    pub fn fill<E>(
        &self,
        grid: &Grid,
        bins: &mut Bins,
        list: &mut [u32],
        check: impl FnMut() -> Result<(), E>,
    ) -> Result<(), E> {
        self.each(grid, check, |bin, triangle| list[bins.next(bin)] = word(triangle))
    }

    fn each<E>(
        &self,
        grid: &Grid,
        mut check: impl FnMut() -> Result<(), E>,
        mut give: impl FnMut(usize, usize),
    ) -> Result<(), E> {
        for triangle in 0..self.triangles.len() {
            if triangle.is_multiple_of(CHUNK) {
                check()?;
            }
            let tiles = grid.tiles(self.pixels(triangle, grid.picture()));
            let (across, down) = (tiles.x1 - tiles.x0, tiles.y1 - tiles.y0);
            if across * down > FEW {
                give(grid.count(), triangle);
                continue;
            }
            for y in tiles.y0..tiles.y1 {
                (tiles.x0..tiles.x1).for_each(|x| give(y * grid.across() + x, triangle));
            }
        }
        Ok(())
    }

    /// A box around the pixels of a triangle.
    fn pixels(&self, triangle: usize, within: Rect) -> Rect {
        if let Some(piece) = self.whole(triangle) {
            return piece::pixels(&piece.at, within);
        }
        let corners: Vec<_> = self.clipped(triangle).flat_map(|piece| piece.at).collect();
        piece::pixels(&corners, within)
    }

    fn whole(&self, triangle: usize) -> Option<Piece> {
        let corners = self.triangles[triangle].map(|vertex| vertex as usize);
        let places = corners.map(|i| Place { at: self.at[i], inverse: self.inverse[i] });
        let inverse = places.map(|place| f64::from(place.inverse));
        let is_whole = inverse.iter().all(|inverse| *inverse > 0.0);
        is_whole.then_some(Piece { at: places.map(|place| place.at), inverse, parts: None })
    }

    fn clipped(&self, triangle: usize) -> impl Iterator<Item = Piece> {
        clip::pieces(self.camera, self.triangles[triangle].map(|vertex| (self.position)(vertex)))
    }

    /// The triangle, or what clipping leaves of it.
    pub(crate) fn pieces(&self, triangle: usize, mut draw: impl FnMut(Piece)) {
        match self.whole(triangle) {
            Some(piece) => draw(piece),
            None => self.clipped(triangle).for_each(draw),
        }
    }
}
