//! Calls that make, keep and release handles.

use std::{
    ffi::{CStr, c_char, c_void},
    ptr::{from_ref, null, null_mut},
    sync::atomic::Ordering,
};

use ptlib::ffi::*;

use super::{
    structs::Place,
    tables::{LogUse, Session},
};

/// The most logs of one run.
const MAX_LOGS: usize = 8;

impl Session<'_> {
    /// Creates an engine whose computations are tiny.
    pub(crate) fn create_engine(&mut self) {
        let mut options = Place::to_fill(&mut self.input, size_of::<ptl_engine_options>()).0;
        let place = options.as_ptr::<ptl_engine_options>();
        // SAFETY: the place has that many bytes, and all of them are initialised.
        let mut given = unsafe {
            ptl_engine_options_init(place, size_of::<ptl_engine_options>());
            place.read()
        };
        given.flags = self.input.of(&[0, 0, 0, PTL_ENGINE_NO_CACHE, 2]);
        given.threads = self.input.of(&[1, 2, 3]);
        given.cache_bytes = self.input.of(&[0, 1, 1 << 12, 1 << 20]);
        given.max_memory_bytes = self.input.of(&[8 << 20, 1 << 16, 1]);
        given.max_file_bytes = self.input.of(&[0, 1 << 12]);
        given.max_read_bytes = 1 << 12;
        (given.max_blocks, given.max_connections) = self.input.of(&[(0, 0), (3, 2), (64, 64)]);
        given.max_text_bytes = self.input.of(&[0, 8, 256]);
        given.max_text_symbols = 1 << 10;
        given.max_image_side = 32;
        given.max_faults = self.input.of(&[0, 1, 3]);
        let folders: [*const c_char; 2] = [c"/nowhere/ptlib".as_ptr(), c"".as_ptr()];
        given.read_folder_count = self.input.of(&[0, 1, 2]);
        given.write_folder_count = self.input.of(&[0, 0, 1]);
        given.read_folders = if self.input.once_in(16) { null() } else { folders.as_ptr() };
        given.write_folders = folders.as_ptr();
        // SAFETY: a struct of the header.
        let mut options = unsafe { Place::filled(&mut self.input, &given) };
        let options = options.as_ptr::<ptl_engine_options>();
        // SAFETY: the options, the folders and the places live during the calls.
        unsafe {
            let engine = self.call_for(|out, error| ptl_engine_create(options, out, error));
            if (options.cast::<u32>().read() as usize) < size_of::<ptl_engine_options>() {
                // Without the limits that keep this program small, it may only be released.
                ptl_engine_release(engine);
            } else {
                self.engines.keep(engine);
            }
        }
    }

    pub(crate) fn create_graph(&mut self) {
        let engine = self.engine();
        // SAFETY: a live handle or NULL, and places that live during the call.
        unsafe {
            let graph = self.call_for(|out, error| ptl_graph_create(engine, out, error));
            let _ = self.call(|_, error| ptl_graph_set_size(graph, 9, 7, error));
            self.graphs.keep(graph);
        }
    }

    /// Makes, keeps or releases something.
    pub(crate) fn own(&mut self) {
        match self.input.below(16) {
            0 => self.create_engine(),
            1 => self.create_graph(),
            2 => self.clone_graph(),
            3 => self.load(),
            4 => self.load_file(),
            5 => self.set_log(),
            6 => self.create_cancel(),
            7 | 8 => self.retain(),
            9 => self.engines.release_any(&mut self.input),
            10 => self.graphs.release_any(&mut self.input),
            11 => self.images.release_any(&mut self.input),
            12 => self.cancels.release_any(&mut self.input),
            13 => self.errors.release_any(&mut self.input),
            14 => self.bytes.release_any(&mut self.input),
            _ => self.release_as_another(),
        }
    }

    fn clone_graph(&mut self) {
        let graph = self.graph();
        // SAFETY: a live handle or NULL, and places that live during the call.
        let clone = self.call_for(|out, error| unsafe { ptl_graph_clone(graph, out, error) });
        self.graphs.keep(clone);
    }

    /// Loads bytes, or a damaged graph.
    fn load(&mut self) {
        let engine = self.engine();
        let mut file = Vec::new();
        if !self.input.once_in(4) {
            let graph = self.graph();
            // SAFETY: a live handle or NULL; the bytes live until they are released.
            unsafe {
                let saved = self.call_for(|out, error| ptl_graph_save(graph, out, error));
                let mut size = usize::MAX;
                let data = ptl_bytes_data(saved, &raw mut size).cast::<u8>();
                assert_eq!(data.is_null(), saved.is_null());
                if data.is_null() {
                    assert_eq!(size, 0);
                } else {
                    file.extend_from_slice(std::slice::from_raw_parts(data, size));
                    assert_eq!(data.add(size).read(), 0, "a NUL follows");
                }
                self.bytes.keep(saved);
            }
        }
        let count = self.input.below(64);
        let place = self.input.raw() as usize % (file.len() + 1);
        let end = file.len().min(place + self.input.below(16));
        file.splice(place..end, self.input.bytes(count).iter().copied());
        let data = if self.input.once_in(32) { null() } else { file.as_ptr() };
        // SAFETY: a live handle or NULL; `data` has as many bytes, and NULL is refused.
        let graph = self.call_for(|out, error| unsafe {
            ptl_graph_load(engine, data.cast(), file.len(), out, error)
        });
        self.graphs.keep(graph);
    }

    fn load_file(&mut self) {
        let engine = self.engine();
        let path = self.input.of(&[c"/nowhere/ptlib/graph.xml", c"", c"\xff", c"/"]);
        // SAFETY: a live handle or NULL, a text, and places that live during the call.
        let graph = self.call_for(|out, error| unsafe {
            ptl_graph_load_file(engine, path.as_ptr(), out, error)
        });
        assert!(graph.is_null(), "there is no such file");
    }

    fn set_log(&mut self) {
        if self.log_uses.len() == MAX_LOGS {
            return;
        }
        let engine = self.engine();
        let level = self.input.of(&[1, 2, 3, 4, 0, -1, 5]);
        let log: ptl_log_fn = if self.input.once_in(4) { None } else { Some(log) };
        let log_use = Box::<LogUse>::default();
        let user_data = from_ref(&*log_use).cast_mut().cast();
        // SAFETY: a live handle or NULL; `user_data` lives until the end of the run.
        let status = self.call(|_, error| unsafe {
            ptl_engine_set_log(engine, level, log, user_data, Some(free_log_use), error)
        });
        if status != PTL_OK {
            // "After an error it is not called", so that this is the one time.
            log_use.0.fetch_add(1, Ordering::SeqCst);
        }
        self.log_uses.push(log_use);
    }

    fn create_cancel(&mut self) {
        // SAFETY: places that live during the call.
        let cancel = self.call_for(|out, error| unsafe { ptl_cancel_create(out, error) });
        self.cancels.keep(cancel);
    }

    fn retain(&mut self) {
        // SAFETY: live handles, also of other types, or NULL.
        unsafe {
            match self.input.below(4) {
                0 => {
                    let engine = self.engine();
                    self.engines.keep(ptl_engine_retain(engine));
                }
                1 => {
                    let graph = self.graph();
                    self.graphs.keep(ptl_graph_retain(graph));
                }
                2 => {
                    let image = self.image();
                    self.images.keep(ptl_image_retain(image));
                }
                _ => {
                    let cancel = self.cancel();
                    self.cancels.keep(ptl_cancel_retain(cancel));
                }
            }
        }
    }

    /// Releases handles as what they are not: nothing happens.
    fn release_as_another(&mut self) {
        let graph = self.graphs.any(&mut self.input);
        let engine = self.engines.any(&mut self.input);
        // SAFETY: live handles or NULL.
        unsafe {
            ptl_engine_release(graph.cast());
            ptl_image_release(graph.cast());
            ptl_job_release(graph.cast());
            ptl_graph_release(engine.cast());
            ptl_error_release(engine.cast());
            ptl_bytes_release(engine.cast());
            ptl_cancel_release(engine.cast());
            ptl_cancel_release(null_mut());
        }
    }
}

unsafe extern "C" fn log(level: i32, message: *const c_char, user_data: *mut c_void) {
    assert!((PTL_LOG_DEBUG..=PTL_LOG_ERROR).contains(&level), "level {level}");
    // SAFETY: as the header says.
    let (message, log_use) = unsafe { (CStr::from_ptr(message), &*user_data.cast::<LogUse>()) };
    assert!(message.to_str().is_ok(), "{message:?}");
    assert_eq!(log_use.0.load(Ordering::SeqCst), 0, "`user_data` was given back");
}

unsafe extern "C" fn free_log_use(user_data: *mut c_void) {
    // SAFETY: it was given for this function, and lives until the end of the run.
    unsafe { &*user_data.cast::<LogUse>() }.0.fetch_add(1, Ordering::SeqCst);
}
