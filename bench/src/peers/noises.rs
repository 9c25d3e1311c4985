//! Lattice noises in octaves.

use noise::{Fbm, MultiFractal as _, NoiseFn, Perlin, Seedable, Value};
use quick_noise::{Grid, simd::dispatch_simd};

use super::{Contender, Peer, Task, samples};
use crate::Result;

pub(super) static PEERS: &[Peer] = &[
    Peer {
        name: "quick-noise, value",
        does: "value noise on a grid, repeating; no octave is blurred",
        near: None,
        make: |task| Ok(quick(task, quick_value)),
    },
    Peer {
        name: "quick-noise, perlin",
        does: "gradient noise on a grid, repeating",
        near: None,
        make: |task| Ok(quick(task, quick_perlin)),
    },
    Peer {
        name: "noise, value",
        does: "value noise, point by point; it does not repeat",
        near: None,
        make: |task| Ok(by_points::<Value>(task)),
    },
    Peer {
        name: "noise, perlin",
        does: "gradient noise, point by point; it does not repeat",
        near: None,
        make: |task| Ok(by_points::<Perlin>(task)),
    },
];

/// As in the graphs of ours.
const FREQUENCY: u16 = 6;
const OCTAVES: u16 = 6;

/// Lattice points a pixel, in the coarsest octave.
fn frequency(side: u32) -> f64 {
    f64::from(FREQUENCY) / f64::from(side)
}

fn quick(task: &Task, fill: fn((u32, u32), &mut [f32])) -> Box<dyn Contender> {
    let size = task.size;
    samples(task, move |out| {
        fill(size, out);
        Ok(())
    })
}

#[dispatch_simd(A)]
fn quick_value((width, height): (u32, u32), out: &mut [f32]) {
    let grid = Grid::<2, A>::new(width as usize, height as usize);
    #[expect(clippy::cast_possible_truncation, reason = "what the peer takes")]
    let frequency = frequency(width) as f32;
    grid.tiling(Some(width), Some(height))
        .builder::<quick_noise::Fbm, quick_noise::Value>()
        .octaves(usize::from(OCTAVES))
        .frequency(frequency)
        .fill(out);
}

#[dispatch_simd(A)]
fn quick_perlin((width, height): (u32, u32), out: &mut [f32]) {
    let grid = Grid::<2, A>::new(width as usize, height as usize);
    #[expect(clippy::cast_possible_truncation, reason = "what the peer takes")]
    let frequency = frequency(width) as f32;
    grid.tiling(Some(width), Some(height))
        .builder::<quick_noise::Fbm, quick_noise::Perlin>()
        .octaves(usize::from(OCTAVES))
        .frequency(frequency)
        .fill(out);
}

fn by_points<T>(task: &Task) -> Box<dyn Contender>
where
    T: Default + Seedable + NoiseFn<f64, 2> + 'static,
{
    let (width, height) = task.size;
    let noise = Fbm::<T>::new(7).set_octaves(usize::from(OCTAVES)).set_lacunarity(2.0);
    let noise = noise.set_frequency(frequency(width));
    samples(task, move |out| {
        let rows = out.chunks_exact_mut(width as usize).zip(0..height);
        for (row, y) in rows {
            for (pixel, x) in row.iter_mut().zip(0..width) {
                #[expect(clippy::cast_possible_truncation, reason = "a picture of ours has f32")]
                let value = noise.get([f64::from(x), f64::from(y)]) as f32;
                *pixel = value;
            }
        }
        Ok::<_, Box<dyn std::error::Error>>(()) as Result
    })
}
