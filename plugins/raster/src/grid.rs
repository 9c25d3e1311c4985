//! The tiles of a picture.

/// Pixels along a side of a tile.
pub const SIDE: usize = 64;

/// Some pixels: columns `x0` to before `x1`, rows `y0` to before `y1`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rect {
    /// The first column.
    pub x0: usize,
    /// The first row.
    pub y0: usize,
    /// Behind the last column.
    pub x1: usize,
    /// Behind the last row.
    pub y1: usize,
}

impl Rect {
    /// The pixels of both; none has no width or no height.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let (x0, y0) = (self.x0.max(other.x0), self.y0.max(other.y0));
        Self { x0, y0, x1: self.x1.min(other.x1).max(x0), y1: self.y1.min(other.y1).max(y0) }
    }

    /// Whether there are no pixels.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.x0 >= self.x1 || self.y0 >= self.y1
    }
}

/// The tiles of a picture, row by row from the left upper corner. Those at the right and lower edge
/// may be smaller.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    width: usize,
    height: usize,
}

impl Grid {
    /// The tiles of a picture of that size in pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self { width: width as usize, height: height as usize }
    }

    /// Tiles in a row.
    #[must_use]
    pub fn across(&self) -> usize {
        self.width.div_ceil(SIDE)
    }

    /// All tiles.
    #[must_use]
    pub fn count(&self) -> usize {
        self.across() * self.height.div_ceil(SIDE)
    }

    /// All pixels of the picture.
    #[must_use]
    pub fn picture(&self) -> Rect {
        Rect { x0: 0, y0: 0, x1: self.width, y1: self.height }
    }

    /// The pixels of a tile.
    #[must_use]
    pub fn tile(&self, tile: usize) -> Rect {
        let across = self.across().max(1);
        let (x0, y0) = (tile % across * SIDE, tile / across * SIDE);
        Rect { x0, y0, x1: x0 + SIDE, y1: y0 + SIDE }.and(self.picture())
    }

    /// Columns and rows of the tiles that have some of these pixels, which lie in the picture.
    #[must_use]
    pub fn tiles(&self, pixels: Rect) -> Rect {
        if pixels.is_empty() {
            return Rect::default();
        }
        let (x1, y1) = (pixels.x1.div_ceil(SIDE), pixels.y1.div_ceil(SIDE));
        Rect { x0: pixels.x0 / SIDE, y0: pixels.y0 / SIDE, x1, y1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_each_pixel_once() {
        let grid = Grid::new(130, 65);
        assert_eq!((grid.across(), grid.count()), (3, 6));
        let mut seen = vec![0; 130 * 65];
        for tile in 0..grid.count() {
            let rect = grid.tile(tile);
            for y in rect.y0..rect.y1 {
                seen[y * 130 + rect.x0..y * 130 + rect.x1].iter_mut().for_each(|n| *n += 1);
            }
        }
        assert!(seen.iter().all(|n| *n == 1));
        let pixels = Rect { x0: 63, y0: 64, x1: 65, y1: 65 };
        assert_eq!(grid.tiles(pixels), Rect { x0: 0, y0: 1, x1: 2, y1: 2 });
    }
}
