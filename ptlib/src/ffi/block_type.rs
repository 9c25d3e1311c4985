//! Block types: the catalogue's functions.

use std::{ffi::c_char, sync::Arc};

use super::{
    catalogue::BlockTypeObject,
    error::at,
    handle::{Handle, Opaque, Tagged, lend, tag},
    ptl_engine, ptl_param_info, ptl_port_info, ptl_status,
    structs::InOut,
};

/// A block type. It belongs to its engine and lives as long; any thread may read it.
#[derive(Debug)]
pub struct ptl_block_type {
    _opaque: [u8; 0],
}

impl Opaque for ptl_block_type {
    type Object = BlockTypeObject;
    const TAG: u32 = tag(b't');
    const NAME: &'static str = "ptl_block_type";
}

fn count<T>(list: &[T]) -> u32 {
    u32::try_from(list.len()).unwrap_or(u32::MAX)
}

/// The handle of a block type that stays in its engine's catalogue.
fn lent(found: Option<&Arc<Tagged<BlockTypeObject>>>) -> *const ptl_block_type {
    found.map_or(std::ptr::null(), |found| lend(found))
}

/// The number of block types; plug-ins add some. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_block_type_count(engine: *const ptl_engine) -> u32 {
    pt_fn!(else 0; engine: Handle<ptl_engine> =>
        u32::try_from(engine.catalogue.len()).unwrap_or(u32::MAX))
}

/// Block type number `index`: the built-in ones by family, then those of plug-ins in the order in
/// which they came. NULL if there is none.
///
/// Ownership: it lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_block_type_at(
    engine: *const ptl_engine,
    index: u32,
) -> *const ptl_block_type {
    pt_fn!(else std::ptr::null(); engine: Handle<ptl_engine> =>
        lent(engine.catalogue.at(index as usize).as_ref()))
}

/// The block type of that id, such as "perlin noise"; NULL if there is none.
///
/// Ownership: it lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_find_block_type(
    engine: *const ptl_engine,
    id: *const c_char,
) -> *const ptl_block_type {
    pt_fn!(else std::ptr::null(); engine: Handle<ptl_engine>, id: &str =>
        lent(engine.catalogue.find(id).as_ref()))
}

/// The id of a block type in files and in this interface. NULL for NULL.
///
/// Ownership: the text lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_id(block_type: *const ptl_block_type) -> *const c_char {
    pt_fn!(else std::ptr::null(); block_type: Handle<ptl_block_type> => block_type.id.as_ptr())
}

/// The name of a block type for a user interface. NULL for NULL.
///
/// Ownership: the text lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_name(block_type: *const ptl_block_type) -> *const c_char {
    pt_fn!(else std::ptr::null(); block_type: Handle<ptl_block_type> => block_type.name.as_ptr())
}

/// The family of a block type, such as "noise". NULL for NULL.
///
/// Ownership: the text lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_category(
    block_type: *const ptl_block_type,
) -> *const c_char {
    pt_fn!(else std::ptr::null(); block_type: Handle<ptl_block_type> =>
        block_type.category.as_ptr())
}

/// What a block type makes, in a sentence. NULL for NULL.
///
/// Ownership: the text lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_doc(block_type: *const ptl_block_type) -> *const c_char {
    pt_fn!(else std::ptr::null(); block_type: Handle<ptl_block_type> => block_type.doc.as_ptr())
}

/// The id of the plug-in that a block type comes from; empty for built-in ones. NULL for NULL.
///
/// Ownership: the text lives as long as the engine.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_plugin(block_type: *const ptl_block_type) -> *const c_char {
    pt_fn!(else std::ptr::null(); block_type: Handle<ptl_block_type> => block_type.plugin.as_ptr())
}

/// PTL_BLOCK_... flags of a block type. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_flags(block_type: *const ptl_block_type) -> u32 {
    pt_fn!(else 0; block_type: Handle<ptl_block_type> => block_type.flags())
}

/// The number of parameters of a block type. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_param_count(block_type: *const ptl_block_type) -> u32 {
    pt_fn!(else 0; block_type: Handle<ptl_block_type> => count(&block_type.params))
}

/// The number of inputs of a block type. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_input_count(block_type: *const ptl_block_type) -> u32 {
    pt_fn!(else 0; block_type: Handle<ptl_block_type> => count(&block_type.inputs))
}

/// The number of outputs of a block type. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_output_count(block_type: *const ptl_block_type) -> u32 {
    pt_fn!(else 0; block_type: Handle<ptl_block_type> => count(&block_type.outputs))
}

/// Fills in parameter number `index`.
///
/// Ownership: the texts live as long as the engine.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_param_info(
    block_type: *const ptl_block_type,
    index: u32,
    inout: *mut ptl_param_info,
) -> ptl_status {
    pt_fn!(std::ptr::null_mut();
        block_type: Handle<ptl_block_type>, inout: InOut<ptl_param_info> => {
        inout.set(&at(&block_type.params, index, "parameter")?.to_c());
        Ok(())
    })
}

/// Fills in input number `index`.
///
/// Ownership: the texts live as long as the engine.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_input_info(
    block_type: *const ptl_block_type,
    index: u32,
    inout: *mut ptl_port_info,
) -> ptl_status {
    pt_fn!(std::ptr::null_mut();
        block_type: Handle<ptl_block_type>, inout: InOut<ptl_port_info> => {
        inout.set(&at(&block_type.inputs, index, "input")?.to_c());
        Ok(())
    })
}

/// Fills in output number `index`.
///
/// Ownership: the texts live as long as the engine.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_block_type_output_info(
    block_type: *const ptl_block_type,
    index: u32,
    inout: *mut ptl_port_info,
) -> ptl_status {
    pt_fn!(std::ptr::null_mut();
        block_type: Handle<ptl_block_type>, inout: InOut<ptl_port_info> => {
        inout.set(&at(&block_type.outputs, index, "output")?.to_c());
        Ok(())
    })
}
