//! Patterns of output file names: `out/{name}-{width}.png`.
//!
//! | placeholder | stands for |
//! |---|---|
//! | `{name}` | the graph file's name without folder and extension |
//! | `{folder}` | the graph file's folder as the command line gives it |
//! | `{block}` | the id of the rendered block in its file |
//! | `{width}`, `{height}` | the picture's size |
//! | `{seed}` | the seed that it is rendered with |
//!
//! `{{` and `}}` stand for braces. A name without placeholders is a pattern, too.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    str::FromStr,
};

/// A pattern of file names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Pattern(Vec<Piece>);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Piece {
    Literal(String),
    Placeholder(Placeholder),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Placeholder {
    Name,
    Folder,
    Block,
    Width,
    Height,
    Seed,
}

/// What the placeholders stand for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Picture<'a> {
    /// The graph file.
    pub(crate) graph: &'a Path,
    /// The id of the rendered block in it.
    pub(crate) block: &'a str,
    /// The picture's width and height.
    pub(crate) size: (u32, u32),
    /// The seed.
    pub(crate) seed: u64,
}

impl Placeholder {
    const ALL: [(&'static str, Self); 6] = [
        ("name", Self::Name),
        ("folder", Self::Folder),
        ("block", Self::Block),
        ("width", Self::Width),
        ("height", Self::Height),
        ("seed", Self::Seed),
    ];

    fn text(self, picture: &Picture<'_>) -> OsString {
        match self {
            Self::Name => picture.graph.file_stem().unwrap_or_default().to_owned(),
            Self::Folder => match picture.graph.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder.as_os_str().to_owned(),
                _ => ".".into(),
            },
            Self::Block => harmless(picture.block).into(),
            Self::Width => picture.size.0.to_string().into(),
            Self::Height => picture.size.1.to_string().into(),
            Self::Seed => picture.seed.to_string().into(),
        }
    }
}

/// An id from a graph file as a part of a file name. The file is not trusted: its ids must not
/// lead into other folders.
fn harmless(id: &str) -> String {
    let keep = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
    id.chars().map(|c| if keep(c) { c } else { '_' }).collect()
}

impl Pattern {
    /// The file name for a picture.
    pub(crate) fn path(&self, picture: &Picture<'_>) -> PathBuf {
        let mut path = OsString::new();
        for piece in &self.0 {
            match piece {
                Piece::Literal(text) => path.push(text),
                Piece::Placeholder(placeholder) => path.push(placeholder.text(picture)),
            }
        }
        path.into()
    }
}

impl FromStr for Pattern {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.is_empty() {
            return Err("a file name is not empty".to_owned());
        }
        let mut pieces = Vec::new();
        let mut literal = String::new();
        let mut rest = text;
        while let Some(brace) = rest.find(['{', '}']) {
            literal.push_str(&rest[..brace]);
            let after = &rest[brace + 1..];
            if after.starts_with(&rest[brace..=brace]) {
                literal.push_str(&rest[brace..=brace]);
                rest = &after[1..];
                continue;
            }
            let (placeholder, after) = placeholder(&rest[brace..])?;
            pieces.push(Piece::Literal(std::mem::take(&mut literal)));
            pieces.push(Piece::Placeholder(placeholder));
            rest = after;
        }
        literal.push_str(rest);
        pieces.push(Piece::Literal(literal));
        pieces.retain(|piece| *piece != Piece::Literal(String::new()));
        Ok(Self(pieces))
    }
}

/// The placeholder that `text` starts with, and what follows it.
fn placeholder(text: &str) -> Result<(Placeholder, &str), String> {
    let parts = text.strip_prefix('{').and_then(|text| text.split_once('}'));
    let Some((word, rest)) = parts else {
        return Err("a brace has no partner; write {{ or }} for a brace itself".to_owned());
    };
    match Placeholder::ALL.into_iter().find(|(known, _)| *known == word) {
        Some((_, placeholder)) => Ok((placeholder, rest)),
        None => {
            let known = Placeholder::ALL.map(|(known, _)| format!("{{{known}}}")).join(", ");
            Err(format!("there is no placeholder {{{word}}}, but {known}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(pattern: &str, graph: &str, block: &str) -> String {
        let picture = Picture { graph: Path::new(graph), block, size: (64, 32), seed: 7 };
        let path = pattern.parse::<Pattern>().unwrap().path(&picture);
        path.into_os_string().into_string().unwrap()
    }

    #[test]
    fn placeholders_stand_for_what_they_say() {
        assert_eq!(path("out/{name}.png", "a/lava.v2.xml", "3"), "out/lava.v2.png");
        assert_eq!(path("{folder}/{name}.png", "a/b/lava.xml", "3"), "a/b/lava.png");
        assert_eq!(path("{folder}/{name}.png", "lava.xml", "3"), "./lava.png");
        assert_eq!(path("{width}x{height} {seed} {block}", "lava", "3"), "64x32 7 3");
    }

    #[test]
    fn a_plain_name_stands_for_itself() {
        assert_eq!(path("lava 2.png", "x.xml", "3"), "lava 2.png");
        assert_eq!(path("{{{name}}}.png", "x.xml", "3"), "{x}.png");
    }

    #[test]
    fn ids_from_files_lead_nowhere() {
        assert_eq!(path("{block}.png", "x.xml", "../../etc/passwd"), "______etc_passwd.png");
        assert_eq!(path("{block}.png", "x.xml", "höhe 1"), "höhe_1.png");
    }

    #[test]
    fn wrong_patterns_are_refused() {
        let refusal = |pattern: &str| pattern.parse::<Pattern>().unwrap_err();
        assert!(refusal("{nam}.png").contains("{nam}, but {name}, {folder}"));
        for pattern in ["{name.png", "name}.png", "{", "}"] {
            assert!(refusal(pattern).contains("no partner"), "{pattern}");
        }
        assert!(refusal("").contains("not empty"));
    }
}
