//! `ptc check-plugin`: each broken promise is found by the check that is there for it.
#![cfg(target_os = "linux")]

mod support;

use std::{path::Path, process::Command};

use support::{Folder, Run};

/// Builds the misbehaving plug-in of the tests; `false` if there is no C compiler.
fn build(folder: &Folder, breaks: u32) -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a member of the workspace");
    let mut command = Command::new("cc");
    command.args(["-std=c99", "-O1", "-shared", "-fPIC"]).arg(format!("-DBREAKS={breaks}"));
    command.arg("-I").arg(root.join("include")).arg(root.join("tests/plugins/misbehaving.c"));
    command.arg("-o").arg(folder.path("a.ptplugin.so")).arg("-lm");
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

fn check(folder: &Folder, more: &[&str]) -> Run {
    let arguments = [&["check-plugin", "a.ptplugin.so", "--timeout", "20"], more].concat();
    folder.ptc(&arguments)
}

#[test]
fn a_plugin_that_keeps_its_promises_passes() {
    let folder = Folder::new("check-plugin-good");
    if !build(&folder, 0) {
        return;
    }
    let run = check(&folder, &[]).ends_with(0).says("9 checks, 0 failed");
    assert!(run.out.contains("rectangles: ok"), "{run:#?}");
    let run = check(&folder, &["--json"]).ends_with(0);
    assert!(run.out.contains("\"passed\": true"), "{run:#?}");
}

#[test]
fn every_broken_promise_is_found() {
    let folder = Folder::new("check-plugin-bad");
    let cases = [
        (1, "defaults", "signal 11 (invalid memory)"),
        (2, "defaults", "ended by itself"),
        (4, "defaults", "wrote to the standard output"),
        (5, "rectangles", "wrote outside of the rectangle"),
        (6, "rectangles", "left a sample unwritten"),
        (7, "rectangles", "changed the samples of an input"),
        (8, "rectangles", "gives another value"),
        (9, "strips", "results differ between strips"),
        (10, "cancel", "after it was asked to stop"),
        (11, "environment", "changed the locale"),
        (12, "environment", "changed the floating-point mode"),
        (13, "creations", "memory grew by"),
        (14, "parameters", "not finite"),
        (15, "load", "loading took"),
    ];
    for (breaks, check_name, said) in cases {
        if !build(&folder, breaks) {
            return;
        }
        let run = check(&folder, &["--only", check_name]).ends_with(1);
        let line = format!("a.ptplugin.so: error: {check_name}: ");
        assert!(run.out.contains(&line) && run.out.contains(said), "{breaks}: {run:#?}");
    }
}

#[test]
fn a_plugin_that_never_returns_is_ended() {
    let folder = Folder::new("check-plugin-hang");
    if !build(&folder, 3) {
        return;
    }
    let only = ["check-plugin", "a.ptplugin.so", "--timeout", "1", "--only", "defaults"];
    let run = folder.ptc(&only).ends_with(1);
    assert!(run.out.contains("did not end within 1 s"), "{run:#?}");
}

#[test]
fn what_is_no_plugin_is_not_checked_further() {
    let folder = Folder::new("check-plugin-none");
    std::fs::write(folder.path("a.ptplugin.so"), "no library").expect("the folder is there");
    let run = check(&folder, &[]).ends_with(1).says("1 check, 1 failed");
    assert!(run.out.contains("cannot be loaded"), "{run:#?}");
}
