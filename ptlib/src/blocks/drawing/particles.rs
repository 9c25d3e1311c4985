//! Traces of particles that fly apart from one place, steered by a picture.
//!
//! Specification 2.18; [`Swarm`] is the primitive that it shares with the turtle. Traces wrap
//! around, so the result tiles.

// Pictured: `particles` `60`, `initial velocity` `10`.
// Pictured: `particles` `120`, `initial x` `0.1`, `initial y` `0.9`, `angle` `40`, `spread` `20`,
//   `initial velocity` `8`.

use std::sync::atomic::{AtomicU32, Ordering};

use super::swarm::{Steering, Swarm, Traces, UNITS};
use crate::block::prelude::*;

/// The steering picture.
const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many particles there are. Their traces are one pixel wide, so larger images need
        /// more to be as bright. 0 gives plain black.
        particles: int [hard 0..=100000 soft 0..=5000] = 500;
        /// Where they start, from the left edge.
        initial_x "initial x": float [hard 0.0..=1.0 soft 0.0..=1.0 unit "of the width"] = 0.5;
        /// Where they start, from the top edge.
        initial_y "initial y": float [hard 0.0..=1.0 soft 0.0..=1.0 unit "of the height"] = 0.5;
        /// Their mean direction: 0 right, 90 up.
        angle: int [hard 0..=360 soft 0..=360 unit "degrees"] = 0;
        /// How far directions are from the mean at most, on both sides: with 180, particles fly
        /// all around.
        spread: int [hard 0..=360 soft 0..=360 unit "degrees"] = 360;
        /// How far particles fly before they turn for the first time; from turn to turn it is 5 %
        /// less. In all they fly up to 20 times as far. 0 gives plain black.
        initial_velocity "initial velocity":
            float [hard 0.0..=1000.0 soft 0.0..=20.0 unit "% of the width"] = 5.0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<Particles>(About {
    id: "particles",
    summary: "Traces of particles that fly apart, steered by the red channel of a picture.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    in_pixels: "the width of the traces",
    ..About::DEFAULT
});

/// Particles that one task lets fly.
const PARTICLES: u64 = 16;

/// Pixels that one task converts.
const PIXELS: usize = 1 << 16;

struct Particles;

impl WholeBlock for Particles {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let (width, height) = (cx.width, cx.height);
        let steering = Steering { plane: cx.image(IMAGE)?.channel(0), width, height };
        let last = |fraction: f64, size: u32| convert::truncate64(fraction * f64::from(size - 1));
        let start =
            ray::Position::new(last(params.initial_x, width), last(params.initial_y, height));
        let directions = (f64::from(params.angle), f64::from(params.spread));
        let speed = params.initial_velocity * 0.01 * f64::from(width);
        let count = u64::from(params.particles.unsigned_abs());
        let swarm = Swarm::new::<L>(count, start, directions, speed);

        let sums: Vec<AtomicU32> =
            (0..width as usize * height as usize).map(|_| AtomicU32::new(0)).collect();
        let tasks = convert::index(swarm.count().div_ceil(PARTICLES).cast_signed());
        cx.parallel(tasks, |task| {
            let first = task as u64 * PARTICLES;
            let last = swarm.count().min(first + PARTICLES);
            let mut traces = Shared { sums: &sums, cx };
            (first..last).try_for_each(|i| swarm.fly::<L>(i, &steering, &mut traces))
        })?;

        let mut image = cx.new_image(1)?;
        for plane in image.planes_mut() {
            cx.parallel_pieces(plane, PIXELS, |piece, pixels| {
                for (pixel, sum) in pixels.iter_mut().zip(&sums[piece * PIXELS..]) {
                    let levels = f64::from(sum.load(Ordering::Relaxed)) / f64::from(UNITS);
                    *pixel = levels::from_level(convert::single(levels.min(255.0)));
                }
                Ok(())
            })?;
        }
        Ok(vec![image.into()])
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        u64::from(width) * u64::from(height) * size_of::<AtomicU32>() as u64
    }
}

/// The sums of all traces, shared by the threads.
struct Shared<'a> {
    sums: &'a [AtomicU32],
    cx: &'a Context<'a>,
}

impl Traces for Shared<'_> {
    #[inline]
    fn add(&mut self, place: usize, amount: u32) {
        // White stays white: a sum ends at most one trace of each thread above it, far from 2³².
        let sum = &self.sums[place];
        if sum.load(Ordering::Relaxed) < 255 * UNITS {
            sum.fetch_add(amount, Ordering::Relaxed);
        }
    }

    fn spend(&mut self, _: u64) -> Result<(), Error> {
        self.cx.check()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn steering(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).map(|i| (i * i % 253).to_le_bytes()[0]).collect()
    }

    fn trial(width: u32, height: u32) -> Trial {
        let image = image_of_levels(width, &[&steering(width, height)]);
        Trial::of(&BLOCK).size(width, height).input(IMAGE, image)
    }

    /// As the specification tells it: round after round, all particles in each.
    fn naive((width, height): (u32, u32), count: i32, angle: i32, spread: i32, v: f64) -> Vec<u8> {
        let steering = steering(width, height);
        let place = |p: ray::Position| {
            let (x, y) = (convert::wrap(p.x, width), convert::wrap(p.y, height));
            y as usize * width as usize + x as usize
        };
        let mut levels = vec![0_i64; steering.len()];
        let start = ray::Position::new(i64::from(width - 1) / 2, i64::from(height - 1) / 2);
        let direction = |i: i32| {
            let (angle, spread) = (f64::from(angle), f64::from(spread));
            let part = 2.0 * spread * f64::from(i) / f64::from(count - 1);
            if count == 1 { angle } else { angle - spread + part }
        };
        let mut particles: Vec<_> =
            (0..count).map(|i| (start, direction(i) * PI / 180.0)).collect();
        let first = v * 0.01 * f64::from(width);
        let mut speed = first;
        while speed > 0.0 {
            for (position, angle) in &mut particles {
                let ray = ray::Ray::new(*position, *angle);
                for k in 0..convert::truncate64(speed) {
                    let level = &mut levels[place(ray.at(k))];
                    *level = (*level + convert::truncate64(100.0 * speed / first)).min(255);
                }
                *position = ray.at(convert::truncate64(speed));
                *angle +=
                    (127.0 - f64::from(steering[place(*position)])) / 127.0 * 90.0 * PI / 180.0;
            }
            speed *= 0.95;
            if speed <= 0.5 {
                break;
            }
        }
        levels.into_iter().map(|level| level.to_le_bytes()[0]).collect()
    }

    #[test]
    fn particles_fly_as_the_specification_says() {
        for (size, count, angle, spread, velocity) in [
            ((41, 31), 30, 0, 360, 20.0),
            ((64, 64), 7, 90, 20, 5.0),
            ((33, 50), 1, 45, 90, 30.0),
            ((20, 20), 2, 200, 10, 400.0),
            ((64, 20), 0, 0, 360, 20.0),
            ((64, 20), 9, 0, 360, 0.0),
            ((64, 20), 9, 0, 360, 1.0),
            ((1, 1), 50, 0, 360, 1000.0),
        ] {
            let trial = trial(size.0, size.1)
                .int("particles", count)
                .int("angle", angle)
                .int("spread", spread)
                .float("initial velocity", velocity);
            let expected = naive(size, count, angle, spread, velocity);
            assert!(trial.levels(0) == expected, "{count} particles on {size:?}");
        }
    }

    #[test]
    fn without_steering_a_particle_flies_straight_in_both_precisions() {
        let mut grey = image_of_levels(200, &[&[127; 200 * 3]]);
        let trial = Trial::of(&BLOCK).size(200, 3).int("particles", 1);
        let trial = trial.float("initial velocity", 2.0).float("initial x", 0.0);
        let levels = trial.clone().input(IMAGE, grey.clone()).levels(0);
        assert!(levels[..200].iter().chain(&levels[400..]).all(|level| *level == 0));
        assert_eq!(levels[200..208], [100, 100, 100, 100, 95, 95, 95, 90]);

        grey = image_of_levels(200, &[&[0; 200 * 3]]);
        grey.planes_mut().for_each(|plane| plane.fill(0.5));
        let image = trial.input(IMAGE, grey).image();
        assert_eq!(image.row(0, 1)[4], 95.0 / 255.0);
        assert!(image.row(0, 0).iter().chain(image.row(0, 2)).all(|value| *value == 0.0));
    }

    #[test]
    fn many_particles_end_in_white() {
        let trial = trial(6, 5).int("particles", 3000).float("initial velocity", 1000.0);
        assert!(trial.image().channel(0).iter().all(|value| *value == 1.0));
    }
}
