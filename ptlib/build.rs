//! Gives the shared library its soname.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let is_linux = std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux");
    if is_linux {
        // Counts the incompatible changes of the C ABI.
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libptlib.so.0");
    }
}
