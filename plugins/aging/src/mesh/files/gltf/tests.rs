//! Scenes of one triangle, right and wrong.

use ptlib_plugin::BlockError;

use super::{
    super::{Alone, testing::assert_fault},
    *,
};

/// Positions, normals, texture coordinates of three vertices, then indices of 16 bits.
fn buffer() -> Vec<u8> {
    let floats = [
        [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0_f32],
    ];
    let texcoords = [0.0, 0.0, 0.5, 0.25, 1.0, 1.0_f32];
    let floats = floats.iter().flatten().chain(&texcoords);
    let mut bytes: Vec<u8> = floats.flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2].iter().flat_map(|corner| corner.to_le_bytes()));
    bytes
}

const VIEWS: &str = r#"{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},
    {"buffer":0,"byteOffset":72,"byteLength":24},{"buffer":0,"byteOffset":96,"byteLength":6}"#;
const ACCESSORS: &str = r#"
    {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,2,0]},
    {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
    {"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"},
    {"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"}"#;
const PRIMITIVE: &str = r#"{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3}"#;

/// A scene of these parts.
fn scene(uri: &str, views: &str, accessors: &str, primitives: &str, nodes: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
        "meshes":[{{"primitives":[{primitives}]}}],"accessors":[{accessors}],
        "bufferViews":[{views}],"buffers":[{{"byteLength":102{uri}}}]}}"#
    )
}

/// A GLB of a description and a buffer.
fn glb(json: &str, bytes: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, bytes) = (padded(json.as_bytes(), b' '), padded(bytes, 0));
    let word = |number: usize| u32::try_from(number).unwrap().to_le_bytes();
    let length = word(28 + json.len() + bytes.len());
    let parts: [&[u8]; 9] = [
        b"glTF",
        &word(2),
        &length,
        &word(json.len()),
        b"JSON",
        &json,
        &word(bytes.len()),
        b"BIN\0",
        &bytes,
    ];
    parts.concat()
}

/// A GLB with something replaced in its description.
fn changed(from: &str, to: &str) -> Vec<u8> {
    let json = scene("", VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0}"#);
    assert!(json.contains(from), "{from}");
    glb(&json.replace(from, to), &buffer())
}

fn mesh(bytes: &[u8]) -> FileMesh {
    read(bytes, &Alone, &Limits::default()).unwrap()
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |group: &[u8]| {
        let bits = group.iter().fold(0_u32, |bits, byte| bits << 8 | u32::from(*byte));
        [18, 12, 6, 0].map(|shift| char::from(DIGITS[(bits >> shift & 63) as usize]))
    };
    bytes.chunks(3).flat_map(group).collect()
}

#[test]
fn a_triangle_is_read_from_all_places() {
    let found = mesh(&changed("102", "102"));
    assert_eq!(found.positions, [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    assert_eq!(found.normals, [[0.0, 0.0, 1.0]; 3]);
    assert_eq!(found.texcoords, [[0.0, 1.0], [0.5, 0.75], [1.0, 0.0]]);
    assert_eq!(found.triangles, [[0, 1, 2]]);
    let uri = format!(r#","uri":"data:application/gltf-buffer;base64,{}""#, base64(&buffer()));
    let here = scene(&uri, VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0}"#);
    assert_eq!(mesh(here.as_bytes()), found);

    struct Beside;
    impl Outside for Beside {
        fn check(&self) -> Result<(), BlockError> {
            Ok(())
        }
        fn read(&self, name: &str) -> Result<Vec<u8>, BlockError> {
            assert_eq!(name, "parts/head 1.bin");
            Ok(buffer())
        }
    }
    let uri = r#","uri":"parts/head%201.bin""#;
    let beside = scene(uri, VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0}"#);
    assert_eq!(read(beside.as_bytes(), &Beside, &Limits::default()), Ok(found));
    let error = read(beside.as_bytes(), &Alone, &Limits::default()).unwrap_err();
    assert!(matches!(error, FileError::Stopped(_)));
    let outside = beside.replace("parts/", "/etc/");
    assert_fault(outside.as_bytes(), "neither data nor a path relative to the file");
}

#[test]
fn nodes_place_their_meshes() {
    let nodes = r#"{"children":[1,2],"translation":[10,0,0]},
        {"mesh":0,"rotation":[0,0,0.70710677,0.70710677],"scale":[2,1,1]},
        {"mesh":0,"matrix":[1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,5,0,1]}"#;
    let json = scene("", VIEWS, ACCESSORS, PRIMITIVE, nodes);
    let found = mesh(&glb(&json, &buffer()));
    // Twice as long, turned by a quarter, shifted by the parent.
    let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-5);
    assert!(near(found.positions[1], [10.0, 4.0, 0.0]), "{found:?}");
    assert!(near(found.positions[2], [8.0, 0.0, 0.0]), "{found:?}");
    // Mirrored: the order of corners turns, so that fronts stay fronts.
    assert_eq!(found.positions[5], [10.0, 3.0, 0.0]);
    assert_eq!(found.triangles, [[0, 1, 2], [3, 5, 4]]);
    assert_eq!(found.normals[5], [0.0, 0.0, 1.0]);
}

#[test]
fn normals_stay_perpendicular_to_stretched_surfaces() {
    let nodes = r#"{"mesh":0,"scale":[1,1,4]}"#;
    let json = scene("", VIEWS, ACCESSORS, PRIMITIVE, nodes);
    let mut bytes = buffer();
    // The plane x = z instead: edges (2,0,2), (0,2,0), normal (-1,0,1).
    bytes[20..24].copy_from_slice(&2.0_f32.to_le_bytes());
    for vertex in 0..3 {
        bytes[36 + 12 * vertex..][..4].copy_from_slice(&(-1.0_f32).to_le_bytes());
        bytes[44 + 12 * vertex..][..4].copy_from_slice(&1.0_f32.to_le_bytes());
    }
    let found = mesh(&glb(&json, &bytes));
    assert_eq!(found.positions[1], [2.0, 0.0, 8.0]);
    let [x, y, z] = found.normals[0];
    assert!((x * 2.0 + z * 8.0).abs() < 1e-6 && y == 0.0 && z > 0.0, "{:?}", found.normals);
}

#[test]
fn what_is_missing_is_told_or_made() {
    let plain = r#"{"attributes":{"POSITION":0}}"#;
    let found = mesh(&changed(PRIMITIVE, plain));
    assert_eq!((found.normals.len(), found.texcoords.len()), (0, 0));
    assert_eq!(found.triangles, [[0, 1, 2]]);
    let some = r#"{"attributes":{"POSITION":0,"NORMAL":1}}"#;
    let both = mesh(&changed(PRIMITIVE, &format!("{plain},{some}")));
    assert_eq!(both.normals[2..4], [[0.0; 3], [0.0, 0.0, 1.0]]);
    let lines = format!(r#"{{"attributes":{{"POSITION":0}},"mode":1}},{PRIMITIVE}"#);
    assert_eq!(mesh(&changed(PRIMITIVE, &lines)).triangles, [[0, 1, 2]]);
    let fault =
        |primitives: &str, expected| assert_fault(&changed(PRIMITIVE, primitives), expected);
    fault(&format!("{PRIMITIVE},{plain}"), "primitive 1: has no TEXCOORD_0");
    fault(r#"{"attributes":{"POSITION":0},"mode":0}"#, "no triangles");
    fault(r#"{"attributes":{"POSITION":0},"indices":1}"#, "accessor 1 has the type Vec3");
    fault(r#"{"attributes":{"POSITION":2}}"#, "");
    fault(r#"{"attributes":{"NORMAL":1}}"#, "");
}

#[test]
fn accessors_that_lie_are_found_out() {
    let texcoord = r#""count":3,"type":"VEC2""#;
    let fault = |to: &str, expected: &str| assert_fault(&changed(texcoord, to), expected);
    fault(r#""count":0,"type":"VEC2""#, "accessor 2 has 0 elements");
    fault(r#""count":4,"type":"VEC2""#, "accessor 2 has 4 elements");
    fault(r#""count":2,"type":"VEC2""#, "2 texture coordinates for 3 positions");
    fault(r#""count":4611686018427387904,"type":"VEC2""#, "4611686018427387904 elements");
    fault(r#""count":18446744073709551615,"type":"VEC2""#, "18446744073709551615 elements");
    fault(r#""count":3,"byteOffset":18446744073709551615,"type":"VEC2""#, "accessor 2 has 3");
    fault(r#""count":3,"byteOffset":4,"type":"VEC2""#, "from byte 4 on, but its view has 24");
    fault(r#""count":36893488147419103232,"type":"VEC2""#, "line");
    let position = r#""count":3,"type":"VEC3","min""#;
    let huge = r#""count":4611686018427387904,"type":"VEC3","min""#;
    assert_fault(&changed(position, huge), "4611686018427387904 vertices, allowed 16777216");
    let empty = r#""count":0,"type":"VEC3","min""#;
    assert_fault(&changed(position, empty), "accessor 0 has 0 elements");
    let corners = r#""count":3,"type":"SCALAR""#;
    let odd = r#""count":2,"type":"SCALAR""#;
    assert_fault(&changed(corners, odd), "2 corners, allowed are multiples of 3");
    let huge = r#""count":4611686018427387904,"type":"SCALAR""#;
    assert_fault(&changed(corners, huge), "triangles, allowed 33554432");
}

#[test]
fn views_and_buffers_that_lie_are_found_out() {
    let view = r#"{"buffer":0,"byteLength":36}"#;
    let fault = |to: &str, expected: &str| assert_fault(&changed(view, to), expected);
    fault(
        r#"{"buffer":0,"byteLength":36,"byteStride":4}"#,
        "accessor 0 has stride 4, allowed from 12",
    );
    fault(
        r#"{"buffer":0,"byteLength":36,"byteStride":3}"#,
        "accessor 0 has stride 3, allowed from 12",
    );
    fault(r#"{"buffer":0,"byteLength":36,"byteStride":16}"#, "16 bytes apart");
    fault(r#"{"buffer":0,"byteOffset":67,"byteLength":36}"#, "but buffer 0 has 102");
    fault(r#"{"buffer":0,"byteOffset":18446744073709551615,"byteLength":36}"#, "buffer 0 has 102");
    fault(r#"{"buffer":7,"byteLength":36}"#, "buffer 7 does not exist");
    let buffer = r#"{"byteLength":102}"#;
    let fault = |to: &str, expected: &str| assert_fault(&changed(buffer, to), expected);
    fault(r#"{"byteLength":105}"#, "buffer 0 has 104 bytes, but claims 105");
    fault(r#"{"byteLength":1099511627776}"#, "1099511627776 bytes in buffers");
    fault(r#"{"byteLength":102,"uri":"data:;base64,AAAA"}"#, "buffer 0 has 3 bytes");
    let json = scene("", VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0}"#);
    assert_fault(json.as_bytes(), "buffer 0 is neither here nor in a file");
}

#[test]
fn numbers_of_every_stream_are_finite() {
    let json = scene("", VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0}"#);
    for (stream, offset) in [("position", 4), ("normal", 40), ("texture coordinate", 76)] {
        for number in [f32::NAN, f32::INFINITY] {
            let mut bytes = buffer();
            bytes[offset..][..4].copy_from_slice(&number.to_le_bytes());
            assert_fault(&glb(&json, &bytes), &format!("vertex 0: the {stream}"));
        }
    }
    let mut bytes = buffer();
    bytes[100] = 3;
    assert_fault(&glb(&json, &bytes), "index 2 is 3, allowed below 3");
}

#[test]
fn whole_numbers_stand_for_parts_of_1() {
    let from = r#""componentType":5126,"count":3,"type":"VEC2""#;
    let to = r#""componentType":5121,"count":3,"normalized":true,"type":"VEC2""#;
    let json = scene("", VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0}"#).replace(from, to);
    let mut bytes = buffer();
    bytes[72..78].copy_from_slice(&[0, 255, 51, 102, 255, 0]);
    let found = mesh(&glb(&json, &bytes));
    assert_eq!(found.texcoords, [[0.0, 0.0], [0.2, 0.6], [1.0, 1.0]]);
    assert_fault(&glb(&json.replace(r#""normalized":true,"#, ""), &bytes), "of type U8");
}

#[test]
fn containers_that_lie_are_found_out() {
    let good = changed("102", "102");
    for length in [0, 11, u32::MAX] {
        let mut bytes = good.clone();
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        assert_fault(&bytes, "byte 8: the container claims");
    }
    for length in [0, 1, u32::MAX] {
        let mut bytes = good.clone();
        bytes[12..16].copy_from_slice(&length.to_le_bytes());
        assert!(read(&bytes, &Alone, &Limits::default()).is_err());
    }
    for end in 0..good.len() - 1 {
        assert!(read(&good[..end], &Alone, &Limits::default()).is_err(), "{end}");
    }
    assert_fault(b"{", "line 1");
    let draco = r#""asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]"#;
    assert_fault(
        &changed(r#""asset":{"version":"2.0"}"#, draco),
        "requires the extension KHR_draco_mesh_compression",
    );
    assert_fault(&changed(r#""2.0""#, r#""1.0""#), "asset.version is");
    assert_fault(b"{\"asset\":{\"version\":\"2.0\"}}", "no scene");
}

#[test]
fn indices_that_lead_nowhere_are_found_out() {
    let fault = |from, to, expected| assert_fault(&changed(from, to), expected);
    fault(r#""POSITION":0"#, r#""POSITION":9"#, "accessor 9 does not exist");
    fault(r#""NORMAL":1"#, r#""NORMAL":4294967295"#, "accessor 4294967295 does not exist");
    fault(r#""indices":3"#, r#""indices":4"#, "accessor 4 does not exist");
    fault(r#""nodes":[0]"#, r#""nodes":[1]"#, "there is no node 1");
    fault(r#"{"mesh":0}"#, r#"{"mesh":1}"#, "there is no mesh 1");
    fault(r#"{"mesh":0}"#, r#"{"children":[7]}"#, "there is no node 7");
    fault(r#""scene":0"#, r#""scene":1"#, "there is no scene");
    fault(r#"{"bufferView":2,"#, r#"{"bufferView":4,"#, "accessor 2 has no view");
    fault(r#"{"bufferView":2,"#, "{", "accessor 2 has no view");
    fault(r#""type":"VEC2""#, r#""type":"VEC5""#, "accessor 2 has an unknown type");
}

#[test]
fn attributes_of_ones_own_are_passed_over() {
    let own = PRIMITIVE.replace(r#""NORMAL":1"#, r#""NORMAL":1,"_AGE":77,"STRANGE":78"#);
    assert_eq!(mesh(&changed(PRIMITIVE, &own)), mesh(&changed("102", "102")));
    let skin = r#""2.0"},"extensionsRequired":["KHR_materials_unlit"]"#;
    assert_eq!(mesh(&changed(r#""2.0"}"#, skin)).triangles.len(), 1);
}

#[test]
fn rings_and_copies_of_nodes_are_refused() {
    let ring = scene("", VIEWS, ACCESSORS, PRIMITIVE, r#"{"mesh":0,"children":[0]}"#);
    assert_fault(&glb(&ring, &buffer()), "node 0 is in the scene twice");
    let nodes = r#"{"children":[1,1]},{"mesh":0}"#;
    let copies = scene("", VIEWS, ACCESSORS, PRIMITIVE, nodes);
    assert_fault(&glb(&copies, &buffer()), "node 1 is in the scene twice");
}

#[test]
fn counts_have_limits() {
    let good = changed("102", "102");
    let read = |limits| read(&good, &Alone, &limits).unwrap_err();
    let default = Limits::default();
    let error = read(Limits { vertices: 2, ..default });
    assert_eq!(error, FileError::Limit("3 vertices, allowed 2".into()));
    let error = read(Limits { triangles: 0, ..default });
    assert_eq!(error, FileError::Limit("1 triangles, allowed 0".into()));
    let error = read(Limits { bytes: 101, ..default });
    assert_eq!(error, FileError::Limit("102 bytes in buffers, allowed 101".into()));
    assert!(matches!(read(Limits { entries: 20, ..default }), FileError::Limit(_)));
    let many = format!(r#"{{"nodes":[{}]}}"#, vec!["{}"; (1 << 20) + 1].join(","));
    assert_fault(many.as_bytes(), "objects in JSON, allowed 1048576");
}
