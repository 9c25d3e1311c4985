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

struct LoadFile;

impl WholeBlock for LoadFile {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let picture = cx.read_image(&params.path).map_err(|error| error.at_parameter("path"))?;
        // A grey picture is made once and given as red, green and blue.
        let planes = picture.planes().min(3);
        let image = cx.stretched::<L>(&picture, planes, params.interpolation)?;
        Ok(vec![image.into_colour().into()])
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        Resampling::bytes_of((width, height))
    }
}
