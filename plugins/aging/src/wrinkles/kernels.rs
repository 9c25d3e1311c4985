//! The inner loops: what a muscle adds to a row of places. They have no branches, so that they
//! vectorise.
//!
//! A place counts if it lies abreast of the fibre (the *side*) or past its end (the *cap*). Both
//! loops may be run over more places than that: they decide by the same number, so that each place
//! gets a height from one of them and 0 from the other.

use super::arith::{asin, at_most_one, bulge, positive, smooth};

/// Horizontal coordinates of places, in two parts of single precision: the nearest number, and what
/// it lacks. A difference of two of them is as exact as if it were near 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places<'a> {
    pub(super) near: &'a [f32],
    pub(super) rest: &'a [f32],
}

impl<'a> Places<'a> {
    /// Some of them.
    #[inline]
    pub(super) fn part(&self, range: std::ops::Range<usize>) -> Self {
        let part = |all: &'a [f32]| all.get(range.clone()).unwrap_or_default();
        Self { near: part(self.near), rest: part(self.rest) }
    }
}

/// How heights lie across a wrinkle, and how they fade.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    /// Round below and above, not |sin|.
    pub(super) is_wave: bool,
    /// Heights fade without kinks.
    pub(super) is_smooth: bool,
}

/// A linear function of a horizontal distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) slope: f32,
    pub(super) height: f32,
}

impl Line {
    #[inline(always)]
    fn at(self, x: f32) -> f32 {
        x * self.slope + self.height
    }
}

/// What a muscle is in all rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    pub(super) amplitude: f32,
    /// Wrinkles along the fibre at the rim, and how many more there are on the fibre.
    pub(super) wrinkles: [f32; 2],
    /// 1 over half of the width.
    pub(super) narrow: f32,
    /// 1 over the angle of the cap.
    pub(super) steep: f32,
}

/// A muscle in one row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trace {
    pub(super) shape: Shape,
    /// The horizontal coordinate of the middle of what it covers, as that of places.
    pub(super) middle: [f32; 2],
    /// The part of the fibre that lies before a place, over the distance from the middle.
    pub(super) along: Line,
    /// The distance from the fibre, in halves of the width, over the same.
    pub(super) aside: Line,
    /// The horizontal coordinate of its end.
    pub(super) to: [f32; 2],
    /// How far a place lies past the end, over the horizontal distance from the end.
    pub(super) past: Line,
    /// The square of the vertical distance from the end.
    pub(super) squared: f32,
}

impl Trace {
    /// Adds the heights of places abreast of the fibre.
    #[inline]
    pub(super) fn add_side(&self, style: Style, places: Places<'_>, sums: &mut [f32]) {
        match (style.is_wave, style.is_smooth) {
            (false, false) => self.side::<false, false>(places, sums),
            (false, true) => self.side::<false, true>(places, sums),
            (true, false) => self.side::<true, false>(places, sums),
            (true, true) => self.side::<true, true>(places, sums),
        }
    }

    /// Adds the heights of places past the end.
    #[inline]
    pub(super) fn add_cap(&self, style: Style, places: Places<'_>, sums: &mut [f32]) {
        match (style.is_wave, style.is_smooth) {
            (false, false) => self.cap::<false, false>(places, sums),
            (false, true) => self.cap::<false, true>(places, sums),
            (true, false) => self.cap::<true, false>(places, sums),
            (true, true) => self.cap::<true, true>(places, sums),
        }
    }

    fn side<const WAVE: bool, const SMOOTH: bool>(&self, places: Places<'_>, sums: &mut [f32]) {
        let Self { shape, middle, along, aside, .. } = *self;
        let places = places.near.iter().zip(places.rest);
        for (sum, (&near, &rest)) in sums.iter_mut().zip(places) {
            let x = (near - middle[0]) + (rest - middle[1]);
            let t = along.at(x);
            let fading = positive(1.0 - aside.at(x).abs());
            let soft = smooth(fading);
            let height = profile::<WAVE>(shape.frequency(soft) * t);
            let height = height * if SMOOTH { soft } else { fading };
            let is_abreast = (0.0..=1.0).contains(&t);
            *sum += if is_abreast { height * shape.amplitude } else { 0.0 };
        }
    }

    fn cap<const WAVE: bool, const SMOOTH: bool>(&self, places: Places<'_>, sums: &mut [f32]) {
        let Self { shape, middle, along, to, past, squared, .. } = *self;
        let places = places.near.iter().zip(places.rest);
        for (sum, (&near, &rest)) in sums.iter_mut().zip(places) {
            let is_past = along.at((near - middle[0]) + (rest - middle[1])) > 1.0;
            let x = (near - to[0]) + (rest - to[1]);
            let distance = (x * x + squared).sqrt();
            let fading = positive(1.0 - distance * shape.narrow);
            let soft = smooth(fading);
            // In the very end there is no direction: any angle will do, for it is continuous.
            let distance = if distance > f32::MIN_POSITIVE { distance } else { f32::MIN_POSITIVE };
            let angle = asin(at_most_one(positive(past.at(x)) / distance));
            let turning = positive(1.0 - angle * shape.steep);
            let height = profile::<WAVE>(shape.frequency(soft));
            let height = height * if SMOOTH { soft * smooth(turning) } else { fading * turning };
            *sum += if is_past { height * shape.amplitude } else { 0.0 };
        }
    }
}

impl Shape {
    /// Wrinkles along the fibre, where that much is left of its height.
    #[inline(always)]
    fn frequency(&self, soft: f32) -> f32 {
        self.wrinkles[0] + self.wrinkles[1] * soft
    }
}

/// The height across wrinkles, of period 1.
#[inline(always)]
fn profile<const WAVE: bool>(x: f32) -> f32 {
    let bulge = bulge(x);
    // ½ + ½ sin π(2x - ½) = sin² πx.
    if WAVE { bulge * bulge } else { bulge }
}
