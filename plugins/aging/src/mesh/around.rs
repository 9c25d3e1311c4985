//! The triangles around each vertex, in their order.
//!
//! Sums over the triangles of a vertex are gathered by it: vertices can then be computed on any
//! number of threads, and each sum still has one order. Counting, prefix sums and writing in place
//! take three passes over memory.

use ptlib_plugin::{Scratch, prelude::*};

/// Triangles or vertices between two questions whether to stop.
const PASS: usize = 1 << 16;

/// The triangles around each vertex.
#[derive(Debug)]
pub(super) struct Around<'a> {
    /// Where the triangles of a vertex end; those of the first start at 0.
    ends: Scratch<'a, u32>,
    triangles: Scratch<'a, u32>,
}

impl<'a> Around<'a> {
    /// Those of a mesh. A triangle that has a vertex twice is around it twice.
    pub(super) fn new(mesh: &Mesh<'_>, work: Work<'a>) -> Result<Self, BlockError> {
        let corners = mesh.triangles();
        let mut ends = work.scratch::<u32>(mesh.vertex_count())?;
        let mut triangles = work.scratch::<u32>(corners.len() * 3)?;
        for pass in corners.chunks(PASS) {
            work.check()?;
            pass.as_flattened().iter().for_each(|vertex| ends[*vertex as usize] += 1);
        }
        let mut start = 0;
        for pass in ends.chunks_mut(PASS) {
            work.check()?;
            for end in pass {
                start += std::mem::replace(end, start);
            }
        }
        // Each entry is the start of its vertex, and grows to its end.
        let numbers = 0..u32::MAX;
        for (pass, numbers) in corners.chunks(PASS).zip(numbers.step_by(PASS)) {
            work.check()?;
            for (triangle, number) in pass.iter().zip(numbers..) {
                for vertex in triangle {
                    let end = &mut ends[*vertex as usize];
                    triangles[*end as usize] = number;
                    *end += 1;
                }
            }
        }
        Ok(Self { ends, triangles })
    }

    /// The numbers of the triangles around a vertex, rising.
    #[inline]
    pub(super) fn of(&self, vertex: usize) -> &[u32] {
        let start = vertex.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.triangles[start as usize..self.ends[vertex] as usize]
    }
}
