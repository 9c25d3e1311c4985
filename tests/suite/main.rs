//! Suites that cross crates: `../README.md` says which test goes where.
#![expect(clippy::print_stdout, reason = "tests tell what they skipped and where they wrote")]

mod abi;
mod conformance;
mod examples;
mod frozen;
mod golden;
mod hostile;
mod hostile_laws;
mod inputs;
mod laws;
mod picture;
#[cfg(target_os = "linux")]
mod plugin_abi;
#[cfg(target_os = "linux")]
mod plugin_cpp;
#[cfg(target_os = "linux")]
mod plugin_faults;
#[cfg(target_os = "linux")]
mod plugin_hexagons;
#[cfg(target_os = "linux")]
mod plugin_kuwahara;
#[cfg(target_os = "linux")]
mod plugin_values;
#[cfg(target_os = "linux")]
mod plugins;
mod resolution;
mod simd;
mod specimen;
