//! Reads a mesh from a file: OBJ, PLY, glTF or GLB ([`super::files`]).
//!
//! Only what the caller opened is read, also the files that a glTF names. The second texture
//! coordinate is that of the file in OBJ and PLY, which let it point up; in glTF it points down and
//! is turned. Tangents of a file are passed over: `mesh frames` makes them of what is there.

use ptlib_plugin::{
    prelude::*,
    stream::{NORMAL, POSITION, TEXCOORD},
};

use super::files::{self, FileMesh, Limits, Outside};

choice! {
    /// What a file is.
    Format {
        /// What its first bytes say.
        ByContent = "by content",
        /// Wavefront OBJ.
        Obj = "obj",
        /// PLY, the Stanford polygon format: text or binary.
        Ply = "ply",
        /// glTF 2.0: JSON, or all in one file (GLB).
        Gltf = "gltf",
    }
}

params! {
    /// Parameters of [`LoadMesh`].
    Params {
        /// The file of the mesh: OBJ, PLY, glTF or GLB. It is looked for beside the graph, and in
        /// the folders that the program opened.
        path: path [read] = "";
        /// What the file is. Its first bytes tell, so it need not be said.
        format: choice [Format] = Format::ByContent;
        /// What every coordinate is multiplied by: 1 leaves the mesh as it is, 0.01 makes metres of
        /// centimetres.
        scale: float [hard 0.000001..=1000000.0 soft 0.01..=100.0] = 1.0;
        /// Whether the texture is upside down in this file: the second texture coordinate becomes
        /// 1 minus itself.
        flip_v "flip v": bool = false;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct LoadMesh(Params);

impl Block for LoadMesh {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.load mesh",
        name: c"Load mesh",
        category: c"mesh",
        summary: c"Reads a mesh from an OBJ, PLY, glTF or GLB file.",
        outputs: &[&output(c"mesh", Planes::Grey).of_kind(Kind::Mesh).doc(
            c"The triangles of the file, with normals and texture coordinates if it has them.",
        )],
        shape: Shape::Whole,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(params.clone()))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let Self(Params { path, format, .. }) = self;
        if path.is_empty() {
            let message = "parameter \"path\" names no file: give one in OBJ, PLY or glTF";
            return Err(BlockError::invalid(message));
        }
        let format = match format {
            Format::ByContent => None,
            Format::Obj => Some(files::Format::Obj),
            Format::Ply => Some(files::Format::Ply),
            Format::Gltf => Some(files::Format::Gltf),
        };
        let beside = Beside { work: call.work(), path };
        let bytes = beside.work.read_file(path)?;
        beside.work.report(0.3);
        let mesh = files::read(&bytes, format, &beside, &Limits::default())
            .map_err(|error| error.of_file(path))?;
        drop(bytes);
        beside.work.report(0.8);
        self.give(call, &mesh)
    }
}

impl LoadMesh {
    /// Gives what was read, scaled.
    fn give(&self, call: &Call<'_>, mesh: &FileMesh) -> Result<(), BlockError> {
        let FileMesh { positions, normals, texcoords, triangles } = mesh;
        let streams = (
            POSITION,
            (!normals.is_empty()).then_some(NORMAL),
            (!texcoords.is_empty()).then_some(TEXCOORD),
        );
        let count = Triangles::New(triangles.len());
        let mut out = call.new_mesh(0, positions.len(), count, streams)?;
        out.triangles().copy_from_slice(triangles);
        let Params { scale, flip_v, .. } = self.0;
        out.fill(|first, (places, directions, coordinates)| {
            for (out, position) in places.iter_mut().zip(&positions[first..]) {
                *out = position.map(|x| math::single(f64::from(x) * scale));
            }
            if let Some(directions) = directions {
                directions.copy_from_slice(&normals[first..][..directions.len()]);
            }
            if let Some(coordinates) = coordinates {
                for (out, [u, v]) in coordinates.iter_mut().zip(&texcoords[first..]) {
                    *out = [*u, if flip_v { 1.0 - v } else { *v }];
                }
            }
            Ok(())
        })?;
        out.finish()
    }
}

/// The files beside the one that is read.
struct Beside<'a> {
    work: Work<'a>,
    path: &'a str,
}

impl Outside for Beside<'_> {
    fn check(&self) -> Result<(), BlockError> {
        self.work.check()
    }

    fn read(&self, name: &str) -> Result<Vec<u8>, BlockError> {
        let folder = self.path.rfind(['/', '\\']).map_or("", |end| &self.path[..=end]);
        self.work.read_file(&format!("{folder}{name}"))
    }
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use ptlib::{
        ComputeOptions, Engine, EngineOptions, Error, Limits, params::ParamValue, value::Value,
    };

    use crate::{mesh::testing, testing::register};

    /// A folder of files, gone at the end.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let folder = format!("ptlib-aging-{}-{name}", std::process::id());
            let folder = std::env::temp_dir().join(folder);
            fs::create_dir_all(folder.join("parts")).unwrap();
            Self(folder)
        }

        fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
            fs::write(self.0.join(name), bytes).unwrap();
        }

        fn load(&self, parameters: &[(&str, ParamValue)]) -> Result<Value, Error> {
            self.load_with(parameters, Limits::default())
        }

        fn load_with(
            &self,
            parameters: &[(&str, ParamValue)],
            limits: Limits,
        ) -> Result<Value, Error> {
            let engine = Engine::new(EngineOptions {
                cache_bytes: 0,
                read_folders: vec![self.0.clone()],
                limits,
                ..Default::default()
            });
            register(&engine);
            let mut graph = engine.new_graph();
            let block = graph.add("aging.load mesh").unwrap();
            for (name, value) in parameters {
                graph.set(block, name, value.clone()).unwrap();
            }
            engine.compute_value(&graph, block, 0, ComputeOptions::default())
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn path(name: &str) -> (&'static str, ParamValue) {
        ("path", ParamValue::Text(name.into()))
    }

    const OBJ: &str = "v 1 2 3\nv 3 2 1\nv 0 0 9\nvt 0.25 0.75\nvn 0 0 2\nf 1/1/1 2/1/1 3/1/1\n";

    #[test]
    fn a_file_becomes_a_mesh() {
        let folder = Folder::new("reads");
        folder.write("head.obj", OBJ);
        let Value::Mesh(mesh) = folder.load(&[path("head.obj")]).unwrap() else { panic!("kind") };
        assert_eq!(testing::floats(&mesh, "position")[1], [3.0, 2.0, 1.0]);
        assert_eq!(testing::floats(&mesh, "normal")[2], [0.0, 0.0, 1.0]);
        assert_eq!(testing::floats(&mesh, "texcoord")[0], [0.25, 0.75]);
        assert_eq!(&mesh.indices()[..], [0, 1, 2]);
        let parameters = [
            path("head.obj"),
            ("scale", ParamValue::Float(0.5)),
            ("flip v", ParamValue::Bool(true)),
            ("format", ParamValue::Choice(1)),
        ];
        let Value::Mesh(mesh) = folder.load(&parameters).unwrap() else { panic!("kind") };
        assert_eq!(testing::floats(&mesh, "position")[1], [1.5, 1.0, 0.5]);
        assert_eq!(testing::floats(&mesh, "texcoord")[0], [0.25, 0.25]);
    }

    #[test]
    fn the_head_of_the_examples_gets_frames_and_coordinates() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/head");
        let engine = Engine::new(EngineOptions {
            cache_bytes: 0,
            read_folders: vec![folder.into()],
            ..Default::default()
        });
        register(&engine);
        let mut graph = engine.new_graph();
        let [load, frames, sphere] = ["load mesh", "mesh frames", "sphere coordinates"]
            .map(|name| graph.add(&format!("aging.{name}")).unwrap());
        graph.set(load, "path", ParamValue::Text("head.ply".into())).unwrap();
        graph.connect(load, 0, frames, 0).unwrap();
        graph.connect(frames, 0, sphere, 0).unwrap();
        let value = engine.compute_value(&graph, sphere, 0, ComputeOptions::default()).unwrap();
        let Value::Mesh(mesh) = value else { panic!("kind") };
        let of = |id| testing::floats(&mesh, id);
        let (places, tangents, around) = (of("position"), of("tangent"), of("texcoord1"));
        for ((place, tangent), around) in places.iter().zip(&tangents).zip(&around) {
            assert_eq!(tangent[3].to_bits(), 1.0_f32.to_bits(), "{place:?}");
            // On the face the texture grows to the right of who looks at it, from its middle on.
            if place[2] > 0.5 {
                assert!(tangent[0] > 0.2, "{place:?}: {tangent:?}");
                assert!((around[0] - 0.5).abs() < 0.13, "{place:?}: {around:?}");
                assert!(place[0].abs() < 1e-3 || (around[0] > 0.5) == (place[0] > 0.0));
            }
        }
    }

    #[test]
    fn a_mesh_without_normals_and_coordinates_has_no_such_streams() {
        let folder = Folder::new("bare");
        folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        let Value::Mesh(mesh) = folder.load(&[path("bare.obj")]).unwrap() else { panic!("kind") };
        assert_eq!(mesh.streams().len(), 1);
    }

    #[test]
    fn buffers_lie_beside_their_file_and_nowhere_else() {
        let folder = Folder::new("beside");
        let bytes: Vec<u8> =
            [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 7.0_f32].map(f32::to_le_bytes).concat();
        folder.write("parts/a b.bin", &bytes);
        let gltf = |uri: &str| {
            format!(
                r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
                "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"accessors":[{{
                "bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],
                "max":[1,1,7]}}],"bufferViews":[{{"buffer":0,"byteLength":36}}],
                "buffers":[{{"byteLength":36,"uri":"{uri}"}}]}}"#
            )
        };
        folder.write("parts/head.gltf", gltf("a%20b.bin"));
        let Value::Mesh(mesh) = folder.load(&[path("parts/head.gltf")]).unwrap() else {
            panic!("kind")
        };
        assert_eq!(testing::floats(&mesh, "position")[2], [0.0, 1.0, 7.0]);
        folder.write("head.gltf", gltf("../../../../../etc/passwd"));
        let error = folder.load(&[path("head.gltf")]).unwrap_err().to_string();
        assert!(error.contains("may not read"), "{error}");
        folder.write("head.gltf", gltf("nowhere.bin"));
        let error = folder.load(&[path("head.gltf")]).unwrap_err().to_string();
        assert!(error.contains("nowhere.bin"), "{error}");
    }

    #[test]
    fn errors_name_the_block_the_file_and_the_place() {
        let folder = Folder::new("errors");
        folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
        let said = |parameters: &[_]| folder.load(parameters).unwrap_err().to_string();
        let error = said(&[path("bad.obj")]);
        for part in ["aging.load mesh", "\"bad.obj\": line 2:", "allowed"] {
            assert!(error.contains(part), "{error}");
        }
        assert!(said(&[path("nowhere.obj")]).contains("nowhere.obj"));
        assert!(said(&[]).contains("parameter \"path\""));
        let as_ply = [path("bad.obj"), ("format", ParamValue::Choice(2))];
        assert!(said(&as_ply).contains("\"bad.obj\": in the header: Line 1"));
        folder.write("good.obj", OBJ);
        let limits = Limits { mesh_vertices: 2, ..Limits::default() };
        let error = folder.load_with(&[path("good.obj")], limits).unwrap_err();
        assert!(error.to_string().contains("3 vertices are given, allowed 2"), "{error}");
        let huge = [path("good.obj"), ("scale", ParamValue::Float(1e6))];
        folder.write("good.obj", OBJ.replace("v 1 2 3", "v 1e17 0 0"));
        assert!(said(&huge).contains("allowed finite numbers"));
    }
}
