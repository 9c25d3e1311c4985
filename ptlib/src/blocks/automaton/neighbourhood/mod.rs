//! Which cells are neighbours.

use crate::block::prelude::*;

/// The largest size of a neighbourhood (specification 2.21).
pub(super) const MAX_SIZE: usize = 10;

choice! {
    /// The shape of a neighbourhood.
    Neighbourhood {
        /// A square: up to so many steps in each direction, diagonals included.
        Moore = "moore",
        /// A diamond: up to so many steps along rows and columns together.
        VonNeumann = "von neumann",
    }
}

impl Neighbourhood {
    /// The steps to all neighbours, to the right and down, in the order of rows from above and of
    /// columns from the left. The cell itself is not its neighbour.
    pub(super) fn steps(self, size: i32) -> impl Iterator<Item = (isize, isize)> {
        let size = size as isize;
        (-size..=size).flat_map(move |dy| {
            let reach = match self {
                Self::Moore => size,
                Self::VonNeumann => size - dy.abs(),
            };
            (-reach..=reach).map(move |dx| (dx, dy)).filter(|step| *step != (0, 0))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_and_diamonds() {
        let steps = |shape: Neighbourhood, size| shape.steps(size).collect::<Vec<_>>();
        assert_eq!(steps(Neighbourhood::VonNeumann, 1), [(0, -1), (-1, 0), (1, 0), (0, 1)]);
        let square = steps(Neighbourhood::Moore, 1);
        assert_eq!((square.len(), square[0], square[7]), (8, (-1, -1), (1, 1)));
        assert_eq!(steps(Neighbourhood::Moore, 10).len(), 440);
        assert_eq!(steps(Neighbourhood::VonNeumann, 10).len(), 220);
        assert_eq!(steps(Neighbourhood::Moore, 0).len(), 0);
    }
}
