//! The file that pkg-config reads.

/// `ptlib.pc` of a version, for a static library that needs `native` besides.
pub(super) fn file(version: &str, native: &[String]) -> String {
    let native = native.join(" ");
    format!(
        "\
prefix=${{pcfiledir}}/../..
libdir=${{prefix}}/lib
includedir=${{prefix}}/include

Name: ptlib
Description: An engine for procedural textures
Version: {version}
Cflags: -I${{includedir}}
Libs: -L${{libdir}} -lptlib
# For `pkg-config --static`. Where both libraries are installed, linkers take the shared one for
# -lptlib: name the file ${{libdir}}/libptlib.a to get the other.
Libs.private: {native}
"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_names_no_place_and_all_libraries() {
        let text = file("1.2.3", &["-lm".to_owned(), "-lc".to_owned()]);
        assert!(text.starts_with("prefix=${pcfiledir}/../..\n"));
        assert!(text.contains("\nVersion: 1.2.3\n"));
        assert!(text.ends_with("\nLibs.private: -lm -lc\n"));
    }
}
