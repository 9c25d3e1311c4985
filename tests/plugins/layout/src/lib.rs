//! A root module of the name of a plug-in's, but whose function gives something else.

use abi_stable::{
    StableAbi, export_root_module, library::RootModule, package_version_strings,
    prefix_type::PrefixTypeTrait as _, sabi_types::VersionStrings,
};

/// What it exports.
#[repr(C)]
#[derive(Clone, Copy, StableAbi)]
#[sabi(kind(Prefix(prefix_ref = PluginRootRef)))]
#[sabi(missing_field(panic))]
#[allow(missing_debug_implementations, reason = "abi_stable gives the derived type its own")]
pub struct PluginRoot {
    /// Not an entry.
    #[sabi(last_prefix_field)]
    pub entry: extern "C" fn(u64) -> u64,
}

impl RootModule for PluginRootRef {
    abi_stable::declare_root_module_statics! {PluginRootRef}
    const BASE_NAME: &'static str = "ptplugin";
    const NAME: &'static str = "ptplugin";
    const VERSION_STRINGS: VersionStrings = package_version_strings!();
}

extern "C" fn entry(number: u64) -> u64 {
    number
}

#[export_root_module]
fn root() -> PluginRootRef {
    PluginRoot { entry }.leak_into_prefix()
}
