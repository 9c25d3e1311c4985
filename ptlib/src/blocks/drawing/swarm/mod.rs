//! Particles that fly apart from one place, steered by a picture: PARTICLES of specification 2.18.
//!
//! A particle flies in rounds: straight on, then it turns by what the picture says there. In each
//! round all particles are equally fast and leave equal traces, 5 % slower and weaker from round to
//! round. Particles do not see each other, so one after the other may fly all of its rounds.
//!
//! Traces are sums in whole numbers: their order does not matter, so particles may fly on several
//! threads and still give the same bits.

use std::f64::consts::FRAC_PI_2;

use crate::block::prelude::*;

/// Units of traces in one level.
pub(super) const UNITS: u32 = 1 << 16;

/// Pixels of a trace between two questions whether to go on.
const PIECE: i64 = 4096;

/// The steering picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steering<'a> {
    pub(super) plane: &'a [f32],
    pub(super) width: u32,
    pub(super) height: u32,
}

/// What takes the traces.
pub(super) trait Traces {
    /// Adds to a pixel, given by its place in the plane; in [`UNITS`].
    fn add(&mut self, place: usize, amount: u32);

    /// Called before so many pixels are drawn.
    ///
    /// # Errors
    /// Whatever makes the drawing stop.
    fn spend(&mut self, pixels: u64) -> Result<(), Error>;
}

/// Particles that start at one place.
#[derive(Debug, Clone)]
pub(super) struct Swarm {
    count: u64,
    start: ray::Position,
    /// The middle direction in degrees, counter-clockwise from the right.
    angle: f64,
    /// How far directions are from it at most, in degrees.
    spread: f64,
    rounds: Vec<Round>,
}

/// What all particles do in a round.
#[derive(Debug, Clone, Copy)]
struct Round {
    /// Pixels that they fly.
    length: i64,
    /// What they add to each of them.
    amount: u32,
}

impl Swarm {
    /// Particles that fly `speed` pixels in their first round.
    pub(super) fn new<L: Levels>(
        count: u64,
        start: ray::Position,
        (angle, spread): (f64, f64),
        speed: f64,
    ) -> Self {
        let speeds = std::iter::successors(Some(speed), |speed| Some(0.95 * speed));
        // Slower ones leave no trace any more.
        let speeds = speeds.take_while(|speed| *speed >= 1.0);
        let rounds = speeds.map(|present| Round {
            length: convert::truncate64(present),
            amount: amount::<L>(100.0 * present / speed),
        });
        Self { count, start, angle, spread, rounds: rounds.collect() }
    }

    /// How many there are that leave a trace.
    pub(super) fn count(&self) -> u64 {
        if self.rounds.is_empty() { 0 } else { self.count }
    }

    /// Lets particle number `i` fly.
    ///
    /// # Errors
    /// What [`Traces::spend`] returns.
    pub(super) fn fly<L: Levels>(
        &self,
        i: u64,
        steering: &Steering<'_>,
        traces: &mut impl Traces,
    ) -> Result<(), Error> {
        let mut position = self.start;
        let mut angle = self.direction(i).to_radians();
        for round in &self.rounds {
            let ray = ray::Ray::new(position, angle);
            for from in (0..round.length).step_by(4096) {
                let to = round.length.min(from + PIECE);
                traces.spend((to - from).unsigned_abs())?;
                for k in from..to {
                    traces.add(steering.place(ray.at(k)), round.amount);
                }
            }
            position = ray.at(round.length);
            angle += turn::<L>(steering.plane[steering.place(position)]);
        }
        Ok(())
    }

    /// Where particle number `i` flies at first, in degrees.
    fn direction(&self, i: u64) -> f64 {
        if self.count < 2 {
            // The original divides 0 by 0: BUG → the middle.
            return self.angle;
        }
        #[expect(clippy::cast_precision_loss, reason = "counts of particles are below 2⁵²")]
        let (i, last) = (i as f64, (self.count - 1) as f64);
        self.angle - self.spread + 2.0 * self.spread * i / last
    }
}

/// What a particle adds, from levels.
fn amount<L: Levels>(levels: f64) -> u32 {
    let levels = if L::EIGHT_BIT { levels.trunc() } else { levels };
    convert::wrap(convert::round64(levels * f64::from(UNITS)), u32::MAX)
}

/// How far a particle turns at a value of the steering picture, in radians.
fn turn<L: Levels>(value: f32) -> f64 {
    // The middle grey steers nowhere. In levels it is 127; on real numbers a half.
    let middle = if L::EIGHT_BIT { 127.0 } else { 127.5 };
    let level = f64::from(value) * 255.0;
    let level = if L::EIGHT_BIT { level.round() } else { level };
    (middle - level) / middle * FRAC_PI_2
}

impl Steering<'_> {
    /// The place of a pixel in the plane.
    #[inline]
    fn place(&self, position: ray::Position) -> usize {
        let x = convert::wrap_near(position.x, self.width);
        let y = convert::wrap_near(position.y, self.height);
        y as usize * self.width as usize + x as usize
    }
}
