//! A colour transition: colours along a line, for `map transition`.
//!
//! Specification 2.43.

// Pictured: `data` `0 0 0 128;255 255 255 255`.
// Pictured: `data` `60 20 60 20;110 90 140 50;111 60 40 20;170 230 190 120;255 255 250 230`.

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// The colours: `position red green blue;` for each, whole numbers 0..255, as in
        /// `0 0 0 128; 255 255 255 255;` (navy to white). Between two positions colours change
        /// evenly, outside of all they stay. Without any, everything is grey.
        data: text = "";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<ColorTransition>(About {
    id: "color transition",
    summary: "A line of colours that change evenly from one to the next.",
    outputs: &[output("transition", Planes::Colour).of_kind(Kind::Gradient)],
    ..About::DEFAULT
});

/// The most colours that count.
const MOST_STOPS: usize = 255;

struct ColorTransition;

impl WholeBlock for ColorTransition {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, _: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        Ok(vec![Gradient::new(stops(&params.data)).into()])
    }
}

/// The colours of a text, up to the first group that does not start with four whole numbers.
fn stops(data: &str) -> Vec<GradientStop> {
    let groups = data.split(';').map_while(|group| {
        let mut rest = group;
        let mut next = || {
            let (value, after) = leading_number(rest)?;
            rest = after;
            Some(levels::from_level(value))
        };
        let position = next()?;
        Some(GradientStop { position, color: [next()?, next()?, next()?] })
    });
    groups.take(MOST_STOPS).collect()
}

/// The whole number at the start of `text` after blanks, clamped to 0..255, and what follows it.
fn leading_number(text: &str) -> Option<(f32, &str)> {
    let text = text.trim_ascii_start();
    let is_negative = text.starts_with('-');
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    let (digits, rest) = digits.split_at(end);
    if digits.is_empty() {
        return None;
    }
    // More digits than a byte holds are a number above 255.
    let level = if is_negative { 0 } else { digits.parse().unwrap_or(255) };
    Some((f32::from(u8::try_from(level.min(255_u32)).unwrap_or(255)), rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels_of(data: &str) -> Vec<[f32; 4]> {
        let numbers = |stop: GradientStop| {
            let [red, green, blue] = stop.color;
            [stop.position, red, green, blue].map(levels::to_level)
        };
        stops(data).into_iter().map(numbers).collect()
    }

    #[test]
    fn reads_groups_of_four_numbers() {
        let expected = [[0.0, 1.0, 2.0, 3.0], [255.0, 4.0, 5.0, 6.0]];
        assert_eq!(levels_of("0 1 2 3;255 4 5 6;"), expected);
        assert_eq!(levels_of(" 0\t1 2\n3 ; 255 4 5 6"), expected);
    }

    #[test]
    fn stops_at_the_first_group_that_is_not_one() {
        assert_eq!(levels_of("9 1 2 3;;8 4 5 6"), [[9.0, 1.0, 2.0, 3.0]]);
        assert_eq!(levels_of("9 1 2 3;8 4 x 6;7 1 1 1"), [[9.0, 1.0, 2.0, 3.0]]);
        assert_eq!(levels_of("9 1 2 3 and more;8 4 5 6").len(), 2);
        assert!(levels_of("").is_empty());
        assert!(levels_of("1 2 3").is_empty());
    }

    #[test]
    fn numbers_are_clamped() {
        let expected = [[0.0, 255.0, 255.0, 7.0]];
        assert_eq!(levels_of("-5 300 99999999999999999999 +7"), expected);
    }

    #[test]
    fn only_so_many_stops_count() {
        assert_eq!(stops(&"1 2 3 4;".repeat(300)).len(), MOST_STOPS);
    }
}
