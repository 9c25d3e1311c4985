//! Error propagation: each pixel takes the tone of its value and passes the rest on.
//!
//! Floyd and Steinberg, "An Adaptive Algorithm for Spatial Grey Scale", Proceedings of the Society
//! for Information Display 17, 1976.
//!
//! 7/16 of a pixel's error go to the right, so that a row is one chain of dependent steps; and as
//! the last pixel of a row passes 1/16 to the first one below (Q), so is the whole picture. Rows
//! cannot overlap. What can be done at once: the channels, which keep a core busy while each waits
//! for its own chain, and all that comes from the row above.

use super::Threshold;
use crate::block::prelude::*;

/// The picture in the tones of `threshold`; `tones` are those of the 256 levels.
pub(in super::super) fn propagate<L: Levels>(
    cx: &PrepareContext<'_>,
    image: &Image,
    threshold: Threshold,
    tones: &[f32; 256],
) -> Result<Image, Error> {
    let mut result = cx.new_image(image.planes())?;
    let mut planes: Vec<&mut [f32]> = result.planes_mut().collect();
    let tone = |value: f32| {
        if L::EIGHT_BIT {
            let level = convert::truncate(value);
            (convert::level(level), tones[convert::index(level.into()) & 255])
        } else {
            (value, threshold.tone(value))
        }
    };
    match planes.len() {
        1 => rows::<L, 1>(cx, image, &mut planes, tone)?,
        3 => rows::<L, 3>(cx, image, &mut planes, tone)?,
        _ => rows::<L, 4>(cx, image, &mut planes, tone)?,
    }
    drop(planes);
    Ok(result)
}

/// Writes all rows of `N` channels. `tone` gives a value as it is stored, and its tone, whose unit
/// is 1 even where that of values is a level.
fn rows<L: Levels, const N: usize>(
    cx: &PrepareContext<'_>,
    image: &Image,
    planes: &mut [&mut [f32]],
    tone: impl Fn(f32) -> (f32, f32),
) -> Result<(), Error> {
    let width = cx.width as usize;
    let white = if L::EIGHT_BIT { 255.0 } else { 1.0 };
    // Values with what came from above (then tones), and what is left over of each pixel.
    let mut pixels = vec![[0.0; N]; width];
    let mut errors = vec![[0.0; N]; width];
    for y in 0..cx.height {
        cx.check()?;
        for channel in 0..N {
            let row = image.row(channel, y);
            for (x, (pixel, value)) in pixels.iter_mut().zip(row).enumerate() {
                let left = errors[if x == 0 { width - 1 } else { x - 1 }][channel];
                let right = errors[if x + 1 == width { 0 } else { x + 1 }][channel];
                let error = (left + 5.0 * errors[x][channel] + 3.0 * right) * (1.0 / 16.0);
                let value = if L::EIGHT_BIT { levels::to_level(*value) } else { *value };
                pixel[channel] = value + error;
            }
        }
        let mut last = [0.0; N];
        for (pixel, errors) in pixels.iter_mut().zip(&mut errors) {
            for (pixel, last) in pixel.iter_mut().zip(&mut last) {
                let value = (*pixel + *last * (7.0 / 16.0)).clamp(0.0, white);
                let (value, tone) = tone(value);
                *last = value - levels_of::<L>(tone);
                *pixel = tone;
            }
            *errors = last;
        }
        for (channel, plane) in planes.iter_mut().enumerate() {
            let row = &mut plane[y as usize * width..][..width];
            for (out, pixel) in row.iter_mut().zip(&pixels) {
                *out = pixel[channel];
            }
        }
    }
    Ok(())
}

/// A tone in the unit of values.
#[inline(always)]
fn levels_of<L: Levels>(tone: f32) -> f32 {
    if L::EIGHT_BIT { levels::to_level(tone) } else { tone }
}
