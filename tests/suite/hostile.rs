//! Hostile files: each fails with its named error, or is read. Whatever is read is written again
//! without loss.
//!
//! `hostile/` has the files and `expected.txt`, what becomes of them; files that would be large are
//! made here. Nothing here looks at the clock: a file that takes too long would show in the time of
//! the suite.

use std::{collections::BTreeSet, fmt::Write, fs};

use ptlib::{ComputeOptions, Engine, EngineOptions, Error, Reading, io::write_graph};

use crate::picture::folder;

const ROOT: &str = "<texturegraph width=\"8\" height=\"8\" seed=\"0\" supersampling=\"1\"";

fn engine() -> Engine {
    Engine::new(EngineOptions { threads: 1, ..EngineOptions::default() })
}

/// Reads a file; whatever is read must survive writing and reading again.
fn read(xml: &[u8]) -> Result<Reading, Error> {
    let engine = engine();
    let reading = engine.read_graph(xml)?;
    let written = write_graph(&reading.graph);
    let again = engine.read_graph(written.as_bytes()).expect("what was written is readable");
    assert_eq!(write_graph(&again.graph), written);
    Ok(reading)
}

/// The kind of the outcome and all that was said.
fn outcome(xml: &[u8]) -> (String, String) {
    match read(xml) {
        Ok(reading) => {
            let warnings: Vec<_> = reading.warnings.iter().map(ToString::to_string).collect();
            ("ok".to_owned(), warnings.join("\n"))
        }
        Err(error) => (format!("{:?}", error.kind()), error.to_string()),
    }
}

#[test]
fn each_file_fails_with_its_named_error() {
    let folder = folder("hostile");
    let table = fs::read_to_string(folder.join("expected.txt")).unwrap();
    let mut listed = BTreeSet::from(["expected.txt".to_owned()]);
    let mut wrong = String::new();
    for line in table.lines().filter(|line| !line.starts_with('#')) {
        let [name, kind, text] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("expected.txt: three columns, not {line:?}")
        };
        listed.insert(name.to_owned());
        let (found, said) = outcome(&fs::read(folder.join(name)).unwrap());
        if found != kind || !said.contains(text) {
            writeln!(wrong, "{name}: expected {kind} and {text:?}, is {found}:\n{said}").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    let files = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name());
    let files: BTreeSet<_> = files.map(|name| name.into_string().unwrap()).collect();
    assert_eq!(files, listed, "files and table differ");
}

/// A file of `count` blocks of an unknown type, each with what `inputs` says.
fn many_blocks(count: usize, inputs: impl Fn(usize) -> String) -> Vec<u8> {
    let blocks: String =
        (0..count).map(|i| format!("<block type='?' id='{i}'>{}</block>", inputs(i))).collect();
    format!("{ROOT}>{blocks}</texturegraph>").into_bytes()
}

fn input(id: usize, slot: usize) -> String {
    format!("<input id='{id}' slot='{slot}'/>")
}

fn assert_outcome(xml: &[u8], kind: &str, text: &str) {
    let (found, said) = outcome(xml);
    assert_eq!(found, kind, "{said}");
    assert!(said.contains(text), "{said}");
}

#[test]
fn counts_have_limits() {
    assert_outcome(&many_blocks(10_001, |_| String::new()), "Limit", "more than 10000 blocks");
    let inputs = |_| (0..51).map(|_| input(0, 0)).collect();
    assert_outcome(&many_blocks(1000, inputs), "Limit", "more than 50000 connections");
    let long = format!("{ROOT} a='{}'/>", "x".repeat((1 << 20) + 1));
    assert_outcome(long.as_bytes(), "Limit", "a text has 1048577 bytes, allowed 1048576");
    let deep = format!("{ROOT}>{}", "<a>".repeat(1_000_000));
    assert_outcome(deep.as_bytes(), "Limit", "nested deeper than 16");
    let huge = vec![b' '; (16 << 20) + 1];
    assert_outcome(&huge, "Limit", "16777217 bytes, allowed 16777216");
}

#[test]
fn connections_in_a_malicious_order_are_read() {
    let count = 10_000;
    let connected = |inputs: &dyn Fn(usize) -> String| {
        let reading = read(&many_blocks(count, inputs)).unwrap();
        reading.graph.connections().count()
    };
    let chain = |i: usize| if i == 0 { String::new() } else { input(i - 1, 0) };
    assert_eq!(connected(&chain), count - 1);
    let backwards = |i: usize| if i + 1 < count { input(i + 1, 0) } else { String::new() };
    assert_eq!(connected(&backwards), count - 1);
    let ring = |i: usize| input((i + 1) % count, 0);
    assert_eq!(connected(&ring), count - 1);
    let tangle =
        |i: usize| (0..5).map(|slot| input((i * 7919 + slot * 31 + 1) % count, slot)).collect();
    assert_outcome(&many_blocks(count, tangle), "Limit", "more than 100 connections would close");
    let closing_again_and_again = |i: usize| match i {
        0 => String::new(),
        9_999 => (0..40_000).map(|_| input(0, 0)).collect(),
        _ => input(i - 1, 0),
    };
    assert_eq!(connected(&closing_again_and_again), count - 1);
    let closing_at_the_end = |i: usize| match i {
        0 => (0..40_000).map(|again| input(count - 1 - again % 5000, 0)).collect(),
        _ => input(i - 1, 0),
    };
    assert_eq!(connected(&closing_at_the_end), count - 1);
}

#[test]
fn many_of_everything_is_read() {
    let attributes: String = (0..400_000).map(|i| format!(" a{i}='&lt;'")).collect();
    assert_outcome(format!("{ROOT}{attributes}/>").as_bytes(), "ok", "");
    let parameter = "<parameter name='a' type='int' value='1'/>";
    let parameters = format!(
        "{ROOT}><block type='?' id='0'>{}</block></texturegraph>",
        parameter.repeat(100_000)
    );
    assert_outcome(parameters.as_bytes(), "ok", "");
    let twice = format!("{ROOT}{}/>", " a=''".repeat(400_000));
    assert_outcome(twice.as_bytes(), "Parse", "reading stopped after 100 faults");
    let stray = format!("{ROOT}>{}</texturegraph>", "x<!---->".repeat(400_000));
    assert_outcome(stray.as_bytes(), "ok", "399900 more warnings are not listed");
    let nonsense =
        format!("{ROOT}>{}</texturegraph>", "<block type='end' id='0' x=1/>\n".repeat(9000));
    assert_outcome(nonsense.as_bytes(), "Parse", "not in quotes");
}

/// What becomes of a readable file when all of its results are computed.
fn computed(body: &str, attributes: &str) -> (String, String) {
    let engine = engine();
    let root = format!("<texturegraph seed=\"0\" {attributes}>");
    let xml = format!("{root}{body}</texturegraph>");
    let mut graph = engine.read_graph(xml.as_bytes()).expect("the file is readable").graph;
    graph.set_folder(Some(folder("conformance/in")));
    match engine.compute_all(&graph, ComputeOptions::default()) {
        Ok(_) => ("ok".to_owned(), String::new()),
        Err(error) => (format!("{:?}", error.kind()), error.to_string()),
    }
}

#[test]
fn what_a_file_may_not_do_is_refused_when_it_is_computed() {
    let small = "width=\"8\" height=\"8\" supersampling=\"1\"";
    let load = |path: &str| {
        format!(
            "<block type=\"load file\" id=\"0\">\
             <parameter name=\"path\" type=\"string\" value=\"{path}\"/></block>\
             <block type=\"end\" id=\"1\"><input id=\"0\" slot=\"0\"/></block>"
        )
    };
    let save = "<block type=\"color fill\" id=\"0\"/><block type=\"save file\" id=\"1\">\
                <input id=\"0\" slot=\"0\"/>\
                <parameter name=\"path\" type=\"string\" value=\"stolen.png\"/></block>";
    let bumps = "<block type=\"bump noise\" id=\"0\">\
                 <parameter name=\"quantity\" type=\"int\" value=\"1000\"/></block>\
                 <block type=\"end\" id=\"1\"><input id=\"0\" slot=\"0\"/></block>";
    let huge = "width=\"65536\" height=\"65536\" supersampling=\"1\"";
    let sampled = "width=\"60000\" height=\"8\" supersampling=\"6\"";
    for (body, attributes, kind, text) in [
        (load("grey.png"), small, "ok", ""),
        (load("../perlin-1.png"), small, "Denied", "read_folders"),
        (load("/etc/passwd"), small, "Denied", "parameter \"path\""),
        (load("missing.png"), small, "Io", "missing.png"),
        (load("koch.txt"), small, "Unsupported", "koch.txt"),
        (load(""), small, "Denied", "parameter \"path\""),
        (save.to_owned(), small, "Denied", "write_folders"),
        (bumps.to_owned(), huge, "Limit", "MiB"),
        (bumps.to_owned(), sampled, "Limit", "360000"),
        (String::new(), small, "NotFound", "\"end\""),
        ("<block type=\"teapot\" id=\"0\"/>".to_owned(), small, "NotFound", "\"end\""),
        (
            "<block type=\"end\" id=\"7\"/>".to_owned(),
            small,
            "Unconnected",
            "block 7 (end): input 0",
        ),
    ] {
        let (found, said) = computed(&body, attributes);
        assert!(found == kind && said.contains(text), "{body}: {found}, not {kind}:\n{said}");
    }
}
