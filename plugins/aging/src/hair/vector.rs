//! Vectors of three numbers.

/// Three numbers.
pub type Vector = [f64; 3];

/// A vector of single precision, exactly.
#[inline(always)]
pub fn wide(a: [f32; 3]) -> Vector {
    a.map(f64::from)
}

/// The difference.
#[inline(always)]
pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The vector product.
#[inline(always)]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The length.
#[inline(always)]
pub fn length(a: Vector) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

/// The vector at length 1, if it is long enough to have a direction.
#[inline(always)]
pub fn direction(a: Vector, shortest: f64) -> Option<Vector> {
    let length = length(a);
    // One division: they take longer than all else about a hair's direction.
    let inverse = 1.0 / length;
    (length > shortest).then(|| a.map(|x| x * inverse))
}

/// A point of a triangle, by the weights of its second and third corner.
#[inline(always)]
pub fn between<const N: usize>(corners: [[f32; N]; 3], weights: [f64; 2]) -> [f64; N] {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let first = 1.0 - weights[0] - weights[1];
    std::array::from_fn(|axis| a[axis] * first + b[axis] * weights[0] + c[axis] * weights[1])
}
