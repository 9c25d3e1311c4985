//! Cracks that grow straight on until they meet one.
//!
//! Specification 2.14, steps 1 to 3. All cracks grow by a pixel in each step, one after the other
//! in the order of their birth: who comes first to a place decides who ends there, so this is
//! sequential by nature. Growing costs what it draws: a crack that meets another is forgotten, and
//! cracks are born at distances that shrink from phase to phase until there are no more.

use crate::block::prelude::*;
use ray::{Position, Ray};

/// A pixel of a crack.
pub(super) const BLACK: u8 = 0;
/// A pixel that no crack came to.
pub(super) const WHITE: u8 = 255;

/// What grows.
pub(super) struct Settings {
    /// How many cracks there are at first.
    pub(super) lines: u32,
    /// For how many phases cracks give birth to others.
    pub(super) phases: u32,
}

/// Pixels to be drawn between two questions whether to go on.
const PIXELS_BETWEEN_CHECKS: usize = 1 << 14;

struct Crack {
    ray: Ray,
    angle: f64,
    /// The pixel that it comes to next.
    length: i64,
}

struct Growth<'a> {
    cx: &'a WholeContext<'a>,
    draws: elias::Draws,
    pixels: Vec<u8>,
    /// Those that still grow, in the order of their birth.
    cracks: Vec<Crack>,
}

/// The cracks after they have grown: black on white.
pub(super) fn grow(settings: &Settings, cx: &WholeContext<'_>) -> Result<Vec<u8>, Error> {
    // Memory of zeros is taken from the system where it is written first: on all threads.
    let mut pixels = vec![0; cx.width as usize * cx.height as usize];
    cx.parallel_pieces(&mut pixels, cx.width as usize, |_, row| {
        row.fill(WHITE);
        Ok(())
    })?;
    let draws = elias::Draws::from_index(cx.seed32().wrapping_mul(32));
    let mut growth = Growth { cx, draws, pixels, cracks: Vec::new() };
    for _ in 0..settings.lines {
        growth.start();
    }
    // One number is drawn for nothing after them, and after each birth (specification, appendix A).
    growth.draws.next_noise();
    let mut distance = i64::from(cx.width / 4);
    let mut phases = settings.phases;
    let mut steps = 2 * distance + 1;
    let mut drawn_since_check = 0;
    loop {
        let births = (phases > 0 && distance > 0).then_some(distance);
        let drawn = growth.step(births);
        if drawn == 0 {
            return Ok(growth.pixels);
        }
        drawn_since_check += drawn;
        if drawn_since_check >= PIXELS_BETWEEN_CHECKS {
            drawn_since_check = 0;
            cx.check()?;
        }
        steps -= 1;
        if steps == 0 && births.is_some() {
            phases -= 1;
            #[expect(clippy::cast_precision_loss, reason = "a distance in an image")]
            let shorter = distance as f64 * 0.6;
            distance = convert::truncate64(shorter);
            steps = 2 * distance;
        }
    }
}

impl Growth<'_> {
    /// Starts a crack anywhere, in any direction.
    fn start(&mut self) {
        let x = self.draws.next_integer(0, i64::from(self.cx.width));
        let y = self.draws.next_integer(0, i64::from(self.cx.height));
        let angle = std::f64::consts::PI * (1.0 + self.draws.next_noise());
        let ray = Ray::new(Position::new(x, y), angle);
        self.cracks.push(Crack { ray, angle, length: 0 });
    }

    /// Lets each crack grow by a pixel, and give birth to another every `births` pixels. Returns
    /// how many pixels were drawn.
    fn step(&mut self, births: Option<i64>) -> usize {
        let mut drawn = 0;
        let mut cracks = std::mem::take(&mut self.cracks);
        let mut born = Vec::new();
        cracks.retain_mut(|crack| {
            let place = crack.ray.at(crack.length);
            if births.is_some_and(|births| crack.length > 0 && crack.length % births == 0) {
                born.push(self.branch(crack, place));
            }
            let x = convert::wrap_near(place.x, self.cx.width) as usize;
            let y = convert::wrap_near(place.y, self.cx.height) as usize;
            let pixel = &mut self.pixels[y * self.cx.width as usize + x];
            let grows = *pixel != BLACK;
            if grows {
                *pixel = BLACK;
                crack.length += 1;
                drawn += 1;
            }
            grows
        });
        cracks.append(&mut born);
        self.cracks = cracks;
        drawn
    }

    /// A crack that goes off to the left or right of another one.
    fn branch(&mut self, crack: &Crack, place: Position) -> Crack {
        let quarter = std::f64::consts::FRAC_PI_2;
        let goes_left = self.draws.next_noise() > 0.0;
        self.draws.next_noise();
        let angle = crack.angle + if goes_left { quarter } else { -quarter };
        Crack { ray: Ray::new(place, angle), angle, length: 1 }
    }
}
