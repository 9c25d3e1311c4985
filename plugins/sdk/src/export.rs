//! What a plug-in exports: [`export_plugin!`](crate::export_plugin!).

use std::ffi::c_char;

use ptlib_plugin_abi::{PTLP_OK, ptlp_host, ptlp_status};

use crate::host;

/// The `init` of each plug-in.
///
/// # Safety
/// The contract.
pub unsafe extern "C" fn init(from: *const ptlp_host, _: *const c_char) -> ptlp_status {
    host::set(from);
    PTLP_OK
}

/// Makes a library a plug-in: its id (the vendor of its blocks' ids, or the vendor, a point and a
/// word), name, vendor, licence (an SPDX expression) and blocks. The version is that of the crate.
/// Inputs of graphs ([`GraphInput`](crate::GraphInput)), if there are any, follow the blocks as
/// `inputs: […]`.
///
/// ```text
/// export_plugin! {
///     id: c"acme.tools",
///     name: c"Acme tools",
///     vendor: c"Acme",
///     license: c"MIT",
///     blocks: [Threshold, Other],
/// }
/// ```
#[macro_export]
macro_rules! export_plugin {
    (
        id: $id:expr,
        name: $name:expr,
        vendor: $vendor:expr,
        license: $license:expr,
        blocks: [$($block:ty),* $(,)?] $(, inputs: [$($input:ty),* $(,)?])? $(,)?
    ) => {
        /// The plug-in, as the host finds it.
        #[allow(unsafe_code, reason = "the host finds it by this name")]
        #[allow(non_upper_case_globals, reason = "the name that the host looks for")]
        #[unsafe(no_mangle)]
        pub static ptl_plugin_entry_v1: $crate::private::abi::ptlp_entry = {
            use $crate::private::{self, abi};

            const BLOCKS: &[&abi::ptlp_block] = &[
                $({
                    static BLOCK: abi::ptlp_block = private::table::<$block>();
                    &BLOCK
                },)*
                $($({
                    static INPUT: abi::ptlp_block = private::graph_input::<$input>();
                    &INPUT
                },)*)?
            ];
            abi::ptlp_entry {
                struct_size: private::count(size_of::<abi::ptlp_entry>()),
                abi_major: abi::PTLP_ABI_MAJOR,
                abi_minor: abi::PTLP_ABI_MINOR,
                flags: 0,
                id: $id.as_ptr(),
                name: $name.as_ptr(),
                vendor: $vendor.as_ptr(),
                version: concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast(),
                license: $license.as_ptr(),
                built_with: private::BUILT_WITH.as_ptr().cast(),
                init: Some(private::init),
                deinit: None,
                get_extension: None,
                blocks: BLOCKS.as_ptr().cast(),
                block_count: private::count(BLOCKS.len()),
                reserved0: 0,
            }
        };

        $crate::private::abi::export_root_module!(ptl_plugin_entry_v1);
    };
}
