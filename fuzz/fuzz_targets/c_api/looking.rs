//! Calls that change nothing.

use std::{
    ffi::{CStr, c_char},
    ptr::{null, null_mut},
};

use ptlib::ffi::*;

use super::{structs::Place, tables::Session};

/// Checks a text that the library lent.
///
/// # Safety
/// `text` is NULL or ends with NUL.
unsafe fn check_text(text: *const c_char) {
    if !text.is_null() {
        // SAFETY: the caller's promise.
        let text = unsafe { CStr::from_ptr(text) };
        assert!(text.to_str().is_ok(), "{text:?}");
    }
}

impl Session<'_> {
    pub(crate) fn look(&mut self) {
        match self.input.below(8) {
            0 => self.look_at_versions(),
            1 => self.look_at_types(),
            2 => self.look_at_graph(),
            3 | 4 => self.look_at_block(),
            5 => self.look_at_faults(),
            6 => self.look_at_null(),
            _ => self.look_at_cancel(),
        }
    }

    /// Has a struct filled in, and checks where.
    fn fill<T>(&mut self, own: usize, fill: impl FnOnce(&mut Self, *mut T) -> ptl_status) {
        let (mut place, size) = Place::to_fill(&mut self.input, own);
        let target = if self.input.once_in(32) { null_mut() } else { place.as_ptr() };
        let status = fill(self, target);
        place.check(size, own, status == PTL_OK && !target.is_null());
    }

    fn look_at_versions(&mut self) {
        let name = self.input.text();
        let number = self.input.integer() as u32;
        // SAFETY: texts or NULL.
        unsafe {
            assert!(ptl_version_number() > 0 && ptl_abi_version() == PTL_ABI_VERSION);
            check_text(ptl_version_string());
            check_text(ptl_status_name(number.cast_signed()));
            assert!(ptl_abi_sizeof(number) < 1024);
            assert!((0..=1).contains(&ptl_has_feature(name.as_ptr())));
        }
    }

    fn look_at_types(&mut self) {
        let engine = self.engine();
        let (id, index, item) = (self.input.text(), self.input.index(), self.input.index());
        // SAFETY: live handles or NULL; types and their texts live as long as the engine.
        unsafe {
            let count = ptl_engine_block_type_count(engine);
            let mut block_type = ptl_engine_block_type_at(engine, index);
            assert_eq!(block_type.is_null(), index >= count);
            if self.input.once_in(4) {
                block_type = ptl_engine_find_block_type(engine, id.as_ptr());
            }
            if self.input.once_in(16) {
                block_type = self.graphs.any(&mut self.input).cast();
            }
            for text in [
                ptl_block_type_id,
                ptl_block_type_name,
                ptl_block_type_category,
                ptl_block_type_doc,
                ptl_block_type_plugin,
            ] {
                check_text(text(block_type));
            }
            let _ = ptl_block_type_flags(block_type);
            self.fill(size_of::<ptl_param_info>(), |_, info| {
                let status = ptl_block_type_param_info(block_type, item, info);
                assert!(item < ptl_block_type_param_count(block_type) || status != PTL_OK);
                status
            });
            self.fill(size_of::<ptl_port_info>(), |_, info| {
                let status = ptl_block_type_input_info(block_type, item, info);
                assert!(item < ptl_block_type_input_count(block_type) || status != PTL_OK);
                status
            });
            self.fill(size_of::<ptl_port_info>(), |_, info| {
                let status = ptl_block_type_output_info(block_type, item, info);
                assert!(item < ptl_block_type_output_count(block_type) || status != PTL_OK);
                status
            });
        }
    }

    fn look_at_graph(&mut self) {
        let (graph, index, file_id) = (self.graph(), self.input.index(), self.input.text());
        // SAFETY: live handles or NULL, texts or NULL, and places that live during the calls.
        unsafe {
            let count = ptl_graph_block_count(graph);
            let block = ptl_graph_block_at(graph, index);
            assert_eq!(block == 0, index >= count);
            let others =
                [ptl_graph_find_block(graph, file_id.as_ptr()), ptl_graph_main_result(graph)];
            for block in others.into_iter().chain([block]) {
                self.saw(block);
            }
            self.fill(size_of::<ptl_graph_info>(), |session, info| {
                session.call(|_, error| ptl_graph_get_info(graph, info, error))
            });
            self.fill(size_of::<ptl_fault>(), |_, fault| {
                let status = ptl_graph_warning_at(graph, index, fault);
                assert!(index < ptl_graph_warning_count(graph) || status != PTL_OK);
                status
            });
            let saved = self.call_for(|out, error| ptl_graph_save(graph, out, error));
            self.bytes.keep(saved);
        }
    }

    fn look_at_block(&mut self) {
        let (graph, block, port) = (self.graph(), self.block(), self.input.index() % 4);
        let (mut source, mut out_port, mut seed, mut is_own) = (77, 77, 77, 77);
        let own_place = if self.input.once_in(4) { null_mut() } else { &raw mut is_own };
        // SAFETY: live handles or NULL, and places that live during the calls.
        unsafe {
            let id = self.call_for(|out, error| ptl_graph_block_id(graph, block, out, error));
            self.bytes.keep(id);
            let id = self.call_for(|out, error| ptl_graph_block_type_id(graph, block, out, error));
            self.bytes.keep(id);
            let (to, to_port) = (&raw mut source, &raw mut out_port);
            let status = self
                .call(|_, error| ptl_graph_input_source(graph, block, port, to, to_port, error));
            assert!(status == PTL_OK || (source, out_port) == (77, 77), "untouched");
            let to = &raw mut seed;
            let status =
                self.call(|_, error| ptl_graph_get_block_seed(graph, block, to, own_place, error));
            assert!(status == PTL_OK || (seed, is_own) == (77, 77), "untouched");
            let _ = self.call(|_, error| ptl_graph_validate(graph, block, error));
        }
    }

    fn look_at_faults(&mut self) {
        let (error, index) = (self.error(), self.input.index());
        let bytes = self.a_bytes();
        // SAFETY: live handles or NULL, and texts that live as long as their error.
        unsafe {
            let _ = (ptl_error_status(error), ptl_error_block(error));
            check_text(ptl_error_message(error));
            check_text(ptl_error_param(error));
            self.fill(size_of::<ptl_fault>(), |_, fault| {
                let status = ptl_error_fault_at(error, index, fault);
                assert!(index < ptl_error_fault_count(error) || status != PTL_OK);
                status
            });
            let mut size = usize::MAX;
            let data = ptl_bytes_data(bytes, &raw mut size).cast::<u8>();
            assert!(!data.is_null() || size == 0);
            assert!(data.is_null() || data.add(size).read() == 0, "a NUL follows");
        }
    }

    fn look_at_null(&mut self) {
        let mut size = usize::MAX;
        // SAFETY: NULL is allowed everywhere here.
        unsafe {
            assert_eq!(ptl_graph_block_count(null()), 0);
            assert_eq!(ptl_graph_main_result(null()), 0);
            assert_eq!(ptl_graph_find_block(null(), null()), 0);
            assert_eq!(ptl_graph_warning_count(null()), 0);
            assert_eq!(ptl_engine_block_type_count(null()), 0);
            assert_eq!(ptl_error_fault_count(null()), 0);
            assert_eq!(ptl_cancel_is_requested(null()), 0);
            assert!(ptl_image_pixels(null(), &raw mut size).is_null() && size == 0);
            assert!(ptl_graph_retain(null_mut()).is_null());
            assert_eq!(ptl_job_poll(null(), null_mut()), PTL_E_INVALID_ARGUMENT);
            ptl_cancel_request(null_mut());
            ptl_compute_options_init(null_mut(), size);
            ptl_engine_options_init(null_mut(), 8);
        }
    }

    fn look_at_cancel(&mut self) {
        let cancel = self.cancel();
        // SAFETY: live handles or NULL.
        unsafe {
            if self.input.once_in(4) {
                let is_one = self.cancels.any(&mut self.input) == cancel && !cancel.is_null();
                ptl_cancel_request(cancel);
                assert!(!is_one || ptl_cancel_is_requested(cancel) == 1);
            }
            assert!((0..=1).contains(&ptl_cancel_is_requested(cancel)));
        }
    }
}
