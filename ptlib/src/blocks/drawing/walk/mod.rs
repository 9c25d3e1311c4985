//! A turtle that follows the commands of a text: specification 2.45 without the drawing.
//!
//! [`Walk`] is the turtle's state, and finds one [`Line`] after the other. What a line looks like,
//! or whether only its end matters, is the business of whoever asks for it.
//!
//! Positions are whole pixels without bounds. Steps fit 32 bits, and a text has less than 2³²
//! commands, so positions fit 64 bits.

mod commands;

use std::f64::consts::PI;

use commands::{Command, Commands};

use crate::block::prelude::*;

/// Brackets that may be open at a time. Plants have tens; each takes the memory of a state.
const MAX_DEPTH: usize = 1 << 20;

/// Bytes of text between two questions whether to go on.
const BYTES_PER_CHECK: usize = 1 << 14;

/// How lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::blocks) enum Style {
    /// As one straight line.
    Plain,
    /// In 19 pieces that go to and fro.
    ZigZag,
    /// As two periods of a wave.
    Wave,
    /// With a head at its end.
    Arrow,
    /// As two lines side by side.
    Double,
    /// As particles that start at its beginning.
    Particles,
}

/// What lines are drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::blocks) struct Pen {
    /// Red, green, blue.
    pub(in crate::blocks) color: [u8; 3],
    /// In pixels, at least 1.
    pub(in crate::blocks) width: i64,
    pub(in crate::blocks) style: Style,
    /// Pixels left out between two that are drawn, at least 0.
    pub(in crate::blocks) gap: i64,
}

/// A line to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::blocks) struct Line {
    pub(in crate::blocks) from: ray::Position,
    pub(in crate::blocks) to: ray::Position,
    pub(in crate::blocks) pen: Pen,
}

/// Where a turtle starts.
#[derive(Debug, Clone, Copy)]
pub(in crate::blocks) struct Start {
    /// From the left edge; 1 is the image's width.
    pub(in crate::blocks) x: f64,
    /// From the top edge; 1 is the image's height.
    pub(in crate::blocks) y: f64,
    /// In degrees, counter-clockwise from the right.
    pub(in crate::blocks) angle: i32,
}

/// What brackets keep.
#[derive(Debug, Clone, Copy)]
struct State {
    position: ray::Position,
    /// In degrees, 0..360.
    angle: u16,
    /// In pixels, 0..2³¹.
    step: i64,
    pen: Pen,
}

/// A turtle on its way.
#[derive(Debug)]
pub(in crate::blocks) struct Walk<'a> {
    commands: Commands<'a>,
    /// Width of the image, which lengths are relative to.
    width: i64,
    state: State,
    stack: Vec<State>,
    /// Cosine and sine of each degree.
    directions: Vec<[f64; 2]>,
    next_check: usize,
}

impl<'a> Walk<'a> {
    /// A turtle that is about to follow a text.
    pub(in crate::blocks) fn new(text: &'a str, start: Start, cx: &Context<'_>) -> Self {
        let width = i64::from(cx.width);
        let direction = |degrees: u16| {
            let angle = f64::from(degrees) * PI / 180.0;
            [elementary::cos64(angle), elementary::sin64(angle)]
        };
        let state = State {
            position: ray::Position::new(
                convert::truncate64(start.x * f64::from(cx.width)),
                convert::truncate64(start.y * f64::from(cx.height)),
            ),
            angle: degrees(i64::from(start.angle)),
            step: width / 5,
            pen: Pen { color: [0; 3], width: (width / 512).max(1), style: Style::Plain, gap: 0 },
        };
        Self {
            commands: Commands::new(text),
            width,
            state,
            stack: Vec::new(),
            directions: (0..360).map(direction).collect(),
            next_check: 0,
        }
    }

    /// Where the turtle is.
    pub(in crate::blocks) fn position(&self) -> ray::Position {
        self.state.position
    }

    /// How much of the text it has followed, 0..1.
    pub(in crate::blocks) fn fraction_done(&self) -> f64 {
        self.commands.fraction_done()
    }

    /// Follows the text to the next line.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`] for too many open brackets, or [`ErrorKind::Cancelled`].
    pub(in crate::blocks) fn next_line(&mut self, cx: &Context<'_>) -> Result<Option<Line>, Error> {
        while let Some(command) = self.commands.next() {
            if self.commands.place() >= self.next_check {
                self.next_check = self.commands.place() + BYTES_PER_CHECK;
                cx.check()?;
            }
            match command.letter {
                b'[' if self.stack.len() >= MAX_DEPTH => {
                    let message =
                        format!("the text opens more than {MAX_DEPTH} brackets at a time");
                    return Err(Error::new(ErrorKind::Limit, message));
                }
                b'[' => self.stack.push(self.state),
                b']' => self.state = self.stack.pop().unwrap_or(self.state),
                b'D' => {
                    let (from, pen) = (self.state.position, self.state.pen);
                    self.step_forward();
                    return Ok(Some(Line { from, to: self.state.position, pen }));
                }
                b'G' => self.step_forward(),
                _ => self.obey(&command),
            }
        }
        Ok(None)
    }

    fn step_forward(&mut self) {
        let State { position, angle, step, .. } = &mut self.state;
        let [cosine, sine] = self.directions[usize::from(*angle)];
        #[expect(clippy::cast_precision_loss, reason = "steps are below 2³²")]
        let step = *step as f64;
        position.x += convert::truncate64(step * cosine);
        position.y -= convert::truncate64(step * sine);
    }

    /// Follows a command that changes the state and not the position. What is no command, or has
    /// too few values, changes nothing.
    fn obey(&mut self, command: &Command) {
        let Self { state, width, .. } = self;
        let (pen, width) = (&mut state.pen, *width);
        let longest = i64::from(i32::MAX);
        match (command.letter, command.values()) {
            (b'A', [x, ..]) => state.angle = degrees(*x),
            (b'L', [x, ..]) => state.angle = degrees(i64::from(state.angle) + x),
            (b'R', [x, ..]) => state.angle = degrees(i64::from(state.angle) - x),
            (b'P', [x, ..]) => state.step = (state.step * x.max(&0) / 100).min(longest),
            (b'B', [x, ..]) => state.step = (width * x / 1000).clamp(0, longest),
            (b'I', [x, ..]) => state.step = (state.step + x).clamp(0, longest),
            (b'M', [x, ..]) => state.step = *x.max(&0),
            (b'W', [x, ..]) => pen.width = (width * x.abs() / 1000).max(1),
            (b'F', [x, ..]) => pen.width = *x.max(&1),
            (b'C', [r, g, b, ..]) => {
                pen.color = [r, g, b].map(|x| x.clamp(&0, &255).to_le_bytes()[0]);
            }
            (b'S', [x, y, ..]) => (pen.style, pen.gap) = (style(*x, pen.style), y * width / 1000),
            // BUG: the original's gap is y · W pixels → y.
            (b'T', [x, y, ..]) => (pen.style, pen.gap) = (style(*x, pen.style), *y),
            _ => {}
        }
        pen.gap = pen.gap.max(0);
    }
}

/// An angle in 0..360 degrees.
fn degrees(angle: i64) -> u16 {
    u16::try_from(angle.rem_euclid(360)).unwrap_or(0)
}

/// The style of that number; `present` if there is none.
fn style(number: i64, present: Style) -> Style {
    match number {
        0 => Style::Plain,
        1 => Style::ZigZag,
        2 => Style::Wave,
        3 => Style::Arrow,
        4 => Style::Double,
        5 => Style::Particles,
        _ => present,
    }
}
