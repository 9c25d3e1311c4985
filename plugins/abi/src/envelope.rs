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
