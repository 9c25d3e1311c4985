//! A turtle that draws what a text tells it.
//!
//! Specification 2.33 and 2.45. [`Walk`] is the turtle, [`Canvas`] what it draws on. Lines go on at
//! the opposite edge, so the result tiles.

use super::{
    canvas::{Canvas, Spray},
    walk::{Start, Walk},
};
use crate::block::prelude::*;

/// The text.
const TEXT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Where the turtle starts, from the left edge.
        initial_x "initial x": float [hard 0.0..=1.0 soft 0.0..=1.0 unit "of the width"] = 0.5;
        /// Where the turtle starts, from the top edge.
        initial_y "initial y": float [hard 0.0..=1.0 soft 0.0..=1.0 unit "of the height"] = 0.5;
        /// Where the turtle looks at first: 0 right, 90 up.
        initial_angle "initial angle": int [hard -36000..=36000 soft 0..=360 unit "degrees"] = 90;
        /// How much lines of particles (style 5) bend and spread; 0 makes them straight.
        noise_intensity "noise intensity": float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
        /// How many particles lines of particles (style 5) have: with 1, twice as many as with 0.
        particle_density "particle density": float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<Turtle>(About {
    id: "turtle",
    summary: "Draws what the text of an L-system tells a turtle to.",
    inputs: &[input("l-system", Kind::Text)],
    outputs: &[output("image", Planes::Colour)],
    in_pixels: "lengths, widths and gaps of the commands I, M, F and T",
    ..About::DEFAULT
});

/// Lines between two reports.
const LINES_PER_REPORT: usize = 64;

/// Pixels that one task converts.
const PIXELS: usize = 1 << 16;

struct Turtle;

impl WholeBlock for Turtle {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let start = Start { x: params.initial_x, y: params.initial_y, angle: params.initial_angle };
        let mut walk = Walk::new(cx.text(TEXT)?, start, cx);
        let mut image = cx.new_image(3)?;
        in_pieces(&mut image, cx, |pixels| pixels.fill(255.0))?;
        let mut planes = image.planes_mut();
        if let (Some(red), Some(green), Some(blue)) = (planes.next(), planes.next(), planes.next())
        {
            let spray = Spray::new(params.noise_intensity, params.particle_density);
            let mut canvas = Canvas::new([red, green, blue], spray, cx);
            let mut lines = 0_usize;
            while let Some(line) = walk.next_line(cx)? {
                canvas.draw::<L>(&line)?;
                lines += 1;
                if lines.is_multiple_of(LINES_PER_REPORT) {
                    cx.report(walk.fraction_done());
                }
            }
        }
        drop(planes);
        in_pieces(&mut image, cx, |pixels| {
            pixels.iter_mut().for_each(|level| *level = levels::from_level(*level));
        })?;
        Ok(vec![image.into()])
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        Spray::bytes_of(params.noise_intensity, width, height)
    }
}

/// Changes an image on all threads.
fn in_pieces(
    image: &mut Image,
    cx: &WholeContext<'_>,
    change: impl Fn(&mut [f32]) + Sync,
) -> Result<(), Error> {
    image.planes_mut().try_for_each(|plane| {
        cx.parallel_pieces(plane, PIXELS, |_, pixels| {
            change(pixels);
            Ok(())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    /// A turtle in the middle that looks to the right; steps are 0 until the text says otherwise.
    fn trial(text: &str, width: u32, height: u32) -> Trial {
        let text = std::string::String::from("M(0)") + text;
        Trial::of(&BLOCK).size(width, height).input(TEXT, text).int("initial angle", 0)
    }

    /// The picture in characters: `#` for black, `.` for white, `?` for anything else.
    fn picture(trial: &Trial, width: usize) -> Vec<String> {
        let [red, green, blue] = [0, 1, 2].map(|channel| trial.levels(channel));
        let pixels = red.iter().zip(green).zip(blue).map(|((r, g), b)| match (r, g, b) {
            (0, 0, 0) => '#',
            (255, 255, 255) => '.',
            _ => '?',
        });
        let pixels: Vec<char> = pixels.collect();
        pixels.chunks(width).map(|row| row.iter().collect()).collect()
    }

    fn draws(text: &str, expected: &[&str]) {
        let width = expected[0].len();
        let size = |side: usize| u32::try_from(side).unwrap();
        let trial = trial(text, size(width), size(expected.len()));
        assert_eq!(picture(&trial, width), expected, "{text}");
    }

    #[test]
    fn nothing_to_draw_is_white() {
        for text in ["", "G", "x(1)d(2)", "((((", "]]]", "M(9)GL(90)P(50)G"] {
            assert_eq!(trial(text, 5, 4).levels(1), [255; 20], "{text}");
        }
        // The step at the beginning is a fifth of the width.
        let trial = Trial::of(&BLOCK).size(10, 3).input(TEXT, std::string::String::from("D"));
        assert_eq!(picture(&trial, 10), [".....#....", ".....#....", ".....#...."]);
    }

    #[test]
    fn lines_have_both_ends_and_wrap() {
        draws("M(2)D", &[".......", "...###.", "......."]);
        draws("M(5)D", &[".......", "##.####", "......."]);
        draws("M(1)A(90)DDDD", &["..#..", "..#..", "..#.."]);
        // From column 2 three to the left: column 4 on the other side.
        draws("I(3)R(180)GR(90)M(1)D", &["....#", "....#", "....."]);
    }

    #[test]
    fn lengths_come_in_pixels_thousandths_and_percent() {
        draws("B(400)D", &["..........", ".....#####", ".........."]);
        draws("B(-400)D", &["..........", ".....#....", ".........."]);
        draws("M(4)P(50)D", &["..........", ".....###..", ".........."]);
        draws("M(4)P(-50)I(1)D", &["..........", ".....##...", ".........."]);
        draws("M(-3)I(2)D", &["..........", ".....###..", ".........."]);
        // 90 · 70 / 100 is 63, though 0.7 is a little less than that.
        let text = trial("M(90)P(70)D", 200, 1).levels(0);
        assert_eq!(text.iter().filter(|level| **level == 0).count(), 64);
    }

    #[test]
    fn brackets_keep_the_whole_state() {
        draws("M(1)[L(90)M(2)F(3)S(4,0)C(9,9,9)]D]D", &["......", "...###", "......"]);
        draws("[M(2)", &["......", "......"]);
    }

    #[test]
    fn pens_are_squares() {
        draws("F(3)D", &[".....", ".###.", ".###.", ".###.", "....."]);
        draws("F(2)D", &[".....", ".##..", ".##..", ".....", "....."]);
        draws("F(0)D", &["...", ".#.", "..."]);
        draws("F(-5)D", &["...", ".#.", "..."]);
        draws("F(256)D", &["...", "...", "..."]);
        draws("F(257)D", &["...", ".#.", "..."]);
        draws("W(200)D", &[".....", "..#..", "....."]);
        draws("W(-400)D", &[".....", ".##..", ".##..", ".....", "....."]);
        draws("F(9)M(1)D", &["###", "###"]);
    }

    #[test]
    fn gaps_leave_the_first_pixels_out() {
        draws("M(5)T(0,1)D", &[".......#.#.#"]);
        draws("M(5)T(0,2)D", &["........#..#"]);
        draws("M(5)S(0,167)D", &["........#..#"]);
        draws("M(5)T(0,-3)D", &["......######"]);
        draws("M(5)T(0,6)D", &["............"]);
    }

    #[test]
    fn colours_cover_each_other() {
        let trial = trial("M(3)C(300,-1,7)DC(1,2,3)R(180)M(1)D", 8, 1);
        assert_eq!(trial.levels(0), [255, 255, 255, 255, 255, 255, 1, 1]);
        assert_eq!(trial.levels(1), [255, 255, 255, 255, 0, 0, 2, 2]);
        assert_eq!(trial.levels(2), [255, 255, 255, 255, 7, 7, 3, 3]);
    }

    /// As the specification tells it: a square at every pixel, pixel by pixel.
    fn naive(
        from: (i64, i64),
        to: (i64, i64),
        (side, gap): (i64, i64),
        size: (u32, u32),
    ) -> Vec<u8> {
        let mut levels = vec![255; size.0 as usize * size.1 as usize];
        let at = |(x, y): (i64, i64)| ray::Position::new(x, y);
        let mut counter = 0;
        for pixel in ray::Segment::new(at(from), at(to)).pixels() {
            counter += 1;
            if counter <= gap {
                continue;
            }
            counter = 0;
            for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
                let x = convert::wrap(pixel.x - side / 2 + i, size.0);
                let y = convert::wrap(pixel.y - side / 2 + j, size.1);
                levels[(y * size.0 + x) as usize] = 0;
            }
        }
        levels
    }

    #[test]
    fn a_line_covers_what_its_stamps_cover() {
        let size = (37, 23);
        for degrees in (0..360).step_by(13).chain([45, 90, 180, 270]) {
            for (length, side, gap) in [
                (0, 1, 0),
                (9, 1, 0),
                (15, 4, 0),
                (70, 7, 0),
                (30, 5, 3),
                (30, 5, 4),
                (30, 5, 5),
                (60, 2, 9),
                (10, 40, 0),
            ] {
                let angle = f64::from(degrees) * std::f64::consts::PI / 180.0;
                let from = (18, 11);
                let step = f64::from(length);
                let across = convert::truncate64(step * elementary::cos64(angle));
                let down = -convert::truncate64(step * elementary::sin64(angle));
                let expected = naive(from, (from.0 + across, from.1 + down), (side, gap), size);
                let text = format!("M({length})A({degrees})F({side})T(0,{gap})D");
                assert!(trial(&text, size.0, size.1).levels(0) == expected, "{text}");
            }
        }
    }

    #[test]
    fn a_double_line_leaves_its_middle_white() {
        let (white, line) = ("..........", ".....####.");
        draws("M(3)S(4,0)D", &[white, line, white, white, white, white, white, line, white]);
    }

    #[test]
    fn an_arrow_has_a_head_unless_its_last_pixel_is_left_out() {
        let ink = |text: &str| trial(text, 40, 40).levels(0).iter().filter(|x| **x == 0).count();
        assert!(ink("M(18)S(3,0)D") > ink("M(18)S(0,0)D") + 6);
        // 19 pixels; a gap of 1 leaves out the last one, and that of 18 draws it alone.
        assert_eq!(ink("M(18)T(3,1)D"), ink("M(18)T(0,1)D"));
        assert_eq!((ink("M(18)T(0,18)D"), ink("M(18)T(3,18)D")), (1, 1));
    }

    #[test]
    fn styles_that_do_not_exist_change_nothing() {
        for text in ["S(6,0)", "S(-1,0)", "T(77,0)"] {
            let text = format!("M(9)S(4,0){text}D");
            assert_eq!(trial(&text, 30, 30).levels(0), trial("M(9)S(4,0)D", 30, 30).levels(0));
        }
    }

    #[test]
    fn wild_lines_go_to_and_fro_and_end_one_pixel_past_the_end() {
        for style in [1, 2] {
            let levels = trial(&format!("M(60)S({style},0)D"), 200, 60).levels(0);
            let ink = levels.iter().filter(|level| **level == 0).count();
            assert!((60..300).contains(&ink), "style {style}: {ink}");
            assert_eq!((levels[30 * 200 + 100], levels[30 * 200 + 161]), (0, 0), "style {style}");
        }
    }

    #[test]
    fn particles_take_colour_away_and_fly_straight_without_noise() {
        let trial = trial("M(12)S(5,0)C(255,0,100)D", 64, 48).float("noise intensity", 0.0);
        let trial = trial.float("particle density", 0.0);
        let [red, green, blue] = [0, 1, 2].map(|channel| trial.levels(channel));
        assert!(red.iter().all(|level| *level == 255));
        assert!(green.iter().any(|level| *level < 155));
        for (green, blue) in green.iter().zip(&blue) {
            assert!(blue >= green && u16::from(*blue) >= 100);
        }
        // Straight rays within 8° around the line: nothing behind its start.
        let behind = (0..48).flat_map(|y| (8..32).map(move |x| y * 64 + x));
        assert!(behind.into_iter().all(|place: usize| green[place] == 255));
    }

    #[test]
    fn precisions_differ_by_the_truncation_of_particles_only() {
        let text = "M(12)F(3)C(10,20,30)S(3,0)DL(70)S(1,0)D";
        let image = trial(text, 64, 64).image();
        let levels = trial(text, 64, 64).levels(2);
        for (value, level) in image.channel(2).iter().zip(levels) {
            assert_eq!(*value, f32::from(level) / 255.0);
        }
    }

    #[test]
    fn hostile_texts_end_at_a_limit_or_are_drawn() {
        let fails = |text: &str, what: &str| {
            let error = trial(text, 8, 8).max_text_symbols(1 << 10).compute().unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Limit, "{text}");
            assert!(error.to_string().contains(what), "{error}");
        };
        let pixels = "draws more than 1048576 pixels";
        fails("M(2147483647)L(90)D", pixels);
        fails("M(2147483647)L(45)D", pixels);
        fails("M(2147483647)L(1)F(200)D", pixels);
        fails("M(2147483647)T(0,9)L(1)D", pixels);
        fails("M(2147483647)S(5,0)D", pixels);
        fails(&format!("M(7){}", "F(255)D".repeat(200_000)), pixels);
        fails(&"[".repeat(2_000_000), "more than 1048576 brackets");
        // One row, however long it is; and steps that grow beyond all numbers.
        trial("M(2147483647)DT(0,2147483647)DF(2147483647)D", 8, 8).levels(0);
        trial(&"P(2147483647)I(2147483647)GL(2147483647)R(-2147483648)".repeat(1000), 8, 8)
            .levels(0);
        trial("W(-2147483648)B(2147483647)B(-2147483648)S(0,-2147483648)D", 8, 8).levels(0);
    }

    #[test]
    fn a_text_is_needed() {
        assert_eq!(Trial::of(&BLOCK).compute().unwrap_err().kind(), ErrorKind::Unconnected);
    }
}
