//! `cargo xtask header`: makes `include/ptlib/ptlib.h` from `ptlib/src/ffi`.
//!
//! The header is committed, so that C programs need no Rust tool to be compiled, and `--check`
//! (and a test) fails when it is not what the sources give. cbindgen writes the declarations; the
//! rules at the top and the macros are in `header/top.h` and `header/bottom.h`.

use std::{fs, path::PathBuf};

use crate::{Result, repository};

/// The sources, in the order in which the header explains things.
const SOURCES: [&str; 20] = [
    "status",
    "types",
    "version",
    "error",
    "engine",
    "log",
    "plugin",
    "block_type",
    "graph",
    "graph_settings",
    "graph_edit",
    "graph_params",
    "compute",
    "job",
    "cancel",
    "image",
    "value",
    "value_view",
    "graph_values",
    "bytes",
];

const TOP: &str = include_str!("header/top.h");
const BOTTOM: &str = include_str!("header/bottom.h");

/// Columns of a line.
const WIDTH: usize = 100;

pub(crate) fn run(arguments: &[String]) -> Result {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        [] => Ok(fs::write(path(), generate()?)?),
        ["--check"] => check(),
        _ => Err("usage: cargo xtask header [--check]".into()),
    }
}

fn path() -> PathBuf {
    repository::root().join("include/ptlib/ptlib.h")
}

fn check() -> Result {
    let committed = fs::read_to_string(path())?.replace("\r\n", "\n");
    if committed == generate()? {
        return Ok(());
    }
    Err("include/ptlib/ptlib.h is not what ptlib/src/ffi gives: run `cargo xtask header`".into())
}

/// The header.
fn generate() -> Result<String> {
    let declarations = laid_out(&declarations()?);
    let version: Vec<&str> = repository::VERSION.split('.').collect();
    let [major, minor, patch] = version[..] else {
        return Err(format!("version {} has no three parts", repository::VERSION).into());
    };
    let top = TOP.replace("@MAJOR@", major).replace("@MINOR@", minor).replace("@PATCH@", patch);
    Ok(format!("{top}\n{}\n{BOTTOM}", declarations.trim_end()))
}

/// What cbindgen makes of the sources.
fn declarations() -> Result<String> {
    let config = cbindgen::Config {
        language: cbindgen::Language::C,
        style: cbindgen::Style::Both,
        no_includes: true,
        // Written by hand: cbindgen's are no C89.
        cpp_compat: false,
        include_version: false,
        usize_is_size_t: true,
        documentation: true,
        documentation_style: cbindgen::DocumentationStyle::Doxy,
        tab_width: 4,
        line_length: WIDTH,
        function: cbindgen::FunctionConfig {
            prefix: Some("PTL_API".to_owned()),
            must_use: Some("PTL_MUST_USE".to_owned()),
            ..Default::default()
        },
        ..Default::default()
    };
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(repository::root().join(format!("ptlib/src/ffi/{source}.rs")));
    }
    let mut text = Vec::new();
    builder.generate()?.write(&mut text);
    Ok(String::from_utf8(text)?)
}

/// The declarations with calling conventions, which cbindgen cannot place; functions are broken
/// into lines the same way everywhere, and a comment of one line takes one.
fn laid_out(declarations: &str) -> String {
    let mut text = String::new();
    let mut function: Option<String> = None;
    for line in short_comments(declarations).lines() {
        let line = if line.starts_with("typedef struct") {
            line.to_owned()
        } else {
            line.replace("struct ptl_", "ptl_")
                .replace("(*ptl_", "(PTL_CALL *ptl_")
                .replace("const ptlp_entry *", "const struct ptlp_entry *")
        };
        let starts = line.starts_with("PTL_MUST_USE") || line.starts_with("PTL_API");
        if starts || function.is_some() {
            let words = function.get_or_insert_default();
            words.extend([line.trim(), " "]);
            if line.ends_with(';') {
                text.push_str(&laid_out_function(words.trim_end()));
                function = None;
            }
        } else {
            text.push_str(&line);
            text.push('\n');
        }
    }
    text
}

fn short_comments(declarations: &str) -> String {
    let lines: Vec<&str> = declarations.lines().collect();
    let mut text = String::new();
    let mut rest = lines.as_slice();
    while let [line, behind @ ..] = rest {
        rest = behind;
        match behind {
            [only, end, behind @ ..] if line.trim() == "/**" && end.trim() == "*/" => {
                let only = only.trim().trim_start_matches("* ");
                text.push_str(&line.replace("/**", &format!("/** {only} */")));
                rest = behind;
            }
            _ => text.push_str(line),
        }
        text.push('\n');
    }
    text
}

/// One function: on one line if it fits, else one parameter a line.
fn laid_out_function(words: &str) -> String {
    let Some((head, parameters)) = words.split_once('(') else { return format!("{words}\n") };
    let (result, name) = match head.rfind(['*', ' ']) {
        Some(end) => head.split_at(end + 1),
        None => ("", head),
    };
    let separator = if result.ends_with('*') { "" } else { " " };
    let head = format!("{}{separator}PTL_CALL {name}", result.trim_end());
    let line = format!("{head}({parameters}");
    if line.len() <= WIDTH {
        return format!("{line}\n");
    }
    format!("{head}(\n    {}\n", parameters.replace(", ", ",\n    "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_header_is_what_the_sources_give() {
        check().unwrap();
    }

    #[test]
    fn functions_get_their_calling_convention() {
        assert_eq!(
            laid_out("PTL_API const ptl_a *ptl_f(void);\n"),
            "PTL_API const ptl_a *PTL_CALL ptl_f(void);\n"
        );
        assert_eq!(
            laid_out("PTL_API\nvoid ptl_f(int a,\n           int b);\n"),
            "PTL_API void PTL_CALL ptl_f(int a, int b);\n"
        );
        assert_eq!(laid_out("    /**\n     * A.\n     */\n"), "    /** A. */\n");
        let long = format!("PTL_API void ptl_f(int {}, int b);", "a".repeat(WIDTH));
        assert!(laid_out(&long).ends_with(",\n    int b);\n"));
    }
}
