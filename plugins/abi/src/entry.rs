//! What a plug-in exports.

use std::ffi::{CStr, c_char, c_void};

use abi_stable::StableAbi;

use crate::{ptlp_block, ptlp_host, ptlp_status};

/// The data symbol of a plug-in: a [`ptlp_entry`].
pub const PTLP_ENTRY_SYMBOL: &CStr = c"ptl_plugin_entry_v1";

/// A plug-in.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_entry {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// [`PTLP_ABI_MAJOR`](crate::PTLP_ABI_MAJOR) of the tables.
    pub abi_major: u32,
    /// [`PTLP_ABI_MINOR`](crate::PTLP_ABI_MINOR) of the tables.
    pub abi_minor: u32,
    /// 0.
    pub flags: u32,
    /// Its id: the vendor of its blocks, or the vendor, a point and a word.
    pub id: *const c_char,
    /// What people call it.
    pub name: *const c_char,
    /// Who made it.
    pub vendor: *const c_char,
    /// Its version, such as `1.2.0`.
    pub version: *const c_char,
    /// The SPDX expression of its licence.
    pub license: *const c_char,
    /// The compiler that built it; may be NULL.
    pub built_with: *const c_char,
    /// Called once in a process, before anything else. May be NULL.
    pub init: Option<
        unsafe extern "C" fn(host: *const ptlp_host, plugin_path: *const c_char) -> ptlp_status,
    >,
    /// Only called by tools that check plug-ins. May be NULL.
    pub deinit: Option<unsafe extern "C" fn()>,
    /// What it offers besides, by id; NULL for unknown ids. May be NULL itself.
    pub get_extension: Option<unsafe extern "C" fn(id: *const c_char) -> *const c_void>,
    /// Its block types.
    pub blocks: *const *const ptlp_block,
    /// How many.
    pub block_count: u32,
    /// 0.
    pub reserved0: u32,
}

// SAFETY: the table is made once, by the plug-in, and only read from then on.
unsafe impl Sync for ptlp_entry {}
