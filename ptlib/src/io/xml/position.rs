//! Places in a text.

/// Line and column of a byte offset, from 1; columns count characters.
pub(super) fn position(text: &str, offset: usize) -> (u32, u32) {
    let offset = text.floor_char_boundary(offset);
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let lines = before.bytes().filter(|&byte| byte == b'\n').count();
    let columns = before.get(line_start..).map_or(0, |line| line.chars().count());
    let from_1 = |count| u32::try_from(count + 1).unwrap_or(u32::MAX);
    (from_1(lines), from_1(columns))
}

/// The byte offset of `part`, a slice of `text`.
pub(super) fn offset_of(text: &str, part: &str) -> usize {
    part.as_ptr().addr().saturating_sub(text.as_ptr().addr())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let text = "aé\nüb☃c";
        assert_eq!(position(text, 0), (1, 1));
        assert_eq!(position(text, offset_of(text, &text[4..])), (2, 1));
        assert_eq!(position(text, text.find('c').unwrap()), (2, 4));
        assert_eq!(position(text, 2), (1, 2), "inside of é");
        assert_eq!(position(text, 99), (2, 5));
    }
}
