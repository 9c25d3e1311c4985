//! `ptc render` of one graph.

mod support;

use support::{Folder, Png, broken, end, graph, noise, twice_broken};

/// A folder with the graph `noise.xml`.
fn folder(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.write("noise.xml", &noise());
    folder
}

#[test]
fn the_picture_has_the_graphs_size_and_nothing_is_said() {
    let folder = folder("render_plain");
    let run = folder.ptc(&["render", "noise.xml", "-o", "noise.png"]).ends_with(0);
    assert_eq!((run.out, run.err), (String::new(), String::new()));
    assert_eq!(folder.png("noise.png"), Png { width: 64, height: 32, bits: 8 });
    assert_eq!(folder.names(), ["noise.png", "noise.xml"]);
}

#[test]
fn the_size_is_exact_or_that_of_the_longer_side() {
    let folder = folder("render_size");
    for (size, width, height) in [("20x30", 20, 30), ("128", 128, 64), ("3", 3, 2)] {
        folder.ptc(&["render", "noise.xml", "-o", "a.png", "--size", size]).ends_with(0);
        assert_eq!(folder.png("a.png"), Png { width, height, bits: 8 });
    }
}

#[test]
fn options_change_the_picture_and_threads_do_not() {
    let folder = folder("render_options");
    let picture = |options: &[&str]| {
        folder.ptc(&[&["render", "noise.xml", "-o", "a.png"], options].concat()).ends_with(0);
        folder.read("a.png")
    };
    let plain = picture(&[]);
    assert_eq!(picture(&["--threads", "1"]), plain);
    assert_eq!(picture(&["--threads", "7"]), plain);
    assert_eq!(picture(&["--seed", "0"]), plain);
    assert_eq!(picture(&["--supersampling", "1"]), plain);
    assert_eq!(picture(&["--precision", "8"]), plain);
    assert_ne!(picture(&["--seed", "1"]), plain);
    assert_ne!(picture(&["--supersampling", "2"]), plain);
    assert_ne!(picture(&["--precision", "float", "--bits", "16"]), plain);
    assert_eq!(folder.png("a.png").bits, 16);
}

#[test]
fn the_last_result_is_rendered_unless_a_block_is_named() {
    let folder = Folder::new("render_block");
    let blocks = "<block type=\"color fill\" id=\"white\"/>\n\
                  <block type=\"invert\" id=\"black\"><input id=\"white\" slot=\"0\"/></block>\n";
    let blocks = format!("{blocks}{}{}", end("first", "white"), end("last", "black"));
    folder.write("a.xml", &graph(&blocks));
    let picture = |options: &[&str]| {
        folder.ptc(&[&["render", "a.xml", "-o", "a.png"], options].concat()).ends_with(0);
        folder.read("a.png")
    };
    let black = picture(&[]);
    let white = picture(&["--block", "first"]);
    assert_ne!(black, white);
    assert_eq!(picture(&["--block", "last"]), black);
    assert_eq!(picture(&["--block", "black"]), black);
    assert_eq!(picture(&["--block", "white"]), white);
    let run = folder.ptc(&["render", "a.xml", "-o", "b.png", "--block", "middle"]);
    run.ends_with(1)
        .says_one_error()
        .says("a.xml: the graph has no block of id \"middle\"")
        .says("(hint: its `end` blocks are \"first\", \"last\")");
}

#[test]
fn all_results_are_rendered_under_their_ids() {
    let folder = Folder::new("render_all_results");
    let blocks =
        format!("<block type=\"color fill\" id=\"0\"/>\n{}{}", end("1", "0"), end("2", "0"));
    folder.write("a.xml", &graph(&blocks));
    let run = folder.ptc(&["render", "a.xml", "-o", "a.png", "--all-results"]);
    run.ends_with(2).says_one_error().says("two pictures of a.xml would be a.png").says("{block}");
    folder.ptc(&["render", "a.xml", "-o", "{name}-{block}.png", "--all-results"]).ends_with(0);
    assert_eq!(folder.names(), ["a-1.png", "a-2.png", "a.xml"]);
}

#[test]
fn missing_folders_are_made_and_old_pictures_replaced() {
    let folder = folder("render_folders");
    folder.write("new/old.png", "no picture");
    folder.ptc(&["render", "noise.xml", "-o", "new/old.png"]).ends_with(0);
    folder.ptc(&["render", "noise.xml", "-o", "x/{name}/{width}-{seed}.png"]).ends_with(0);
    assert_eq!(folder.png("new/old.png").width, 64);
    assert_eq!(folder.png("x/noise/64-0.png").width, 64);
}

#[test]
fn a_graph_that_cannot_be_rendered_leaves_no_file() {
    let folder = Folder::new("render_nothing");
    folder.write("old.png", "the old picture");
    folder.write("type.xml", &broken());
    folder.write("unconnected.xml", &graph("<block type=\"end\" id=\"1\"/>"));
    folder.write("empty.xml", &graph(""));
    folder.write("cut.xml", &noise()[..100]);
    let before = folder.names();
    for (file, part) in [
        ("type.xml", "(hint: did you mean \"simple noise\"?)"),
        ("unconnected.xml", "unconnected.xml: block 1 (end): "),
        ("empty.xml", "empty.xml: the graph has no block of type \"end\""),
        ("cut.xml", "cut.xml:"),
        ("missing.xml", "missing.xml: "),
        (".", "ptc: error: .: "),
    ] {
        folder.ptc(&["render", file, "-o", "old.png"]).ends_with(1).says_one_error().says(part);
    }
    assert_eq!(folder.names(), before);
    assert_eq!(folder.read("old.png"), b"the old picture");
}

#[test]
fn faults_of_a_file_have_their_positions() {
    let folder = Folder::new("render_positions");
    folder.write("two.xml", &twice_broken());
    let run = folder.ptc(&["render", "two.xml", "-o", "{block}.png", "--all-results"]);
    let run = run.ends_with(1);
    let lines: Vec<_> = run.err.lines().collect();
    assert_eq!(lines.len(), 2, "{run:#?}");
    assert!(lines[0].starts_with("ptc: error: two.xml:3:"), "{run:#?}");
    assert!(lines[1].starts_with("ptc: error: two.xml:4:"), "{run:#?}");
}

#[test]
fn more_memory_than_allowed_is_refused() {
    let folder = folder("render_memory");
    let line = ["render", "noise.xml", "-o", "a.png", "--size", "2000", "--memory", "1M"];
    folder.ptc(&line).ends_with(1).says_one_error().says("--memory");
    folder.ptc(&[&line[..6], &["--memory", "1G"]].concat()).ends_with(0);
}

#[test]
fn files_are_read_where_that_is_allowed() {
    let folder = folder("render_reads");
    folder.ptc(&["render", "noise.xml", "-o", "outside.png"]).ends_with(0);
    folder.ptc(&["render", "noise.xml", "-o", "graphs/inside.png"]).ends_with(0);
    for (name, path) in [("inside", "inside.png"), ("outside", "../outside.png")] {
        let path = format!("<parameter name=\"path\" type=\"string\" value=\"{path}\"/>");
        let load = format!("<block type=\"load file\" id=\"0\">{path}</block>\n{}", end("1", "0"));
        folder.write(&format!("graphs/{name}.xml"), &graph(&load));
    }
    folder.ptc(&["render", "graphs/inside.xml", "-o", "a.png"]).ends_with(0);
    let denied = folder.ptc(&["render", "graphs/outside.xml", "-o", "b.png"]);
    denied.ends_with(1).says_one_error().says("block 0 (load file)").says("--allow-read");
    folder.ptc(&["render", "graphs/outside.xml", "-o", "b.png", "--allow-read", "."]).ends_with(0);
    let going = folder.ptc(&["render", "graphs/outside.xml", "-o", "c.png", "--keep-going"]);
    going
        .ends_with(0)
        .says("ptc: warning: graphs/outside.xml: went on with white: block 0 (load file)");
    assert_eq!(folder.png("c.png").width, 64);
}

#[test]
fn save_file_writes_where_that_is_allowed() {
    let folder = Folder::new("render_writes");
    for (name, path) in [("inside", "saved.png"), ("outside", "../saved.png")] {
        let path = format!("<parameter name=\"path\" type=\"string\" value=\"{path}\"/>");
        let save = "<block type=\"save file\" id=\"2\"><input id=\"0\" slot=\"0\"/>";
        let fill = "<block type=\"color fill\" id=\"0\"/>\n";
        let blocks = format!("{fill}{}{save}{path}</block>\n", end("1", "0"));
        folder.write(&format!("{name}.xml"), &graph(&blocks));
    }
    folder.write("out/there", "");
    folder.ptc(&["render", "inside.xml", "-o", "a.png"]).ends_with(0);
    assert!(!folder.path("out/saved.png").exists());
    let denied = folder.ptc(&["render", "outside.xml", "-o", "b.png", "--allow-write", "out"]);
    denied.ends_with(1).says_one_error().says("block 2 (save file)").says("--allow-write");
    assert!(!folder.path("saved.png").exists() && !folder.path("b.png").exists());
    folder.ptc(&["render", "inside.xml", "-o", "b.png", "--allow-write", "out"]).ends_with(0);
    assert_eq!(folder.png("out/saved.png"), folder.png("b.png"));
    folder.write("out/saved.png", "");
    folder.ptc(&["render", "inside.xml", "--allow-write", "out"]).ends_with(0);
    assert_eq!(folder.png("out/saved.png").width, 64);
}

#[test]
fn texts_of_strangers_do_not_reach_the_terminal_as_they_are() {
    let folder = Folder::new("render_escapes");
    let blocks = "<block type=\"\u{9b}31mred&#10;line\" id=\"0\"/>\n";
    folder.write("a.xml", &graph(&format!("{blocks}{}", end("1", "0"))));
    let run = folder.ptc(&["render", "a.xml", "-o", "a.png"]).ends_with(1).says_one_error();
    assert!(!run.err.contains('\u{9b}'), "{run:#?}");
}

#[test]
fn inputs_get_their_values_from_files() {
    let folder = folder("render_inputs");
    let blocks = "<block type=\"image input\" id=\"0\">\
                  <parameter name=\"name\" type=\"string\" value=\"photo\"/></block>\n\
                  <block type=\"text input\" id=\"1\"/>\n\
                  <block type=\"invert\" id=\"2\"><input id=\"0\" slot=\"0\"/></block>\n\
                  <block type=\"turtle\" id=\"3\"><input id=\"1\" slot=\"0\"/></block>\n";
    let text = graph(&format!("{blocks}{}{}", end("4", "3"), end("5", "2")));
    folder.write("inputs.xml", &text);
    folder.write("line.txt", "D(0.2)");
    folder.ptc(&["render", "noise.xml", "-o", "photo.png"]).ends_with(0);
    let run = |inputs: &[&str]| {
        folder.ptc(
            &[&["render", "inputs.xml", "-o", "{block}.png", "--all-results"], inputs].concat(),
        )
    };
    run(&["--input", "photo=photo.png", "--input", "text=line.txt"]).ends_with(0);
    assert_ne!(folder.read("5.png"), folder.read("photo.png"));
    let missing = run(&["--input", "photo=photo.png"]).ends_with(1);
    assert!(missing.err.contains("--input"), "{}", missing.err);
    let unknown = run(&["--input", "foto=photo.png"]).ends_with(1);
    assert!(unknown.err.contains("its inputs are \"photo\", \"text\""), "{}", unknown.err);
}
