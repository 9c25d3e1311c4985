//! Sums of columns, and of those along a row: for matrices that are few products of a column and a
//! row of weights.
//!
//! A matrix of m × n weights has m·n taps, a product only m + n; a Gaussian is one product. The
//! largest weight that is left gives the next one (elimination with full pivoting, the cross
//! approximation of low-rank matrices): its column, divided by it, times its row. So everything
//! with few products is found, without being told.
//!
//! The products need not meet the weights exactly, as those of a Gaussian are written with some
//! decimals only. They may miss them by what summing the taps in single precision may err by
//! anyway. Products that largely cancel each other would err by more, and are not taken.
//!
//! Columns come first: their sums lie side by side for one row of the result, which so depends on
//! no row before it.

use super::{
    MAX_SIDE,
    taps::{add_weighted, put},
};
use crate::{
    math::{convert, simd},
    value::{Image, ring},
};

/// Pixels whose sums stay in registers.
const BLOCK: usize = 64;

/// Pixels whose sums of columns are made together. The longer, the fewer are made twice.
const PIECE: usize = 16 * BLOCK;

/// How many columns ahead the rows of an image are fetched: more rows at a time than a CPU watches.
const AHEAD: usize = 2 * BLOCK;

/// How much larger than the weights all products together may be.
const MOST_CANCELLED: f64 = 4.0;

/// Half a unit in the last place of a number of single precision, relative to it.
const ROUNDING: f64 = 1.0 / 16_777_216.0;

/// A matrix as a sum of products.
#[derive(Debug)]
pub(super) struct Separable {
    /// Columns from the first one to the middle.
    left: usize,
    /// Columns of the matrix.
    width: usize,
    products: Vec<Product>,
}

#[derive(Debug)]
struct Product {
    /// How many rows below the pixel there is a weight, and that.
    column: Vec<(i64, f32)>,
    /// How many columns right of the first one there is a weight, and that.
    row: Vec<(usize, f32)>,
    /// The same for two columns of one weight, as every Gaussian has them. They are added first,
    /// which saves a multiplication.
    pairs: Vec<([usize; 2], f32)>,
}

impl Separable {
    /// The matrix of `width` columns with those weights, if products make it cheaper.
    pub(super) fn of(width: usize, weights: &[f64]) -> Option<Self> {
        let size = |weights: &[f64]| weights.iter().map(|weight| weight.abs()).sum::<f64>();
        let taps = weights.iter().filter(|weight| **weight != 0.0).count();
        let tolerance = f64::from(convert::position(taps)) * ROUNDING * size(weights);
        let mut rest = weights.to_vec();
        let (mut products, mut cost, mut sizes) = (Vec::new(), 0, 0.0);
        while size(&rest) > tolerance {
            let (column, row) = split_off(&mut rest, width);
            sizes += size(&column) * size(&row);
            let product = Product::new(&column, &row);
            cost += product.column.len() + product.row.len() + 2 * product.pairs.len();
            if cost >= taps || sizes > MOST_CANCELLED * size(weights) {
                return None;
            }
            products.push(product);
        }
        (!products.is_empty()).then_some(Self { left: width / 2, width, products })
    }

    /// Writes the sums for row `y` of a channel of `image`.
    #[inline(always)]
    pub(super) fn write(&self, image: &Image, channel: usize, y: u32, out: &mut [f32]) {
        let mut columns = [0.0; PIECE + BLOCK];
        for (piece, out) in out.chunks_mut(PIECE).enumerate() {
            let first = (piece * PIECE) as i64 - self.left as i64;
            let wanted = (out.len() + self.width - 1).next_multiple_of(BLOCK);
            for (number, product) in self.products.iter().enumerate() {
                product.down((image, channel, y), first, &mut columns[..wanted], out);
                product.along(&columns, out, number == 0);
            }
        }
    }
}

/// The product that the largest of the weights is the corner of, subtracted from them: a column
/// and a row.
fn split_off(weights: &mut [f64], width: usize) -> (Vec<f64>, Vec<f64>) {
    let mut largest = 0;
    for (place, weight) in weights.iter().enumerate() {
        if weight.abs() > weights[largest].abs() {
            largest = place;
        }
    }
    let (pivot, start) = (weights[largest], largest / width * width);
    let row = weights[start..start + width].to_vec();
    let column: Vec<_> =
        weights.chunks(width).map(|weights| weights[largest % width] / pivot).collect();
    for (weights, factor) in weights.chunks_mut(width).zip(&column) {
        for (weight, along) in weights.iter_mut().zip(&row) {
            *weight -= factor * along;
        }
    }
    (column, row)
}

impl Product {
    fn new(column: &[f64], row: &[f64]) -> Self {
        let middle = (column.len() / 2) as i64;
        let used = |weights: &[f64]| -> Vec<(usize, f32)> {
            let weights = weights.iter().map(|weight| convert::single(*weight)).enumerate();
            weights.filter(|(_, weight)| *weight != 0.0).collect()
        };
        let below = |(j, weight): (usize, f32)| (j as i64 - middle, weight);
        let column = used(column).into_iter().map(below).collect();
        let (mut row, mut pairs) = (used(row), Vec::new());
        let mut first = 0;
        while let Some((left, weight)) = row.get(first).copied() {
            match row.iter().rposition(|(_, other)| *other == weight) {
                Some(last) if last > first => {
                    pairs.push(([left, row.remove(last).0], weight));
                    row.remove(first);
                }
                _ => first += 1,
            }
        }
        Self { column, row, pairs }
    }

    /// Writes the sums of columns from column `first` on, which may lie beyond an edge. Fetches the
    /// memory of `out` meanwhile, which is written next.
    #[inline(always)]
    fn down(
        &self,
        (image, channel, y): (&Image, usize, u32),
        first: i64,
        sums: &mut [f32],
        out: &[f32],
    ) {
        let mut rows: [(&[f32], f32); MAX_SIDE] = [(&[], 0.0); MAX_SIDE];
        for (row, (below, weight)) in rows.iter_mut().zip(&self.column) {
            let y = convert::wrap_near(i64::from(y) + below, image.height());
            *row = (image.row(channel, y), *weight);
        }
        let rows = &rows[..self.column.len()];
        let width = i64::from(image.width());
        for (block, columns) in sums.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            simd::fetch_to_write(out.chunks(BLOCK).nth(block).unwrap_or_default());
            let start = convert::index((first + (block * BLOCK) as i64).rem_euclid(width));
            let mut sums = [0.0; BLOCK];
            if start + BLOCK <= image.width() as usize {
                for (row, weight) in rows {
                    simd::fetch_to_read(
                        row.get(start + AHEAD..start + AHEAD + BLOCK).unwrap_or_default(),
                    );
                    add_weighted(&mut sums, &row[start..], *weight);
                }
                put(sums, columns, |column, sum| *column = sum);
            } else {
                let mut near = [0.0; BLOCK];
                for (row, weight) in rows {
                    ring::copy(row, start as i64, |value| value, &mut near);
                    add_weighted(&mut sums, &near, *weight);
                }
                put(sums, columns, |column, sum| *column = sum);
            }
        }
    }

    /// Writes the sums along the row, or adds them.
    #[inline(always)]
    fn along(&self, columns: &[f32; PIECE + BLOCK], out: &mut [f32], is_first: bool) {
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let mut sums = [0.0; BLOCK];
            for (column, weight) in &self.row {
                add_weighted(&mut sums, &columns[block * BLOCK + column..], *weight);
            }
            for (pair, weight) in &self.pairs {
                let [left, right] = pair.map(|column| &columns[block * BLOCK + column..]);
                let both = left.first_chunk::<BLOCK>().zip(right.first_chunk::<BLOCK>());
                let (left, right) = both.expect("a block has its neighbours beside it");
                for i in 0..BLOCK {
                    sums[i] += (left[i] + right[i]) * weight;
                }
            }
            if is_first {
                put(sums, out, |out, sum| *out = sum);
            } else {
                put(sums, out, |out, sum| *out += sum);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use super::*;

    /// What the products make of a matrix, and how many there are.
    fn made(width: usize, weights: &[f64]) -> Option<(Vec<f64>, usize)> {
        let separable = Separable::of(width, weights)?;
        let middle = (weights.len() / width / 2) as i64;
        let mut sums = vec![0.0; weights.len()];
        for product in &separable.products {
            for (below, down) in &product.column {
                let pairs = product.pairs.iter();
                let pairs = pairs.flat_map(|(pair, along)| pair.map(|column| (column, *along)));
                for (column, along) in product.row.iter().copied().chain(pairs) {
                    let place = convert::index(below + middle) * width + column;
                    sums[place] += f64::from(*down) * f64::from(along);
                }
            }
        }
        Some((sums, separable.products.len()))
    }

    fn assert_made_of(products: usize, width: usize, weights: &[f64]) {
        let (found, count) = made(width, weights).unwrap();
        assert_eq!(count, products);
        let missed: f64 = weights.iter().zip(&found).map(|(a, b)| (a - b).abs()).sum();
        let size: f64 = weights.iter().map(|weight| weight.abs()).sum();
        assert!(missed <= 2.0 * weights.len() as f64 * ROUNDING * size, "{missed} of {size}");
    }

    /// A Gaussian of `side`² weights of that many decimals.
    fn gaussian(side: usize, decimals: i32) -> Vec<f64> {
        let along = |i: usize| {
            let (x, width) = (i as f64 - (side / 2) as f64, side as f64 / 5.0);
            crate::math::elementary::exp64(-x * x / (2.0 * width * width))
        };
        let unit = f64::from_str(&format!("1e{decimals}")).unwrap();
        let weight = |i: usize| (along(i % side) * along(i / side) * unit * 0.1).round() / unit;
        (0..side * side).map(weight).collect()
    }

    #[test]
    fn gaussians_are_one_product_also_with_few_decimals() {
        for side in [3, 5, 8, 13, 16] {
            assert_made_of(1, side, &gaussian(side, 17));
        }
        assert_made_of(1, 13, &gaussian(13, 8));
        // So few decimals say something else.
        assert!(made(5, &gaussian(5, 3)).is_none_or(|(_, products)| products > 1));
    }

    #[test]
    fn a_difference_of_gaussians_is_two_products() {
        let mut weights = gaussian(13, 17);
        for (place, weight) in weights.iter_mut().enumerate() {
            let (x, y) = (place % 13, place / 13);
            let is_near = x.abs_diff(6) <= 2 && y.abs_diff(6) <= 2;
            *weight -= if is_near { 0.04 } else { 0.0 };
        }
        assert_made_of(2, 13, &weights);
    }

    #[test]
    fn what_taps_do_as_cheaply_is_left_to_them() {
        assert!(made(3, &[0.0; 9]).is_none());
        assert!(made(9, &[0.1; 9]).is_none());
        assert!(made(3, &[0.0, -1.0, 0.0, -1.0, 5.0, -1.0, 0.0, -1.0, 0.0]).is_none());
        let noise: Vec<f64> = (0..81_u32).map(|i| f64::from(i * i % 83)).collect();
        assert!(made(9, &noise).is_none());
    }

    #[test]
    fn large_and_small_weights_stay_in_range() {
        for weight in [1e30, -1e30, 1e-30] {
            assert_made_of(1, 16, &[weight; 256]);
        }
    }
}
