//! Cem Yuksel's HAIR files, which renderers read: strands only, and no ages.
//!
//! <http://www.cemyuksel.com/research/hairmodels>: a header of 128 bytes; segments of each strand
//! as u16; then of each point: position, thickness, transparency, colour, those whose bit is set.

use ptlib_plugin::prelude::*;

use super::{bytes::Bytes, hairs::Hairs};

const SEGMENTS: u32 = 1;
const POINTS: u32 = 2;
const THICKNESS: u32 = 4;
const COLORS: u32 = 16;

const HEADER: usize = 128;
const TEXT: usize = 88;

/// The file.
///
/// # Errors
/// Points instead of strands, a strand of more than 65,536 points, and those of the host.
pub fn file<'a>(hairs: &Hairs<'_>, work: Work<'a>) -> Result<Bytes<'a>, BlockError> {
    check(hairs)?;
    let (strands, points) = (hairs.count(), hairs.positions.len());
    let sizes = [Some(12), hairs.radii.map(|_| 4), hairs.colors.map(|_| 12)];
    let of_a_point: usize = sizes.into_iter().flatten().sum();
    let most = points.saturating_mul(of_a_point).saturating_add(strands.saturating_mul(2));
    let mut bytes = Bytes::new(work, most.saturating_add(HEADER))?;
    bytes.add(&header(hairs))?;
    bytes.records(strands, 2, |strands, bytes| {
        for (strand, place) in strands.zip(bytes.chunks_exact_mut(2)) {
            let segments = u16::try_from(hairs.points_of(strand) - 1).unwrap_or(u16::MAX);
            place.copy_from_slice(&segments.to_le_bytes());
        }
    })?;
    floats(&mut bytes, hairs, |point, _| hairs.positions.get(point))?;
    if let Some(radii) = hairs.radii {
        floats(&mut bytes, hairs, |point, _| [2.0 * radii.get(point)])?;
    }
    if hairs.colors.is_some() {
        floats(&mut bytes, hairs, |_, hair| hairs.color(hair))?;
    }
    Ok(bytes)
}

fn check(hairs: &Hairs<'_>) -> Result<(), BlockError> {
    if hairs.first.is_none() {
        let message = "a file of `format` hair holds strands, not points: connect `strands`";
        return Err(BlockError::invalid(message));
    }
    let most = usize::from(u16::MAX) + 1;
    match (0..hairs.count()).find(|strand| hairs.points_of(*strand) > most) {
        Some(strand) => Err(BlockError::limit(format!(
            "strand {strand} has {} points, allowed in `format` hair {most}",
            hairs.points_of(strand)
        ))),
        None => Ok(()),
    }
}

fn header(hairs: &Hairs<'_>) -> Vec<u8> {
    let count = |count: usize| u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes();
    let thickness = hairs.radii.map_or(0, |_| THICKNESS);
    let colors = hairs.colors.map_or(0, |_| COLORS);
    let bits = SEGMENTS | POINTS | thickness | colors;
    let mut header = [
        *b"HAIR",
        count(hairs.count()),
        count(hairs.positions.len()),
        bits.to_le_bytes(),
        // Defaults for what has no list: segments, thickness, transparency, colour.
        1_u32.to_le_bytes(),
        1.0_f32.to_le_bytes(),
        0.0_f32.to_le_bytes(),
    ]
    .concat();
    header.extend([1.0_f32.to_le_bytes(); 3].concat());
    let mut text = format!("ptlib aging 1, seed {}", hairs.seed).into_bytes();
    text.resize(TEXT, 0);
    header.extend(text);
    header
}

/// A list of `N` numbers a point.
fn floats<const N: usize>(
    bytes: &mut Bytes<'_>,
    hairs: &Hairs<'_>,
    numbers: impl Fn(usize, usize) -> [f32; N] + Sync,
) -> Result<(), BlockError> {
    let size = N * size_of::<f32>();
    bytes.records(hairs.positions.len(), size, |points, bytes| {
        for ((point, hair), bytes) in hairs.points(points).zip(bytes.chunks_exact_mut(size)) {
            let numbers = numbers(point, hair);
            for (place, number) in bytes.chunks_exact_mut(size_of::<f32>()).zip(numbers) {
                place.copy_from_slice(&number.to_le_bytes());
            }
        }
    })
}
