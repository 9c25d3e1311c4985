//! Notes which compiler builds a plug-in: faults of compilers are found by it.

use std::process::Command;

fn main() {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(compiler).arg("--version").output();
    let version = version.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    println!("cargo:rustc-env=PTLIB_BUILT_WITH={}", version.unwrap_or_else(|_| "rustc".to_owned()));
    println!("cargo:rerun-if-changed=build.rs");
}
