//! Lines of particles: style 5 of specification 2.45.
//!
//! A line is a swarm that starts at its beginning. It is drawn on a plane of its own, and what it
//! leaves there takes colour away from the picture. The plane is cleared pixel by pixel, so that a
//! short line in a large picture costs little.

use super::{
    super::swarm::{Steering, Swarm, Traces, UNITS},
    Effort, Line, length, number, steering,
};
use crate::block::prelude::*;

/// How lines of particles look.
#[derive(Debug, Clone)]
pub(in super::super) struct Spray {
    /// How much they bend and spread, 0..1.
    intensity: f64,
    /// How many more particles there are, 0..1.
    density: f64,
    planes: Option<Planes>,
}

/// What exists from the first line of particles on.
#[derive(Debug, Clone)]
struct Planes {
    noise: Vec<f32>,
    /// The traces of a swarm, in [`UNITS`]; 0 between lines.
    sums: Vec<u32>,
    /// The places where they are not 0.
    touched: Vec<u32>,
}

/// A swarm on its way.
struct Drawing<'a, 'e, 'c> {
    sums: &'a mut [u32],
    touched: &'a mut Vec<u32>,
    effort: &'e mut Effort<'c>,
}

impl Traces for Drawing<'_, '_, '_> {
    #[inline]
    fn add(&mut self, place: usize, amount: u32) {
        let sum = &mut self.sums[place];
        if *sum == 0 && amount > 0 {
            // Images have at most 2³² pixels.
            self.touched.push(u32::try_from(place).unwrap_or(u32::MAX));
        }
        *sum = (*sum + amount).min(255 * UNITS);
    }

    fn spend(&mut self, pixels: u64) -> Result<(), Error> {
        // Turning at the end of a trace takes as long as some pixels.
        self.effort.spend(pixels + 16)
    }
}

impl Spray {
    pub(in super::super) fn new(intensity: f64, density: f64) -> Self {
        Self { intensity, density, planes: None }
    }

    /// The most memory that it takes, in bytes.
    pub(in super::super) fn bytes_of(intensity: f64, width: u32, height: u32) -> u64 {
        // Sums and touched places.
        u64::from(width) * u64::from(height) * 8 + steering::bytes_of(intensity, width, height)
    }

    /// Draws a line on planes of levels.
    pub(super) fn draw<L: Levels>(
        &mut self,
        canvas: &mut [&mut [f32]; 3],
        line: &Line,
        effort: &mut Effort<'_>,
    ) -> Result<(), Error> {
        let cx = effort.cx;
        let swarm = self.swarm::<L>(line, cx);
        let planes = match &mut self.planes {
            Some(planes) => planes,
            none => none.insert(Planes::new::<L>(self.intensity, cx)?),
        };
        let Planes { noise, sums, touched } = planes;
        let steering = Steering { plane: noise, width: cx.width, height: cx.height };
        let mut drawing = Drawing { sums, touched, effort };
        for i in 0..swarm.count() {
            drawing.spend(0)?;
            swarm.fly::<L>(i, &steering, &mut drawing)?;
        }
        for place in touched.drain(..) {
            let sum = std::mem::take(&mut sums[place as usize]);
            let trace = f64::from(sum) / f64::from(UNITS);
            for (plane, color) in canvas.iter_mut().zip(line.pen.color) {
                let amount = trace / 255.0 * f64::from(255 - color);
                let amount = if L::EIGHT_BIT { amount.trunc() } else { amount };
                let level = &mut plane[place as usize];
                *level = (*level - convert::single(amount)).max(0.0);
            }
        }
        Ok(())
    }

    /// The particles of a line.
    fn swarm<L: Levels>(&self, line: &Line, cx: &Context<'_>) -> Swarm {
        let length = length(line) / f64::from(cx.width);
        let count = 128.0 * length + 1.0 + 128.0 * length * self.density;
        let count = convert::truncate64(count).unsigned_abs();
        let start = |position: i64, size: u32| {
            let last = f64::from(size - 1);
            // A size of 1 may give 0/0, which is truncated to 0 in the end.
            let fraction = (number(position) / last).clamp(0.0, 1.0);
            convert::truncate64(fraction * last)
        };
        let start = ray::Position::new(start(line.from.x, cx.width), start(line.from.y, cx.height));
        let angle = ray::Segment::new(line.from, line.to).angle.to_degrees().trunc();
        let spread = (20.0 * length + 5.0 + 75.0 * self.intensity).trunc();
        let velocity = 13.0 * length + 0.1 + 20.0 * self.intensity * length;
        Swarm::new::<L>(count, start, (angle, spread), velocity * 0.01 * f64::from(cx.width))
    }
}

impl Planes {
    fn new<L: Levels>(intensity: f64, cx: &Context<'_>) -> Result<Self, Error> {
        let noise = steering::steering::<L>(intensity, cx)?;
        Ok(Self { sums: vec![0; noise.len()], touched: Vec::new(), noise })
    }
}
