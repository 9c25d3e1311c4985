//! A white picture that lines are drawn on: the line styles of specification 2.45.
//!
//! [`plain`] draws straight lines, [`spray`] those of particles; here are the styles that are made
//! of them. The picture is kept in levels 0..255 and wraps around.
//!
//! What a text makes the turtle draw has a limit, counted in pixels: a short text can ask for lines
//! of billions of pixels.

mod plain;
mod spray;
mod steering;

use std::f64::consts::{FRAC_PI_2, PI};

pub(super) use spray::Spray;

use super::walk::{Line, Pen, Style};
use crate::block::prelude::*;

/// Pixels to draw for each symbol that a text may have: a line of a usual length, and wide ones
/// where a text is shorter than it may be.
const PIXELS_PER_SYMBOL: u64 = 1024;

/// Pixels between two questions whether to go on.
const PIXELS_PER_CHECK: u64 = 1 << 18;

/// Points of a zig-zag or a wave behind its start.
const POINTS: u8 = 19;

/// The picture.
pub(super) struct Canvas<'a> {
    /// Red, green, blue; in levels.
    planes: [&'a mut [f32]; 3],
    width: u32,
    height: u32,
    effort: Effort<'a>,
    spray: Spray,
}

/// What has been drawn.
struct Effort<'a> {
    cx: &'a Context<'a>,
    pixels: u64,
    next_check: u64,
}

impl Effort<'_> {
    /// Counts pixels.
    fn spend(&mut self, pixels: u64) -> Result<(), Error> {
        self.pixels = self.pixels.saturating_add(pixels);
        if self.pixels < self.next_check {
            return Ok(());
        }
        self.next_check = self.pixels.saturating_add(PIXELS_PER_CHECK);
        self.cx.check()?;
        let limit = self.cx.max_text_symbols().saturating_mul(PIXELS_PER_SYMBOL);
        if self.pixels <= limit {
            return Ok(());
        }
        let message = format!("the turtle draws more than {limit} pixels");
        Err(Error::new(ErrorKind::Limit, message).with_hint(
            "the limit is a multiple of that of the symbols of a text, which the caller can raise: \
             `Limits` in `EngineOptions`",
        ))
    }
}

impl<'a> Canvas<'a> {
    /// The picture in these planes, which have the size of the context. 255 is white.
    pub(super) fn new(planes: [&'a mut [f32]; 3], spray: Spray, cx: &'a Context<'a>) -> Self {
        let effort = Effort { cx, pixels: 0, next_check: 0 };
        Self { planes, width: cx.width, height: cx.height, effort, spray }
    }

    /// Draws a line.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`], [`ErrorKind::Cancelled`] or [`ErrorKind::NoMemory`].
    pub(super) fn draw<L: Levels>(&mut self, line: &Line) -> Result<(), Error> {
        let Line { from, to, pen } = line;
        match pen.style {
            Style::Plain => self.plain(*from, *to, pen),
            Style::ZigZag => self.zig_zag(line),
            Style::Wave => self.wave(line),
            Style::Arrow => self.arrow(line),
            Style::Double => self.double(line),
            Style::Particles => self.particles::<L>(line),
        }
    }

    fn zig_zag(&mut self, line: &Line) -> Result<(), Error> {
        let segment = ray::Segment::new(line.from, line.to);
        let most = convert::truncate64(0.05 * number(segment.count));
        self.pieces(line, |i| {
            let mut point = segment.ray.at(along(&segment, i));
            if i < POINTS {
                // The same draws for every line (specification, appendix A).
                let mut draws = elias::Draws::from_index(2 * i32::from(i));
                point.x += draws.next_integer(-most, most);
                point.y += draws.next_integer(-most, most);
            }
            point
        })
    }

    fn wave(&mut self, line: &Line) -> Result<(), Error> {
        let segment = ray::Segment::new(line.from, line.to);
        self.pieces(line, |i| {
            let point = segment.ray.at(along(&segment, i));
            let phase = 0.2 * PI * f64::from(i + 1);
            let aside = 0.1 * number(segment.count) * elementary::sin64(phase);
            ray::Ray::new(point, segment.angle - FRAC_PI_2).at(convert::truncate64(aside))
        })
    }

    /// Plain lines from a line's start through points 1..=[`POINTS`].
    fn pieces(&mut self, line: &Line, point: impl Fn(u8) -> ray::Position) -> Result<(), Error> {
        let mut from = line.from;
        for i in 1..=POINTS {
            let to = point(i);
            self.plain(from, to, &line.pen)?;
            from = to;
        }
        Ok(())
    }

    fn arrow(&mut self, line: &Line) -> Result<(), Error> {
        let Line { from, to, pen } = *line;
        self.plain(from, to, &pen)?;
        let segment = ray::Segment::new(from, to);
        if segment.count % (pen.gap + 1) != 0 {
            // Its last pixel is left out, and with it the head.
            return Ok(());
        }
        let tip = segment.ray.at(segment.count - 1);
        let length = 0.3 * length(line);
        for turn in [2.8, -2.8] {
            self.plain(tip, tip.jump(length, segment.angle + turn), &pen)?;
        }
        Ok(())
    }

    fn double(&mut self, line: &Line) -> Result<(), Error> {
        let Line { from, to, pen } = *line;
        let angle = ray::Segment::new(from, to).angle + FRAC_PI_2;
        let aside = ray::Position::default().jump(number(2 * pen.width + 1), angle);
        for side in [1, -1] {
            let moved = |position: ray::Position| {
                ray::Position::new(position.x + side * aside.x, position.y + side * aside.y)
            };
            self.plain(moved(from), moved(to), &pen)?;
        }
        Ok(())
    }

    fn plain(&mut self, from: ray::Position, to: ray::Position, pen: &Pen) -> Result<(), Error> {
        plain::draw(self, &ray::Segment::new(from, to), pen)
    }

    fn particles<L: Levels>(&mut self, line: &Line) -> Result<(), Error> {
        let Self { planes, spray, effort, .. } = self;
        spray.draw::<L>(planes, line, effort)
    }
}

/// How many pixels along a line point number `i` of a zig-zag or a wave lies. The last one lies
/// one pixel past the end.
fn along(segment: &ray::Segment, i: u8) -> i64 {
    if i == POINTS {
        return segment.count;
    }
    convert::truncate64(0.05 * number(segment.count) * f64::from(i + 1))
}

/// The length of a line in pixels, as the crow flies.
fn length(line: &Line) -> f64 {
    let (across, down) = (number(line.to.x - line.from.x), number(line.to.y - line.from.y));
    (across * across + down * down).sqrt()
}

#[expect(clippy::cast_precision_loss, reason = "distances and widths are below 2⁵²")]
fn number(pixels: i64) -> f64 {
    pixels as f64
}
