//! A file that a computation writes.
//!
//! Specification 2.42. The engine writes it, reduced to the graph's size, when the caller asks for
//! all results and has allowed writing there. The block itself only says what and where.

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// The file, relative to the first folder where the caller allows writing. Its name says
        /// the format, such as `.png`.
        path: path [write] = "";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<SaveFile>(About {
    id: "save file",
    summary: "Writes a picture to a file, where the caller allows it.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::As(IMAGE))],
    role: Role::Writer,
    ..About::DEFAULT
});

struct SaveFile;

impl PointBlock for SaveFile {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        out.map(inputs, IMAGE, |value| value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn gives_what_it_writes() {
        let image = image_of_levels(2, &[&[1, 2], &[3, 4], &[5, 255]]);
        let trial = Trial::of(&BLOCK).size(2, 1).input(IMAGE, image);
        assert_eq!([0, 1, 2].map(|channel| trial.levels(channel)), [[1, 2], [3, 4], [5, 255]]);
    }
}
