//! The files that CMake's `find_package(ptlib)` reads.

use super::Names;

/// `ptlib-config.cmake`: the targets `ptlib::shared`, `ptlib::static`, and for plug-ins
/// `ptlib::headers`.
pub(super) fn config(names: &Names, native: &[String]) -> String {
    let shared = names.shared();
    let (key, value) = match names.import() {
        Some(import) => ("IMPORTED_IMPLIB", format!("${{_ptlib_prefix}}/{}", import.installed)),
        None => ("IMPORTED_SONAME", names.soname().to_owned()),
    };
    let static_library = names.static_library();
    let native = native.join(";");
    format!(
        "\
# Targets: ptlib::shared, and ptlib::static for programs without other static libraries in Rust;
# ptlib::headers for plug-ins, which link nothing.
get_filename_component(_ptlib_prefix \"${{CMAKE_CURRENT_LIST_DIR}}/../../..\" ABSOLUTE)

if(NOT TARGET ptlib::shared)
  add_library(ptlib::shared SHARED IMPORTED)
  set_target_properties(ptlib::shared PROPERTIES
    IMPORTED_LOCATION \"${{_ptlib_prefix}}/{shared}\"
    {key} \"{value}\"
    INTERFACE_INCLUDE_DIRECTORIES \"${{_ptlib_prefix}}/include\")
endif()

if(NOT TARGET ptlib::static)
  add_library(ptlib::static STATIC IMPORTED)
  set_target_properties(ptlib::static PROPERTIES
    IMPORTED_LOCATION \"${{_ptlib_prefix}}/lib/{static_library}\"
    INTERFACE_COMPILE_DEFINITIONS PTL_STATIC
    INTERFACE_INCLUDE_DIRECTORIES \"${{_ptlib_prefix}}/include\"
    INTERFACE_LINK_LIBRARIES \"{native}\")
endif()

if(NOT TARGET ptlib::headers)
  add_library(ptlib::headers INTERFACE IMPORTED)
  set_target_properties(ptlib::headers PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES \"${{_ptlib_prefix}}/include\")
endif()

unset(_ptlib_prefix)
"
    )
}

/// `ptlib-config-version.cmake`: a version fits who asks for it or an older one with the same
/// first number, before 1.0 with the same first two.
pub(super) fn version(version: &str) -> String {
    let mut numbers = version.split('.');
    let (major, minor) = (numbers.next().unwrap_or("0"), numbers.next().unwrap_or("0"));
    let fits = if major == "0" { format!("0.{minor}") } else { major.to_owned() };
    let pattern = fits.replace('.', "[.]");
    format!(
        "\
set(PACKAGE_VERSION \"{version}\")
if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
elseif(\"${{PACKAGE_FIND_VERSION}}.\" MATCHES \"^{pattern}[.]\")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
else()
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
endif()
"
    )
}

#[cfg(test)]
mod tests {
    use super::{super::Platform, *};

    #[test]
    fn all_targets_are_there() {
        let text = config(&Names::new(Platform::Elf, 2), &["-lm".to_owned(), "-lc".to_owned()]);
        assert!(text.contains("IMPORTED_SONAME \"libptlib.so.2\""), "{text}");
        assert!(text.contains("/lib/libptlib.a\""));
        assert!(text.contains("INTERFACE_LINK_LIBRARIES \"-lm;-lc\""));
        assert!(text.contains("add_library(ptlib::headers INTERFACE IMPORTED)"));
    }

    #[test]
    fn versions_before_one_fit_by_two_numbers() {
        assert!(version("0.3.1").contains("\"^0[.]3[.]\""));
        assert!(version("2.3.1").contains("\"^2[.]\""));
    }
}
