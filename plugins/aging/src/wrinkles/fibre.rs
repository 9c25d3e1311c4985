//! A muscle, prepared: where it is in an image of some proportions, and which part of a row it
//! covers.
//!
//! From A to B a fibre of length ℓ has n wrinkles across it. A place q lies t = (q-A)·(B-A)/ℓ² of
//! its length before the foot of the plumb line on it, and d away. Heights fade linearly (a, or
//! without kinks S(a)) up to d = R, half of the width; wrinkles along t become fewer there. Behind
//! A there is nothing; past B, wrinkles go on as arcs about B and fade with the angle to the line
//! abreast of B.
//!
//! Lengths are isotropic: horizontal coordinates are multiplied by the proportion of the image.

use std::ops::Range;

use ptlib_plugin::math;

use super::{
    arith::bulge,
    grammar::Muscle,
    kernels::{Line, Places, Shape, Style, Trace},
};

/// How much greater than exact the covered part is taken, in lengths of the fibre: far more than
/// the inner loops err, and far less than a pixel.
const SLACK: f64 = 1e-5;

/// A muscle, prepared.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fibre {
    from: [f64; 2],
    /// From its start to its end.
    across: [f64; 2],
    /// The same direction, of length 1.
    unit: [f64; 2],
    length: f64,
    /// Half of its width.
    radius: f64,
    /// The sine and the cosine of the angle up to which wrinkles go round the end, from the line
    /// abreast of it; none if they do not.
    cap: Option<[f64; 2]>,
    shape: Shape,
    /// The smallest and the largest coordinates of what it covers.
    pub(super) bounds: [[f64; 2]; 2],
}

/// Places of a row: the vertical coordinate, where the first one is, and how far they are apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row<'a> {
    pub(super) v: f64,
    pub(super) first: f64,
    pub(super) step: f64,
    pub(super) places: Places<'a>,
}

/// A range of horizontal distances.
type Span = [f64; 2];

impl Fibre {
    /// In an image that is `proportion` times as wide as high.
    pub(super) fn new(muscle: &Muscle, proportion: f64) -> Self {
        let isotropic = |[u, v]: [f64; 2]| [u * proportion, v];
        let [from, to] = [muscle.from, muscle.to].map(isotropic);
        let across = [to[0] - from[0], to[1] - from[1]];
        let length = (across[0] * across[0] + across[1] * across[1]).sqrt();
        let unit = across.map(|side| side / length);
        let radius = muscle.width * length;
        // The part of two right angles that the cap has on each side.
        let part = (muscle.max_angle - 1.0) / 2.0;
        let sine = |part: f64| f64::from(bulge(math::single(part)));
        let sides = [0, 1].map(|axis| radius * unit[1 - axis].abs());
        let bound = |sign: f64, pick: fn(f64, f64) -> f64| {
            [0, 1].map(|axis| {
                // The cap is a part of a disc about the end.
                let end = if part > 0.0 { radius } else { sides[axis] };
                pick(from[axis] + sign * sides[axis], to[axis] + sign * end)
            })
        };
        let wrinkles = muscle.wrinkles;
        Self {
            from,
            across,
            unit,
            length,
            radius,
            cap: (part > 0.0).then(|| [sine(part), sine(0.5 - part)]),
            shape: Shape {
                amplitude: math::single(muscle.amplitude),
                wrinkles: [muscle.low, 1.0 - muscle.low].map(|part| math::single(wrinkles * part)),
                narrow: math::single(1.0 / radius),
                steep: math::single((1.0 / (part * std::f64::consts::PI)).min(1e30)),
            },
            bounds: [bound(-1.0, f64::min), bound(1.0, f64::max)],
        }
    }

    /// The place at that part of the fibre.
    pub(super) fn at(&self, t: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.from[axis] + self.across[axis] * t)
    }

    /// Adds its heights to those of a row, from where it is shifted by `shift`. Returns how many
    /// places that looked at.
    #[inline]
    pub(super) fn add(
        &self,
        shift: [f64; 2],
        style: Style,
        row: &Row<'_>,
        sums: &mut [f32],
    ) -> usize {
        let from = [self.from[0] + shift[0], self.from[1] + shift[1]];
        let down = row.v - from[1];
        let span = self.side(down);
        let trace = self.trace(from, down, span);
        let side = row.covered(from[0], span, sums.len());
        let mut seen = side.len();
        if let Some(sums) = sums.get_mut(side.clone()) {
            trace.add_side(style, row.places.part(side), sums);
        }
        for cap in self.caps(from[0], down, row, sums.len()) {
            seen += cap.len();
            if let Some(sums) = sums.get_mut(cap.clone()) {
                trace.add_cap(style, row.places.part(cap), sums);
            }
        }
        seen
    }

    /// The muscle in a row `down` from its start, where it covers that span.
    #[inline]
    fn trace(&self, from: [f64; 2], down: f64, [least, most]: Span) -> Trace {
        let Self { across, unit: [x, y], length, radius, shape, .. } = *self;
        let line = |slope: f64, height: f64| Line {
            slope: math::single(slope),
            height: math::single(height),
        };
        // Distances from the middle of what is covered are short, and so are their errors.
        let middle = if least < most { f64::midpoint(least, most) } else { 0.0 };
        // From the end.
        let [end, below] = [from[0] + across[0], down - across[1]];
        Trace {
            shape,
            middle: in_two(from[0] + middle),
            along: line(x / length, (down * y + middle * x) / length),
            aside: line(-y / radius, (down * x - middle * y) / radius),
            to: in_two(end),
            past: line(x, below * y),
            squared: math::single(below * below),
        }
    }

    /// Where a row `down` from the start lies abreast of the fibre.
    #[inline]
    fn side(&self, down: f64) -> Span {
        let Self { unit: [x, y], length, radius, .. } = *self;
        let along = cut(ALL, [x, down * y], [-SLACK * length, (1.0 + SLACK) * length]);
        cut(along, [-y, down * x], [-radius, radius])
    }

    /// The parts of a row `down` from the start that the cap covers: one on each side of the
    /// fibre's line, which may be one.
    #[inline]
    fn caps(
        &self,
        from: f64,
        down: f64,
        row: &Row<'_>,
        len: usize,
    ) -> impl Iterator<Item = Range<usize>> {
        let Self { across, unit: [x, y], length, radius, cap, .. } = *self;
        let [end, below] = [from + across[0], down - across[1]];
        let chord = radius * radius - below * below;
        let cap = cap.filter(|_| chord > 0.0);
        let [mut left, mut right] = [0..0, 0..0];
        if let Some([sine, cosine]) = cap {
            let half = chord.sqrt();
            let slack = SLACK * length;
            let past = cut([-half, half], [x, below * y], [-slack, f64::INFINITY]);
            // Places whose angle is small enough, with the line's sides taken for themselves.
            let wedge = |side: f64| {
                let slope = side * sine * -y - cosine * x;
                let height = below * (side * sine * x - cosine * y);
                row.covered(end, cut(past, [slope, height], [-slack, f64::INFINITY]), len)
            };
            [left, right] = [wedge(-1.0), wedge(1.0)];
            if right.start < left.start {
                std::mem::swap(&mut left, &mut right);
            }
            if right.start <= left.end && !right.is_empty() {
                // Each place once.
                left = left.start..left.end.max(right.end);
                right = 0..0;
            }
        }
        [left, right].into_iter().filter(|part| !part.is_empty())
    }
}

impl Row<'_> {
    /// The places of a span of distances from `origin`, and one more on each side.
    #[inline]
    fn covered(&self, origin: f64, [least, most]: Span, len: usize) -> Range<usize> {
        if least > most {
            return 0..0;
        }
        let [start, end] = [least - self.step, most + self.step]
            .map(|distance| (distance + (origin - self.first)) / self.step);
        let end = place(end + 1.0, len);
        place(start, len).min(end)..end
    }
}

/// All horizontal distances.
const ALL: Span = [f64::NEG_INFINITY, f64::INFINITY];

/// The part of a span where slope·x + height lies in a range; if there is none, its start lies
/// behind its end.
#[inline]
fn cut(span: Span, [slope, height]: [f64; 2], [least, most]: Span) -> Span {
    if slope.abs() < 1e-30 {
        let is_inside = least <= height && height <= most;
        return if is_inside { span } else { [1.0, 0.0] };
    }
    let [one, other] = [(least - height) / slope, (most - height) / slope];
    let (start, end) = if slope > 0.0 { (one, other) } else { (other, one) };
    [span[0].max(start), span[1].min(end)]
}

/// The index of a place, at most `len`.
#[inline]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "made 0 to len before")]
fn place(at: f64, len: usize) -> usize {
    at.clamp(0.0, len as f64) as usize
}

/// A coordinate in two parts of single precision.
#[inline]
pub(super) fn in_two(x: f64) -> [f32; 2] {
    let near = math::single(x);
    [near, math::single(x - f64::from(near))]
}
