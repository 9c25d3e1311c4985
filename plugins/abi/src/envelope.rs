//! The envelope of Rust plug-ins: a root module of `abi_stable`, whose one function gives the
//! entry. At load time `abi_stable` compares the layout of everything that can be reached from it
//! with the host's.

use abi_stable::{
    StableAbi,
    library::RootModule,
    package_version_strings,
    sabi_types::{RRef, VersionStrings},
};

pub use abi_stable::library::{LibraryError, lib_header_from_path};

use crate::ptlp_entry;

/// What a Rust plug-in exports.
#[repr(C)]
#[derive(Clone, Copy, StableAbi)]
#[sabi(kind(Prefix(prefix_ref = PluginRootRef)))]
#[sabi(missing_field(panic))]
#[allow(missing_debug_implementations, reason = "abi_stable gives the derived type its own")]
pub struct PluginRoot {
    /// The plug-in.
    #[sabi(last_prefix_field)]
    pub entry: extern "C" fn() -> RRef<'static, ptlp_entry>,
}

impl RootModule for PluginRootRef {
    abi_stable::declare_root_module_statics! {PluginRootRef}
    const BASE_NAME: &'static str = "ptplugin";
    const NAME: &'static str = "ptplugin";
    const VERSION_STRINGS: VersionStrings = package_version_strings!();
}

/// Where `abi_stable` looks for the root module of a library.
const _: () = {
    let name = abi_stable::library::ROOT_MODULE_LOADER_NAME.as_bytes();
    let here = b"_1as_0lib_1header_0root_bmodule_bloader";
    assert!(name.len() == here.len(), "the macro below has another name");
    let mut i = 0;
    while i < name.len() {
        assert!(name[i] == here[i], "the macro below has another name");
        i += 1;
    }
};

/// What the macro uses; not for people.
#[doc(hidden)]
pub mod private {
    pub use abi_stable::{
        library::{__call_root_module_loader, CheckTypeLayout, LibHeader, RootModuleResult},
        prefix_type::PrefixTypeTrait,
        sabi_types::RRef,
    };
}

/// Exports a static [`ptlp_entry`] as the root module of the library.
#[macro_export]
macro_rules! export_root_module {
    ($entry:path) => {
        #[allow(unsafe_code, reason = "abi_stable finds it by this name")]
        const _: () = {
            use $crate::envelope::{PluginRoot, PluginRootRef, private::*};

            extern "C" fn entry() -> RRef<'static, $crate::ptlp_entry> {
                RRef::new(&$entry)
            }

            fn root() -> PluginRootRef {
                PluginRoot { entry }.leak_into_prefix()
            }

            extern "C" fn module() -> RootModuleResult {
                __call_root_module_loader(root)
            }

            // SAFETY: `module` makes the module of that type.
            #[unsafe(export_name = "_1as_0lib_1header_0root_bmodule_bloader")]
            static HEADER: LibHeader = unsafe {
                LibHeader::from_constructor::<PluginRootRef>(module, CheckTypeLayout::Yes)
            };
        };
    };
}
