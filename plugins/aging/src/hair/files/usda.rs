//! USD as text: one prim `BasisCurves` of straight pieces, or `Points`.
//!
//! Universal Scene Description, schema UsdGeom (<https://openusd.org>): widths are whole
//! thicknesses, one for each point; what a hair has as a whole is a primvar of interpolation
//! `uniform` on curves, and of `vertex` on points.

use std::ops::Range;

use ptlib_plugin::prelude::*;

use super::{
    bytes::{Bytes, NUMBER, Text, WHOLE, shortest},
    hairs::Hairs,
};

/// The most bytes of three numbers, in parentheses.
const TRIPLE: usize = 3 * (NUMBER + 1) + 4;

/// The file.
///
/// # Errors
/// Those of the host.
pub fn file<'a>(hairs: &Hairs<'_>, work: Work<'a>) -> Result<Bytes<'a>, BlockError> {
    let (count, points) = (hairs.count(), hairs.positions.len());
    let head = head(hairs);
    let of_points = points.saturating_mul(TRIPLE + NUMBER + 2);
    let of_hairs = count.saturating_mul(WHOLE + 2 + TRIPLE + NUMBER + 2);
    let most = of_points.saturating_add(of_hairs).saturating_add(head.len() + 2048);
    let mut bytes = Bytes::new(work, most)?;
    bytes.add(head.as_bytes())?;
    if hairs.first.is_some() {
        bytes.add(b"    int[] curveVertexCounts = [")?;
        list(&mut bytes, count, WHOLE, |strand, text| {
            text.write(format_args!("{}", hairs.points_of(strand)));
        })?;
        bytes.add(b"]\n")?;
    }
    bytes.add(b"    point3f[] points = [")?;
    list(&mut bytes, points, TRIPLE, |i, text| triple(hairs.positions.get(i), text))?;
    bytes.add(b"]\n")?;
    if let Some(radii) = hairs.radii {
        bytes.add(b"    float[] widths = [")?;
        list(&mut bytes, points, NUMBER, |i, text| text.number(2.0 * radii.get(i)))?;
        bytes.add(b"] (\n        interpolation = \"vertex\"\n    )\n")?;
    }
    let of_a_hair = if hairs.first.is_some() { "uniform" } else { "vertex" };
    let end = format!("] (\n        interpolation = \"{of_a_hair}\"\n    )\n");
    if hairs.colors.is_some() {
        bytes.add(b"    color3f[] primvars:displayColor = [")?;
        list(&mut bytes, count, TRIPLE, |i, text| triple(hairs.color(i), text))?;
        bytes.add(end.as_bytes())?;
    }
    if hairs.ages.is_some() {
        bytes.add(b"    float[] primvars:age = [")?;
        list(&mut bytes, count, NUMBER, |i, text| text.number(hairs.age(i)))?;
        bytes.add(end.as_bytes())?;
    }
    bytes.add(b"}\n")?;
    Ok(bytes)
}

fn head(hairs: &Hairs<'_>) -> String {
    let (prim, kind) = if hairs.first.is_some() {
        ("BasisCurves", "    uniform token type = \"linear\"\n")
    } else {
        ("Points", "")
    };
    let corner = |corner: [f32; 3]| corner.map(shortest).join(", ");
    format!(
        "#usda 1.0\n(\n    defaultPrim = \"hair\"\n    doc = \"ptlib aging 1, seed {}\"\n    \
         upAxis = \"Y\"\n)\n\ndef {prim} \"hair\"\n{{\n{kind}    float3[] extent = [({}), ({})]\n",
        hairs.seed,
        corner(hairs.bounds[0]),
        corner(hairs.bounds[1])
    )
}

fn triple(numbers: [f32; 3], text: &mut Text<'_>) {
    text.add("(");
    text.numbers(numbers, ", ");
    text.add(")");
}

/// The items of a list, with commas between them.
fn list(
    bytes: &mut Bytes<'_>,
    count: usize,
    most: usize,
    write: impl Fn(usize, &mut Text<'_>) + Sync,
) -> Result<(), BlockError> {
    bytes.texts(count, most + 2, |items: Range<usize>, text| {
        for item in items {
            if item > 0 {
                text.add(", ");
            }
            write(item, text);
        }
    })
}
