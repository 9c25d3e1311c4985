//! A text that a grammar grows from an axiom: what a turtle follows.
//!
//! Specification 2.44 (Lindenmayer systems with numbers, conditions and chances). A file has the
//! grammar; [`Grammar`] reads it and rewrites its axiom.

// Pictured: `iterations` `3`.
// Pictured: `path` `in/stochastic.txt`, `iterations` `12`.

use super::grammar::Grammar;
use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// The file with the grammar, relative to the folder of the graph. Its first line is the
        /// axiom, every other line a rule such as `s(x) [x < 6] : 2 -> D[L(30)s(x + 1)]`.
        path: path [read] = "";
        /// How many times all symbols are replaced, unless none changes any more. 0 gives the
        /// axiom.
        iterations: int [hard 0..=65536 soft 0..=20] = 10;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<LSystem>(About {
    id: "l-system",
    summary: "Grows a text for a turtle from the rules of a grammar.",
    outputs: &[output("text", Planes::Grey).of_kind(Kind::Text)],
    uses_seed: true,
    ..About::DEFAULT
});

struct LSystem;

impl WholeBlock for LSystem {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let bytes = cx.read_file(&params.path)?;
        let grammar = Grammar::read(&bytes, cx).map_err(|error| error.at_parameter("path"))?;
        Ok(vec![grammar.rewrite::<L>(params.iterations.unsigned_abs(), cx)?.into()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    fn trial(grammar: &str, iterations: i32) -> Trial {
        Trial::of(&BLOCK).file(grammar.as_bytes()).int("iterations", iterations)
    }

    fn text(grammar: &str, iterations: i32) -> String {
        trial(grammar, iterations).text_and_warnings().unwrap().0
    }

    fn error(trial: &Trial) -> Error {
        trial.compute().unwrap_err()
    }

    #[test]
    fn follows_the_vectors_of_the_specification() {
        assert_eq!(text("a(3)b\n\na(x) [(x > 1) & (x < 4)] -> a(x - 1)c\n", 10), "a(1)ccb");
        let rule = "s -> a(2 + 3)b(7-1)c(7 - 1)d((2 + 3) * 4)e(2 * (3 + 4))f(-7 / 2)";
        assert_eq!(text(&format!("s\n{rule}"), 1), "a(5)b(0)c(6)d(20)e(14)f(-3)");
        assert_eq!(text("s\ns -> sa\na ->", 4), "sa");
        let nested = "s\ns -> a(((1 + 2) * (3 + 4)) + 1)b(((5)))";
        assert_eq!(text(nested, 1), "a(22)b(5)");
    }

    #[test]
    fn no_iteration_gives_the_axiom_with_all_its_values() {
        assert_eq!(text("s(1)", 0), "s(1)");
        assert_eq!(text("\u{feff}( a b ( 1 , -2 )[+])\r\nx\n", 7), "(ab(1,-2)[+])");
        assert_eq!(text("", 7), "");
        assert_eq!(text("\ns -> s", 7), "");
    }

    #[test]
    fn symbols_are_replaced_at_the_same_time_by_rules_that_look_like_them() {
        assert_eq!(text("ab\na -> b\nb -> a", 3), "ba");
        assert_eq!(text("a(1)a(1,2)a\na -> x\na(x) -> y(x)\na(x,y) -> z(y,x)", 1), "y(1)z(2,1)x");
        let signs = "&|!<>=+[]{},:-*/\n+ -> -\n- -> (\n: -> ::\n> -> ()";
        // A bracket that does not follow a symbol is one itself.
        assert_eq!(text(signs, 1), "&|!<()=-[]{},::(*/");
    }

    #[test]
    fn carriage_returns_and_a_last_line_break_change_nothing() {
        assert_eq!(text("s\r\n\r\ns -> ss\r\n", 2), "ssss");
    }

    #[test]
    fn invalid_expressions_count_as_0() {
        for invalid in [
            "1 + 2 + 3",
            "! x",
            "",
            "x -1",
            "y",
            "y + 5",
            "x x",
            "(1 + 2) (3)",
            "(1 + 2)3",
            "x -> 3",
            "x + ()",
            "()",
            "x # 2",
            "x +",
            "+ x",
            "(x + 1) + 1 + 1",
            "(x, 1)",
            "x = = x",
        ] {
            let grammar = format!("s(7)\ns(x) -> a({invalid})b");
            let (text, warnings) = trial(&grammar, 1).text_and_warnings().unwrap();
            assert_eq!(text, "a(0)b", "{invalid}");
            assert_eq!(warnings.len(), 1, "{invalid}");
        }
        for (valid, value) in [
            ("x", 7),
            ("(x)", 7),
            ("x > 6", 1),
            ("x / 0", 0),
            ("((x) - (((2))))", 5),
            ("2147483647 + x", i32::MIN + 6),
            ("((x - 1) * (x - 2)) + (x / 2)", 33),
        ] {
            let grammar = format!("s(7)\ns(x) -> a({valid})b");
            let (text, warnings) = trial(&grammar, 1).text_and_warnings().unwrap();
            assert_eq!(text, format!("a({value})b"), "{valid}");
            assert_eq!(warnings, [""; 0], "{valid}");
        }
    }

    #[test]
    fn a_condition_that_is_no_expression_never_holds() {
        for (condition, expected) in [
            ("x > 1", "b"),
            ("x < 1", "a(7)"),
            ("x", "b"),
            ("x > 1 & x < 9", "a(7)"),
            ("(x > 1) & (x < 9)", "b"),
            ("y = 0", "a(7)"),
            ("(x > 1", "a(7)"),
            ("x) (x", "a(7)"),
            ("x > -1", "b"),
            ("x >-1", "b"),
            ("", "a(7)"),
        ] {
            assert_eq!(text(&format!("a(7)\na(x) [{condition}] -> b"), 1), expected, "{condition}");
        }
    }

    #[test]
    fn invalid_rules_are_ignored_with_a_warning() {
        for (rule, place, what) in [
            ("s", "line 3, column 2", "the line ends, where \"->\" has to come"),
            ("s -> s1", "line 3, column 7", "there is the number 1, where a symbol"),
            ("s ->\ts", "line 3, column 5", "there is a tab"),
            ("s -> é.", "line 3, column 6", "a character that no grammar has"),
            ("s -> a(1", "line 3, column 9", "the line ends, where ',' has to come"),
            ("s -> a((1)b", "line 3, column 12", "the line ends"),
            ("s(x [x] -> s", "line 3, column 5", "there is '[', where ',' or ')'"),
            ("s [1] -> b", "line 3, column 3", "there is '[', where \"->\""),
            ("s(1) -> b", "line 3, column 3", "the number 1, where the name"),
            ("s : x -> b", "line 3, column 5", "there is 'x', where a weight"),
            ("s -> a(1,2,3,4,5,6)", "line 3, column 18", "at most 5 values"),
            ("s(a,b,c,d,e,f) -> a", "line 3, column 13", "at most 5 values"),
            ("s -> a -> b", "line 3, column 8", "there is \"->\", where a symbol"),
        ] {
            let grammar = format!("s\n\n{rule}\nt -> u");
            let (text, warnings) = trial(&grammar, 3).text_and_warnings().unwrap();
            assert_eq!((&*text, warnings.len()), ("s", 1), "{rule}");
            assert!(warnings[0].starts_with(place), "{warnings:?}");
            assert!(warnings[0].contains(what), "{warnings:?}");
            assert!(warnings[0].ends_with("(the rule is ignored)"), "{warnings:?}");
        }
        let (_, warnings) = trial(&"x\n".repeat(50), 1).text_and_warnings().unwrap();
        assert_eq!(warnings.len(), 11);
        assert!(warnings[10].contains("39 more"), "{warnings:?}");
    }

    #[test]
    fn an_invalid_axiom_is_an_error() {
        for (axiom, place) in [
            ("s1", "line 1, column 2: "),
            ("s(x)", "line 1, column 3: "),
            ("s(1", "line 1, column 4: "),
            ("s()", "line 1, column 3: "),
            ("s -> s", "line 1, column 3: "),
            ("s(1,2,3,4,5,6)", "line 1, column 13: "),
        ] {
            let error = error(&trial(axiom, 1));
            assert_eq!(error.kind(), ErrorKind::Parse);
            assert!(error.to_string().starts_with(place), "{error}");
            assert!(error.to_string().contains("\"path\""), "{error}");
        }
    }

    #[test]
    fn rules_are_drawn_in_proportion_to_their_weights() {
        let count = |rules: &str, seed| {
            let grammar = format!("{}\n{rules}", "s".repeat(20_000));
            let (text, _) = trial(&grammar, 1).seed(seed).text_and_warnings().unwrap();
            text.bytes().filter(|byte| *byte == b'a').count()
        };
        for seed in [0, 1, 77] {
            assert!(count("s : 5 -> a\ns : 1 -> b", seed).abs_diff(16_667) < 200);
            assert!(count("s : 3 -> b\ns : 1 -> a\ns -> c", seed).abs_diff(4_000) < 200);
            assert!(count("s -> b\ns -> a\n", seed).abs_diff(10_000) < 250);
            // -1 counts as 255, 256 as 0, which is never drawn unless it is the only one.
            assert_eq!(count("s : 256 -> a\ns : -1 -> b", seed), 0);
            assert_eq!(count("s : 0 -> a", seed), 20_000);
            assert_eq!(count("s : 0 -> a\ns : 0 -> b", seed), 20_000);
        }
        assert_ne!(count("s -> b\ns -> a\n", 0), count("s -> b\ns -> a\n", 5));
    }

    #[test]
    fn in_8_bit_precision_the_first_and_the_last_unit_of_weight_count_half() {
        let grammar = format!("{}\ns : 5 -> a\ns : 1 -> b", "s".repeat(20_000));
        let (text, _) = trial(&grammar, 1).eight_bit().text_and_warnings().unwrap();
        let count = text.bytes().filter(|byte| *byte == b'a').count();
        assert!(count.abs_diff(18_000) < 200, "{count}");
    }

    #[test]
    fn draws_are_taken_in_the_order_of_the_text_and_of_nothing_else() {
        let grammar = "sts\ns -> a\ns -> b\nt : 0 -> u";
        let drawn = |k| if elias::noise64(k) <= 0.0 { 'a' } else { 'b' };
        for seed in 0..20_u8 {
            let (text, _) = trial(grammar, 1).seed(seed.into()).text_and_warnings().unwrap();
            let k = i32::from(seed);
            assert_eq!(text, format!("{}u{}", drawn(k), drawn(k + 1)), "seed {seed}");
        }
    }

    #[test]
    fn hostile_grammars_end_at_a_limit() {
        let trial = |grammar: &str| trial(grammar, 65_536).max_text_symbols(10_000);
        let ends = |grammar: &str, what: &str| {
            let error = error(&trial(grammar));
            assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
            assert!(error.to_string().contains(what), "{error}");
        };
        ends("s\ns -> ss", "in iteration 14 of 65536, the text grows beyond 10000 symbols");
        ends(&format!("s\ns -> {}", "st(1)".repeat(200)), "in iteration 2 of 65536");
        ends("s(1)s(1)s(1)\ns(x) -> s(x + 1)\n", "taken 640000 steps");
        ends("sssss\ns -> t\ns -> u\nt -> s\nu -> s", "taken 640000 steps");
        ends(&format!("s\n{}", "s(x) [0] -> s\n".repeat(2000)), "has 28002 bytes, allowed 10000");
        let many = format!("{}\n{}", "s(1)".repeat(900), "s(x)[0]->s\n".repeat(580));
        ends(&many, "taken 640000 steps");
        // What does not change any more is done, whatever replaces it.
        assert_eq!(trial("st\ns -> s\nt -> t").text_and_warnings().unwrap().0, "st");
    }

    #[test]
    fn nesting_has_no_bound_but_that_of_the_file() {
        let (open, close) = ("(".repeat(100_000), ")".repeat(100_000));
        assert_eq!(text(&format!("s\ns -> a({open}7{close})"), 1), "a(7)");
        let (open, close) = ("(1 + ".repeat(100_000), ")".repeat(100_000));
        assert_eq!(text(&format!("s\ns -> a({open}7{close})"), 1), "a(100007)");
        let grammar = format!("s\ns -> a({open}");
        assert_eq!(trial(&grammar, 1).text_and_warnings().unwrap().1.len(), 1);
    }

    #[test]
    fn a_file_that_cannot_be_read_is_an_error() {
        assert_eq!(error(&Trial::of(&BLOCK)).kind(), ErrorKind::Denied);
    }
}
