//! Files that are read back: by the readers of others where there are such, by small ones here
//! else.

use std::{
    fs,
    path::PathBuf,
    sync::Arc,
    sync::atomic::{AtomicU32, Ordering},
};

use ply_rs_bw::{
    parser::Parser,
    ply::{DefaultElement, Ply, Property},
};
use ptlib::{
    Engine, EngineOptions, Error, ErrorKind, Limits,
    params::ParamValue,
    value::{StrandParts, Strands, Stream, StreamShape, Value, Words},
};

use crate::{
    hair::testing::{Scene, points},
    mesh::files::{self, Alone, FileMesh},
};

/// A folder for one test, which goes with it.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::SeqCst);
        let name = format!("ptlib-aging-hair-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).ok();
    }
}

#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
fn engine(folder: &Folder) -> Engine {
    let write_folders = vec![folder.0.clone()];
    let engine = Engine::new(EngineOptions { write_folders, ..Default::default() });
    // SAFETY: the entry is a static of this crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const crate::ptl_plugin_entry_v1) }.unwrap();
    engine
}

/// Saves values at the inputs points and strands, and gives the bytes of the file.
fn saved(given: [Option<Value>; 2], format: u32) -> Result<Vec<u8>, Error> {
    let folder = Folder::new();
    let path = folder.0.join("hair.bin");
    let mut scene = Scene::of_points(points(&[]));
    scene.engine = engine(&folder);
    scene.graph = scene.engine.new_graph();
    let block = scene.graph.add("aging.save strands").unwrap();
    for (port, (value, input)) in
        (0..).zip(given.into_iter().zip(["points input", "strands input"]))
    {
        if value.is_some() {
            let input = scene.graph.add(input).unwrap();
            scene.graph.set_input(input, value).unwrap();
            scene.graph.connect(input, 0, block, port).unwrap();
        }
    }
    let text = ParamValue::Text(path.to_string_lossy().into());
    scene.graph.set(block, "path", text).unwrap();
    scene.graph.set(block, "format", ParamValue::Choice(format)).unwrap();
    let Value::Text(report) = scene.value(block)? else { panic!("a text") };
    let bytes = fs::read(&path).unwrap();
    assert!(report.contains(&format!("{} bytes", bytes.len())), "{report}");
    Ok(bytes)
}

const PLY: u32 = 0;
const PLY_TEXT: u32 = 1;
const USDA: u32 = 2;
const GLB: u32 = 3;
const HAIR: u32 = 4;

/// Numbers that are hard to write.
const POSITIONS: [[f32; 3]; 7] = [
    [0.1, -0.0, 1.0 / 3.0],
    [1e-20, 3.4e17, -1e-42],
    [16_777_217.0, 1e9, 123_456.79],
    [0.0, 0.000_1, 0.000_099_999],
    [-5.5, 2.0, 8.0],
    [1.0, 2.0, 3.0],
    [4.0, 5.0, 6.0],
];
const FIRST: [u32; 4] = [0, 2, 5, 7];
const AGES: [f32; 3] = [1.0, 0.7, 1e-7];
const COLORS: [[f32; 3]; 3] = [[0.3, 0.2, 0.1], [1.0, 0.0, 0.5], [0.75, 0.75, 0.78]];
const RADII: [f32; 7] = [0.5, 0.0, 0.25, 0.1, 0.0, 1.0, 0.0];

fn floats(id: &str, components: u32, numbers: &[f32]) -> Stream {
    let words: Vec<u32> = numbers.iter().map(|number| number.to_bits()).collect();
    Stream::packed(StreamShape::floats(id, components), Words::copy_of(&words).unwrap()).unwrap()
}

fn strands() -> Value {
    let parts = StrandParts {
        point_count: 7,
        first_point: Words::copy_of(&FIRST).unwrap(),
        point_streams: vec![
            floats("position", 3, POSITIONS.as_flattened()),
            floats("radius", 1, &RADII),
        ],
        strand_streams: vec![
            floats("loss age", 1, &AGES),
            floats("color", 3, COLORS.as_flattened()),
        ],
    };
    Value::Strands(Arc::new(Strands::new(parts, &Limits::default()).unwrap()))
}

/// The strand of each point.
const STRANDS: [usize; 7] = [0, 0, 1, 1, 1, 2, 2];
const EDGES: [[u32; 2]; 4] = [[0, 1], [2, 3], [3, 4], [5, 6]];

fn ply(bytes: &[u8]) -> Ply<DefaultElement> {
    Parser::<DefaultElement>::new().read_ply(&mut &bytes[..]).unwrap()
}

/// What `load mesh` reads.
fn read_mesh(bytes: &[u8]) -> FileMesh {
    files::read(bytes, None, &Alone, &files::Limits::default()).unwrap()
}

fn float(element: &DefaultElement, name: &str) -> f32 {
    match element[name] {
        Property::Float(number) => number,
        ref other => panic!("{name} is {other:?}"),
    }
}

fn bytes_of(color: [f32; 3]) -> [u8; 3] {
    color.map(|channel| {
        (0..=255).rfind(|byte| f32::from(*byte) <= channel * 255.0 + 0.5).unwrap_or(0)
    })
}

#[test]
fn ply_of_strands_is_read_back() {
    for format in [PLY, PLY_TEXT] {
        let bytes = saved([None, Some(strands())], format).unwrap();
        let head = String::from_utf8_lossy(&bytes[..120]).into_owned();
        assert!(head.contains("comment ptlib aging 1\ncomment seed "), "{head}");
        let ply = ply(&bytes);
        let vertices = &ply.payload["vertex"];
        assert_eq!(vertices.len(), 7);
        for (i, vertex) in vertices.iter().enumerate() {
            let position = ["x", "y", "z"].map(|name| float(vertex, name));
            assert_eq!(position.map(f32::to_bits), POSITIONS[i].map(f32::to_bits), "{i}");
            assert_eq!(float(vertex, "age"), AGES[STRANDS[i]]);
            let color = ["red", "green", "blue"].map(|name| match vertex[name] {
                Property::UChar(byte) => byte,
                ref other => panic!("{other:?}"),
            });
            assert_eq!(color, bytes_of(COLORS[STRANDS[i]]));
        }
        let edges: Vec<_> = ply.payload["edge"]
            .iter()
            .map(|edge| {
                ["vertex1", "vertex2"].map(|name| match edge[name] {
                    Property::Int(vertex) => u32::try_from(vertex).unwrap(),
                    ref other => panic!("{other:?}"),
                })
            })
            .collect();
        assert_eq!(edges, EDGES);
        let own = read_mesh(&bytes).positions.into_iter().flatten().map(f32::to_bits);
        assert!(own.eq(POSITIONS.into_iter().flatten().map(f32::to_bits)), "by our own reader");
    }
}

#[test]
fn ply_of_points_has_all_that_hair_has() {
    let ages = [1.0, 0.6, 0.3];
    for format in [PLY, PLY_TEXT] {
        let bytes = saved([Some(points(&ages)), None], format).unwrap();
        let ply = ply(&bytes);
        let vertices = &ply.payload["vertex"];
        assert_eq!(vertices.len(), 3);
        let names = ["x", "y", "z", "nx", "ny", "nz", "s", "t", "age", "param"];
        for (i, vertex) in (0..3_u8).zip(vertices) {
            let x = f32::from(i);
            let age = ages[usize::from(i)];
            let expected = [x, 0.0, 0.0, 0.0, 0.0, 1.0, x / 8.0, 0.5, age, x / 65_536.0];
            assert_eq!(names.map(|name| float(vertex, name)), expected);
        }
        assert!(!ply.payload.contains_key("edge"));
        let own = read_mesh(&bytes);
        assert_eq!(own.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
        assert_eq!(own.normals, [[0.0, 0.0, 1.0]; 3]);
        assert_eq!(own.texcoords, [[0.0, 0.5], [0.125, 0.5], [0.25, 0.5]]);
    }
}

#[test]
fn many_strands_lie_where_they_should() {
    // More than a task has, of 2 to 4 points.
    let counts: Vec<u32> = (0..9000).map(|i| 2 + i % 3).collect();
    let first: Vec<u32> = std::iter::once(0)
        .chain(counts.iter().scan(0, |sum, count| {
            *sum += count;
            Some(*sum)
        }))
        .collect();
    let all = first[9000];
    let positions: Vec<f32> =
        (0..all).flat_map(|i| [f32::from(u16::try_from(i % 60_000).unwrap()), 0.0, 0.0]).collect();
    let ages: Vec<f32> = (0..9000_u16).map(|i| f32::from(i) / 9000.0).collect();
    let parts = StrandParts {
        point_count: all,
        first_point: Words::copy_of(&first).unwrap(),
        point_streams: vec![floats("position", 3, &positions)],
        strand_streams: vec![floats("loss age", 1, &ages)],
    };
    let strands = Value::Strands(Arc::new(Strands::new(parts, &Limits::default()).unwrap()));
    let [binary, text] = [PLY, PLY_TEXT]
        .map(|format| ply(&saved([None, Some(strands.clone())], format).unwrap()).payload);
    assert_eq!(binary, text);
    let edges = &binary["edge"];
    assert_eq!(edges.len(), all as usize - 9000);
    let mut expected = vec![];
    let mut of_points = vec![];
    for (strand, pair) in first.windows(2).enumerate() {
        expected.extend(pair[0]..pair[1] - 1);
        of_points.extend((pair[0]..pair[1]).map(|_| ages[strand]));
    }
    for (edge, first) in edges.iter().zip(expected) {
        assert_eq!(edge["vertex1"], Property::Int(i32::try_from(first).unwrap()));
        assert_eq!(edge["vertex2"], Property::Int(i32::try_from(first + 1).unwrap()));
    }
    for (vertex, age) in binary["vertex"].iter().zip(of_points) {
        assert_eq!(float(vertex, "age"), age);
    }
}

/// Without validation: as it is built here, the crate takes attributes of one's own for faults.
fn read_glb(bytes: &[u8]) -> gltf::Gltf {
    gltf::Gltf::from_slice_without_validation(bytes).unwrap()
}

/// The numbers of an accessor.
fn words(gltf: &gltf::Gltf, accessor: &gltf::Accessor<'_>) -> Vec<u32> {
    let blob = gltf.blob.as_ref().unwrap();
    let view = accessor.view().unwrap();
    let start = view.offset() + accessor.offset();
    let bytes = &blob[start..start + accessor.count() * accessor.size()];
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect()
}

#[test]
fn glb_is_read_back() {
    let bytes = saved([None, Some(strands())], GLB).unwrap();
    assert_eq!(bytes.len() % 4, 0);
    let gltf = read_glb(&bytes);
    let mesh = gltf.meshes().next().unwrap();
    let primitive = mesh.primitives().next().unwrap();
    assert_eq!(primitive.mode(), gltf::mesh::Mode::Lines);
    let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let position = primitive.get(&gltf::Semantic::Positions).unwrap();
    assert_eq!(words(&gltf, &position), bits(POSITIONS.as_flattened()));
    let bounds = [position.min().unwrap(), position.max().unwrap()];
    assert_eq!(bounds[0][0].as_f64(), Some(-5.5));
    assert_eq!(bounds[1][1].as_f64().map(ptlib::math::convert::single), Some(3.4e17));
    let color = primitive.get(&gltf::Semantic::Colors(0)).unwrap();
    let colors: Vec<f32> = STRANDS.iter().flat_map(|strand| COLORS[*strand]).collect();
    assert_eq!(words(&gltf, &color), bits(&colors));
    let indices = primitive.indices().unwrap();
    assert_eq!(words(&gltf, &indices), EDGES.as_flattened());
    // An attribute of one's own: the crate leaves it out, so it is the accessor between.
    let json = String::from_utf8_lossy(&bytes).into_owned();
    assert!(json.contains("\"_AGE\":2"));
    let ages: Vec<f32> = STRANDS.iter().map(|strand| AGES[*strand]).collect();
    assert_eq!(words(&gltf, &gltf.accessors().nth(2).unwrap()), bits(&ages));
    // Points.
    let bytes = saved([Some(points(&[1.0, 0.5])), None], GLB).unwrap();
    let gltf = read_glb(&bytes);
    let mesh = gltf.meshes().next().unwrap();
    let primitive = mesh.primitives().next().unwrap();
    assert_eq!(primitive.mode(), gltf::mesh::Mode::Points);
    assert!(primitive.indices().is_none());
}

#[test]
fn hair_files_are_read_back() {
    let bytes = saved([None, Some(strands())], HAIR).unwrap();
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!(&bytes[..4], b"HAIR");
    assert_eq!([word(4), word(8), word(12)], [3, 7, 1 | 2 | 4 | 16]);
    assert!(bytes[40..128].starts_with(b"ptlib aging 1, seed "));
    let segments: Vec<_> = bytes[128..134].chunks_exact(2).map(|s| [s[0], s[1]]).collect();
    assert_eq!(segments, [[1, 0], [2, 0], [1, 0]]);
    let numbers: Vec<u32> = (134..bytes.len()).step_by(4).map(word).collect();
    let colors = STRANDS.iter().flat_map(|strand| COLORS[*strand]);
    let expected = POSITIONS.as_flattened().iter().copied();
    let expected = expected.chain(RADII.iter().map(|radius| 2.0 * radius)).chain(colors);
    assert_eq!(numbers, expected.map(f32::to_bits).collect::<Vec<_>>());
}

/// The numbers of a list in USD.
fn list(text: &str, name: &str) -> Vec<f32> {
    let start = text.find(&format!("{name} = [")).unwrap() + name.len() + 4;
    let end = start + text[start..].find(']').unwrap();
    text[start..end]
        .split([',', '(', ')', ' '])
        .filter(|number| !number.is_empty())
        .map(|number| number.parse().unwrap())
        .collect()
}

#[test]
fn usda_is_read_back() {
    let text = String::from_utf8(saved([None, Some(strands())], USDA).unwrap()).unwrap();
    assert!(text.starts_with("#usda 1.0\n"));
    assert!(text.contains("def BasisCurves \"hair\"\n{"));
    assert!(text.contains("uniform token type = \"linear\""));
    let bits = |numbers: Vec<f32>| numbers.into_iter().map(f32::to_bits).collect::<Vec<_>>();
    assert_eq!(list(&text, "curveVertexCounts"), [2.0, 3.0, 2.0]);
    assert_eq!(bits(list(&text, "points")), bits(POSITIONS.as_flattened().to_vec()));
    assert_eq!(list(&text, "widths"), RADII.map(|radius| 2.0 * radius));
    assert_eq!(list(&text, "primvars:displayColor"), COLORS.as_flattened());
    assert_eq!(list(&text, "primvars:age"), AGES);
    assert_eq!(list(&text, "extent"), [-5.5, 0.0, -1e-42, 16_777_216.0, 3.4e17, 123_456.79]);
    let count = |sign| text.matches(sign).count();
    assert_eq!((count("["), count("("), count("{")), (count("]"), count(")"), count("}")));
    // Points.
    let text = saved([Some(points(&[1.0, 0.5])), None], USDA).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("def Points \"hair\"") && !text.contains("curveVertexCounts"));
}

#[test]
fn nothing_to_write_is_a_file_of_nothing() {
    let parts = StrandParts {
        point_count: 0,
        first_point: Words::copy_of(&[]).unwrap(),
        point_streams: vec![floats("position", 3, &[])],
        strand_streams: vec![],
    };
    let none = Value::Strands(Arc::new(Strands::new(parts, &Limits::default()).unwrap()));
    for format in [PLY, PLY_TEXT] {
        let ply = ply(&saved([None, Some(none.clone())], format).unwrap());
        assert_eq!(ply.header.elements["vertex"].count, 0);
    }
    let gltf = gltf::Gltf::from_slice(&saved([None, Some(none.clone())], GLB).unwrap()).unwrap();
    assert_eq!(gltf.meshes().len(), 0);
    assert_eq!(saved([None, Some(none.clone())], HAIR).unwrap().len(), 128);
    let text = String::from_utf8(saved([None, Some(none)], USDA).unwrap()).unwrap();
    assert!(list(&text, "points").is_empty());
}

#[test]
fn what_cannot_be_saved_is_refused() {
    let both = saved([Some(points(&[1.0])), Some(strands())], PLY).unwrap_err();
    assert_eq!(both.kind(), ErrorKind::InvalidArgument);
    assert!(both.message().contains("both `points` and `strands`"), "{both}");
    let none = saved([None, None], PLY).unwrap_err();
    assert_eq!(none.kind(), ErrorKind::Unconnected);
    assert!(none.message().contains("neither `points` nor `strands`"), "{none}");
    let points = saved([Some(points(&[1.0])), None], HAIR).unwrap_err();
    assert!(points.message().contains("connect `strands`"), "{points}");
}

#[test]
fn a_strand_too_long_for_hair_is_refused() {
    let of = |count: u32| {
        let parts = StrandParts {
            point_count: count + 2,
            first_point: Words::copy_of(&[0, 2, count + 2]).unwrap(),
            point_streams: vec![floats("position", 3, &vec![0.0; 3 * (count as usize + 2)])],
            strand_streams: vec![],
        };
        let strands = Value::Strands(Arc::new(Strands::new(parts, &Limits::default()).unwrap()));
        saved([None, Some(strands)], HAIR)
    };
    let error = of(65_537).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    let said = "strand 1 has 65537 points, allowed in `format` hair 65536";
    assert!(error.message().contains(said), "{error}");
    let bytes = of(65_536).unwrap();
    assert_eq!(bytes[130..132], [0xFF; 2]);
}

#[test]
fn files_are_only_written_where_they_may_be() {
    let (folder, other) = (Folder::new(), Folder::new());
    let mut scene = Scene::of_points(points(&[1.0]));
    let engine = engine(&folder);
    let block = scene.behind("aging.save strands", scene.source);
    let mut save = |path: String| {
        scene.graph.set(block, "path", ParamValue::Text(path.into())).unwrap();
        engine.compute_value(&scene.graph, block, 0, Default::default())
    };
    let error = save(String::new()).unwrap_err();
    assert!(error.message().contains("`path` is empty"), "{error}");
    let outside = other.0.join("hair.ply");
    let error = save(outside.to_string_lossy().into_owned()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Denied, "{error}");
    assert!(!outside.exists());
    // Each time, although the engine has a cache.
    let inside = folder.0.join("hair.ply");
    for _ in 0..2 {
        save(inside.to_string_lossy().into_owned()).unwrap();
        fs::remove_file(&inside).unwrap();
    }
}

#[test]
fn threads_do_not_matter() {
    let ages: Vec<f32> = (0..10_000_u16).map(|i| f32::from(i) / 10_000.0).collect();
    let folder = Folder::new();
    let mut scene = Scene::of_points(points(&ages));
    scene.engine = engine(&folder);
    let block = scene.behind("aging.save strands", scene.source);
    let path = folder.0.join("hair");
    let text = ParamValue::Text(path.to_string_lossy().into());
    scene.graph.set(block, "path", text).unwrap();
    for format in [PLY, PLY_TEXT, USDA, GLB] {
        scene.graph.set(block, "format", ParamValue::Choice(format)).unwrap();
        let file = |threads| {
            scene.value_on(block, threads).unwrap();
            fs::read(&path).unwrap()
        };
        let first = file(1);
        for threads in [2, 3, 8] {
            assert!(file(threads) == first, "{format} {threads}");
        }
    }
}
