//! `cargo xtask guide`: does what CONTRIBUTING.md says, in a scratch copy of the repository.
//!
//! Comments in CONTRIBUTING.md say what the text below them is:
//!
//! - `<!-- replay: write PATH -->`: the next code block is that file,
//! - `<!-- replay: add WORD to PATH -->`: the word joins the list of the family in that file,
//! - `<!-- replay: run -->`: the next code block is commands, one a line,
//! - `<!-- replay: expect PATH -->`: that file is there afterwards, and not empty.

use std::{fs, path::Path};

use crate::{
    Result,
    process::{self, cargo, empty_folder},
    repository,
};

/// One thing that the text says to do.
#[derive(Debug, PartialEq, Eq)]
enum Action {
    Write { path: String, text: String },
    Add { word: String, path: String },
    Run { command: String },
    Expect { path: String },
}

/// The command.
pub(crate) fn run(arguments: &[String]) -> Result {
    if !arguments.is_empty() {
        return Err("usage: cargo xtask guide".into());
    }
    let root = repository::root();
    let actions = read(&fs::read_to_string(root.join("CONTRIBUTING.md"))?)?;
    let copy = repository::target().join("guide");
    empty_folder(&copy)?;
    for file in repository::files(&root)? {
        write(&copy.join(&file), &fs::read(root.join(&file))?)?;
    }
    for action in &actions {
        perform(action, &copy)?;
    }
    Ok(())
}

/// What the text says to do, in its order.
fn read(text: &str) -> Result<Vec<Action>> {
    let mut actions = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some(order) = line.strip_prefix("<!-- replay: ") else { continue };
        let order = order.strip_suffix(" -->").ok_or("a replay comment ends in -->")?;
        match order.split(' ').collect::<Vec<_>>()[..] {
            ["write", path] => {
                let text = block(&mut lines)?;
                actions.push(Action::Write { path: path.to_owned(), text });
            }
            ["add", word, "to", path] => {
                actions.push(Action::Add { word: word.to_owned(), path: path.to_owned() });
            }
            ["run"] => {
                let commands = block(&mut lines)?;
                let commands = commands.lines().map(str::to_owned);
                actions.extend(commands.map(|command| Action::Run { command }));
            }
            ["expect", path] => actions.push(Action::Expect { path: path.to_owned() }),
            _ => return Err(format!("no such replay comment: {line}").into()),
        }
    }
    if actions.is_empty() { Err("there is nothing to replay".into()) } else { Ok(actions) }
}

/// The contents of the next code block.
fn block<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Result<String> {
    let mut text = String::new();
    lines.by_ref().find(|line| line.starts_with("```")).ok_or("a code block is missing")?;
    for line in lines {
        if line == "```" {
            return Ok(text);
        }
        text.push_str(line);
        text.push('\n');
    }
    Err("a code block does not end".into())
}

fn perform(action: &Action, copy: &Path) -> Result {
    match action {
        Action::Write { path, text } => {
            let path = copy.join(path);
            if path.exists() {
                let message = format!("{} is in the repository: take another", path.display());
                return Err(message.into());
            }
            write(&path, text.as_bytes())
        }
        Action::Add { word, path } => {
            let path = copy.join(path);
            let text = add(&fs::read_to_string(&path)?, word)?;
            write(&path, text.as_bytes())
        }
        Action::Run { command } => execute(command, copy),
        Action::Expect { path } => match fs::metadata(copy.join(path)) {
            Ok(file) if file.len() > 0 => Ok(()),
            _ => Err(format!("{path} is missing or empty").into()),
        },
    }
}

/// The family's file with a word more in its list.
fn add(text: &str, word: &str) -> Result<String> {
    let start = text.find("family!(").ok_or("the file has no family! list")?;
    let end = start + text[start..].find(')').ok_or("the family! list does not end")?;
    let list = text[..end].trim_end().trim_end_matches(',');
    Ok(format!("{list}, {word}{}", &text[end..]))
}

/// Runs a line such as `NAME=value cargo test …` in the copy.
fn execute(line: &str, copy: &Path) -> Result {
    println!("$ {line}");
    let mut cargo = cargo();
    // Not the folder of the repository: cargo tells packages apart by their path in the workspace,
    // so it would take the copy's libraries for the repository's.
    cargo.current_dir(copy).env("CARGO_TARGET_DIR", repository::target().join("guide-build"));
    let mut words = line.split_whitespace();
    for word in words.by_ref() {
        match word.split_once('=') {
            Some((name, value)) => cargo.env(name, value),
            None if word == "cargo" => break,
            None => return Err(format!("only cargo commands are replayed, not `{line}`").into()),
        };
    }
    let is_test = line.contains("cargo test");
    let output = process::output(cargo.args(words))?;
    if is_test && !output.contains(" ... ok\n") {
        return Err(format!("`{line}` ran no test:\n{output}").into());
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result {
    fs::create_dir_all(path.parent().ok_or("a file lies in a folder")?)?;
    Ok(fs::write(path, bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_says_what_to_do() {
        let text = "# Guide\n<!-- replay: write a/b.rs -->\n```rust\nfn f() {}\n\n// x\n```\n\
                    <!-- replay: add b to a/mod.rs -->\nwords\n\n<!-- replay: run -->\nmore words\n\
                    ```sh\ncargo a\ncargo b\n```\n<!-- replay: expect c.png -->\n";
        let actions = read(text).unwrap();
        let run = |command: &str| Action::Run { command: command.to_owned() };
        let path = |path: &str| path.to_owned();
        assert_eq!(
            actions,
            [
                Action::Write { path: path("a/b.rs"), text: "fn f() {}\n\n// x\n".to_owned() },
                Action::Add { word: "b".to_owned(), path: path("a/mod.rs") },
                run("cargo a"),
                run("cargo b"),
                Action::Expect { path: path("c.png") },
            ]
        );
    }

    #[test]
    fn a_broken_guide_is_no_success() {
        assert!(read("# Guide\n").is_err());
        assert!(read("<!-- replay: dance -->\n").is_err());
        assert!(read("<!-- replay: run -->\n```sh\ncargo a\n").is_err());
    }

    #[test]
    fn a_word_joins_the_list() {
        let text = "//! x\n\ncrate::family!(\"a\": b, c);\n";
        assert_eq!(add(text, "d").unwrap(), "//! x\n\ncrate::family!(\"a\": b, c, d);\n");
        let text = "crate::family!(\n    \"a\": b,\n    c,\n);\n";
        assert_eq!(add(text, "d").unwrap(), "crate::family!(\n    \"a\": b,\n    c, d);\n");
        assert!(add("mod b;", "d").is_err());
    }
}
