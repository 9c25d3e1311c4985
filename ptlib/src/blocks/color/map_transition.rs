//! Colours of a transition instead of grey levels.
//!
//! Specification 2.40 and 2.43. The colours of a transition lie at whole levels k/255, with
//! straight lines between them; so a table of the 256 levels holds all of it, and in float
//! precision, values between two levels lie on the straight line between their colours.

use crate::block::prelude::*;

const IMAGE: usize = 0;
const TRANSITION: usize = 1;

params! {
    /// Parameters of [`BLOCK`].
    Params {}
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<MapTransition>(About {
    id: "map transition",
    summary: "Gives each pixel the colour that a transition has at its red channel.",
    inputs: &[input("image", Kind::Image), input("transition", Kind::Gradient)],
    outputs: &[output("image", Planes::Colour)],
    ..About::DEFAULT
});

struct MapTransition {
    /// Red, green and blue.
    channels: Box<[Channel; 3]>,
}

/// One channel of the transition, by level.
struct Channel {
    values: [f32; 256],
    /// From each level to the next one.
    steps: [f32; 256],
}

impl PointBlock for MapTransition {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let gradient = cx.gradient(TRANSITION)?;
        let colors: [_; 256] = std::array::from_fn(|level| {
            let level = u8::try_from(level).unwrap_or(u8::MAX);
            gradient.color_at(levels::from_level(f32::from(level))).map(L::store)
        });
        let channel = |channel: usize| Channel {
            values: colors.map(|color| color[channel]),
            steps: std::array::from_fn(|i| colors[(i + 1).min(255)][channel] - colors[i][channel]),
        };
        Ok(Self { channels: Box::new([0, 1, 2].map(channel)) })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let image = inputs.channel(IMAGE, 0);
        for (channel, out) in self.channels.iter().zip(out.rgb()) {
            for (out, value) in out.iter_mut().zip(image) {
                *out = channel.at::<L>(value * 255.0);
            }
        }
    }
}

impl Channel {
    /// The value at `position` = 0..255.
    #[inline(always)]
    fn at<L: Levels>(&self, position: f32) -> f32 {
        if L::EIGHT_BIT {
            // A level, but for rounding.
            return self.values[convert::truncate_masked(position + 0.5, 255)];
        }
        let below = position.trunc();
        let index = convert::truncate_masked(below, 255);
        self.values[index] + self.steps[index] * (position - below)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn gradient() -> Gradient {
        let stop = |position: f32, red: f32, green: f32, blue: f32| GradientStop {
            position: levels::from_level(position),
            color: [red, green, blue].map(levels::from_level),
        };
        Gradient::new(vec![stop(50.0, 0.0, 100.0, 7.0), stop(241.0, 255.0, 40.0, 7.0)])
    }

    #[test]
    fn the_table_holds_the_whole_transition() {
        let mut image = image_of_levels(1024, &[&[0; 1024]]);
        for plane in image.planes_mut() {
            (0..1024_u16).zip(plane).for_each(|(i, value)| *value = f32::from(i) / 1023.0);
        }
        let trial = Trial::of(&BLOCK)
            .size(1024, 1)
            .input(IMAGE, image.clone())
            .input(TRANSITION, gradient());
        let mapped = trial.image();
        for (i, value) in image.channel(0).iter().enumerate() {
            let expected = gradient().color_at(*value);
            for (channel, expected) in expected.iter().enumerate() {
                assert!((mapped.channel(channel)[i] - expected).abs() < 1e-5, "at {value}");
            }
        }
        trial.assert_same_bits();
    }

    #[test]
    fn eight_bit_colours_are_truncated() {
        let levels: Vec<u8> = (0..=255).collect();
        let trial = Trial::of(&BLOCK)
            .size(256, 1)
            .input(IMAGE, image_of_levels(256, &[&levels, &[0; 256], &[0; 256]]))
            .input(TRANSITION, gradient());
        let expected = levels.iter().map(|level| {
            let along = (u32::from(*level).clamp(50, 241) - 50) * 255 / 191;
            u8::try_from(along).unwrap()
        });
        assert_eq!(trial.levels(0), expected.collect::<Vec<_>>());
        assert_eq!(trial.levels(2), [7; 256]);
    }
}
