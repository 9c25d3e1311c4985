//! `ptc render` of several graphs.

mod support;

use support::{Folder, broken, noise};

fn folder(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.write("a.xml", &noise());
    folder.write("b.xml", &noise());
    folder.write("c/a.xml", &noise());
    folder.write("broken.xml", &broken());
    folder
}

#[test]
fn every_graph_has_its_picture() {
    let folder = folder("batch_all");
    let run = folder.ptc(&["render", "a.xml", "b.xml", "-o", "out/{name}-{width}x{height}.png"]);
    let run = run.ends_with(0);
    assert_eq!(run.err, "ptc: 2 graphs rendered, 0 failed\n");
    assert_eq!(folder.read("out/a-64x32.png"), folder.read("out/b-64x32.png"));
    folder.ptc(&["render", "a.xml", "c/a.xml", "-o", "{folder}/{name}.png"]).ends_with(0);
    assert_eq!(folder.read("a.png"), folder.read("c/a.png"));
}

#[test]
fn pictures_that_would_overwrite_each_other_are_refused() {
    let folder = folder("batch_collisions");
    let before = folder.names();
    for (graphs, pattern) in [
        (["a.xml", "b.xml"], "a.png"),
        (["a.xml", "b.xml"], "out/{width}.png"),
        (["a.xml", "c/a.xml"], "out/{name}.png"),
        (["a.xml", "./a.xml"], "{name}.png"),
        (["a.xml", "./a.xml"], "{folder}/{name}.png"),
    ] {
        let run = folder.ptc(&["render", graphs[0], graphs[1], "-o", pattern]);
        run.ends_with(2).says_one_error().says(graphs[1]).says("(hint: a pattern with {name}");
    }
    assert_eq!(folder.names(), before);
}

#[test]
fn a_graph_that_fails_does_not_keep_the_others_from_being_rendered() {
    let folder = folder("batch_some");
    let line = ["render", "a.xml", "broken.xml", "missing.xml", "b.xml", "-o", "{name}.png"];
    let run = folder.ptc(&line).ends_with(3).says("broken.xml:3:").says("missing.xml: ");
    assert!(run.err.ends_with("ptc: 2 graphs rendered, 2 failed\n"), "{run:#?}");
    assert!(folder.path("a.png").exists() && folder.path("b.png").exists());
}

#[test]
fn a_batch_of_which_all_fail_is_a_failure() {
    let folder = folder("batch_none");
    let run = folder.ptc(&["render", "missing.xml", "broken.xml", "-o", "{name}.png"]);
    run.ends_with(1).says("ptc: 0 graphs rendered, 2 failed\n");
}

#[test]
fn quiet_shows_errors_only_and_timing_shows_times() {
    let folder = folder("batch_quiet");
    let line = ["render", "a.xml", "broken.xml", "-o", "{name}.png", "--quiet"];
    folder.ptc(&line).ends_with(3).says_one_error();
    let run = folder.ptc(&["render", "a.xml", "-o", "a.png", "--timing"]).ends_with(0);
    assert!(run.err.starts_with("ptc: a.xml: read in "), "{run:#?}");
    assert_eq!(run.err.lines().count(), 1);
}
