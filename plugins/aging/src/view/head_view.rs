//! The picture of a head: skin with wrinkles, and hair.
//!
//! The head is seen in perspective and drawn by a software rasteriser, tile by tile
//! ([`ptlib_raster`]), so that its picture has the same bits everywhere. Wrinkles are searched for
//! along the line of sight (parallax occlusion mapping; N. Tatarchuk, "Dynamic Parallax Occlusion
//! Mapping with Approximate Soft Shadows", 2006), so they hide each other although the mesh is
//! smooth. Hair is drawn over it from far to near, in the light of Kajiya and Kay.
//!
//! Where the head ends a pixel is covered or not; supersampling of the graph smooths that.

use std::sync::atomic::{AtomicUsize, Ordering};

use ptlib_plugin::prelude::*;
use ptlib_raster::{
    Camera, Grid, Solid, Tile,
    line::{self, Canvas},
};

use super::{
    hairs::Hairs,
    parallax::Search,
    params::Params,
    picture::{self, TargetRow},
    skin::{Skin, Textures},
    stage::Stage,
    surface::{Needs, Surface},
    texture::{Heights, Texture},
};

const MESH: usize = 0;
const COLOR: usize = 1;
const NORMALS: usize = 2;
const FINE: usize = 3;
const MASK: usize = 4;
const HAIR: usize = 5;

/// The plane of normals that holds heights.
const HEIGHT: usize = 3;

/// Vertices of a task.
const CHUNK: u32 = 4096;

/// The block, prepared.
#[derive(Debug)]
pub struct HeadView(Params);

impl Block for HeadView {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.head view",
        name: c"Head view",
        category: c"view",
        summary: c"A picture of a head with wrinkled skin and hair, seen by a camera.",
        inputs: &[
            &input(c"mesh", Kind::Mesh).doc(
                c"The head, with normals; for images on it also with texture coordinates, for \
                normals and fine detail with tangents.",
            ),
            &input(c"color", Kind::Image)
                .optional()
                .doc(c"The colour of the skin; a light skin if unconnected."),
            &input(c"normals", Kind::Image).optional().doc(
                c"Normals of wrinkles with their heights as alpha, as \"height to normal\" makes \
                them.",
            ),
            &input(c"fine", Kind::Image).optional().doc(
                c"Normals of fine detail, at the mesh's second texture coordinates if it has such.",
            ),
            &input(c"mask", Kind::Image).optional().doc(
                c"What the depth of wrinkles is multiplied by. A mask that \"age height\" has \
                used must not be here again.",
            ),
            &input(c"hair", Kind::Strands).optional().doc(c"Hair, in space as the head is."),
        ],
        outputs: &[&output(c"image", Planes::ColourAlpha)
            .doc(c"The picture; alpha tells how much of a pixel is head or hair.")],
        shape: Shape::Whole,
        tiling_exception: c"the picture that a camera takes has edges",
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(params.clone()))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let size = call.output(0).map(|out| [out.width(), out.height()])?;
        let (mesh, strands, work) = (call.mesh(MESH)?, call.optional_strands(HAIR), call.work());
        let bounds = match strands {
            Some(strands) if mesh.vertex_count() == 0 => strands.bounds(),
            _ => mesh.bounds(),
        };
        let stage = Stage::new(&self.0, bounds, size);
        let (surface, skin) = self.dress(call, mesh, &stage)?;
        let mut hairs = match strands {
            Some(strands) => Hairs::new(&self.0, &stage, strands, work)?,
            None => Hairs::none(work)?,
        };
        let mut at = work.scratch::<[i32; 2]>(mesh.vertex_count())?;
        let mut inverse = work.scratch::<f32>(mesh.vertex_count())?;
        place(&stage.camera, &surface, (&mut at, &mut inverse), work)?;
        let position = |vertex| surface.place(vertex);
        let (camera, triangles) = (&stage.camera, mesh.triangles());
        let solid = Solid { camera, triangles, at: &at, inverse: &inverse, position };
        let grid = Grid::new(size[0], size[1]);
        let (total, mut bins) = solid.count(&grid, || work.check())?;
        let mut list = work.scratch::<u32>(total)?;
        solid.fill(&grid, &mut bins, &mut list, || work.check())?;
        let in_many = &list[bins.range(grid.count())];
        let (width, done) = (hairs.width(), AtomicUsize::new(0));
        let (lines, entries) = hairs.split(grid.count());
        let targets = picture::targets(call.output(0)?, &grid).into_iter();
        work.for_each(targets.zip(entries).enumerate(), |(number, (target, entries))| {
            let mut tile = Tile::default();
            tile.start(grid.tile(number));
            tile.draw(&solid, in_many, || work.check())?;
            tile.draw(&solid, &list[bins.range(number)], || work.check())?;
            let mut canvas = Canvas::default();
            picture::paint(&mut canvas, &tile, (&solid, &surface), &skin);
            entries.sort_unstable();
            line::draw(&mut canvas, &tile, (lines, entries), width, || work.check())?;
            picture::write(&canvas, target);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            work.report(done as f64 / grid.count() as f64);
            Ok(())
        })
    }

    fn memory(_: &Params, width: u32, height: u32) -> u64 {
        let rows = Grid::new(width, 1).across() as u64 * u64::from(height);
        // The pieces of rows of the output, and tiles on some threads.
        rows * size_of::<TargetRow<'_>>() as u64 + 64 * (Tile::BYTES + Canvas::BYTES)
    }
}

impl HeadView {
    /// The surface with its images.
    fn dress<'a>(
        &self,
        call: &Call<'a>,
        mesh: Mesh<'a>,
        stage: &Stage,
    ) -> Result<(Surface<'a>, Skin<'a>), BlockError> {
        let images = [COLOR, NORMALS, FINE, MASK].map(|input| call.optional_image(input));
        let [color, normals, fine, mask] = images;
        if let Some(image) = normals.filter(|image| image.channels() < 4) {
            return Err(BlockError::invalid(format!(
                "the input \"normals\" has {} planes and no heights; \"aging.height to normal\" \
                gives normals with heights as alpha",
                image.channels()
            )));
        }
        let needs = Needs {
            tangent: normals.is_some() || fine.is_some(),
            texcoord: color.is_some() || normals.is_some() || mask.is_some(),
            fine: fine.is_some(),
        };
        let surface = Surface::new(mesh, needs, (stage.centre, stage.unit))?;
        let textures = images.map(|image| image.as_ref().map(Texture::new));
        let [color, normals, fine, mask] = textures;
        let is_deep = self.0.search != Search::Off && self.0.depth * self.0.age > 0.0;
        let heights = images[1].filter(|_| is_deep);
        let heights = heights.map(|image| Heights::new(&image, HEIGHT, call.work())).transpose()?;
        let textures = Textures { color, normals, heights, fine, mask };
        Ok((surface, Skin::new(&self.0, textures, stage.light, stage.camera.eye)))
    }
}

/// Where each vertex is in the picture.
fn place(
    camera: &Camera,
    surface: &Surface<'_>,
    (at, inverse): (&mut [[i32; 2]], &mut [f32]),
    work: Work<'_>,
) -> Result<(), BlockError> {
    let chunks = at.chunks_mut(CHUNK as usize).zip(inverse.chunks_mut(CHUNK as usize));
    work.for_each(chunks.zip(0_u32..), |((at, inverse), chunk)| {
        for ((at, inverse), vertex) in at.iter_mut().zip(inverse).zip(chunk * CHUNK..) {
            let place = camera.place(surface.place(vertex));
            (*at, *inverse) = (place.at, place.inverse);
        }
        work.check()
    })
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
