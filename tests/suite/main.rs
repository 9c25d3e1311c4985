//! Suites that cross crates: `../README.md` says which test goes where.
#![expect(clippy::print_stdout, reason = "tests tell what they skipped and where they wrote")]

mod abi;
mod conformance;
mod examples;
mod frozen;
mod golden;
mod hostile;
mod hostile_laws;
mod laws;
mod picture;
mod resolution;
mod specimen;
