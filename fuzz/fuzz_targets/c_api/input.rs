//! From bytes to arguments.

use std::ffi::{CStr, CString, c_char};

/// Texts that mean something somewhere, and some that do nowhere.
const TEXTS: &[&CStr] = &[
    c"",
    c"0",
    c"1",
    c"-1",
    c"0.5",
    c"1e999",
    c"nan",
    c"-inf",
    c"true",
    c"false",
    c"4294967296",
    c"99999999999999999999",
    c"end",
    c"perlin noise",
    c"voronoi diagram",
    c"save file",
    c"F[+F]F",
    c"../../etc/passwd",
    c"\xff\xfe",
    c"\xc3\xa4\xf0\x9f\x8c\x8d",
    c"a\x01b",
    c"]]>&<",
];

const FLOATS: &[f64] = &[
    0.0,
    -0.0,
    0.5,
    1.0,
    -1.0,
    255.0,
    1e-310,
    1e30,
    1e300,
    f64::MAX,
    f64::MIN_POSITIVE,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

const INTEGERS: &[i64] = &[
    0,
    1,
    -1,
    2,
    3,
    6,
    255,
    256,
    65_536,
    i32::MAX as i64,
    i32::MIN as i64,
    u32::MAX as i64,
    i64::MAX,
    i64::MIN,
];

/// The bytes of a run. When they end, everything is 0.
pub(crate) struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.0.split_off_first().copied().unwrap_or_default()
    }

    pub(crate) fn bytes(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(count.min(self.0.len()));
        self.0 = rest;
        taken
    }

    /// A number less than `end`, which is 1 to 256.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    /// `true` once in `times`.
    pub(crate) fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == times - 1
    }

    pub(crate) fn of<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    pub(crate) fn raw(&mut self) -> u64 {
        self.bytes(8).iter().fold(0, |number, byte| number << 8 | u64::from(*byte))
    }

    pub(crate) fn float(&mut self) -> f64 {
        match self.below(3) {
            0 => self.of(FLOATS),
            1 => f64::from(self.byte()) / 16.0,
            _ => f64::from_bits(self.raw()),
        }
    }

    pub(crate) fn integer(&mut self) -> i64 {
        match self.below(3) {
            0 => self.of(INTEGERS),
            1 => self.byte().into(),
            _ => self.raw().cast_signed(),
        }
    }

    /// A number of a port, a parameter, an item: mostly small.
    pub(crate) fn index(&mut self) -> u32 {
        match self.byte() {
            255 => u32::MAX,
            byte => u32::from(byte) % 12,
        }
    }

    /// A text, or NULL.
    pub(crate) fn text(&mut self) -> Text {
        Text(match self.below(8) {
            0 => None,
            1 => {
                let count = self.below(64);
                let bytes = self.bytes(count);
                let until_nul = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
                CString::new(until_nul).ok()
            }
            2..6 => Some(self.of(TEXTS).to_owned()),
            _ => Some(c"perlin noise".to_owned()),
        })
    }
}

/// A text for a call, or NULL.
pub(crate) struct Text(pub(crate) Option<CString>);

impl Text {
    pub(crate) fn as_ptr(&self) -> *const c_char {
        self.0.as_ref().map_or(std::ptr::null(), |text| text.as_ptr())
    }
}
