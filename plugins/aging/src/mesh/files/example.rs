//! The head that people start with: it is read, and it is what it says.

use super::{Alone, FileMesh, Limits, read};

/// The program that made it.
#[allow(dead_code, reason = "its start and its other formats are not for tests")]
#[path = "../../../examples/head.rs"]
mod maker;

const HEAD: &[u8] = include_bytes!("../../../examples/head/head.ply");

fn head() -> FileMesh {
    read(HEAD, None, &Alone, &Limits::default()).unwrap()
}

fn difference(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The area of a triangle, twice, as a vector.
fn area(mesh: &FileMesh, triangle: [u32; 3]) -> [f32; 3] {
    let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
    let (p, q) = (difference(b, a), difference(c, a));
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

#[test]
fn its_program_makes_it_again() {
    assert!(maker::ply(&maker::head(maker::TRIANGLES)) == HEAD, "run the example and commit both");
}

#[test]
fn both_of_its_formats_are_the_same_mesh() {
    let obj = maker::obj(&maker::head(2000.0)).unwrap();
    let ply = maker::ply(&maker::head(2000.0));
    let [obj, ply] =
        [obj, ply].map(|bytes| read(&bytes, None, &Alone, &Limits::default()).unwrap());
    // OBJ has vertices in the order in which faces use them.
    assert_eq!(obj.triangles.len(), ply.triangles.len());
    for (a, b) in obj.triangles.as_flattened().iter().zip(ply.triangles.as_flattened()) {
        let [a, b] = [*a as usize, *b as usize];
        assert_eq!(obj.positions[a], ply.positions[b]);
        assert_eq!(obj.normals[a], ply.normals[b]);
        assert_eq!(obj.texcoords[a], ply.texcoords[b]);
    }
}

#[test]
fn it_has_the_size_of_a_head_and_room_for_more() {
    let head = head();
    assert!(HEAD.len() < 700_000 && head.positions.len() < 10_000);
    assert!((18_000..20_000).contains(&head.triangles.len()));
    let bounds = |axis: usize| {
        let numbers = || head.positions.iter().map(|place| place[axis]);
        (numbers().fold(f32::MAX, f32::min), numbers().fold(f32::MIN, f32::max))
    };
    let (y, x, z) = (bounds(1), bounds(0), bounds(2));
    assert!((y.0 + 1.0).abs() < 0.01 && (y.1 - 1.0).abs() < 0.01, "{y:?}");
    assert!((x.0 + x.1).abs() < 1e-3 && x.1 < 0.7, "{x:?}");
    assert!(z.1 > 0.7 && z.0 < -0.6, "{z:?}");
}

#[test]
fn it_is_closed_and_no_triangle_is_degenerate() {
    let head = head();
    let mut edges: Vec<[[u32; 3]; 2]> = vec![];
    for triangle in &head.triangles {
        let normal = area(&head, *triangle);
        assert!(dot(normal, normal) > 1e-16, "{triangle:?}");
        let places =
            triangle.map(|vertex| head.positions[vertex as usize].map(|x| (x + 0.0).to_bits()));
        edges.extend([0, 1, 2].map(|i| [places[i], places[(i + 1) % 3]]));
        for vertex in triangle {
            let given = head.normals[*vertex as usize];
            assert!((dot(given, given) - 1.0).abs() < 1e-5);
            assert!(dot(given, normal) > 0.0, "{triangle:?} looks away from its normals");
        }
    }
    // Each edge is there once in each direction: the copies of vertices are at the same places.
    edges.sort_unstable();
    assert!(edges.windows(2).all(|pair| pair[0] != pair[1]));
    let is_closed = |[a, b]: &[[u32; 3]; 2]| edges.binary_search(&[*b, *a]).is_ok();
    assert!(edges.iter().all(is_closed));
}

#[test]
fn its_texture_goes_around_it_without_a_fold() {
    let head = head();
    for triangle in &head.triangles {
        let [a, b, c] = triangle.map(|vertex| head.texcoords[vertex as usize]);
        let det = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        assert!(det > 0.0, "{a:?} {b:?} {c:?}");
        assert!([a, b, c].iter().flatten().all(|number| (0.0..=1.0).contains(number)));
    }
    for (place, [u, v]) in head.positions.iter().zip(&head.texcoords) {
        assert!((u - 0.5).abs() < 0.2 || place[2] < 0.3, "the face is in the middle");
        assert!((*v < 0.45 || place[1] > -0.3) && (*v > 0.45 || place[1] < 0.1));
    }
}
