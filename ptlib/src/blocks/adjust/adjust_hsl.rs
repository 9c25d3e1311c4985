//! Hue, saturation and lightness changed.
//!
//! Specification 2.13. Everything is computed in double precision, step by step as written there:
//! which levels fall one short of a whole number depends on it, even at all-zero parameters (Q).
//!
//! Of hues below 0 and from 1 on, PT Designer made red and dark grey (BUG). Here the hue of a
//! colour is always 0..1 and goes round. Only where a negative `hue` leads below 0 does 8-bit
//! precision stop at red, as a vector of section 5 of the specification has it; in float
//! precision the hue goes round there too.

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What is added to the hue, in turns around the colour circle: 1/3 makes red green.
        hue: float [hard -1000.0..=1000.0 soft -1.0..=1.0 unit "turns"] = 0.0;
        /// What is added to the saturation: -1 makes everything grey, 1 every colour pure.
        saturation: float [hard -1.0..=1.0 soft -1.0..=1.0] = 0.0;
        /// What is added to the lightness: -1 makes everything black, 1 white.
        lightness: float [hard -1.0..=1.0 soft -1.0..=1.0] = 0.0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<AdjustHsl>(About {
    id: "adjust hsl",
    summary: "Turns the hue of a picture, and changes its saturation and lightness.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Colour)],
    ..About::DEFAULT
});

struct AdjustHsl {
    hue: f64,
    saturation: f64,
    lightness: f64,
}

impl PointBlock for AdjustHsl {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, _: &PrepareContext<'_>) -> Result<Self, Error> {
        let Params { hue, saturation, lightness } = *params;
        Ok(Self { hue, saturation, lightness })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let value = |value: f32| {
            if L::EIGHT_BIT { f64::from(levels::to_level(value)) / 255.0 } else { f64::from(value) }
        };
        let [red, green, blue] = inputs.rgb(IMAGE);
        let [out_red, out_green, out_blue] = out.rgb();
        for i in 0..out_red.len() {
            let hsl = hsl_of([value(red[i]), value(green[i]), value(blue[i])]);
            [out_red[i], out_green[i], out_blue[i]] =
                rgb_of(self.adjust::<L>(hsl)).map(stored::<L>);
        }
    }
}

impl AdjustHsl {
    #[inline(always)]
    fn adjust<L: Levels>(&self, [hue, saturation, lightness]: [f64; 3]) -> [f64; 3] {
        let hue = hue + self.hue;
        let hue = if L::EIGHT_BIT && hue < 0.0 { 0.0 } else { on_circle(hue) };
        let within = |value: f64| value.clamp(0.0, 1.0);
        [hue, within(saturation + self.saturation), within(lightness + self.lightness)]
    }
}

/// `hue` without its whole turns: 0 ≤ result < 1.
#[inline(always)]
fn on_circle(hue: f64) -> f64 {
    let part = hue - hue.floor();
    if part < 1.0 { part } else { 0.0 }
}

/// Hue 0..1, saturation and lightness of a colour.
#[inline(always)]
fn hsl_of([red, green, blue]: [f64; 3]) -> [f64; 3] {
    let greatest = red.max(green).max(blue);
    let least = red.min(green).min(blue);
    let span = greatest - least;
    let lightness = f64::midpoint(greatest, least);
    if span == 0.0 {
        return [0.0, 0.0, lightness];
    }
    let sixths = if red > green && red >= blue {
        (green - blue) / span
    } else if blue > red.max(green) {
        (red - green) / span + 4.0
    } else {
        (blue - red) / span + 2.0
    };
    // BUG of the specification, fixed: a colour between red and blue has a negative hue.
    [on_circle(sixths / 6.0), span / (1.0 - (2.0 * lightness - 1.0).abs()), lightness]
}

/// The colour of a hue 0 ≤ hue < 1, a saturation and a lightness.
#[inline(always)]
fn rgb_of([hue, saturation, lightness]: [f64; 3]) -> [f64; 3] {
    let chroma = (1.0 - (2.0 * lightness - 1.0).abs()) * saturation;
    let sixths = 6.0 * hue;
    let in_third = sixths - 2.0 * (sixths * 0.5).floor();
    let second = chroma * (1.0 - (in_third - 1.0).abs());
    let least = lightness - chroma / 2.0;
    let red = if !(1.0..5.0).contains(&sixths) {
        chroma
    } else if !(2.0..4.0).contains(&sixths) {
        second
    } else {
        0.0
    };
    let green = if (1.0..3.0).contains(&sixths) {
        chroma
    } else if sixths < 4.0 {
        second
    } else {
        0.0
    };
    let blue = if (3.0..5.0).contains(&sixths) {
        chroma
    } else if sixths >= 2.0 {
        second
    } else {
        0.0
    };
    [red + least, green + least, blue + least]
}

/// A value as it is stored: truncated without slack, so that what falls short of a level by
/// rounding becomes the one below, as specified.
#[inline(always)]
fn stored<L: Levels>(value: f64) -> f32 {
    if L::EIGHT_BIT {
        levels::from_level(convert::level(convert::truncate64_to_i32(value * 255.0)))
    } else {
        convert::single(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(color: [u8; 3], changes: [f64; 3]) -> Trial {
        let planes = color.map(|level| [level]);
        Trial::of(&BLOCK)
            .size(1, 1)
            .input(IMAGE, image_of_levels(1, &planes.each_ref().map(<[u8; 1]>::as_slice)))
            .float("hue", changes[0])
            .float("saturation", changes[1])
            .float("lightness", changes[2])
    }

    fn adjusted(color: [u8; 3], changes: [f64; 3]) -> [u8; 3] {
        let trial = trial(color, changes);
        [0, 1, 2].map(|channel| trial.levels(channel)[0])
    }

    fn adjusted_float(color: [u8; 3], changes: [f64; 3]) -> [u8; 3] {
        let image = trial(color, changes).image();
        [0, 1, 2].map(|channel| convert::to_byte(image.channel(channel)[0]))
    }

    #[test]
    fn follows_the_vectors_of_the_specification() {
        let turned = [0.2, 0.0, 0.0];
        assert_eq!(adjusted([200, 100, 50], turned), [120, 200, 49]);
        assert_eq!(adjusted([50, 100, 200], turned), [180, 49, 200]);
        let brighter = [-0.1, 0.3, 0.1];
        assert_eq!(adjusted([200, 100, 50], brighter), [244, 56, 56]);
        assert_eq!(adjusted([10, 250, 90], brighter), [109, 255, 55]);
        assert_eq!(adjusted([200, 100, 50], [0.0; 3]), [200, 99, 49]);
    }

    #[test]
    fn hues_between_blue_and_red_stay() {
        let [red, green, blue] = adjusted([255, 0, 128], [0.0; 3]);
        assert!(red == 255 && green == 0 && (127..=128).contains(&blue), "{blue}");
        assert_eq!(adjusted_float([255, 0, 128], [0.0; 3]), [255, 0, 128]);
    }

    #[test]
    fn hues_go_round() {
        // Magenta and a third more is yellow; red and a whole turn is red.
        assert_eq!(adjusted_float([255, 0, 255], [1.0 / 3.0, 0.0, 0.0]), [255, 255, 0]);
        assert_eq!(adjusted([255, 0, 0], [1.0, 0.0, 0.0]), [255, 0, 0]);
        for turns in [-1000.0, -3.0, 7.0] {
            assert_eq!(adjusted_float([30, 200, 90], [turns, 0.0, 0.0]), [30, 200, 90]);
        }
        assert_eq!(adjusted_float([255, 0, 0], [-1.0 / 6.0, 0.0, 0.0]), [255, 0, 255]);
    }

    #[test]
    fn zero_changes_nothing_in_float_precision() {
        for color in [[0, 0, 0], [255; 3], [1, 2, 3], [3, 1, 2], [2, 3, 1], [255, 254, 0]] {
            assert_eq!(adjusted_float(color, [0.0; 3]), color);
        }
    }

    #[test]
    fn ends_of_the_ranges() {
        assert_eq!(adjusted([200, 100, 50], [0.0, 0.0, 1.0]), [255; 3]);
        assert_eq!(adjusted([200, 100, 50], [0.0, 0.0, -1.0]), [0; 3]);
        assert_eq!(adjusted([200, 100, 50], [0.0, -1.0, 0.0]), [125; 3]);
        assert_eq!(adjusted([200, 100, 50], [0.0, 1.0, 0.0])[2], 0);
    }

    #[test]
    fn same_bits_however_rows_are_asked_for() {
        let plane = |step: u32| -> Vec<u8> {
            (0..200).map(|i: u32| (i * i * step % 256).to_le_bytes()[0]).collect()
        };
        let planes = [plane(1), plane(7), plane(3)];
        let trial = Trial::of(&BLOCK)
            .size(50, 4)
            .input(IMAGE, image_of_levels(50, &planes.each_ref().map(Vec::as_slice)))
            .float("hue", 0.3)
            .float("saturation", 0.2);
        trial.clone().eight_bit().assert_same_bits();
        trial.assert_same_bits();
    }
}
