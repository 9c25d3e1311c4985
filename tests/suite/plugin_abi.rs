//! The plug-in contract in C and in Rust are twins: the same structs with the same fields at the
//! same places, the same constants.

use std::{collections::BTreeMap, fmt::Write, fs, mem::offset_of, path::Path, process::Command};

use ptlib_plugin_abi::{services::*, values::*, *};

use crate::abi::{root, run, scratch, tool};

/// What C must say about each struct: one line for its size and one for each field.
#[derive(Default)]
struct Layout {
    expected: Vec<(String, usize)>,
}

/// Adds structs to a layout. The pattern is exhaustive: a field that is left out does not compile.
macro_rules! structs {
    ($layout:ident: $($name:ident { $($field:ident),+ $(,)? })+) => {$({
        #[allow(dead_code, reason = "it is there to be compiled")]
        fn all_fields(value: &$name) {
            let $name { $($field: _),+ } = value;
        }
        let name = stringify!($name);
        $layout.expected.push((format!("sizeof({name})"), size_of::<$name>()));
        $(
            let field = stringify!($field).trim_start_matches("r#");
            $layout.expected.push((format!("offsetof({name}, {field})"), offset_of!($name, $field)));
        )+
    })+};
}

fn layout() -> Layout {
    let mut layout = Layout::default();
    structs! { layout:
        ptl_stream { struct_size, r#type, components, flags, id, data, stride }
        ptl_mesh_data {
            struct_size, flags, vertex_count, index_count, indices, streams, stream_count,
            reserved0, bounds_min, bounds_max,
        }
        ptl_points_data {
            struct_size, flags, point_count, stream_count, streams, bounds_min, bounds_max,
        }
        ptl_strands_data {
            struct_size, flags, strand_count, point_count, first_point, point_streams,
            strand_streams, point_stream_count, strand_stream_count, bounds_min, bounds_max,
        }
        ptl_gradient_stop { position, color }
        ptl_gradient_data { struct_size, stop_count, stops }
        ptl_text_data { struct_size, flags, text, size }
        ptl_image_data { struct_size, format, width, height, pixels, row_stride }
        ptlp_host { struct_size, abi_major, abi_minor, flags, name, version, data, get_extension }
        ptlp_job { struct_size, flags, data, is_cancelled, report, set_error, warn }
        ptlp_port { struct_size, kind, flags, planes, planes_input, reserved0, id, doc }
        ptlp_param {
            struct_size, r#type, flags, choice_count, min, max, soft_min, soft_max, default_value,
            id, doc, unit, default_text, choice_ids, choice_docs,
        }
        ptlp_value { r#type, reserved0, integer, number, text, reserved1 }
        ptlp_tile {
            struct_size, channels, x, y, width, height, image_width, image_height, row_stride,
            planes,
        }
        ptlp_wire { struct_size, kind, value }
        ptlp_setup {
            struct_size, flags, width, height, precision, value_count, input_count, reserved0,
            seed, values, inputs,
        }
        ptlp_block {
            struct_size, version, shape, thread_mode, flags, input_count, output_count,
            param_count, id, name, category, doc, tiling_exception, in_pixels, inputs, outputs,
            params, user_data, create, destroy, prepare, compute, memory,
        }
        ptlp_entry {
            struct_size, abi_major, abi_minor, flags, id, name, vendor, version, license,
            built_with, init, deinit, get_extension, blocks, block_count, reserved0,
        }
        ptlp_log { struct_size, reserved0, write }
        ptlp_parallel { struct_size, reserved0, run }
        ptlp_scratch { struct_size, reserved0, allocate, release }
        ptlp_noise { struct_size, reserved0, hash, uniform, elias }
        ptlp_math {
            struct_size, reserved0, sin, cos, tan, asin, acos, atan, atan2, exp, exp2, log, log2,
            pow, tanh, cbrt,
        }
        ptlp_values {
            struct_size, reserved0, mesh_begin, points_begin, strands_begin, finish, text,
            gradient, pass,
        }
        ptlp_file { struct_size, reserved0, read, write }
    }
    layout
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The numbers and texts that the Rust crate calls by a name.
fn constants_in_rust() -> BTreeMap<String, String> {
    let mut constants = BTreeMap::new();
    for file in ["lib", "values", "block", "services", "entry", "host", "envelope"] {
        let source = read(&format!("plugins/abi/src/{file}.rs"));
        for line in source.lines().filter_map(|line| line.strip_prefix("pub const ")) {
            let (name, rest) = line.split_once(':').expect("a constant has a type");
            let value = rest.split_once('=').expect("a constant has a value").1;
            let value = value.trim().trim_end_matches(';').trim_start_matches('c');
            constants.insert(name.to_owned(), value.to_owned());
        }
    }
    // In C it is the name of a variable, not a text.
    assert_eq!(constants.remove("PTLP_ENTRY_SYMBOL").as_deref(), Some("\"ptl_plugin_entry_v1\""));
    constants
}

/// The numbers and texts that the headers define.
fn constants_in_c() -> BTreeMap<String, String> {
    let headers = ["include/ptlib/ptlib_values.h", "include/ptlib/ptlib_plugin.h"].map(read);
    let lines = headers.iter().flat_map(|header| header.lines());
    let define = |line: &str| {
        let (name, value) = line.strip_prefix("#define ")?.split_once(' ')?;
        let is_value = value.starts_with(|first: char| first.is_ascii_digit() || first == '"');
        is_value.then(|| (name.to_owned(), value.to_owned()))
    };
    lines.filter_map(define).collect()
}

#[test]
fn constants_are_the_same_in_c_and_in_rust() {
    let (rust, c) = (constants_in_rust(), constants_in_c());
    assert!(rust.len() > 50, "{rust:?}");
    assert_eq!(rust, c);
}

#[test]
fn structs_are_the_same_in_c_and_in_rust() {
    let Some(compiler) = tool("cc") else { return };
    let layout = layout();
    let mut program = String::from(
        "#include <stddef.h>\n#include <stdio.h>\n#include \"ptlib/ptlib_plugin.h\"\n\
         int main(void) {\n",
    );
    for (expression, _) in &layout.expected {
        writeln!(program, "printf(\"%lu\\n\", (unsigned long){expression});").unwrap();
    }
    program.push_str("return 0; }\n");
    let folder = scratch().join("plugin-layout");
    fs::create_dir_all(&folder).unwrap();
    let (source, binary) = (folder.join("layout.c"), folder.join("layout"));
    fs::write(&source, program).unwrap();
    compile(&compiler, &source, &binary);
    let output = run(&mut Command::new(&binary));
    let numbers = output.lines().map(|line| line.parse::<usize>().unwrap());
    let found: Vec<_> = layout.expected.iter().map(|(name, _)| name.clone()).zip(numbers).collect();
    assert_eq!(found, layout.expected);
    assert_eq!(output.lines().count(), layout.expected.len());
    assert_every_struct_is_listed(&layout);
}

fn compile(compiler: &Path, source: &Path, binary: &Path) {
    let mut command = Command::new(compiler);
    command.arg("-I").arg(root().join("include")).arg(source).arg("-o").arg(binary);
    run(&mut command);
}

fn assert_every_struct_is_listed(layout: &Layout) {
    for header in ["include/ptlib/ptlib_values.h", "include/ptlib/ptlib_plugin.h"] {
        let text = read(header);
        let structs = text.lines().filter_map(|line| {
            let line = line.strip_prefix("typedef ").unwrap_or(line);
            line.strip_prefix("struct ")?.strip_suffix(" {")
        });
        for name in structs {
            let size = format!("sizeof({name})");
            assert!(layout.expected.iter().any(|(listed, _)| *listed == size), "{name}");
        }
    }
}

#[test]
fn headers_compile_as_every_c_and_cpp() {
    let standards = [
        ("cc", "c", &["c89", "c99", "c11", "c17", "c2x"][..]),
        ("c++", "c++", &["c++98", "c++11", "c++17", "c++20"][..]),
    ];
    for (compiler, language, standards) in standards {
        let Some(compiler) = tool(compiler) else { return };
        for standard in standards {
            let mut command = Command::new(&compiler);
            command.arg(format!("-std={standard}"));
            command.args(["-Wall", "-Wextra", "-Wpadded", "-pedantic-errors", "-Werror"]);
            command.args(["-fsyntax-only", "-x", language]);
            run(command.arg(root().join("include/ptlib/ptlib_plugin.h")));
        }
    }
}
