//! PLY, binary and text: points with all that they have, or strands as vertices and edges.
//!
//! Greg Turk, "The PLY Polygon File Format" (1994).

use std::ops::Range;

use ptlib_plugin::prelude::*;

use super::{
    bytes::{Bytes, NUMBER, Text, WHOLE},
    hairs::{Hairs, byte},
};

/// Properties that are numbers, before the three bytes of a colour.
const OF_POINTS: [&str; 10] = ["x", "y", "z", "nx", "ny", "nz", "s", "t", "age", "param"];
const OF_STRANDS: [&str; 4] = ["x", "y", "z", "age"];
const COLORS: [&str; 3] = ["red", "green", "blue"];

/// The file.
///
/// # Errors
/// Those of the host.
pub fn file<'a>(hairs: &Hairs<'_>, is_text: bool, work: Work<'a>) -> Result<Bytes<'a>, BlockError> {
    let header = header(hairs, is_text);
    let (points, edges) = (hairs.positions.len(), hairs.edge_count());
    let numbers = properties(hairs).len();
    let [vertex, edge] = if is_text {
        [numbers * NUMBER + 3 * WHOLE, 2 * WHOLE]
    } else {
        [numbers * size_of::<f32>() + 3, 2 * size_of::<u32>()]
    };
    let most = points.saturating_mul(vertex).saturating_add(edges.saturating_mul(edge));
    let mut bytes = Bytes::new(work, most.saturating_add(header.len()))?;
    bytes.add(header.as_bytes())?;
    if is_text {
        bytes.texts(points, vertex, |points, text| vertex_texts(hairs, points, text))?;
        bytes.texts(edges, edge, |edges, text| {
            for first in hairs.edges(edges) {
                text.write(format_args!("{first} {}\n", first.saturating_add(1)));
            }
        })?;
    } else {
        bytes.records(points, vertex, |points, bytes| vertices(hairs, points, bytes))?;
        bytes.records(edges, edge, |edges, bytes| {
            for (first, bytes) in hairs.edges(edges).zip(bytes.chunks_exact_mut(edge)) {
                let (start, end) = bytes.split_at_mut(edge / 2);
                start.copy_from_slice(&first.to_le_bytes());
                end.copy_from_slice(&first.saturating_add(1).to_le_bytes());
            }
        })?;
    }
    Ok(bytes)
}

fn properties(hairs: &Hairs<'_>) -> &'static [&'static str] {
    if hairs.first.is_some() { &OF_STRANDS } else { &OF_POINTS }
}

fn header(hairs: &Hairs<'_>, is_text: bool) -> String {
    let format = if is_text { "ascii" } else { "binary_little_endian" };
    let mut header = format!(
        "ply\nformat {format} 1.0\ncomment ptlib aging 1\ncomment seed {}\nelement vertex {}\n",
        hairs.seed,
        hairs.positions.len()
    );
    for name in properties(hairs) {
        header += &format!("property float {name}\n");
    }
    for name in COLORS {
        header += &format!("property uchar {name}\n");
    }
    if hairs.first.is_some() {
        header += &format!("element edge {}\n", hairs.edge_count());
        header += "property int vertex1\nproperty int vertex2\n";
    }
    header + "end_header\n"
}

/// The numbers of a point, as many as the properties.
fn record(hairs: &Hairs<'_>, point: usize, hair: usize) -> [f32; OF_POINTS.len()] {
    let [x, y, z] = hairs.positions.get(point);
    if hairs.first.is_some() {
        return [x, y, z, hairs.age(hair), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    }
    let [nx, ny, nz] = hairs.directions.map_or([0.0; 3], |directions| directions.get(point));
    let [s, t] = hairs.texcoords.map_or([0.0; 2], |texcoords| texcoords.get(point));
    let random = hairs.randoms.map_or(0.0, |randoms| randoms.get(point));
    [x, y, z, nx, ny, nz, s, t, hairs.age(hair), random]
}

fn vertices(hairs: &Hairs<'_>, points: Range<usize>, bytes: &mut [u8]) {
    let numbers = properties(hairs).len();
    let size = numbers * size_of::<f32>();
    for ((point, hair), bytes) in hairs.points(points).zip(bytes.chunks_exact_mut(size + 3)) {
        let (places, colors) = bytes.split_at_mut(size);
        let record = record(hairs, point, hair);
        for (place, number) in places.chunks_exact_mut(size_of::<f32>()).zip(record) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        colors.copy_from_slice(&hairs.color(hair).map(byte));
    }
}

fn vertex_texts(hairs: &Hairs<'_>, points: Range<usize>, text: &mut Text<'_>) {
    let numbers = properties(hairs).len();
    for (point, hair) in hairs.points(points) {
        for number in &record(hairs, point, hair)[..numbers] {
            text.number(*number);
            text.add(" ");
        }
        let [red, green, blue] = hairs.color(hair).map(byte);
        text.write(format_args!("{red} {green} {blue}\n"));
    }
}
