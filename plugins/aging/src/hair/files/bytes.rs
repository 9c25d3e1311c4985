//! The bytes of a file, while they are put together.
//!
//! Their memory is the host's, counted, and asked for once, before anything is written. Records of
//! one size go to their places on all threads. Texts, whose length nobody knows before, are written
//! side by side into slots that are long enough, and moved together.

use std::{fmt, ops::Range};

use ptlib_plugin::{Scratch, prelude::*};

/// Records or texts of one task.
const ITEMS_OF_A_TASK: usize = 2048;

/// The most bytes of a number, with what separates it from the next.
pub const NUMBER: usize = 17;
/// The most bytes of a whole number of 32 bits, with what separates it from the next.
pub const WHOLE: usize = 12;

/// The bytes of a file.
#[derive(Debug)]
pub struct Bytes<'a> {
    work: Work<'a>,
    bytes: Scratch<'a, u8>,
    len: usize,
}

fn too_small() -> BlockError {
    BlockError::from("a file is longer than was counted")
}

impl<'a> Bytes<'a> {
    /// A file of at most so many bytes.
    ///
    /// # Errors
    /// If the limit of memory is reached.
    pub fn new(work: Work<'a>, most: usize) -> Result<Self, BlockError> {
        Ok(Self { work, bytes: work.scratch(most)?, len: 0 })
    }

    /// What is written.
    pub fn written(&self) -> &[u8] {
        &self.bytes[..self.len]
    }

    /// Adds bytes.
    ///
    /// # Errors
    /// If they were not counted.
    pub fn add(&mut self, bytes: &[u8]) -> Result<(), BlockError> {
        self.next(bytes.len())?.copy_from_slice(bytes);
        self.len += bytes.len();
        Ok(())
    }

    fn next(&mut self, bytes: usize) -> Result<&mut [u8], BlockError> {
        let end = self.len.checked_add(bytes).ok_or_else(too_small)?;
        self.bytes.get_mut(self.len..end).ok_or_else(too_small)
    }

    /// Adds `count` records of `size` bytes. `write` gets which ones, and their bytes.
    ///
    /// # Errors
    /// If they were not counted, and those of the host.
    pub fn records(
        &mut self,
        count: usize,
        size: usize,
        write: impl Fn(Range<usize>, &mut [u8]) + Sync,
    ) -> Result<(), BlockError> {
        let work = self.work;
        let bytes = self.next(count.saturating_mul(size))?;
        let added = bytes.len();
        work.for_each(bytes.chunks_mut(ITEMS_OF_A_TASK * size).enumerate(), |(task, bytes)| {
            let first = task * ITEMS_OF_A_TASK;
            write(first..first + bytes.len() / size, bytes);
            Ok(())
        })?;
        self.len += added;
        Ok(())
    }

    /// Adds the texts of `count` items, none longer than `most` bytes. `write` gets which ones.
    ///
    /// # Errors
    /// If they were not counted, and those of the host.
    pub fn texts(
        &mut self,
        count: usize,
        most: usize,
        write: impl Fn(Range<usize>, &mut Text<'_>) + Sync,
    ) -> Result<(), BlockError> {
        let (work, size) = (self.work, ITEMS_OF_A_TASK * most);
        let mut lengths = work.scratch::<usize>(count.div_ceil(ITEMS_OF_A_TASK))?;
        let bytes = self.next(count.saturating_mul(most))?;
        let tasks = bytes.chunks_mut(size).zip(lengths.iter_mut()).enumerate();
        work.for_each(tasks, |(task, (bytes, length))| {
            let first = task * ITEMS_OF_A_TASK;
            let mut text = Text { bytes, len: 0, is_full: false };
            write(first..(first + ITEMS_OF_A_TASK).min(count), &mut text);
            *length = text.len;
            if text.is_full { Err(too_small()) } else { Ok(()) }
        })?;
        let start = self.len;
        for (task, length) in lengths.iter().enumerate() {
            let slot = start + task * size;
            self.bytes.copy_within(slot..slot + length, self.len);
            self.len += length;
        }
        Ok(())
    }
}

/// A text in a slot.
#[derive(Debug)]
pub struct Text<'b> {
    bytes: &'b mut [u8],
    len: usize,
    is_full: bool,
}

impl Text<'_> {
    /// Adds a text.
    #[inline]
    pub fn add(&mut self, text: &str) {
        let end = self.len + text.len();
        match self.bytes.get_mut(self.len..end) {
            Some(place) => {
                place.copy_from_slice(text.as_bytes());
                self.len = end;
            }
            None => self.is_full = true,
        }
    }

    /// Adds anything.
    pub fn write(&mut self, what: fmt::Arguments<'_>) {
        self.is_full |= fmt::Write::write_fmt(self, what).is_err();
    }

    /// Adds a number: the shortest text that reads back to it.
    pub fn number(&mut self, number: f32) {
        let size = number.abs();
        if size == 0.0 || (1e-4..1e9).contains(&size) {
            self.write(format_args!("{number}"));
        } else {
            self.write(format_args!("{number:e}"));
        }
    }

    /// Adds numbers, with something between them.
    pub fn numbers<const N: usize>(&mut self, numbers: [f32; N], between: &str) {
        for (i, number) in numbers.into_iter().enumerate() {
            if i > 0 {
                self.add(between);
            }
            self.number(number);
        }
    }
}

impl fmt::Write for Text<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.add(text);
        if self.is_full { Err(fmt::Error) } else { Ok(()) }
    }
}

/// A number as a text.
pub fn shortest(number: f32) -> String {
    let mut bytes = [0; NUMBER];
    let mut text = Text { bytes: &mut bytes, len: 0, is_full: false };
    text.number(number);
    let len = text.len;
    String::from_utf8_lossy(&bytes[..len]).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        let texts = [(0.1, "0.1"), (-0.0, "-0"), (1e-7, "1e-7"), (3e20, "3e20"), (12.5, "12.5")];
        for (number, text) in texts {
            assert_eq!(shortest(number), text);
        }
        for i in 0..200_000_u32 {
            let number = f32::from_bits(i.wrapping_mul(2_654_435_769));
            if number.is_finite() {
                let text = shortest(number);
                assert!(text.len() < NUMBER, "{text}");
                assert_eq!(text.parse::<f32>().unwrap().to_bits(), number.to_bits(), "{text}");
            }
        }
    }

    #[test]
    fn a_text_that_is_too_long_is_noticed() {
        let mut bytes = [0; 3];
        let mut text = Text { bytes: &mut bytes, len: 0, is_full: false };
        text.add("ab");
        assert!(!text.is_full);
        text.number(10.0);
        assert!(text.is_full);
    }
}
