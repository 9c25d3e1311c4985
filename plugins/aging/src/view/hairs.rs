//! Hair as lines of the picture, sorted into tiles.

use std::ops::Range;

use ptlib_plugin::{
    Scratch, Strands, Stream, Work, math,
    prelude::BlockError,
    stream::{COLOR, COLOR_ALPHA},
};
use ptlib_raster::{
    Bins, Count, Grid,
    line::{self, Line, Packed},
};

use super::{params::Params, power::Power, stage::Stage, strand_color::Hair, vector::unit};

/// The colour of hair that has none: that of `grey hair` when young.
const BROWN: [f32; 3] = [0.30, 0.20, 0.10];

/// Strands of a task.
const CHUNK: usize = 1024;

/// Lines between two looks at whether to go on.
const PAUSE: usize = 16_384;

/// All hair of a picture.
#[derive(Debug)]
pub struct Hairs<'a> {
    lines: Scratch<'a, Packed>,
    /// What each tile draws.
    entries: Scratch<'a, u64>,
    bins: Option<Bins>,
    width: f32,
}

/// What makes lines of strands.
struct Comb<'a, 'b> {
    stage: &'b Stage,
    strands: Strands<'a>,
    positions: Stream<'a, [f32; 3]>,
    color: Option<Stream<'a, [f32; 3]>>,
    color_alpha: Option<Stream<'a, [f32; 4]>>,
    hair: Hair,
    width: f32,
}

impl<'a> Hairs<'a> {
    /// No hair.
    pub fn none(work: Work<'a>) -> Result<Self, BlockError> {
        Ok(Self { lines: work.scratch(0)?, entries: work.scratch(0)?, bins: None, width: 0.0 })
    }

    /// The lines of strands, lit, in the tiles that they cross.
    ///
    /// # Errors
    /// If memory does not suffice, or the host asks to stop.
    pub fn new(
        params: &Params,
        stage: &Stage,
        strands: Strands<'a>,
        work: Work<'a>,
    ) -> Result<Self, BlockError> {
        let [width, height] = stage.camera.size;
        let hair_width = math::single(params.hair_width * f64::from(height));
        if strands.count() == 0 || hair_width <= 0.0 {
            return Self::none(work);
        }
        let ambient = [params.k_ambient_red, params.k_ambient_green, params.k_ambient_blue];
        let comb = Comb {
            stage,
            strands,
            positions: strands.positions()?,
            color: strands.strand_streams().get(COLOR),
            color_alpha: strands.strand_streams().get(COLOR_ALPHA),
            hair: Hair {
                diffuse: params.k_diffuse,
                specular: params.k_specular,
                shine: Power::new(params.hair_shine),
                ambient,
            },
            width: hair_width,
        };
        let mut lines = work.scratch::<Packed>(strands.point_count() - strands.count())?;
        comb.all(&mut lines, work)?;
        let grid = Grid::new(width, height);
        let mut count = Count::new(grid.count());
        each_tile((&lines, hair_width), &grid, work, |tile, _| count.add(tile))?;
        let (total, mut bins) = count.finish();
        let mut entries = work.scratch::<u64>(total)?;
        each_tile((&lines, hair_width), &grid, work, |tile, number| {
            entries[bins.next(tile)] = line::entry(&lines[number], number);
        })?;
        Ok(Self { lines, entries, bins: Some(bins), width: hair_width })
    }

    /// How wide hair is, in pixels.
    pub fn width(&self) -> f32 {
        self.width
    }

    /// All lines, and what each of so many tiles draws, to be sorted.
    pub fn split(&mut self, tiles: usize) -> (&[Packed], Vec<&mut [u64]>) {
        let mut rest = &mut self.entries[..];
        let range = |tile| self.bins.as_ref().map_or(0..0, |bins| bins.range(tile));
        let lists = (0..tiles).map(|tile| {
            let (list, after) = std::mem::take(&mut rest).split_at_mut(range(tile).len());
            rest = after;
            list
        });
        let lists = lists.collect();
        (&self.lines, lists)
    }
}

fn each_tile(
    (lines, width): (&[Packed], f32),
    grid: &Grid,
    work: Work<'_>,
    mut give: impl FnMut(usize, usize),
) -> Result<(), BlockError> {
    for (number, packed) in lines.iter().enumerate() {
        if number.is_multiple_of(PAUSE) {
            work.check()?;
        }
        line::tiles(packed, width, grid, |tile| give(tile, number));
    }
    Ok(())
}

impl Comb<'_, '_> {
    /// Lines of all strands. Strand i has one line less than points, so it starts at its first
    /// point less i.
    fn all(&self, lines: &mut [Packed], work: Work<'_>) -> Result<(), BlockError> {
        let mut rest = lines;
        let mut tasks = vec![];
        for first in (0..self.strands.count()).step_by(CHUNK) {
            let strands = first..(first + CHUNK).min(self.strands.count());
            let points: usize = strands.clone().map(|strand| self.points(strand).len()).sum();
            let (lines, after) = rest.split_at_mut(points - strands.len());
            tasks.push((strands, lines));
            rest = after;
        }
        work.for_each(tasks, |(strands, mut lines)| {
            work.check()?;
            for strand in strands {
                let (own, after) = lines.split_at_mut(self.points(strand).len() - 1);
                self.strand(strand, own);
                lines = after;
            }
            Ok(())
        })
    }

    fn points(&self, strand: usize) -> Range<usize> {
        self.strands.points(strand)
    }

    fn strand(&self, strand: usize, lines: &mut [Packed]) {
        let points = self.points(strand);
        let color = self.color_of(strand);
        let mut from = self.stage.scaled(self.positions.get(points.start));
        let mut last: Option<(usize, Line)> = None;
        for (i, point) in points.skip(1).enumerate() {
            let to = self.stage.scaled(self.positions.get(point));
            let mut next = self.line([from, to], color);
            from = to;
            if let (Some((place, mut before)), Some(line)) = (last, &mut next) {
                if place + 1 == i {
                    before.join(line);
                }
                lines[place] = before.pack();
            }
            last = next.map(|line| (i, line)).or_else(|| {
                last.inspect(|(place, before)| lines[*place] = before.pack());
                None
            });
        }
        if let Some((place, line)) = last {
            lines[place] = line.pack();
        }
    }

    /// A piece of a strand, if it has a direction and is seen.
    fn line(&self, ends: [[f64; 3]; 2], color: [f32; 3]) -> Option<Line> {
        let [from, to] = ends;
        let along = unit([0, 1, 2].map(|axis: usize| to[axis] - from[axis]))?;
        let line = Line::new(&self.stage.camera, ends, self.width)?;
        let eye = self.stage.camera.eye;
        let back = [0, 1, 2].map(|axis: usize| eye[axis] - (from[axis] + to[axis]) / 2.0);
        let back = unit(back).unwrap_or(along);
        let parts = self.hair.parts(along, self.stage.light, back);
        Some(Line { color: self.hair.color(parts, color), ..line })
    }

    fn color_of(&self, strand: usize) -> [f32; 3] {
        let without_alpha = || self.color_alpha.map(|colors| colors.get(strand));
        match (self.color, without_alpha()) {
            (Some(colors), _) => colors.get(strand),
            (None, Some([red, green, blue, _])) => [red, green, blue],
            (None, None) => BROWN,
        }
    }
}
