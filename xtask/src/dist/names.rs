//! What files are called on each platform.

use crate::repository::VERSION;

/// A family of systems with the same names for libraries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Platform {
    /// Linux and the other systems with ELF files.
    Elf,
    /// macOS.
    MacOs,
    /// Windows with Microsoft's tools.
    Windows,
}

impl Platform {
    /// The platform that this task runs on, and builds for.
    pub(crate) fn here() -> Self {
        if cfg!(windows) {
            Self::Windows
        } else if cfg!(target_os = "macos") {
            Self::MacOs
        } else {
            Self::Elf
        }
    }
}

/// A file that linkers of Windows need for a shared library.
pub(crate) struct ImportLibrary {
    /// Its name as cargo builds it.
    pub(crate) built: &'static str,
    /// Its place in the tree.
    pub(crate) installed: &'static str,
}

/// The names of the libraries in the tree.
pub(crate) struct Names {
    platform: Platform,
    full: String,
    soname: String,
}

impl Names {
    pub(crate) fn new(platform: Platform, abi: u32) -> Self {
        let (full, soname) = match platform {
            Platform::Elf => {
                (format!("libptlib.so.{abi}.{}", minor_and_patch()), format!("libptlib.so.{abi}"))
            }
            Platform::MacOs => (
                format!("libptlib.{abi}.{}.dylib", minor_and_patch()),
                format!("@rpath/libptlib.{abi}.dylib"),
            ),
            Platform::Windows => ("ptlib.dll".to_owned(), "ptlib.dll".to_owned()),
        };
        Self { platform, full, soname }
    }

    /// The shared library as cargo builds it.
    pub(crate) fn built_shared(&self) -> &'static str {
        match self.platform {
            Platform::Elf => "libptlib.so",
            Platform::MacOs => "libptlib.dylib",
            Platform::Windows => "ptlib.dll",
        }
    }

    /// The place of the shared library in the tree. Windows looks for it where programs are.
    pub(crate) fn shared(&self) -> String {
        let folder = if self.platform == Platform::Windows { "bin" } else { "lib" };
        format!("{folder}/{}", self.full)
    }

    /// The name that programs linked with the shared library ask for.
    pub(crate) fn soname(&self) -> &str {
        &self.soname
    }

    /// The links that lead to the shared library: each place, and the name beside it that it
    /// leads to.
    pub(crate) fn links(&self) -> Vec<(String, &str)> {
        if self.platform == Platform::Windows {
            return vec![];
        }
        let soname = self.soname.trim_start_matches("@rpath/");
        vec![
            (format!("lib/{soname}"), self.full.as_str()),
            (format!("lib/{}", self.built_shared()), soname),
        ]
    }

    /// What Windows needs to link a shared library.
    pub(crate) fn import(&self) -> Option<ImportLibrary> {
        let import = ImportLibrary { built: "ptlib.dll.lib", installed: "lib/ptlib.dll.lib" };
        (self.platform == Platform::Windows).then_some(import)
    }

    /// The static library.
    pub(crate) fn static_library(&self) -> &'static str {
        if self.platform == Platform::Windows { "ptlib.lib" } else { "libptlib.a" }
    }

    /// A program.
    pub(crate) fn program(&self, name: &str) -> String {
        let end = if self.platform == Platform::Windows { ".exe" } else { "" };
        format!("{name}{end}")
    }
}

/// What follows the ABI counter in the full name: the version without its first number.
fn minor_and_patch() -> &'static str {
    VERSION.split_once('.').map_or(VERSION, |(_, rest)| rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_from_the_short_name_to_the_full_one() {
        let names = Names::new(Platform::Elf, 4);
        let full = format!("libptlib.so.4.{}", minor_and_patch());
        assert_eq!(names.shared(), format!("lib/{full}"));
        assert_eq!(
            names.links(),
            [
                ("lib/libptlib.so.4".to_owned(), full.as_str()),
                ("lib/libptlib.so".to_owned(), "libptlib.so.4")
            ]
        );
        assert!(Names::new(Platform::MacOs, 4).shared().ends_with(".dylib"));
    }

    #[test]
    fn windows_has_no_links_but_an_import_library() {
        let names = Names::new(Platform::Windows, 4);
        assert_eq!((names.shared().as_str(), names.soname()), ("bin/ptlib.dll", "ptlib.dll"));
        assert!(names.links().is_empty() && names.import().is_some());
    }
}
