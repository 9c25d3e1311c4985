//! `cargo xtask size`: how large the shared library is, and what each picture format adds to it.
//!
//! Each build is the library of `cargo xtask dist` without its symbols, with other features. Builds
//! have a folder of their own, so that they do not undo those of the other tasks; there are as many
//! as formats, and two more, each a minute or two. The table is written after each, so what was
//! measured is not lost if somebody has no patience.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::{
    Result, bench, dist,
    process::{self, cargo},
    repository,
};

/// The most bytes of the library with everything that `dist` builds: 6 MiB.
const MOST: u64 = 6 << 20;

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    let is_check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err("usage: cargo xtask size [--check]".into()),
    };
    let whole = built("formats")?;
    println!("{whole} bytes with all formats");
    if whole > MOST {
        return Err(format!("the library has {whole} bytes, allowed {MOST}").into());
    }
    if is_check {
        return Ok(());
    }
    let mut sizes = Sizes { whole, none: None, added: Vec::new() };
    sizes.write()?;
    let none = built("")?;
    println!("{none} bytes without formats");
    sizes.none = Some(none);
    for format in formats()? {
        let added = built(&format)?.saturating_sub(none);
        println!("{added} bytes for {format}");
        sizes.added.push((format, added));
        sizes.write()?;
    }
    Ok(())
}

/// What was measured.
struct Sizes {
    whole: u64,
    none: Option<u64>,
    /// Each format and what it adds.
    added: Vec<(String, u64)>,
}

/// The features that the feature `formats` of ptlib turns on.
fn formats() -> Result<Vec<String>> {
    let text = fs::read_to_string(repository::root().join("ptlib/Cargo.toml"))?;
    let list = text.split_once("\nformats = [").and_then(|(_, rest)| rest.split(']').next());
    let list = list.ok_or("ptlib has no feature `formats`")?;
    Ok(list.split(',').map(|word| word.trim().trim_matches('"').to_owned()).collect())
}

/// Builds the shared library with those features; returns its bytes.
fn built(features: &str) -> Result<u64> {
    let target = repository::target().join("size");
    let mut command = cargo();
    command.args(["rustc", "--locked", "--release", "-p", "ptlib", "--lib"]);
    command.args(["--crate-type", "cdylib", "--no-default-features", "--features", features]);
    command.arg("--target-dir").arg(&target).args(["--", "-Cstrip=symbols"]);
    process::output(&mut command)?;
    Ok(fs::metadata(library(&target)?)?.len())
}

fn library(target: &Path) -> Result<PathBuf> {
    let names = dist::Names::new(dist::Platform::here(), dist::abi_version()?);
    Ok(target.join("release").join(names.built_shared()))
}

impl Sizes {
    fn write(&self) -> Result {
        let page = repository::root().join(bench::PAGE);
        let text = fs::read_to_string(&page)?;
        Ok(fs::write(page, bench::fill(&text, "size", &self.table())?)?)
    }

    /// The table of the page.
    fn table(&self) -> String {
        let mut text = "| features | bytes |\n|---|---|\n".to_owned();
        if let Some(none) = self.none {
            text += &format!("| none | {} |\n", grouped(none));
        }
        for (format, added) in &self.added {
            text += &format!("| `{format}` | + {} |\n", grouped(*added));
        }
        text + &format!("| `formats`, the default: all of them | {} |\n", grouped(self.whole))
    }
}

/// A number with blanks between groups of three digits.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_a_table() {
        let added = vec![("png".to_owned(), 89_012)];
        let text = Sizes { whole: 4_000_000, none: Some(1_234_567), added }.table();
        assert!(text.contains("| none | 1 234 567 |\n| `png` | + 89 012 |\n"), "{text}");
        assert_eq!(grouped(12), "12");
    }

    #[test]
    fn every_format_is_a_feature_of_its_own() {
        let formats = formats().unwrap();
        assert!(formats.len() >= 9 && formats.contains(&"png".to_owned()), "{formats:?}");
    }
}
