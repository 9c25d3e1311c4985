//! Vectors.

use super::texture::{Lanes, each};

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector of length 1 in that direction, if it has one.
pub fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    // The largest part is 1 first, so that squares neither overflow nor vanish.
    let most = vector.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if !(most > 1e-300 && most.is_finite()) {
        return None;
    }
    let vector = vector.map(|x| x / most);
    let length = dot(vector, vector).sqrt();
    Some(vector.map(|x| x / length))
}

/// Vectors side by side.
pub type Vectors = [Lanes; 3];

#[inline(always)]
pub fn dots(a: &Vectors, b: &Vectors) -> Lanes {
    each(|i| a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i])
}

#[inline(always)]
pub fn crosses(a: &Vectors, b: &Vectors) -> Vectors {
    let part = |p: usize, q: usize| each(|i| a[p][i] * b[q][i] - a[q][i] * b[p][i]);
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// Length 1, where there is a direction; else (0, 0, 0).
#[inline(always)]
pub fn units(a: &Vectors) -> Vectors {
    let square = dots(a, a);
    let inverse = each(|i| if square[i] > 1e-20 { 1.0 / square[i].sqrt() } else { 0.0 });
    [0, 1, 2].map(|axis: usize| each(|i| a[axis][i] * inverse[i]))
}

/// `a`·x + `b`·y + `c`·z.
#[inline(always)]
pub fn mix([a, b, c]: [&Vectors; 3], [x, y, z]: [&Lanes; 3]) -> Vectors {
    [0, 1, 2].map(|axis: usize| each(|i| a[axis][i] * x[i] + b[axis][i] * y[i] + c[axis][i] * z[i]))
}
