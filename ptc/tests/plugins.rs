//! Plug-ins: what `ptc plugins` finds, and commands that need what is found.
#![cfg(target_os = "linux")]

mod support;

use std::{
    fs,
    os::unix::ffi::OsStringExt as _,
    path::{Path, PathBuf},
    process::Command,
};

use serde_json::Value;
use support::{Folder, Run, ptc};

/// A graph of a block that a plug-in has.
const GRAPH: &str = r#"<texturegraph width="8" height="8" seed="0" supersampling="1" version="1">
  <block type="color fill" id="1"/>
  <block type="ptlib-test.invert" id="2" plugin="ptlib-test.points" plugin-version="1.0.0">
    <input id="1" slot="0"/>
  </block>
  <block type="end" id="3">
    <input id="2" slot="0"/>
  </block>
</texturegraph>
"#;

/// Builds the plug-in with the block `ptlib-test.invert`; `false` if there is no C compiler.
fn build(target: &Path) -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a member of the workspace");
    let mut command = Command::new("cc");
    command.args(["-std=c99", "-shared", "-fPIC", "-I"]).arg(root.join("include"));
    command.arg(root.join("tests/plugins/points.c")).arg("-o").arg(target);
    match command.status() {
        Ok(status) => {
            assert!(status.success(), "{command:?}");
            true
        }
        Err(error) => {
            let is_strict = std::env::var_os("PTLIB_TEST_STRICT").is_some_and(|word| word == "1");
            assert!(!is_strict, "cc: {error}");
            false
        }
    }
}

/// A folder with a good plug-in in `good`, and one that is none in `bad`.
fn folder(test: &str) -> Option<Folder> {
    let folder = Folder::new(test);
    folder.write("bad/broken.ptplugin.so", "no library");
    folder.write("good/notes.txt", "");
    folder.write("a.xml", GRAPH);
    build(&folder.path("good/points.ptplugin.so")).then_some(folder)
}

/// Runs the program in a folder, with `PTLIB_PLUGIN_PATH`.
fn with_path(folder: &Folder, path: impl AsRef<std::ffi::OsStr>, line: &str) -> Run {
    let mut command = ptc();
    command.current_dir(folder.path("")).env("PTLIB_PLUGIN_PATH", path).args(line.split(' '));
    command.output().expect("the program starts").into()
}

#[test]
fn the_search_says_what_is_loaded_and_why_something_is_not() {
    let Some(folder) = folder("plugins-search") else { return };
    folder.write("good/libother.so", "");
    let run = with_path(&folder, "good::bad:missing", "plugins").ends_with(1);
    let run = run.says("1 plug-in loaded, 1 refused");
    for part in [
        "good (PTLIB_PLUGIN_PATH)\n",
        "  points.ptplugin.so: ptlib-test.points 1.0.0 by The tests of ptlib, MIT OR Apache-2.0\n",
        "      ptlib-test.invert\n",
        "  libother.so: not opened: the names of plug-ins end with .ptplugin.so\n",
        "bad (PTLIB_PLUGIN_PATH)\n  broken.ptplugin.so: refused: ",
        "missing (PTLIB_PLUGIN_PATH)\n  does not exist\n",
        " (user)\n  does not exist\n",
        " (system)\n",
    ] {
        assert!(run.out.contains(part), "no {part:?} in {run:#?}");
    }
    with_path(&folder, "good", "plugins").ends_with(0).says("1 plug-in loaded, 0 refused");
}

#[test]
fn the_search_as_json_has_the_documented_fields() {
    let Some(folder) = folder("plugins-json") else { return };
    let line = "plugins --no-plugins --plugins good --plugins bad --json";
    let run = with_path(&folder, "", line).ends_with(1);
    let report: Value = serde_json::from_str(&run.out).unwrap();
    let places = report["places"].as_array().unwrap();
    assert_eq!(places.len(), 2, "{run:#?}");
    let (good, bad) = (&places[0]["files"][0], &places[1]["files"][0]);
    assert_eq!(places[0]["folder"], "good");
    assert_eq!(
        (&places[0]["origin"], &places[0]["exists"]),
        (&"command line".into(), &true.into())
    );
    assert_eq!(
        (&good["state"], &good["blocks"][0]),
        (&"loaded".into(), &"ptlib-test.invert".into())
    );
    assert_eq!(good["plugin"]["license"], "MIT OR Apache-2.0");
    assert_eq!(bad["state"], "refused");
    assert_eq!(bad["kind"], ptlib::ErrorKind::PluginLoad as u32);
    assert!(bad["reason"].is_string() && bad.get("plugin").is_none(), "{bad}");
}

#[test]
fn of_two_plugins_with_one_block_the_first_wins_and_both_are_named() {
    let Some(folder) = folder("plugins-duplicate") else { return };
    if !build(&folder.path("other.ptplugin.so")) {
        return;
    }
    let run = with_path(&folder, "good:.", "plugins").ends_with(1);
    let line = run.out.lines().find(|line| line.contains("other.ptplugin.so: refused")).unwrap();
    assert!(
        line.contains("ptlib-test.invert") && line.contains("good/points.ptplugin.so"),
        "{line}"
    );
}

#[test]
fn commands_know_the_blocks_of_plugins() {
    let Some(folder) = folder("plugins-used") else { return };
    let list = with_path(&folder, "good", "list").ends_with(0);
    assert_eq!(list.err, "");
    let heading = "adjust (plug-in ptlib-test.points 1.0.0)\n  ptlib-test.invert";
    assert!(list.out.contains(heading), "{list:#?}");
    let page = with_path(&folder, "", "describe ptlib-test.invert --plugins good").ends_with(0);
    let about = "From a plug-in: ptlib-test.points 1.0.0 by The tests of ptlib";
    assert!(page.out.contains(about) && page.out.contains("points.ptplugin.so"), "{page:#?}");
    with_path(&folder, "good", "check a.xml").ends_with(0).says("0 errors, 0 warnings");
    let file = "--plugin good/points.ptplugin.so";
    let render = with_path(&folder, "", &format!("render a.xml -o a.png {file}")).ends_with(0);
    assert_eq!((render.err, folder.png("a.png").width), (String::new(), 8));
}

#[test]
fn without_the_plugin_its_block_cannot_be_computed_and_the_message_names_it() {
    let Some(folder) = folder("plugins-missing") else { return };
    for line in ["render a.xml -o a.png --no-plugins", "check a.xml --no-plugins"] {
        let run = with_path(&folder, "good", line).ends_with(1);
        let said = format!("{}{}", run.out, run.err);
        for part in ["ptlib-test.invert", "ptlib-test.points", "1.0.0", "`ptc plugins`"] {
            assert!(said.contains(part), "no {part:?} in {said}");
        }
    }
    assert!(!folder.path("a.png").exists());
}

#[test]
fn what_is_refused_in_a_folder_is_a_warning_and_what_was_named_an_error() {
    let Some(folder) = folder("plugins-refused") else { return };
    let run = with_path(&folder, "bad:good", "render a.xml -o a.png").ends_with(0);
    run.says("ptc: warning: bad/broken.ptplugin.so: ");
    let quiet = with_path(&folder, "bad:good", "render a.xml -o a.png --quiet").ends_with(0);
    assert_eq!(quiet.err, "");
    let file = "list --plugin bad/broken.ptplugin.so";
    with_path(&folder, "good", file).ends_with(1).says_one_error().says("bad/broken.ptplugin.so: ");
    let none = with_path(&folder, "", "list --plugins nowhere").ends_with(2).says_one_error();
    none.says("\"nowhere\" is no folder");
    let file = with_path(&folder, "", "plugins --plugin missing.ptplugin.so").ends_with(1);
    assert!(file.out.contains("missing.ptplugin.so: refused: "), "{file:#?}");
}

/// Loading runs code, so it is left out where nothing is missing.
#[test]
fn graphs_and_descriptions_of_builtin_blocks_load_nothing_from_the_usual_folders() {
    let Some(folder) = folder("plugins-unneeded") else { return };
    folder.write("b.xml", &support::noise());
    for line in ["render b.xml -o b.png", "check b.xml --json", "describe perlin noise"] {
        let run = with_path(&folder, "bad", line).ends_with(0);
        assert_eq!(run.err, "", "{line}");
    }
    with_path(&folder, "bad", "describe perlin nose").ends_with(2).says("broken.ptplugin.so: ");
    // What is named is wanted.
    let run = with_path(&folder, "", "render b.xml -o b.png --plugins bad").ends_with(0);
    run.says("ptc: warning: bad/broken.ptplugin.so: ");
    // Of two graphs, the second needs a plug-in: folders are searched once.
    let run = with_path(&folder, "bad:good", "check b.xml a.xml a.xml").ends_with(0);
    assert_eq!(run.err.matches("ptc: warning: ").count(), 1, "{run:#?}");
}

#[test]
fn a_block_that_may_be_in_a_refused_file_is_reported_with_the_reason() {
    let Some(folder) = folder("plugins-reason") else { return };
    let reason = "it may be in a file that was refused: bad/broken.ptplugin.so: cannot be loaded";
    let line = "render a.xml -o a.png --quiet";
    let run = with_path(&folder, "bad", line).ends_with(1).says_one_error().says(reason);
    assert_eq!(run.err.matches("(hint: ").count(), 1, "{run:#?}");
    let run = with_path(&folder, "bad", "check a.xml --json").ends_with(1);
    assert!(run.out.contains(reason), "{run:#?}");
    let run = with_path(&folder, "bad", "render a.xml -o a.png --quiet --no-plugins").ends_with(1);
    assert!(!run.err.contains("refused"), "{run:#?}");
    // A misspelt built-in block is in no plug-in.
    folder.write("c.xml", &support::broken());
    let run = with_path(&folder, "bad", "render c.xml -o c.png --quiet").ends_with(1);
    assert!(!run.err.contains("refused"), "{run:#?}");
}

#[test]
fn a_file_that_is_found_twice_counts_once() {
    let Some(folder) = folder("plugins-twice") else { return };
    let link = folder.path("link");
    std::os::unix::fs::symlink(folder.path("good"), link).unwrap();
    let line = "plugins --plugin good/points.ptplugin.so";
    let run =
        with_path(&folder, "good:link", line).ends_with(0).says("1 plug-in loaded, 0 refused");
    let repeated = "(PTLIB_PLUGIN_PATH)\n  points.ptplugin.so: is in an earlier place too\n";
    assert_eq!(run.out.matches(repeated).count(), 2, "{run:#?}");
    let run = with_path(&folder, "bad:bad", "plugins").ends_with(1);
    run.says("0 plug-ins loaded, 1 refused");
}

#[test]
fn a_folder_that_cannot_be_read_is_refused_with_the_reason() {
    let Some(folder) = folder("plugins-unreadable") else { return };
    // Whoever has all rights can read every folder, but nobody can follow a link to itself.
    std::os::unix::fs::symlink("loop", folder.path("loop")).unwrap();
    let run = with_path(&folder, "loop:good", "plugins").ends_with(1);
    let run = run.says("1 plug-in loaded, 1 refused");
    assert!(run.out.contains("loop (PTLIB_PLUGIN_PATH)\n  loop: refused: "), "{run:#?}");
    with_path(&folder, "loop:good", "render a.xml -o a.png").ends_with(0).says("warning: loop: ");
}

#[test]
fn options_without_a_value_or_a_sense_are_refused_before_anything_is_loaded() {
    let Some(folder) = folder("plugins-options") else { return };
    for (line, part) in [
        ("list --plugin", "--plugin <FILE>"),
        ("list --plugins", "--plugins <DIR>"),
        ("render a.xml -o a.png --no-plugin", "similar argument"),
        ("list --plugin bad/broken.ptplugin.so --plugins nowhere", "\"nowhere\" is no folder"),
    ] {
        with_path(&folder, "", line).ends_with(2).says_one_error().says(part);
    }
}

#[test]
fn folders_may_have_any_name() {
    let Some(folder) = folder("plugins-names") else { return };
    let name = std::ffi::OsString::from_vec(b"na\xffme".to_vec());
    let other = folder.path("").join(&name);
    fs::create_dir(&other).unwrap();
    fs::copy(folder.path("good/points.ptplugin.so"), other.join("points.ptplugin.so")).unwrap();
    let run = with_path(&folder, PathBuf::from(name), "plugins").ends_with(0);
    assert!(run.out.contains("na\u{fffd}me (PTLIB_PLUGIN_PATH)\n  points.ptplugin.so"), "{run:#?}");
}

#[test]
fn a_file_where_a_folder_should_be_is_refused() {
    let Some(folder) = folder("plugins-file") else { return };
    let run = with_path(&folder, "a.xml", "plugins").ends_with(1);
    assert!(run.out.contains("a.xml: refused: "), "{run:#?}");
}
