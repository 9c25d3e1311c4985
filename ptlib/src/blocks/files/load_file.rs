//! A picture from a file.
//!
//! Specification 2.41: stretched to the size of the graph, whatever its own shape; alpha is
//! dropped. The engine reads the file, as far as the caller's file policy allows it.

// Pictured: `path` `in/shapes.png`.

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// The file, relative to the folder of the graph.
        path: path [read] = "";
        /// How the picture is brought to the size of the graph.
        interpolation: choice [Interpolation] = Interpolation::Linear;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<LoadFile>(About {
    id: "load file",
    summary: "A picture from a file, stretched to the size of the graph.",
    outputs: &[output("image", Planes::Colour)],
    tiling: Tiling::Except("a picture tiles only if the one in the file does"),
    ..About::DEFAULT
});

/// Rows that one task makes.
const ROWS: usize = 16;

struct LoadFile;

impl WholeBlock for LoadFile {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let picture = cx.read_image(&params.path)?;
        let from = (picture.width(), picture.height());
        let resampling = Resampling::new(from, (cx.width, cx.height), params.interpolation.into());
        // A grey picture is made once and given as red, green and blue.
        let mut image = cx.new_image(picture.planes().min(3))?;
        for (channel, plane) in image.planes_mut().enumerate() {
            let source = picture.channel(channel);
            let width = cx.width as usize;
            cx.parallel_pieces(plane, ROWS * width, |piece, rows| {
                cx.check()?;
                for (row, y) in rows.chunks_exact_mut(width).zip(piece * ROWS..) {
                    resampling.row::<L>(source, 0, u32::try_from(y).unwrap_or(u32::MAX), row);
                }
                Ok(())
            })?;
        }
        Ok(vec![image.into_colour().into()])
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        Resampling::bytes_of((width, height))
    }
}
