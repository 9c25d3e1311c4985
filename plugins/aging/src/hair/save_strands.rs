//! Writes hair into a file that modelling programs and renderers read.
//!
//! Only below the folders that the caller of the engine opened for writing. Numbers in texts are
//! the shortest that read back to the same bits; binary numbers are little endian. The thickness of
//! a hair is twice its radius.

use ptlib_plugin::prelude::*;

use super::files::{glb, hairs::Hairs, ply, usda, yuksel};

const POINTS: usize = 0;
const STRANDS: usize = 1;

choice! {
    /// What kind of file it is.
    Format {
        /// Binary PLY: points with direction, texture coordinates, age of loss, random number and
        /// colour; strands as vertices and edges.
        Ply = "ply",
        /// The same as text.
        PlyText = "ply text",
        /// Universal Scene Description as text: curves, or points.
        Usda = "usda",
        /// glTF in one file: lines, or points; the age of loss is the attribute `_AGE`.
        Glb = "glb",
        /// Cem Yuksel's files of hair: strands without their ages, so use `hair at age` before.
        Hair = "hair",
    }
}

params! {
    /// Parameters of `save strands`.
    Params {
        /// The file to write, below a folder that is open for writing. A file that is there is
        /// replaced.
        path: path [write] = "";
        /// What kind of file it is, whatever its name.
        format: choice [Format] = Format::Ply;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct SaveStrands {
    params: Params,
    seed: u64,
}

impl Block for SaveStrands {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.save strands",
        name: c"Save strands",
        category: c"hair",
        summary: c"Writes hair into a file: PLY, USD, glTF or HAIR.",
        inputs: &[
            &input(c"points", Kind::Points)
                .optional()
                .doc(c"Roots of hairs, unless `strands` is connected."),
            &input(c"strands", Kind::Strands)
                .optional()
                .doc(c"Strands of hair, unless `points` is connected."),
        ],
        outputs: &[&output(c"report", Planes::Grey)
            .of_kind(Kind::Text)
            .doc(c"What was written, in a sentence.")],
        shape: Shape::Whole,
        uses_seed: true,
        // What it does lies outside: a result that is kept would write nothing.
        varies: true,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { params: params.clone(), seed: setup.seed() })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (points, strands) = (call.optional_points(POINTS), call.optional_strands(STRANDS));
        let (hairs, what) = match (points, strands) {
            (Some(points), None) => (Hairs::of_points(points, self.seed)?, "points"),
            (None, Some(strands)) => (Hairs::of_strands(strands, self.seed)?, "strands"),
            (Some(_), Some(_)) => {
                let message = "both `points` and `strands` are connected, allowed is one of them";
                return Err(BlockError::invalid(message));
            }
            (None, None) => {
                let message = "neither `points` nor `strands` is connected, one of them is needed";
                return Err(BlockError::unconnected(message));
            }
        };
        let path = &self.params.path;
        if path.is_empty() {
            let message = "`path` is empty: it has to name the file to write";
            return Err(BlockError::invalid(message));
        }
        let work = call.work();
        let bytes = match self.params.format {
            Format::Ply => ply::file(&hairs, false, work),
            Format::PlyText => ply::file(&hairs, true, work),
            Format::Usda => usda::file(&hairs, work),
            Format::Glb => glb::file(&hairs, work),
            Format::Hair => yuksel::file(&hairs, work),
        }?;
        work.report(0.9);
        let written = bytes.written();
        work.write_file(path, written)?;
        let size = written.len();
        call.give_text(0, &format!("{path}: {} {what}, {size} bytes", hairs.count()))
    }
}

#[cfg(test)]
mod tests;
