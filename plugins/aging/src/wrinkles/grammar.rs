//! Reads files of muscles.
//!
//! A file is text: `!` starts a muscle, `key=value` says what it is like, and `#` starts a comment,
//! up to the end of the line. Blanks and tabs may stand between any two of these, and commands in
//! lines as one likes. Keys are read in upper and lower case.
//!
//! | key | value | what |
//! |---|---|---|
//! | `ma`, `mb` | two numbers with `;` between, each -1 to 2; mandatory | where its fibre starts and ends, in texture coordinates |
//! | `n` | digits, 1 to 1024; mandatory | wrinkles along it |
//! | `relwidth` | above 0.000001, up to 1; else 0.5 | half of its width, in lengths of the fibre |
//! | `maxangle` | 1 to 2; else 1.25 | how far wrinkles go round its end, in right angles |
//! | `omegalow` | 0 to 1; else 0.5 | how many of its wrinkles are left at its rim |
//! | `amplitude` | 0 to 4; else 1 | how high it is |
//!
//! [`parse`] tells all faults, not the first one. It never panics, whatever the bytes are.

use std::cmp::Reverse;

use super::scan::{Line, is_blank, lines, number_length};

use super::faults::quoted;
pub use super::faults::{Fault, Faults};

/// A muscle as its file describes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Muscle {
    /// Where its fibre starts, in texture coordinates.
    pub from: [f64; 2],
    /// Where its fibre ends.
    pub to: [f64; 2],
    /// Wrinkles along the fibre: a whole number.
    pub wrinkles: f64,
    /// Half of its width, in lengths of the fibre.
    pub width: f64,
    /// How far wrinkles go round the end of the fibre, in right angles.
    pub max_angle: f64,
    /// The part of its wrinkles that is left at the rim.
    pub low: f64,
    /// How high the wrinkles are.
    pub amplitude: f64,
}

impl Muscle {
    /// All that it is, as bits: the canonical order of muscles is the order of these.
    pub(super) fn bits(&self) -> [u64; 9] {
        let Self { from, to, wrinkles, width, max_angle, low, amplitude } = *self;
        let fields = [from[0], from[1], to[0], to[1], wrinkles, width, max_angle, low, amplitude];
        fields.map(f64::to_bits)
    }
}

/// How large a file may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The most muscles.
    pub muscles: usize,
    /// The most bytes.
    pub bytes: usize,
    /// The most bytes of a line, its comment included.
    pub line_bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { muscles: 4096, bytes: 1 << 20, line_bytes: 4096 }
    }
}

/// What the value of a key looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Point,
    Digits,
    Number,
}

struct Key {
    name: &'static str,
    form: Form,
    low: f64,
    high: f64,
    /// What is allowed, in words.
    allowed: &'static str,
}

const fn key(name: &'static str, form: Form, [low, high]: [f64; 2], allowed: &'static str) -> Key {
    Key { name, form, low, high, allowed }
}

const MA: usize = 0;
const MB: usize = 1;
const N: usize = 2;
const WIDTH: usize = 3;
const MAX_ANGLE: usize = 4;
const LOW: usize = 5;
const AMPLITUDE: usize = 6;

const KEYS: [Key; 7] = [
    key("ma", Form::Point, [-1.0, 2.0], "-1 to 2"),
    key("mb", Form::Point, [-1.0, 2.0], "-1 to 2"),
    key("n", Form::Digits, [1.0, 1024.0], "1 to 1024"),
    key("relwidth", Form::Number, [WIDTH_ABOVE, 1.0], "above 0.000001, up to 1"),
    key("maxangle", Form::Number, [1.0, 2.0], "1 to 2"),
    key("omegalow", Form::Number, [0.0, 1.0], "0 to 1"),
    key("amplitude", Form::Number, [0.0, 4.0], "0 to 4"),
];

/// Widths are greater than this.
const WIDTH_ABOVE: f64 = 1e-6;

/// The shortest fibre, in texture coordinates.
const SHORTEST: f64 = 1e-6;

/// Keys without which a muscle is none.
const MANDATORY: [usize; 3] = [MA, MB, N];

/// A muscle that is being read.
struct Draft {
    /// Where its `!` stands.
    place: [usize; 2],
    /// The keys that were there, with or without a fault.
    is_set: [bool; KEYS.len()],
    values: [[f64; 2]; KEYS.len()],
    is_good: bool,
}

/// Reads the muscles of a file, in canonical order: that of the file does not matter.
///
/// # Errors
/// All faults of the file.
pub fn parse(text: &[u8], limits: &Limits) -> Result<Vec<Muscle>, Faults> {
    let mut reader = Reader { limits, draft: None, muscles: vec![], faults: Faults::default() };
    reader.read(text);
    if reader.faults.count() > 0 {
        reader.faults.sort();
        return Err(reader.faults);
    }
    reader.muscles.sort_by_key(Muscle::bits);
    Ok(reader.muscles)
}

struct Reader<'a> {
    limits: &'a Limits,
    draft: Option<Draft>,
    muscles: Vec<Muscle>,
    faults: Faults,
}

impl Reader<'_> {
    fn read(&mut self, text: &[u8]) {
        let Limits { bytes, line_bytes, .. } = *self.limits;
        if text.len() > bytes {
            let what = format!("the file has {} bytes, allowed are {bytes}", text.len());
            return self.faults.add_limit([1, 1], what);
        }
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        for (line, number) in lines(text).zip(1..) {
            if line.len() > line_bytes {
                let what = format!("the line has {} bytes, allowed are {line_bytes}", line.len());
                self.faults.add_limit([number, 1], what);
            } else {
                self.read_line(Line::new(line, number));
            }
        }
        self.finish_muscle();
    }

    fn read_line(&mut self, mut line: Line<'_>) {
        loop {
            line.skip_blanks();
            let place = line.place();
            match line.peek() {
                None => return,
                Some(b'!') => {
                    line.take(b'!');
                    self.begin_muscle(place);
                }
                Some(byte) if byte.is_ascii_alphabetic() => self.read_pair(&mut line),
                Some(_) => {
                    let piece = line.take_while(|byte| !is_blank(byte) && byte != b'!');
                    let what = "is no command; allowed are `!` and `key=value`";
                    self.faults.add(place, format!("{} {what}", quoted(piece)));
                }
            }
        }
    }

    /// Reads `key=value`.
    fn read_pair(&mut self, line: &mut Line<'_>) {
        let place = line.place();
        let word = line.take_while(|byte| byte.is_ascii_alphanumeric() || b"_-".contains(&byte));
        let found = find(word);
        if found.is_none() {
            let (nearest, shown) = (nearest(word), quoted(word));
            let what = format!("unknown key {shown}, is it `{nearest}`? Known are {}", known());
            self.faults.add(place, what);
        }
        if !line.take(b'=') {
            if found.is_some() {
                let what = format!("`=` and a value must follow {}", quoted(word));
                self.faults.add(line.place(), what);
            }
            line.take_while(|byte| !is_blank(byte) && byte != b'!');
            return;
        }
        let Some(number) = found else { return skip_value(line) };
        let value = self.read_value(line, number);
        let name = KEYS[number].name;
        let Some(draft) = &mut self.draft else {
            return self.faults.add(place, format!("`{name}` stands before the first `!`"));
        };
        if draft.is_set[number] {
            return self.faults.add(place, format!("`{name}` is given twice in one muscle"));
        }
        draft.is_set[number] = true;
        draft.is_good &= value.is_some();
        draft.values[number] = value.unwrap_or_default();
    }

    /// Reads the value of a key; none if it has a fault.
    fn read_value(&mut self, line: &mut Line<'_>, number: usize) -> Option<[f64; 2]> {
        let first = self.read_number(line, number);
        if KEYS[number].form != Form::Point {
            return Some([first?, 0.0]);
        }
        if !line.take(b';') {
            if first.is_some() {
                let what = "needs two numbers with `;` between, such as 0.3;0.75";
                self.faults.add(line.place(), format!("`{}` {what}", KEYS[number].name));
            }
            return None;
        }
        let second = self.read_number(line, number);
        Some([first?, second?])
    }

    /// Reads a number and looks whether the key allows it.
    fn read_number(&mut self, line: &mut Line<'_>, number: usize) -> Option<f64> {
        let Key { name, form, low, high, allowed } = KEYS[number];
        line.skip_blanks();
        let place = line.place();
        let piece = line.take_while(|byte| !is_blank(byte) && !b";!=".contains(&byte));
        let digits = piece.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let length = if form == Form::Digits { digits } else { number_length(piece) };
        let (number, rest) = piece.split_at_checked(length).unwrap_or_default();
        // A key may follow without a blank.
        let is_whole = length > 0 && (rest.is_empty() || find(rest).is_some());
        let value = str::from_utf8(number).ok().and_then(|text| text.parse::<f64>().ok());
        let Some(value) = value.filter(|_| is_whole) else {
            let what = if piece.is_empty() { "nothing".to_owned() } else { quoted(piece) };
            let hint = hint(piece, form);
            let what = format!("the value of `{name}` is {what}, allowed is {hint} {allowed}");
            self.faults.add(place, what);
            return None;
        };
        line.step_back(rest.len());
        let is_allowed = (low..=high).contains(&value) && !(name == "relwidth" && value == low);
        if !is_allowed {
            let what = format!("`{name}` is {}, allowed is {allowed}", quoted(number));
            self.faults.add(place, what);
        }
        // Not -0, whose bits are not those of 0.
        is_allowed.then_some(value + 0.0)
    }

    fn begin_muscle(&mut self, place: [usize; 2]) {
        self.finish_muscle();
        let mut values = [[0.0; 2]; KEYS.len()];
        for (key, value) in [(WIDTH, 0.5), (MAX_ANGLE, 1.25), (LOW, 0.5), (AMPLITUDE, 1.0)] {
            values[key][0] = value;
        }
        let is_set = [false; KEYS.len()];
        self.draft = Some(Draft { place, is_set, values, is_good: true });
    }

    fn finish_muscle(&mut self) {
        let Some(Draft { place, is_set, values, is_good }) = self.draft.take() else { return };
        for key in MANDATORY.into_iter().filter(|key| !is_set[*key]) {
            self.faults.add(place, format!("the muscle has no `{}`", KEYS[key].name));
        }
        if !is_good || MANDATORY.into_iter().any(|key| !is_set[key]) {
            return;
        }
        let [from, to] = [values[MA], values[MB]];
        let across = [to[0] - from[0], to[1] - from[1]];
        if (across[0] * across[0] + across[1] * across[1]).sqrt() < SHORTEST {
            let what = "`ma` and `mb` are the same place, allowed is a distance from 0.000001 on";
            return self.faults.add(place, what.to_owned());
        }
        if self.muscles.len() == self.limits.muscles {
            let what = format!("too many muscles, allowed are {}", self.limits.muscles);
            self.faults.add_limit(place, what);
        }
        let [wrinkles, width, max_angle, low, amplitude] =
            [N, WIDTH, MAX_ANGLE, LOW, AMPLITUDE].map(|key| values[key][0]);
        self.muscles.push(Muscle { from, to, wrinkles, width, max_angle, low, amplitude });
    }
}

/// The key of that name, whatever the case of its letters.
fn find(word: &[u8]) -> Option<usize> {
    KEYS.iter().position(|key| key.name.as_bytes().eq_ignore_ascii_case(word))
}

/// The names of all keys.
fn known() -> String {
    KEYS.map(|key| format!("`{}`", key.name)).join(", ")
}

/// The key that a word is most like: the fewest letters to add, to take away or to change.
fn nearest(word: &[u8]) -> &'static str {
    let distance = |key: &Key| {
        let name = key.name.as_bytes();
        let mut row: Vec<usize> = (0..=name.len()).collect();
        for (letter, line) in word.iter().zip(1..) {
            let mut diagonal = row[0];
            row[0] = line;
            for (column, other) in name.iter().enumerate() {
                let change = diagonal + usize::from(!letter.eq_ignore_ascii_case(other));
                diagonal = row[column + 1];
                row[column + 1] = change.min(diagonal + 1).min(row[column] + 1);
            }
        }
        row[name.len()]
    };
    // Of several, the one that starts alike.
    let alike = |key: &Key| {
        let pairs = key.name.as_bytes().iter().zip(word);
        pairs.take_while(|(one, other)| one.eq_ignore_ascii_case(other)).count()
    };
    let nearest = KEYS.iter().min_by_key(|key| (distance(key), Reverse(alike(key))));
    nearest.map_or("", |key| key.name)
}

/// Reads what is probably the value of an unknown key.
fn skip_value(line: &mut Line<'_>) {
    for _ in 0..2 {
        line.skip_blanks();
        line.take_while(|byte| !is_blank(byte) && !b";!=".contains(&byte));
        if !line.take(b';') {
            break;
        }
    }
}

/// What is allowed where something else stands.
fn hint(piece: &[u8], form: Form) -> &'static str {
    let is_decimal = |pair: &[u8]| pair[0] == b',' && pair[1].is_ascii_digit();
    match form {
        Form::Digits => "a whole number, only digits,",
        _ if piece.windows(2).any(is_decimal) => "a number (use a point, not a comma)",
        Form::Point | Form::Number => "a number",
    }
}

#[cfg(test)]
mod tests;
