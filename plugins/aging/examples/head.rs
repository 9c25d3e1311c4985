//! Makes a head to try ageing on: a ball that is pulled into shape.
//!
//! ```sh
//! cargo run -p ptlib-aging --example head -- FILE.ply [TRIANGLES]
//! ```
//!
//! The ball's rings become cross-sections: each has a height, a width and a depth to the front and
//! to the back, along curves from the neck to the crown. Then bumps and hollows, smooth functions
//! of the place, make a face of it. The head looks along z, y points up; it is 2 units high. The
//! texture goes around it, with the face in the middle (u = ½) and the seam behind, v from the neck
//! (0) to the crown (1). Columns and rings are closest on the face. FILE may also end with `.obj`.

use std::{fmt::Write, fs, path::Path};

use ptlib::math::elementary::{cos64, exp64, sin64};
use ptlib_plugin::math::single;

/// Triangles, if nobody says how many.
pub const TRIANGLES: f64 = 19_000.0;

/// A full turn.
const TURN: f64 = std::f64::consts::TAU;

fn main() -> Result<(), String> {
    let usage = "usage: head FILE.ply|FILE.obj [TRIANGLES from 200 to 2000000]";
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or(usage)?;
    let triangles = arguments.next().map_or(Ok(TRIANGLES), |text| text.parse());
    let triangles = triangles.ok().filter(|count| (200.0..=2e6).contains(count)).ok_or(usage)?;
    let head = head(triangles);
    let bytes = match Path::new(&file).extension().and_then(|end| end.to_str()) {
        Some("ply") => ply(&head),
        Some("obj") => obj(&head).map_err(|error| error.to_string())?,
        _ => return Err(usage.to_owned()),
    };
    fs::write(&file, bytes).map_err(|error| format!("{file}: {error}"))
}

/// A mesh.
pub struct Mesh {
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    texcoords: Vec<[f64; 2]>,
    triangles: Vec<[usize; 3]>,
}

/// A head of about so many triangles.
pub fn head(triangles: f64) -> Mesh {
    let columns = whole(0.8 * triangles.sqrt());
    let rings = whole(0.625 * triangles.sqrt()) + 1;
    let part = |i: f64, of: usize| i / number(of);
    let mut mesh =
        Mesh { positions: vec![], normals: vec![], texcoords: vec![], triangles: vec![] };
    // Vertices of one place have one normal: the first of a ring and its last, and all of a pole.
    let mut same = vec![];
    let mut starts = vec![];
    for ring in 0..=rings {
        let start = mesh.positions.len();
        starts.push(start);
        let v = dense(part(number(ring), rings), 0.45);
        // At a pole each triangle has a vertex of its own, in the middle of its column.
        let is_pole = ring == 0 || ring == rings;
        for column in 0..if is_pole { columns } else { columns + 1 } {
            let shift = if is_pole { 0.5 } else { 0.0 };
            let u = dense(part(number(column) + shift, columns), 0.45);
            // A pole is one place, and the end of a ring is where it began, to the last bit.
            let is_again = column == columns || is_pole && column > 0;
            mesh.positions.push(if is_again { mesh.positions[start] } else { surface(u, v) });
            mesh.texcoords.push([u, v]);
            same.push(if is_again { start } else { start + column });
        }
    }
    for ring in 0..rings {
        for column in 0..columns {
            let [below, above] = [starts[ring] + column, starts[ring + 1] + column];
            if ring > 0 {
                mesh.triangles.push([below, below + 1, above]);
            }
            if ring + 1 < rings {
                let corner = if ring > 0 { below + 1 } else { below };
                mesh.triangles.push([corner, above + 1, above]);
            }
        }
    }
    mesh.normals = normals(&mesh, &same);
    mesh
}

/// Normals by area, the same for all vertices of one place.
fn normals(mesh: &Mesh, same: &[usize]) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; same.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex]);
        let [p, q] = [b, c].map(|corner| [0, 1, 2].map(|axis| corner[axis] - a[axis]));
        let area =
            [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        for vertex in triangle {
            let sum = &mut sums[same[*vertex]];
            *sum = [0, 1, 2].map(|axis| sum[axis] + area[axis]);
        }
    }
    let unit = |vertex: &usize| {
        let [x, y, z] = sums[*vertex];
        let length = (x * x + y * y + z * z).sqrt();
        [x, y, z].map(|x| x / length)
    };
    same.iter().map(unit).collect()
}

/// Steps that are even at first, closer in the middle of 0 to 1: by `more`, a part of 1.
fn dense(t: f64, more: f64) -> f64 {
    t + more * sin64(t * TURN) / TURN
}

/// Cross-sections: v, height, half the width, depths to the front and to the back.
const SECTIONS: [[f64; 5]; 22] = [
    [0.0, -1.0, 0.0, 0.0, 0.0],
    [0.05, -1.0, 0.30, 0.20, 0.41],
    [0.075, -0.985, 0.315, 0.215, 0.425],
    [0.13, -0.87, 0.285, 0.19, 0.405],
    [0.21, -0.70, 0.272, 0.185, 0.395],
    [0.255, -0.61, 0.285, 0.24, 0.395],
    [0.285, -0.55, 0.300, 0.45, 0.40],
    [0.31, -0.505, 0.320, 0.525, 0.405],
    [0.345, -0.435, 0.350, 0.545, 0.42],
    [0.39, -0.34, 0.385, 0.535, 0.46],
    [0.44, -0.22, 0.424, 0.545, 0.525],
    [0.50, -0.08, 0.458, 0.555, 0.60],
    [0.575, 0.10, 0.492, 0.570, 0.67],
    [0.63, 0.24, 0.508, 0.580, 0.695],
    [0.67, 0.36, 0.516, 0.592, 0.70],
    [0.725, 0.51, 0.512, 0.592, 0.69],
    [0.775, 0.64, 0.482, 0.556, 0.655],
    [0.825, 0.765, 0.424, 0.484, 0.585],
    [0.88, 0.875, 0.328, 0.368, 0.46],
    [0.935, 0.955, 0.198, 0.216, 0.275],
    [0.97, 0.99, 0.096, 0.102, 0.13],
    [1.0, 1.0, 0.0, 0.0, 0.0],
];

/// Where the skin is.
fn surface(u: f64, v: f64) -> [f64; 3] {
    let [y, side, front, back] = section(v);
    let angle = (u - 0.5) * TURN;
    let (sin, cos) = (sin64(angle), cos64(angle));
    let place = [side * sin, y, if cos > 0.0 { front * cos } else { back * cos }];
    // Bumps are of the right half; the left one mirrors them. In the middle nothing moves aside.
    let mirror = smooth((place[0].abs() / 0.1).min(1.0)).copysign(place[0]);
    let [x, y, z] = place;
    let mut moved = place;
    for bump in BUMPS {
        let [dx, dy, dz] = bump.push(x.abs(), y, z);
        moved = [moved[0] + mirror * dx, moved[1] + dy, moved[2] + dz];
    }
    if z > 0.0 {
        moved[2] += nose(x, y) + eye(x.abs(), y);
    }
    moved
}

/// The cross-section at v: cubic curves through the table, without overshoot (Fritsch and Carlson).
fn section(v: f64) -> [f64; 4] {
    let last = SECTIONS.len() - 2;
    let i = SECTIONS.iter().rposition(|section| section[0] <= v).unwrap_or(0).min(last);
    let width = |i: usize| SECTIONS[i + 1][0] - SECTIONS[i][0];
    let t = (v - SECTIONS[i][0]) / width(i);
    [1, 2, 3, 4].map(|what| {
        let secant = |i: usize| (SECTIONS[i + 1][what] - SECTIONS[i][what]) / width(i);
        let slope = |i: usize| {
            if i == 0 || i == last + 1 {
                return secant(i.min(last));
            }
            let (a, b) = (secant(i - 1), secant(i));
            if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 }
        };
        let (from, to) = (SECTIONS[i][what], SECTIONS[i + 1][what]);
        let (p, q) = (slope(i) * width(i), slope(i + 1) * width(i));
        let (a, b) = (2.0 * (from - to) + p + q, 3.0 * (to - from) - 2.0 * p - q);
        ((a * t + b) * t + p) * t + from
    })
}

/// A push that is strongest at a place and fades like a bell.
struct Bump {
    at: [f64; 3],
    /// How far it reaches along each axis.
    reach: [f64; 3],
    push: [f64; 3],
}

const FAR: f64 = 1e3;

const fn bump(at: [f64; 3], reach: [f64; 3], push: [f64; 3]) -> Bump {
    Bump { at, reach, push }
}

/// What makes a face of an egg, for the right half.
const BUMPS: &[Bump] = &[
    // The front of the face is flatter than an ellipse.
    bump([0.30, 0.30, 0.5], [0.13, 0.40, 0.25], [0.012, 0.0, 0.03]),
    // Brows, and between them.
    bump([0.11, 0.335, 0.6], [0.065, 0.036, 0.25], [0.0, 0.0, 0.026]),
    bump([0.225, 0.368, 0.6], [0.095, 0.040, 0.25], [0.0, 0.0, 0.040]),
    bump([0.0, 0.37, 0.6], [0.06, 0.05, 0.25], [0.0, 0.0, 0.016]),
    // Sockets, and eyes in them.
    bump([0.185, 0.240, 0.6], [0.105, 0.066, 0.25], [0.0, 0.0, -0.092]),
    bump([0.075, 0.240, 0.6], [0.036, 0.055, 0.25], [0.0, 0.0, -0.046]),
    bump([0.19, 0.235, 0.6], [0.062, 0.044, 0.25], [0.0, 0.0, 0.072]),
    bump([0.30, 0.245, 0.6], [0.040, 0.060, 0.25], [0.0, 0.0, -0.016]),
    // Cheekbone, the hollow below, and the fold beside the nose.
    bump([0.31, 0.10, 0.45], [0.11, 0.085, 0.25], [0.022, 0.0, 0.040]),
    bump([0.34, -0.17, 0.35], [0.11, 0.11, 0.25], [-0.020, 0.0, -0.016]),
    bump([0.15, -0.10, 0.55], [0.035, 0.07, 0.25], [0.0, 0.0, -0.016]),
    // Temple, and the angle of the jaw.
    bump([0.46, 0.40, 0.25], [FAR, 0.11, 0.14], [-0.028, 0.0, 0.0]),
    bump([0.37, -0.36, 0.10], [FAR, 0.085, 0.15], [0.026, 0.0, 0.0]),
    // Around the mouth, lips, and the line between them.
    bump([0.0, -0.22, 0.6], [0.13, 0.13, 0.25], [0.0, 0.0, 0.036]),
    bump([0.040, -0.192, 0.6], [0.068, 0.021, 0.25], [0.0, 0.0, 0.028]),
    bump([0.0, -0.256, 0.6], [0.082, 0.026, 0.25], [0.0, 0.0, 0.036]),
    bump([0.0, -0.221, 0.6], [0.110, 0.010, 0.25], [0.0, 0.0, -0.030]),
    bump([0.145, -0.220, 0.5], [0.026, 0.024, 0.25], [0.0, 0.0, -0.020]),
    bump([0.0, -0.145, 0.6], [0.014, 0.030, 0.25], [0.0, 0.0, -0.012]),
    // Below the lips, and the chin.
    bump([0.0, -0.315, 0.6], [0.10, 0.028, 0.25], [0.0, 0.0, -0.030]),
    bump([0.0, -0.435, 0.6], [0.10, 0.060, 0.25], [0.0, -0.01, 0.058]),
    bump([0.26, -0.46, 0.4], [0.10, 0.09, 0.20], [-0.022, 0.0, -0.025]),
    // Larynx, and the muscles from behind the ears to the breastbone.
    bump([0.0, -0.74, 0.2], [0.055, 0.060, 0.15], [0.0, 0.0, 0.030]),
    bump([0.13, -0.90, 0.15], [0.045, 0.12, 0.15], [0.010, 0.0, 0.020]),
    // Ears: a shell that stands off, its hollow, and the lobe.
    bump([0.5, 0.12, -0.06], [FAR, 0.105, 0.060], [0.062, 0.0, -0.050]),
    bump([0.5, 0.21, -0.07], [FAR, 0.055, 0.055], [0.024, 0.0, -0.024]),
    bump([0.5, 0.13, -0.025], [FAR, 0.055, 0.028], [-0.052, 0.0, 0.0]),
    bump([0.5, -0.01, -0.04], [FAR, 0.040, 0.035], [0.024, 0.0, -0.010]),
    // The back of the head.
    bump([0.0, 0.22, -0.7], [0.25, 0.22, 0.20], [0.0, 0.0, -0.030]),
    bump([0.0, -0.35, -0.45], [0.16, 0.16, 0.15], [0.0, 0.0, 0.025]),
];

impl Bump {
    fn push(&self, x: f64, y: f64, z: f64) -> [f64; 3] {
        let away = [x, y, z];
        let away = [0, 1, 2].map(|axis| (away[axis] - self.at[axis]) / self.reach[axis]);
        let bell = exp64(-0.5 * away.iter().fold(0.0, |sum, x| sum + x * x));
        self.push.map(|push| push * bell)
    }
}

/// How far the nose stands out: a ridge that rises from between the eyes to the tip, ends above the
/// lip, and widens to the wings.
fn nose(x: f64, y: f64) -> f64 {
    const ROOT: f64 = 0.34;
    const TIP: f64 = -0.005;
    const END: f64 = -0.125;
    let t = ((ROOT - y) / (ROOT - TIP)).clamp(0.0, 1.0);
    let below = smooth(((y - END) / (TIP - END)).clamp(0.0, 1.0));
    let height = (0.066 * smooth((t * 2.5).min(1.0)) + 0.078 * t * t.sqrt()) * below;
    let ridge = height * bell(x, 0.040 + 0.026 * t * t);
    let tip = 0.040 * bell(x, 0.048) * bell(y - 0.006, 0.046);
    let wings = 0.062 * bell(x.abs() - 0.090, 0.032) * bell(y + 0.034, 0.038);
    let nostrils = -0.034 * bell(x.abs() - 0.042, 0.022) * bell(y + 0.088, 0.018);
    ridge + tip + wings + nostrils
}

/// How far an eye stands out: lids around an opening that is pointed at both ends, and the fold
/// above the upper one.
fn eye(x: f64, y: f64) -> f64 {
    let along = (x - 0.188) / 0.098;
    let middle = 0.233 + 0.010 * along;
    let half = 0.040 * (1.0 - along * along).max(0.0);
    let away = (y - middle).abs() - half;
    let ends = bell(along, 0.62);
    let lids = 0.017 * bell(away - 0.008, 0.011) * ends;
    let opening = -0.010 * smooth((-away / 0.014).clamp(0.0, 1.0)) * ends;
    let fold = -0.017 * bell(y - middle - half - 0.030, 0.010) * ends;
    lids + opening + fold
}

/// 1 in the middle, fading.
fn bell(away: f64, reach: f64) -> f64 {
    exp64(-0.5 * (away / reach) * (away / reach))
}

/// From 0 to 1 with flat ends.
fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

/// The mesh as a binary PLY file.
pub fn ply(mesh: &Mesh) -> Vec<u8> {
    let names = ["x", "y", "z", "nx", "ny", "nz", "s", "t"];
    let properties: String = names.iter().map(|name| format!("property float {name}\n")).collect();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment a head, made by ptlib\nelement vertex {}\n\
         {properties}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len()
    )
    .into_bytes();
    for (vertex, position) in mesh.positions.iter().enumerate() {
        let numbers = position.iter().chain(&mesh.normals[vertex]).chain(&mesh.texcoords[vertex]);
        bytes.extend(numbers.flat_map(|number| single(*number).to_le_bytes()));
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        let corners = triangle.iter().map(|corner| u32::try_from(*corner).unwrap_or_default());
        bytes.extend(corners.flat_map(u32::to_le_bytes));
    }
    bytes
}

/// The mesh as an OBJ file.
pub fn obj(mesh: &Mesh) -> Result<Vec<u8>, std::fmt::Error> {
    let mut text = "# a head, made by ptlib\n".to_owned();
    for [x, y, z] in mesh.positions.iter().map(|position| position.map(single)) {
        writeln!(text, "v {x} {y} {z}")?;
    }
    for [u, v] in mesh.texcoords.iter().map(|place| place.map(single)) {
        writeln!(text, "vt {u} {v}")?;
    }
    for [x, y, z] in mesh.normals.iter().map(|normal| normal.map(single)) {
        writeln!(text, "vn {x} {y} {z}")?;
    }
    for [a, b, c] in mesh.triangles.iter().map(|triangle| triangle.map(|corner| corner + 1)) {
        writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
    }
    Ok(text.into_bytes())
}

/// A count as a number.
fn number(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small and not negative"
)]
fn whole(x: f64) -> usize {
    x.round() as usize
}
