//! Rings: rows of numbers whose ends meet, as those of an image do.

use crate::math::convert;

/// Writes `load` of the numbers of a ring from place `first` on, which may be some turns back.
#[inline(always)]
pub fn copy<S: Copy, T>(ring: &[S], first: i64, load: impl Fn(S) -> T, out: &mut [T]) {
    let mut rest = out;
    let mut start = convert::index(first.rem_euclid(ring.len() as i64));
    while !rest.is_empty() {
        let count = rest.len().min(ring.len() - start);
        let (piece, behind) = rest.split_at_mut(count);
        for (out, number) in piece.iter_mut().zip(&ring[start..]) {
            *out = load(*number);
        }
        (rest, start) = (behind, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_are_copied_around_their_ends() {
        let copied = |first| {
            let mut out = [0; 8];
            copy(&[1, 2, 3], first, |number| 2 * number, &mut out);
            out
        };
        assert_eq!(copied(0), [2, 4, 6, 2, 4, 6, 2, 4]);
        assert_eq!(copied(-7), copied(2));
        assert_eq!(copied(2), [6, 2, 4, 6, 2, 4, 6, 2]);
    }
}
