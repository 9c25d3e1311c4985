//! glTF 2.0 in one file: lines, or points.
//!
//! The Khronos Group, "glTF 2.0 Specification", 2021. What it has no name for has one with an
//! underscore: `_AGE`.

use ptlib_plugin::prelude::*;

use super::{
    bytes::{Bytes, shortest},
    hairs::Hairs,
};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const POINTS: u32 = 0;
const LINES: u32 = 1;
/// Bytes of three numbers.
const TRIPLE: usize = 12;

/// The file.
///
/// # Errors
/// A file of more bytes than its header can say, and those of the host.
pub fn file<'a>(hairs: &Hairs<'_>, work: Work<'a>) -> Result<Bytes<'a>, BlockError> {
    let (points, edges) = (hairs.positions.len(), hairs.edge_count());
    let mut contents = Contents::default();
    if points > 0 {
        contents.describe(hairs);
    }
    let json = contents.json(hairs);
    let size = contents.size;
    let chunk = if size > 0 { 8 + size } else { 0 };
    let all = 12 + 8 + json.len() + chunk;
    let length = u32::try_from(all).map_err(|_| {
        BlockError::limit(format!("the file takes {all} bytes, allowed in glb {}", u32::MAX))
    })?;
    let word = |size: usize| u32::try_from(size).unwrap_or(u32::MAX).to_le_bytes();
    let mut bytes = Bytes::new(work, all)?;
    bytes.add(&[*b"glTF", 2_u32.to_le_bytes(), length.to_le_bytes()].concat())?;
    bytes.add(&[word(json.len()), *b"JSON"].concat())?;
    bytes.add(json.as_bytes())?;
    if size == 0 {
        return Ok(bytes);
    }
    bytes.add(&[word(size), *b"BIN\0"].concat())?;
    triples(&mut bytes, hairs, |point, _| hairs.positions.get(point))?;
    if hairs.colors.is_some() {
        triples(&mut bytes, hairs, |_, hair| hairs.color(hair))?;
    }
    if hairs.ages.is_some() {
        bytes.records(points, 4, |points, bytes| {
            for ((_, hair), bytes) in hairs.points(points).zip(bytes.chunks_exact_mut(4)) {
                bytes.copy_from_slice(&hairs.age(hair).to_le_bytes());
            }
        })?;
    }
    bytes.records(edges, 8, |edges, bytes| {
        for (first, bytes) in hairs.edges(edges).zip(bytes.chunks_exact_mut(8)) {
            bytes[..4].copy_from_slice(&first.to_le_bytes());
            bytes[4..].copy_from_slice(&first.saturating_add(1).to_le_bytes());
        }
    })?;
    Ok(bytes)
}

fn triples(
    bytes: &mut Bytes<'_>,
    hairs: &Hairs<'_>,
    numbers: impl Fn(usize, usize) -> [f32; 3] + Sync,
) -> Result<(), BlockError> {
    bytes.records(hairs.positions.len(), TRIPLE, |points, bytes| {
        for ((point, hair), bytes) in hairs.points(points).zip(bytes.chunks_exact_mut(TRIPLE)) {
            for (place, number) in bytes.chunks_exact_mut(4).zip(numbers(point, hair)) {
                place.copy_from_slice(&number.to_le_bytes());
            }
        }
    })
}

/// What the buffer holds, one list after the other.
#[derive(Debug, Default)]
struct Contents {
    views: Vec<String>,
    accessors: Vec<String>,
    attributes: Vec<String>,
    indices: Option<usize>,
    size: usize,
}

impl Contents {
    fn describe(&mut self, hairs: &Hairs<'_>) {
        let points = hairs.positions.len();
        let corner = |corner: [f32; 3]| corner.map(shortest).join(",");
        let [min, max] = hairs.bounds.map(corner);
        let bounds = format!(",\"min\":[{min}],\"max\":[{max}]");
        self.attribute("POSITION", points, ("VEC3", TRIPLE), &bounds);
        if hairs.colors.is_some() {
            self.attribute("COLOR_0", points, ("VEC3", TRIPLE), "");
        }
        if hairs.ages.is_some() {
            self.attribute("_AGE", points, ("SCALAR", 4), "");
        }
        if hairs.first.is_some() {
            let edges = hairs.edge_count();
            self.indices = Some(self.list((UNSIGNED_INT, "SCALAR"), edges * 2, 4, ""));
        }
    }

    fn attribute(&mut self, name: &str, count: usize, (kind, size): (&str, usize), more: &str) {
        let accessor = self.list((FLOAT, kind), count, size, more);
        self.attributes.push(format!("\"{name}\":{accessor}"));
    }

    fn list(
        &mut self,
        (component, kind): (u32, &str),
        count: usize,
        size: usize,
        more: &str,
    ) -> usize {
        let number = self.accessors.len();
        let (offset, bytes) = (self.size, count.saturating_mul(size));
        self.views.push(format!("{{\"buffer\":0,\"byteOffset\":{offset},\"byteLength\":{bytes}}}"));
        self.accessors.push(format!(
            "{{\"bufferView\":{number},\"componentType\":{component},\"count\":{count},\
             \"type\":\"{kind}\"{more}}}"
        ));
        self.size = self.size.saturating_add(bytes);
        number
    }

    /// The JSON, as long as its chunk has to be. A list of glTF has at least one element, so of no
    /// hair there is not even a scene.
    fn json(&self, hairs: &Hairs<'_>) -> String {
        let asset = format!(
            "\"asset\":{{\"version\":\"2.0\",\"generator\":\"ptlib aging 1, seed {}\"}}",
            hairs.seed
        );
        let mut json = if self.accessors.is_empty() {
            format!("{{{asset}}}")
        } else {
            let mode = if hairs.first.is_some() { LINES } else { POINTS };
            let indices = self.indices.map(|i| format!("\"indices\":{i},")).unwrap_or_default();
            format!(
                "{{{asset},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],\
                 \"meshes\":[{{\"primitives\":[{{\"attributes\":{{{}}},{indices}\"mode\":{mode}}}\
                 ]}}],\"accessors\":[{}],\"bufferViews\":[{}],\
                 \"buffers\":[{{\"byteLength\":{}}}]}}",
                self.attributes.join(","),
                self.accessors.join(","),
                self.views.join(","),
                self.size
            )
        };
        while !json.len().is_multiple_of(4) {
            json.push(' ');
        }
        json
    }
}
