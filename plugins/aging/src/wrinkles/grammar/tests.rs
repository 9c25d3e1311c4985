use super::*;

const WHOLE: &str = "! ma=.2;.5 mb=.8;.5 n=3 relWidth=.9 maxAngle=1.5 omegaLow=.6 amplitude=2";

fn read(text: impl AsRef<[u8]>) -> Vec<Muscle> {
    parse(text.as_ref(), &Limits::default()).unwrap()
}

/// The faults as `line:column: what`.
fn faults(text: impl AsRef<[u8]>) -> Vec<String> {
    let faults = parse(text.as_ref(), &Limits::default()).unwrap_err();
    assert!(!faults.is_limit(), "{faults}");
    assert_eq!(faults.count(), faults.list().len());
    let line = |fault: &Fault| format!("{}:{}: {}", fault.line, fault.column, fault.what);
    faults.list().iter().map(line).collect()
}

/// That a text has one fault.
#[track_caller]
fn assert_fault(text: impl AsRef<[u8]>, expected: &str) {
    assert_eq!(faults(text), [expected]);
}

#[test]
fn all_keys_are_read_and_the_optional_ones_have_defaults() {
    let muscle = Muscle {
        from: [0.2, 0.5],
        to: [0.8, 0.5],
        wrinkles: 3.0,
        width: 0.9,
        max_angle: 1.5,
        low: 0.6,
        amplitude: 2.0,
    };
    assert_eq!(read(WHOLE), [muscle]);
    let defaults = Muscle { width: 0.5, max_angle: 1.25, low: 0.5, amplitude: 1.0, ..muscle };
    assert_eq!(read("!n=3 mb=.8;.5 ma=.2;.5"), [defaults]);
}

#[test]
fn layout_does_not_matter() {
    let texts = [
        "!ma=.2;.5 mb=.8;.5 n=3 relWidth=.9 maxAngle=1.5 omegaLow=.6 amplitude=2",
        "\u{feff}!ma=.2;.5mb=.8;.5n=3relWidth=.9maxAngle=1.5omegaLow=.6amplitude=2",
        "  !\tMA = 0.2 ; 0.50\r\n\r\n# n=7\r\nMb=8e-1;+5.E-1\rN=003 # a\rRELWIDTH=.9\nmaxangle=1.5\n\
         OmegaLow\t=\t6e-1\namplitude=2.\n",
    ];
    for text in texts {
        assert_eq!(read(text), read(WHOLE), "{text:?}");
    }
    // What people write in comments is in whatever encoding.
    assert_eq!(read([WHOLE.as_bytes(), b" # \xe8el\xf0 \x00\n"].concat()), read(WHOLE));
}

#[test]
fn no_muscle_is_no_fault() {
    for text in ["", "\n", "# nothing", " \t\r\n", "\u{feff}"] {
        assert_eq!(read(text), [], "{text:?}");
    }
}

#[test]
fn the_order_of_muscles_does_not_matter_nor_does_the_sign_of_zero() {
    let [one, two] = ["! ma=0;0 mb=1;1 n=1", "! ma=-1;0.5 mb=1;1 n=2"];
    let same = "! ma=-0;-0.0 mb=1;1 n=1";
    let bits = |text: String| read(text).iter().map(Muscle::bits).collect::<Vec<_>>();
    let expected = bits(format!("{one}\n{two}\n{one}"));
    assert_eq!(expected.len(), 3);
    for text in [format!("{two}{one}{one}"), format!("{same} {two} {one}")] {
        assert_eq!(bits(text), expected);
    }
}

#[test]
fn the_ends_of_all_ranges_are_allowed_and_nothing_beyond() {
    let muscle = |key: &str, value: &str| {
        let all = [("ma", "0;0"), ("mb", "1;.5"), ("n", "1")];
        let rest = all.iter().filter(|pair| pair.0 != key);
        rest.map(|(key, value)| format!("{key}={value} ")).collect::<String>() + key + "=" + value
    };
    let cases = [
        ("ma", ["-1;-1", "2;2"], ["-1.001;0", "0;2.001"], "-1 to 2"),
        ("mb", ["-1;-1", "2;2"], ["0;-1.1", "1e9;0"], "-1 to 2"),
        ("n", ["1", "1024"], ["0", "1025"], "1 to 1024"),
        ("relwidth", ["1.1e-6", "1"], ["1e-6", "1.01"], "above 0.000001, up to 1"),
        ("maxangle", ["1", "2"], ["0.25", "2.5"], "1 to 2"),
        ("omegalow", ["0", "1"], ["-.1", "1.1"], "0 to 1"),
        ("amplitude", ["0", "4"], ["-1e-9", "1e999"], "0 to 4"),
    ];
    for (key, allowed, refused, range) in cases {
        for value in allowed {
            assert_eq!(read(format!("!{}", muscle(key, value))).len(), 1, "{key}={value}");
        }
        for value in refused {
            let found = faults(format!("!{}", muscle(key, value)));
            let [what] = &found[..] else { panic!("{found:?}") };
            let end = format!(", allowed is {range}");
            assert!(what.contains(&format!(": `{key}` is `")) && what.ends_with(&end), "{what}");
        }
    }
    assert_fault(
        "! ma=0;0 mb=1;1 n=99999999999999999999999999",
        "1:19: `n` is `999999999999999999999999…`, allowed is 1 to 1024",
    );
}

#[test]
fn keys_before_the_first_muscle_and_unknown_and_double_ones_are_told() {
    assert_fault("n=3\n! ma=0;0 mb=1;1 n=3", "1:1: `n` stands before the first `!`");
    assert_fault("! ma=0;0 mb=1;1 n=3\n N = 4", "2:2: `n` is given twice in one muscle");
    let known = "Known are `ma`, `mb`, `n`, `relwidth`, `maxangle`, `omegalow`, `amplitude`";
    for (word, nearest) in [
        ("relWidht", "relwidth"),
        ("width", "relwidth"),
        ("omega", "omegalow"),
        ("max-angle", "maxangle"),
        ("mc", "ma"),
        ("nn", "n"),
        ("Amplituda", "amplitude"),
    ] {
        assert_fault(
            format!("! ma=0;0 mb=1;1 n=3 {word}=.5 ; .5 amplitude=1"),
            &format!("1:21: unknown key `{word}`, is it `{nearest}`? {known}"),
        );
        assert_fault(
            format!("! ma=0;0 mb=1;1 n=3 {word}"),
            &format!("1:21: unknown key `{word}`, is it `{nearest}`? {known}"),
        );
    }
}

#[test]
fn missing_keys_are_placed_at_their_muscle() {
    assert_eq!(
        faults("# a\n  ! n=3\n mb=1;1 ! ma=0;0 mb=1;1 ! ma=0;0 mb=1;1 n=1\n!"),
        [
            "2:3: the muscle has no `ma`",
            "3:9: the muscle has no `n`",
            "4:1: the muscle has no `ma`",
            "4:1: the muscle has no `mb`",
            "4:1: the muscle has no `n`",
        ]
    );
    // One that is there with a fault is not missing.
    assert_eq!(faults("! ma=0;0 mb=1;1 n=x").len(), 1);
}

#[test]
fn what_is_no_number_is_told_and_commas_have_a_hint() {
    let point = "allowed is a number (use a point, not a comma) -1 to 2";
    assert_fault("! ma=0,3;.75 mb=1;1 n=3", &format!("1:6: the value of `ma` is `0,3`, {point}"));
    assert_eq!(
        faults("! ma = 0,3 ; 0,75 mb=1;1 n=3"),
        [
            format!("1:8: the value of `ma` is `0,3`, {point}"),
            format!("1:14: the value of `ma` is `0,75`, {point}"),
        ]
    );
    for value in ["x", "inf", "NaN", "1e", "--1", "0x1", "1.2.3", ".", "+", "1_0", "½"] {
        assert_fault(
            format!("! ma=0;0 mb=1;1 n=3 omegaLow={value}"),
            &format!("1:30: the value of `omegalow` is `{value}`, allowed is a number 0 to 1"),
        );
    }
    for (value, shown) in [("4.5", "`4.5`"), ("+4", "`+4`"), ("1e2", "`1e2`"), ("", "nothing")] {
        assert_fault(
            format!("! ma=0;0 mb=1;1 n={value}"),
            &format!(
                "1:19: the value of `n` is {shown}, allowed is a whole number, only digits, 1 to 1024"
            ),
        );
    }
}

#[test]
fn points_are_two_numbers() {
    let what = "`ma` needs two numbers with `;` between, such as 0.3;0.75";
    assert_fault("! ma=.3 mb=1;1 n=3", &format!("1:8: {what}"));
    assert_fault("! mb=1;1 n=3 ma=.3", &format!("1:19: {what}"));
    let nothing = "the value of `ma` is nothing, allowed is a number -1 to 2";
    assert_fault("! ma=;.3 mb=1;1 n=3", &format!("1:6: {nothing}"));

    assert_eq!(faults("! ma=.3; ! ma=0;0 mb=1;1 n=3")[2], format!("1:10: {nothing}"));
}

#[test]
fn a_command_is_on_one_line() {
    let found = faults("! mb=1;1 n=3 ma=.3;\n.75");
    assert_eq!(
        found,
        [
            "1:20: the value of `ma` is nothing, allowed is a number -1 to 2",
            "2:1: `.75` is no command; allowed are `!` and `key=value`",
        ]
    );
}

#[test]
fn what_is_no_command_is_told_once() {
    let good = "! ma=0;0 mb=1;1 n=3";
    for (piece, shown) in [("=3", "=3"), (";", ";"), ("\u{1}x", "\\u{1}x"), ("ěš", "ěš")] {
        assert_fault(
            format!("{good} {piece}"),
            &format!("1:21: `{shown}` is no command; allowed are `!` and `key=value`"),
        );
    }
    for piece in ["n", "n:4", "n 4"] {
        let found = faults(format!("! ma=0;0 mb=1;1 n=3 ! mb=1;1 ma=0;0 {piece}"));
        assert_eq!(found[0], "1:21: the muscle has no `n`");
        assert_eq!(found[1], "1:38: `=` and a value must follow `n`");
    }
    assert_fault(format!("ěš {good}"), "1:1: `ěš` is no command; allowed are `!` and `key=value`");
}

#[test]
fn a_fibre_has_a_length() {
    let what = "`ma` and `mb` are the same place, allowed is a distance from 0.000001 on";
    assert_fault("\n ! ma=.5;.5 mb=.5;.5 n=1", &format!("2:2: {what}"));
    assert_fault("! ma=.5;.5 mb=.5000009;.5 n=1", &format!("1:1: {what}"));
    assert_eq!(read("! ma=.5;.5 mb=.500002;.5 n=1").len(), 1);
}

#[test]
fn all_faults_are_told_in_the_order_of_the_file() {
    let text = "n=1\n! ma=0;0 mb=1;1\n! foo=3 ma=9;0 mb=1 n=2 n=3\n?";
    let places: Vec<String> = faults(text)
        .iter()
        .map(|fault| fault.split(": ").next().unwrap_or_default().to_owned())
        .collect();
    assert_eq!(places, ["1:1", "2:1", "3:3", "3:12", "3:20", "3:25", "4:1"]);
}

fn limit(text: impl AsRef<[u8]>) -> String {
    let faults = parse(text.as_ref(), &Limits::default()).unwrap_err();
    assert!(faults.is_limit());
    faults.to_string()
}

#[test]
fn sizes_have_limits() {
    let muscle = "! ma=0;0 mb=1;1 n=1\n";
    assert_eq!(read(muscle.repeat(4096)).len(), 4096);
    assert_eq!(limit(muscle.repeat(5000)), "4097:1: too many muscles, allowed are 4096");
    let line = format!("#{}", "x".repeat(4095));
    assert_eq!(read(&line), []);
    let long = limit(format!("\n{line}x\n"));
    assert_eq!(long, "2:1: the line has 4097 bytes, allowed are 4096");
    let full = format!("{}\n", "#".repeat(63)).repeat(1 << 14);
    assert_eq!((full.len(), read(&full)), (1 << 20, vec![]));
    let over = limit(format!("{full}\n"));
    assert_eq!(over, "1:1: the file has 1048577 bytes, allowed are 1048576");
    // Others may be asked for.
    let limits = Limits { muscles: 1, bytes: 30, line_bytes: 20 };
    assert_eq!(parse(muscle.as_bytes(), &limits).unwrap().len(), 1);
    assert!(parse(muscle.repeat(2).as_bytes(), &limits).unwrap_err().is_limit());
}

#[test]
fn hostile_texts_give_faults() {
    for text in [
        "! ".repeat(1 << 18),
        "a ".repeat(1 << 10).repeat(1 << 8).replace(" a a a a a a a a ", "\n"),
        "\n!\r".repeat(1 << 18),
        "ma=;=!".repeat(600),
        "=".repeat(4096),
        "relwidthrelwidth".repeat(256),
        format!("!n={}", "9".repeat(4000)),
        format!("!ma={}", "1e5;".repeat(1000)),
    ] {
        assert!(parse(text.as_bytes(), &Limits::default()).is_err(), "{}", &text[..20]);
    }
    // Any bytes behind any others.
    for first in 0..=255_u8 {
        for second in 0..=255_u8 {
            let _ = parse(&[b'!', first, second, b'n', second, first], &Limits::default());
        }
    }
}

#[test]
fn whatever_pieces_come_together_are_read_again_or_refused_with_places() {
    let pieces = [
        "!",
        "#",
        "=",
        ";",
        ",",
        " ",
        "\t",
        "\n",
        "\r\n",
        "ma",
        "mb",
        "n",
        "relwidth",
        "maxAngle",
        "omegaLow",
        "AMPLITUDE",
        "1",
        ".5",
        "-",
        "+",
        "e",
        "9",
        "1e-6",
        "\u{feff}",
        "ř",
        "ma=1;0 ",
        "mb=.5;.5 ",
        "n=3 ",
        "! ma=0;0 mb=1;1 n=2 ",
        "relwidth=.7 ",
    ];
    let mut state = 1_u32;
    let (mut read, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut next = |count: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % count
        };
        let count = next(12);
        let text: String = (0..count)
            .filter_map(|_| pieces.get(next(u32::try_from(pieces.len()).unwrap()) as usize))
            .copied()
            .collect();
        match parse(text.as_bytes(), &Limits::default()) {
            Ok(muscles) => {
                let written: String = muscles.iter().map(written).collect();
                assert_eq!(parse(written.as_bytes(), &Limits::default()).unwrap(), muscles);
                read += usize::from(!muscles.is_empty());
            }
            Err(faults) => {
                refused += 1;
                assert!(faults.count() > 0 && faults.count() == faults.list().len());
                let lines: Vec<_> = lines(text.as_bytes()).collect();
                for Fault { line, column, .. } in faults.list() {
                    assert!((1..=lines[line - 1].len() + 1).contains(column), "{text:?}: {faults}");
                }
            }
        }
    }
    assert!(read > 50 && refused > 10_000, "{read}, {refused}");
}

/// A muscle as its file describes it.
fn written(muscle: &Muscle) -> String {
    let Muscle { from, to, wrinkles, width, max_angle, low, amplitude } = muscle;
    format!(
        "! ma={:e};{:e} mb={:e};{:e} n={wrinkles} relwidth={width:e} maxangle={max_angle:e} \
         omegalow={low:e} amplitude={amplitude:e}\n",
        from[0], from[1], to[0], to[1]
    )
}
