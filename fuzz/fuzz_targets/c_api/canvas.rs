//! Pixels of the caller, and what may not be written.

use super::input::Input;

/// What is in the buffer before.
const UNTOUCHED: u8 = 0xa5;
/// Bytes before and behind the pixels, which no call is told of.
const MARGIN: usize = 64;

/// A buffer for pixels, with any size and stride.
pub(crate) struct Canvas {
    bytes: Vec<u8>,
    start: usize,
    pub(crate) size: usize,
    pub(crate) stride: usize,
}

impl Canvas {
    pub(crate) fn new(input: &mut Input<'_>) -> Self {
        let size = match input.below(4) {
            0 => input.below(256),
            1 => input.below(256) * 37,
            _ => 32 * 32 * 16 * 2,
        };
        let stride = match input.below(8) {
            0..4 => 0,
            4 => input.below(256),
            5 => input.below(256) * 7,
            6 => usize::MAX,
            _ => usize::MAX / 16 + input.below(256),
        };
        // Pixels of a caller need no alignment.
        let start = MARGIN + input.below(8);
        Self { bytes: vec![UNTOUCHED; start + size + MARGIN], start, size, stride }
    }

    pub(crate) fn as_mut_ptr(&mut self) -> *mut u8 {
        self.bytes[self.start..].as_mut_ptr()
    }

    /// Checks that nothing was written outside.
    pub(crate) fn check_margins(&self) {
        let (before, rest) = self.bytes.split_at(self.start);
        let outside = before.iter().chain(&rest[self.size..]);
        assert!(outside.copied().all(is_untouched), "written outside the pixels");
    }

    /// Checks that nothing was written at all.
    pub(crate) fn check_untouched(&self) {
        assert!(self.bytes.iter().copied().all(is_untouched), "written in spite of the error");
    }

    /// Checks that nothing was written outside `height` rows of `row` bytes.
    pub(crate) fn check_gaps(&self, row: usize, height: usize) {
        let stride = if self.stride == 0 { row } else { self.stride };
        let pixels = &self.bytes[self.start..self.start + self.size];
        for (y, line) in pixels.chunks(stride).enumerate() {
            let gap = if y < height { &line[row.min(line.len())..] } else { line };
            assert!(gap.iter().copied().all(is_untouched), "written behind row {y}");
        }
    }
}

fn is_untouched(byte: u8) -> bool {
    byte == UNTOUCHED
}
