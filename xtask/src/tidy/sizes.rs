//! How long files, functions and lines may be.

use super::{
    Fault, Rule,
    source::{Source, closing},
};

/// A limit that fails, and a lower one that is only told of on request.
struct Limit {
    soft: usize,
    hard: usize,
}

const BLOCK_FILE: Limit = Limit { soft: 120, hard: 200 };
const FILE: Limit = Limit { soft: 400, hard: 600 };
const FUNCTION: Limit = Limit { soft: 40, hard: 70 };
const PARAMETERS: Limit = Limit { soft: 5, hard: 5 };
const MACRO: Limit = Limit { soft: 60, hard: 60 };
/// rustfmt keeps code at 100 columns; this is for what it leaves alone: texts, comments, macros.
const LINE: Limit = Limit { soft: 100, hard: 110 };

/// The macros that the house style knows; another one needs a reason.
const MACROS: [&str; 4] = ["params", "choice", "family", "pt_fn"];

impl Limit {
    /// The fault of being over the limit, soft or hard.
    fn check(&self, value: usize, what: &str) -> Option<(bool, String)> {
        let is_hard = value > self.hard;
        let limit = if is_hard { self.hard } else { self.soft };
        (value > limit).then(|| (is_hard, format!("{value} {what}, allowed {limit}")))
    }
}

/// Lines that are too long. The rows of a table in a comment cannot be broken.
pub(super) fn lines(path: &str, text: &str) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let is_table = line.trim_start_matches(['/', '!', '*', ' ']).starts_with("| ");
        if let Some((is_hard, message)) = LINE.check(line.chars().count(), "columns")
            && !is_table
        {
            let fault = Fault::new(Rule::LineLength, path, number + 1, "", message);
            faults.push(fault.soft_unless(is_hard));
        }
    }
    faults
}

/// Files that are too long. Tests beside the code do not count.
pub(super) fn file(source: &Source) -> Vec<Fault> {
    let is_block = is_block(&source.path);
    let limit = if is_block { BLOCK_FILE } else { FILE };
    let over = limit.check(source.lines_without_tests(), "lines without tests");
    let fault = over.map(|(is_hard, message)| {
        Fault::new(Rule::FileLength, &source.path, 1, "", message).soft_unless(is_hard)
    });
    fault.into_iter().collect()
}

/// Whether a file is a block's: `ptlib/src/blocks/FAMILY/BLOCK.rs`. What several blocks share lies
/// deeper.
fn is_block(path: &str) -> bool {
    path.strip_prefix("ptlib/src/blocks/").is_some_and(|rest| rest.matches('/').count() == 1)
}

/// Functions that are too long or take too much. Tests count as well.
pub(super) fn functions(source: &Source) -> Vec<Fault> {
    let mut faults = Vec::new();
    for at in source.words("fn") {
        let Some(function) = function(source, at) else { continue };
        let fault = |rule, over: Option<(bool, String)>| {
            over.map(|(is_hard, message)| {
                let line = source.line(at);
                Fault::new(rule, &source.path, line, function.name, message).soft_unless(is_hard)
            })
        };
        let length = FUNCTION.check(function.lines, "lines");
        faults.extend(fault(Rule::FunctionLength, length));
        // The C ABI decides what its functions take.
        if !source.code[..at].trim_end().ends_with("extern") {
            let parameters = PARAMETERS.check(function.parameters, "parameters");
            faults.extend(fault(Rule::Parameters, parameters));
        }
    }
    faults
}

/// Macros that are too long or that nobody knows. Tests may have others.
pub(super) fn macros(source: &Source) -> Vec<Fault> {
    let mut faults = Vec::new();
    for at in source.words("macro_rules").into_iter().filter(|at| !source.is_test(*at)) {
        let rest = &source.code[at..];
        let Some(open) = rest.find('{') else { continue };
        let name = rest["macro_rules".len()..open].trim_matches(|c: char| c == '!' || c == ' ');
        let line = source.line(at);
        let mut fault =
            |message| faults.push(Fault::new(Rule::Macro, &source.path, line, name, message));
        if !MACROS.contains(&name) {
            fault(format!("macros are {} only", MACROS.join(", ")));
        }
        let lines = source.line(closing(&source.code, at + open)) - line + 1;
        if let Some((_, message)) = MACRO.check(lines, "lines") {
            fault(message);
        }
    }
    faults
}

struct Function<'a> {
    name: &'a str,
    parameters: usize,
    lines: usize,
}

/// The function whose `fn` is at that place; none for a type such as `fn(u8) -> u8`.
fn function(source: &Source, at: usize) -> Option<Function<'_>> {
    let code = &source.code;
    let start = at + "fn".len();
    let start = start + code[start..].find(|c: char| c != ' ')?;
    let length = code[start..].find(|c: char| !c.is_alphanumeric() && c != '_')?;
    if length == 0 {
        return None;
    }
    let open = parameter_list(code, start + length)?;
    let close = closing(code, open);
    let end = close + code.get(close..)?.find(['{', ';'])?;
    let end = if code.as_bytes()[end] == b'{' { closing(code, end) } else { end };
    Some(Function {
        name: &code[start..start + length],
        parameters: parameters(code.get(open + 1..close)?),
        lines: source.line(end) - source.line(at) + 1,
    })
}

/// The place of the bracket that opens the parameter list: behind the generics.
fn parameter_list(code: &str, from: usize) -> Option<usize> {
    let bytes = code.as_bytes();
    let mut angles = 0_usize;
    for at in from..bytes.len() {
        match bytes[at] {
            b'<' => angles += 1,
            b'>' if bytes[at - 1] != b'-' => angles = angles.checked_sub(1)?,
            b'(' if angles == 0 => return Some(at),
            b'{' | b';' if angles == 0 => return None,
            _ => {}
        }
    }
    None
}

/// The number of parameters of a list, `self` not counted.
fn parameters(list: &str) -> usize {
    let mut depth = 0_i32;
    let mut before = ' ';
    let mut parts = vec![String::new()];
    for c in list.chars() {
        match c {
            '(' | '[' | '{' | '<' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            '>' if before != '-' => depth -= 1,
            _ => {}
        }
        before = c;
        match parts.last_mut() {
            Some(part) if c != ',' || depth != 0 => part.push(c),
            _ => parts.push(String::new()),
        }
    }
    let is_self = |part: &str| {
        let part = part.split(':').next().unwrap_or("");
        part.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == "self")
    };
    parts.iter().filter(|part| !part.trim().is_empty() && !is_self(part)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source::new("ptlib/src/blocks/a/b.rs", text)
    }

    fn function_of(lines: usize) -> String {
        format!("fn long() {{\n{}}}\n", "    work();\n".repeat(lines - 2))
    }

    #[test]
    fn a_long_line_is_found_with_its_number() {
        let text = format!("{}\n{}\n//! | {}", "ä".repeat(100), "x".repeat(111), "x".repeat(120));
        let faults = lines("a.rs", &text);
        assert_eq!(faults.len(), 1);
        assert_eq!((faults[0].line, faults[0].is_soft), (2, false));
        assert!(lines("a.rs", &"x".repeat(101))[0].is_soft);
    }

    #[test]
    fn a_function_may_have_seventy_lines() {
        assert!(functions(&source(&function_of(40))).is_empty());
        assert!(functions(&source(&function_of(70)))[0].is_soft);
        let faults = functions(&source(&function_of(71)));
        assert_eq!((faults[0].item.as_str(), faults[0].is_soft), ("long", false));
        assert_eq!(faults[0].message, "71 lines, allowed 70");
    }

    #[test]
    fn parameters_are_counted_behind_generics_and_without_self() {
        let five = "fn f<F: Fn(u8, u8) -> u8, T>(&mut self, a: (u8, u8), b: F, c: [u8; 2], \
                    d: Map<u8, u8>, e: &'a dyn Fn(u8, u8) -> u8,) -> u8;";
        assert!(functions(&source(five)).is_empty());
        let six = "impl X { fn f(self: &Arc<Self>, a: A, b: B, c: C, d: D, e: E, f: F) {} }";
        assert_eq!(functions(&source(six))[0].message, "6 parameters, allowed 5");
        let c = "pub extern \"C\" fn f(a: A, b: B, c: C, d: D, e: E, f: F) {}";
        assert!(functions(&source(c)).is_empty());
        assert!(functions(&source("type F = fn(A, B, C, D, E, F) -> G;")).is_empty());
    }

    #[test]
    fn a_block_file_is_shorter_than_others() {
        let text = "// x\n".repeat(201);
        assert_eq!(file(&source(&text))[0].message, "201 lines without tests, allowed 200");
        assert!(file(&Source::new("ptlib/src/run/plan.rs", &text)).is_empty());
        assert!(file(&Source::new("ptlib/src/blocks/a/shared/b.rs", &text)).is_empty());
        let faults = file(&Source::new("ptlib/src/run/plan.rs", &"// x\n".repeat(401)));
        assert!(faults[0].is_soft);
    }

    #[test]
    fn macros_are_few_and_short() {
        let text = format!("macro_rules! family {{\n{}}}", "() => {};\n".repeat(58));
        assert!(macros(&source(&text)).is_empty());
        let text = format!("macro_rules! family {{\n{}}}", "() => {};\n".repeat(59));
        assert_eq!(macros(&source(&text))[0].message, "61 lines, allowed 60");
        assert_eq!(macros(&source("macro_rules! magic { () => {} }"))[0].item, "magic");
        let text = "#[cfg(test)]\nmod tests { macro_rules! magic { () => {} } }";
        assert!(macros(&source(text)).is_empty());
        assert!(macros(&Source::new("ptlib/src/io/tests/a.rs", "macro_rules! b {}")).is_empty());
    }
}
