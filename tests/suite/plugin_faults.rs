//! Plug-ins that are refused, each with a status of its own and a message that says why. The host
//! lives.

use std::{
    fs,
    os::unix::fs::{PermissionsExt as _, symlink},
    path::Path,
    sync::{Arc, Mutex},
};

use ptlib::{Engine, EngineOptions, Error, ErrorKind, run::LogLevel};

use crate::plugins::{build, build_with, folder, rust_library, rust_plugin};

fn refusal(path: &Path) -> Error {
    let engine = Engine::new(EngineOptions::default());
    let count = engine.registry().blocks().len();
    let error = engine.load_plugin(path).unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with(&path.display().to_string()), "{text}");
    assert_eq!(engine.registry().blocks().len(), count, "{text}");
    assert!(engine.registry().plugins().is_empty());
    error
}

/// Fault number, kind, and what the message says, in the order of `enum fault` in bad.c.
const FAULTS: [(ErrorKind, &str); 46] = [
    (ErrorKind::PluginAbi, "version 2.0 of the plug-in contract"),
    (ErrorKind::PluginAbi, "struct_size of 16"),
    (ErrorKind::PluginAbi, "struct_size of 1000000"),
    (ErrorKind::PluginDescriptor, "`flags`"),
    (ErrorKind::PluginDescriptor, "`id` is NULL"),
    (ErrorKind::PluginDescriptor, "`id` is \"bad plug-in\""),
    (ErrorKind::PluginDescriptor, "`id` is \"ptl.more\""),
    (ErrorKind::PluginDescriptor, "`name` is not UTF-8 from byte 0"),
    (ErrorKind::PluginInit, "status 77"),
    (ErrorKind::PluginInit, "the licence server is on fire"),
    (ErrorKind::PluginDescriptor, "`blocks` is no array"),
    (ErrorKind::PluginDescriptor, "`blocks[0]` is NULL"),
    (ErrorKind::PluginDescriptor, "`blocks[0]` has a struct_size of 100"),
    (ErrorKind::PluginDescriptor, "\"bad.block\" once more"),
    (ErrorKind::PluginDescriptor, "`id` is \"other.block\""),
    (ErrorKind::PluginDescriptor, "`id` is \"bad.Block\""),
    (ErrorKind::PluginDescriptor, "\"bad.block\": `doc` says nothing"),
    (ErrorKind::PluginDescriptor, "`flags` is 0x80000000"),
    (ErrorKind::PluginDescriptor, "`shape` is 4"),
    (ErrorKind::PluginDescriptor, "`thread_mode` is 0"),
    (ErrorKind::PluginDescriptor, "`output_count` is 0"),
    (ErrorKind::PluginDescriptor, "`compute` is NULL"),
    (ErrorKind::PluginDescriptor, "`prepare` is NULL"),
    (ErrorKind::PluginDescriptor, "`shape` is POINT"),
    (ErrorKind::PluginDescriptor, "`shape` is GATHER"),
    (ErrorKind::PluginDescriptor, "`inputs[0]` has a struct_size of 8"),
    (ErrorKind::PluginDescriptor, "inputs[0]: `kind` is 99"),
    (ErrorKind::PluginDescriptor, "inputs[0]: `flags` is 0x40"),
    (ErrorKind::PluginDescriptor, "`inputs` has 10000 entries"),
    (ErrorKind::PluginDescriptor, "outputs[0]: `planes` is 2"),
    (ErrorKind::PluginDescriptor, "outputs[0]: `planes_input` is 5"),
    (ErrorKind::PluginDescriptor, "`outputs` may have 12 planes"),
    (ErrorKind::PluginDescriptor, "`outputs` other than images"),
    (ErrorKind::PluginDescriptor, "`params[0]` has a struct_size of 4096"),
    (ErrorKind::PluginDescriptor, "params[0]: `id` is NULL"),
    (ErrorKind::PluginDescriptor, "params[1]: `id` is \"size\" once more"),
    (ErrorKind::PluginDescriptor, "params[0]: `type` is 42"),
    (ErrorKind::PluginDescriptor, "params[0]: `min` to `max` is 9 to 8"),
    (ErrorKind::PluginDescriptor, "params[0]: `min` to `max` is NaN to 8"),
    (ErrorKind::PluginDescriptor, "`soft_min` to `soft_max` is -3 to 8"),
    (ErrorKind::PluginDescriptor, "params[0]: `default_value` is 11, allowed 0..=8"),
    (ErrorKind::PluginDescriptor, "params[0]: `min` is -0.5, allowed whole numbers"),
    (ErrorKind::PluginDescriptor, "`params` has 10000 entries, allowed 256"),
    (ErrorKind::PluginDescriptor, "`choice_ids` is no array, but its count is 2"),
    (ErrorKind::PluginDescriptor, "`choice_ids[1]` is NULL"),
    (ErrorKind::PluginDescriptor, "params[0]: `default_value` is 2, allowed 0..=1"),
];

#[test]
fn every_faulty_table_is_refused_with_a_word_on_what_is_wrong() {
    let name = |number: usize| format!("bad{number}");
    let Some(good) = build_with("bad", &name(0), &["-DBAD=0"]) else { return };
    Engine::new(EngineOptions::default()).load_plugin(&good).unwrap();
    for (number, (kind, said)) in (1..).zip(FAULTS) {
        let flag = format!("-DBAD={number}");
        let plugin = build_with("bad", &name(number), &[&flag]).unwrap();
        let error = refusal(&plugin);
        assert!(error.to_string().contains(said), "{number}: {error}");
        assert_eq!(error.kind(), kind, "{number}: {error}");
    }
}

#[test]
fn files_that_are_no_plugins_are_refused() {
    let Some(plugin) = build("points") else { return };
    let folder = folder().join("no plugins");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("folder.ptplugin.so")).unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let cases = [
        (file("garbage.ptplugin.so", b"\x7fELF and nothing more"), "cannot be loaded"),
        (file("empty.ptplugin.so", b""), "cannot be loaded"),
        (file("plugin.so", &fs::read(&plugin).unwrap()), "end with \".ptplugin.so\""),
        (folder.join("folder.ptplugin.so"), "no regular file"),
        (folder.join("nowhere.ptplugin.so"), "No such file"),
    ];
    for (path, said) in cases {
        let error = refusal(&path);
        assert!(error.to_string().contains(said), "{error}");
        assert_eq!(error.kind(), ErrorKind::PluginLoad, "{error}");
    }
    let dangling = folder.join("dangling.ptplugin.so");
    symlink(folder.join("not there"), &dangling).unwrap();
    assert_eq!(refusal(&dangling).kind(), ErrorKind::PluginLoad);

    let library = build_with("library", "library", &[]).unwrap();
    let error = refusal(&library);
    assert_eq!(error.kind(), ErrorKind::PluginSymbol, "{error}");
    assert!(error.to_string().contains("ptl_plugin_entry_v1"), "{error}");

    // A symbol that nobody has is missed when the file is loaded, not when it is called.
    let unresolved = build_with("library", "unresolved", &["-DUNRESOLVED"]).unwrap();
    let error = refusal(&unresolved);
    assert_eq!(error.kind(), ErrorKind::PluginLoad, "{error}");
    assert!(error.to_string().contains("nobody_has_this"), "{error}");
}

/// As after an update of one of both sides. The long comparison is for the log.
#[test]
fn a_root_module_of_another_layout_is_refused() {
    let library = rust_library("libptlib_test_layout.so", "layout");
    let engine = Engine::new(EngineOptions::default());
    let said = Arc::new(Mutex::new(Vec::<String>::new()));
    let heard = Arc::clone(&said);
    let log = move |_, message: &str| heard.lock().unwrap().push(message.to_owned());
    engine.set_log(Some((LogLevel::Debug, Arc::new(log))));
    let error = engine.load_plugin(&library).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::PluginLayout, "{error}");
    assert!(error.message().contains("layout.ptplugin.so: its tables are laid out"), "{error}");
    assert_eq!(error.to_string().lines().count(), 1, "{error}");
    assert!(error.hint().is_some_and(|hint| hint.contains("build it again")), "{error}");
    let details = said.lock().unwrap().join("\n");
    assert!(details.contains("entry") && details.lines().count() > 3, "{details}");
}

#[test]
fn a_file_that_cannot_be_read_is_refused() {
    let Some(plugin) = build("points") else { return };
    let folder = folder().join("unreadable");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    // Reading the first page of a process's memory fails, whoever does it.
    let memory = folder.join("memory.ptplugin.so");
    symlink("/proc/self/mem", &memory).unwrap();
    let error = refusal(&memory);
    assert_eq!(error.kind(), ErrorKind::PluginLoad, "{error}");
    assert!(error.to_string().contains("cannot be loaded"), "{error}");
    // This one only those may read who may read everything.
    let secret = folder.join("secret.ptplugin.so");
    fs::copy(&plugin, &secret).unwrap();
    fs::set_permissions(&secret, fs::Permissions::from_mode(0o000)).unwrap();
    if fs::File::open(&secret).is_err() {
        let error = refusal(&secret);
        assert_eq!(error.kind(), ErrorKind::PluginLoad, "{error}");
        assert!(error.to_string().contains("Permission denied"), "{error}");
    }
}

#[test]
fn a_scan_goes_on_and_tells_of_every_file() {
    let Some(plugin) = build("points") else { return };
    let folder = folder().join("scan");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("a-garbage.ptplugin.so"), b"no library").unwrap();
    fs::copy(&plugin, folder.join("b-points.ptplugin.so")).unwrap();
    fs::copy(&plugin, folder.join("c-same-blocks.ptplugin.so")).unwrap();
    fs::copy(rust_plugin(), folder.join("d-rust.ptplugin.so")).unwrap();
    fs::write(folder.join("readme.txt"), b"not opened").unwrap();
    let engine = Engine::new(EngineOptions::default());
    let mut found = Vec::new();
    let folders = [folder.join("not there"), folder.clone(), folder.clone()];
    engine.scan_plugins(&folders, &mut |scanned| {
        let name = scanned.path.file_name().unwrap().to_string_lossy().into_owned();
        found.push((
            name,
            scanned.outcome.as_ref().map(|info| info.id.clone()).map_err(Error::kind),
        ));
        true
    });
    let expected = [
        ("a-garbage.ptplugin.so", Err(ErrorKind::PluginLoad)),
        ("b-points.ptplugin.so", Ok("ptlib-test.points".to_owned())),
        ("c-same-blocks.ptplugin.so", Err(ErrorKind::PluginDuplicate)),
        ("d-rust.ptplugin.so", Ok("ptlib-rust".to_owned())),
    ];
    assert_eq!(found, expected.map(|(name, outcome)| (name.to_owned(), outcome)));
    let mut count = 0;
    Engine::new(EngineOptions::default()).scan_plugins(&[folder], &mut |_| {
        count += 1;
        false
    });
    assert_eq!(count, 1);
}
