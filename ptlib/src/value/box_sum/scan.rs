//! Running sums, many at a time.
//!
//! Each sum needs the one before it, which a loop would wait for. Here, numbers become sums of 2,
//! of 4, of 8 and of 16 neighbours, each step for all places at once; then 16 running sums side by
//! side go on in strides of 16.

/// The most sums that are made at a time.
pub(super) const MOST: usize = 256;

/// Sums that run side by side.
const LANES: usize = 16;

/// Numbers, with nothing in front of them, and one that is left over.
type Numbers = [u32; LANES + MOST + 1];

/// A sum that runs along a row, and room for what is on the way.
pub(super) struct Scan {
    /// The sum that comes next.
    sum: u32,
    numbers: Numbers,
    others: Numbers,
}

impl Scan {
    /// A sum that starts at the low bits of `sum`.
    #[inline(always)]
    pub(super) fn new(sum: i64) -> Self {
        let sum = crate::math::convert::low_bits(sum.cast_unsigned()).cast_unsigned();
        Self { sum, numbers: [0; LANES + MOST + 1], others: [0; LANES + MOST + 1] }
    }

    /// Where to write by how much each of the next `count` sums is smaller than the one after it.
    #[inline(always)]
    pub(super) fn steps(&mut self, count: usize) -> &mut [u32] {
        &mut self.numbers[LANES + 1..][..count]
    }

    /// The next `count` sums.
    #[inline(always)]
    pub(super) fn sums(&mut self, count: usize) -> &[u32] {
        let Self { sum, numbers, others } = self;
        let last_step = numbers[LANES + count];
        numbers[LANES] = *sum;
        // What is left of earlier numbers behind these does no harm: sums look back.
        let end = LANES + count.next_multiple_of(LANES);
        add_neighbours::<1>(numbers, others, end);
        add_neighbours::<2>(others, numbers, end);
        add_neighbours::<4>(numbers, others, end);
        add_neighbours::<8>(others, numbers, end);
        let mut running = [0_u32; LANES];
        for numbers in numbers[LANES..end].as_chunks_mut::<LANES>().0 {
            for (running, number) in running.iter_mut().zip(numbers) {
                *running = running.wrapping_add(*number);
                *number = *running;
            }
        }
        let sums = &numbers[LANES..][..count];
        *sum = sums[count - 1].wrapping_add(last_step);
        sums
    }
}

/// To each number up to `end`, adds the one that many places back. (Were their number known to the
/// compiler, it would write all of them one after the other, in each loop that uses this.)
#[inline(always)]
fn add_neighbours<const BACK: usize>(numbers: &Numbers, sums: &mut Numbers, end: usize) {
    let pairs = numbers[LANES..end].iter().zip(&numbers[LANES - BACK..end - BACK]);
    for (sum, (number, back)) in sums[LANES..end].iter_mut().zip(pairs) {
        *sum = number.wrapping_add(*back);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_go_on_where_the_last_ones_ended() {
        let mut scan = Scan::new(-5);
        let mut expected = 5_u32.wrapping_neg();
        for count in [1, 7, 256, 16, 17, 200] {
            let step = |i: usize| 3_000_000_019_u32.wrapping_mul(u32::try_from(i * i).unwrap());
            scan.steps(count).iter_mut().enumerate().for_each(|(i, number)| *number = step(i));
            for (i, sum) in scan.sums(count).iter().enumerate() {
                assert_eq!(*sum, expected, "{i} of {count}");
                expected = expected.wrapping_add(step(i));
            }
            assert_eq!(scan.sum, expected);
        }
    }
}
