//! Reads any bytes as a PLY file. What is read keeps the rules of meshes.
#![no_main]

mod mesh_rules;

use libfuzzer_sys::fuzz_target;
use ptlib_aging::mesh::files::{Format, ply};

fuzz_target!(|bytes: &[u8]| mesh_rules::check(bytes, Format::Ply, ply::read));
