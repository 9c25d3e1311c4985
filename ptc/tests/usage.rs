//! Command lines that make no sense, and questions about the command itself.

mod support;

use support::{Folder, Run, noise, ptc};

fn run(arguments: &[&str]) -> Run {
    ptc().args(arguments).output().expect("the program starts").into()
}

#[test]
fn version_and_help_are_answers() {
    let version = run(&["--version"]).ends_with(0);
    assert_eq!(version.out, format!("ptc {}\n", env!("CARGO_PKG_VERSION")));
    let help = run(&["--help"]).ends_with(0);
    for part in ["render", "list", "describe", "check", "Exit codes:", "130"] {
        assert!(help.out.contains(part), "no {part:?} in {}", help.out);
    }
    let help = run(&["render", "--help"]).ends_with(0);
    assert!(help.out.contains("{name}") && help.out.contains("Examples:"), "{}", help.out);
}

#[test]
fn no_command_shows_the_help_and_fails() {
    let run = run(&[]).ends_with(2).says("Usage: ptc");
    assert_eq!(run.out, "");
}

#[test]
fn wrong_command_lines_are_refused_in_one_line() {
    for (line, part) in [
        ("rendr a.xml", "unrecognized subcommand 'rendr'"),
        ("render a.xml -o a.png --sise 5", "similar argument exists: '--size'"),
        ("render a.xml", "--output <FILE|PATTERN>"),
        ("render -o a.png", "<GRAPH>"),
        ("render a.xml -o a.png --size 0", "WIDTHxHEIGHT"),
        ("render a.xml -o a.png --size 5x", "WIDTHxHEIGHT"),
        ("render a.xml -o a.png --size 5by5", "WIDTHxHEIGHT"),
        ("render a.xml -o a.png --seed -1", "unexpected argument '-1'"),
        ("render a.xml -o a.png --supersampling 7", "7 is not in 1..=6"),
        ("render a.xml -o a.png --precision 16", "possible values: 8, float"),
        ("render a.xml -o a.png --bits 12", "possible values: 8, 16"),
        ("render a.xml -o a.png --threads 0", "0 is not in 1..=1024"),
        ("render a.xml -o a.png --memory lots", "whole number of bytes"),
        ("render a.xml -o {nmae}.png", "no placeholder {nmae}"),
        ("render a.xml -o {name.png", "no partner"),
        ("render a.xml -o a.png --block 1 --all-results", "cannot be used with"),
        ("render a.xml --allow-write . --block 1", "--output"),
        ("render a.xml -o a.png --quiet --timing", "cannot be used with"),
        ("check", "<GRAPH>"),
        ("describe", "<BLOCK>"),
    ] {
        let arguments: Vec<_> = line.split(' ').collect();
        run(&arguments).ends_with(2).says_one_error().says(part).says("(hint: ");
    }
}

#[test]
fn a_name_that_tells_no_format_is_refused_before_anything_is_done() {
    let folder = Folder::new("no_format");
    folder.write("a.xml", &noise());
    for name in ["a", "out/a", "a.xyz", ".png"] {
        folder.ptc(&["render", "a.xml", "-o", name]).ends_with(2).says_one_error().says(name);
    }
    assert_eq!(folder.names(), ["a.xml"]);
}
