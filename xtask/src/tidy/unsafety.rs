//! Where `unsafe` may stand.

use super::{Fault, Rule, source::Source};

/// The only places with unsafe code. Everything else is proven by the compiler.
const PLACES: [&str; 3] = ["ptlib/src/ffi", "ptlib/src/math/simd", "ptlib/src/plugin"];

/// Unsafe code elsewhere, and attributes that would permit it.
pub(super) fn check(source: &Source) -> Vec<Fault> {
    let is_shipped = source.path.starts_with("ptlib/src/") || source.path.starts_with("ptc/src/");
    if !is_shipped || PLACES.iter().any(|place| source.path.starts_with(place)) {
        return vec![];
    }
    let places = ["unsafe", "unsafe_code"].into_iter().flat_map(|word| source.words(word));
    let fault = |at| {
        let message = format!("unsafe code is in {} only", PLACES.join(", "));
        Fault::new(Rule::Unsafe, &source.path, source.line(at), "", message)
    };
    places.map(fault).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsafe_code_has_its_places() {
        let count = |path, text| check(&Source::new(path, text)).len();
        assert_eq!(count("ptlib/src/run/pool.rs", "unsafe { f() }"), 1);
        assert_eq!(count("ptlib/src/run/pool.rs", "#![allow(unsafe_code)]"), 1);
        assert_eq!(count("ptlib/src/run/pool.rs", "// unsafe\nis_unsafe()"), 0);
        assert_eq!(count("ptlib/src/ffi/graph.rs", "unsafe { f() }"), 0);
    }
}
