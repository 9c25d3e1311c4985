//! Calls that compute, and those that take what came out.

use std::{
    ffi::c_void,
    ptr::{null_mut, without_provenance_mut},
};

use ptlib::ffi::*;

use super::{canvas::Canvas, structs::Place, tables::Session};

const FORMATS: &[ptl_format] = &[
    PTL_FORMAT_AUTO,
    PTL_FORMAT_GREY8,
    PTL_FORMAT_RGB8,
    PTL_FORMAT_RGBA8,
    PTL_FORMAT_GREY16,
    PTL_FORMAT_RGB16,
    PTL_FORMAT_RGBA16,
    PTL_FORMAT_GREY_F32,
    PTL_FORMAT_RGB_F32,
    PTL_FORMAT_RGBA_F32,
    0x0102,
    u32::MAX,
];

/// Bytes of a pixel of a format.
fn pixel(format: ptl_format) -> usize {
    (format & 0xff) as usize * (format >> 8 & 0xff) as usize
}

/// Says what `user_data` is, after a look at what it was told.
unsafe extern "C" fn progress(progress: *const ptl_progress, user_data: *mut c_void) -> i32 {
    // SAFETY: valid during the call.
    let progress = unsafe { &*progress };
    assert!((0.0..=1.0).contains(&progress.fraction), "{progress:?}");
    assert!(progress.units_done <= progress.units_total, "{progress:?}");
    i32::from(!user_data.is_null())
}

impl Session<'_> {
    /// Options of a tiny computation.
    fn options(&mut self) -> ptl_compute_options {
        let mut place = Place::to_fill(&mut self.input, size_of::<ptl_compute_options>()).0;
        let options = place.as_ptr::<ptl_compute_options>();
        // SAFETY: the place has that many bytes, and all of them are initialised.
        let mut options = unsafe {
            ptl_compute_options_init(options, size_of::<ptl_compute_options>());
            options.read()
        };
        options.flags = self.input.of(&[0, 0, PTL_COMPUTE_SEED, PTL_COMPUTE_KEEP_GOING, 3, 4]);
        options.width = self.input.below(17) as u32;
        options.height = self.input.below(17) as u32;
        options.format = self.input.of(FORMATS);
        options.threads = self.input.of(&[0, 1, 2, 3]);
        options.seed = self.input.integer().cast_unsigned();
        options.memory_limit = self.input.of(&[0, 0, 0, 1, 1 << 14, 1 << 20]);
        if self.input.once_in(32) {
            options.region[3] = self.input.float();
        }
        options.progress_interval_ms = self.input.of(&[0, 1, u32::MAX]);
        options.supersampling = self.input.of(&[0, 0, 1, 2, 99]);
        options.precision = self.input.of(&[0, 0, 1, 2, 3]);
        if self.input.once_in(4) {
            options.cancel = self.cancel();
        }
        if self.input.once_in(2) {
            options.progress = Some(progress);
            options.user_data = without_provenance_mut(self.input.below(2));
        }
        if self.input.once_in(64) {
            options.reserved1 = without_provenance_mut(1);
        }
        options
    }

    /// A block to compute: mostly the last.
    fn output(&mut self) -> (ptl_block, u32) {
        let block = match self.blocks.last() {
            Some(block) if !self.input.once_in(3) => *block,
            _ => self.block(),
        };
        (block, self.input.of(&[0, 0, 0, 1, 2, u32::MAX]))
    }

    pub(crate) fn compute(&mut self) {
        let (graph, (block, port)) = (self.graph(), self.output());
        let given = self.options();
        // SAFETY: a struct of the header.
        let mut place = unsafe { Place::filled(&mut self.input, &given) };
        let options = if self.input.once_in(8) { null_mut() } else { place.as_ptr() };
        // SAFETY: live handles or NULL, and places that live during the calls; the cancel request
        // in the options is live, and `user_data` points to nothing.
        unsafe {
            match self.input.below(8) {
                0..3 => {
                    let image = self.call_for(|out, error| {
                        ptl_graph_compute(graph, block, port, options, out, error)
                    });
                    self.images.keep(image);
                }
                3..5 => {
                    let job = self.call_for(|out, error| {
                        ptl_graph_compute_start(graph, block, port, options, out, error)
                    });
                    self.jobs.keep(job);
                }
                5 => {
                    let _ = self.call(|_, error| ptl_graph_write_files(graph, options, error));
                }
                _ => self.compute_into(graph, block, port, options),
            }
        }
    }

    /// # Safety
    /// Live handles or NULL.
    unsafe fn compute_into(
        &mut self,
        graph: *const ptl_graph,
        block: ptl_block,
        port: u32,
        options: *const ptl_compute_options,
    ) {
        let mut canvas = Canvas::new(&mut self.input);
        let (size, stride) = (canvas.size, canvas.stride);
        let pixels = if self.input.once_in(32) { null_mut() } else { canvas.as_mut_ptr().cast() };
        let status = self.call(|_, error| {
            // SAFETY: the pixels are NULL or as many as told; the rest is the caller's promise.
            unsafe {
                ptl_graph_compute_into(graph, block, port, options, pixels, size, stride, error)
            }
        });
        canvas.check_margins();
        if matches!(status, PTL_E_BUFFER_TOO_SMALL | PTL_E_INVALID_ARGUMENT | PTL_E_LIMIT) {
            canvas.check_untouched();
        }
        // SAFETY: NULL, or options in a place that is larger than they are.
        if let Some(options) = unsafe { options.as_ref() }
            && status == PTL_OK
            && options.struct_size as usize >= size_of::<ptl_compute_options>()
            && options.width > 0
            && options.format != PTL_FORMAT_AUTO
        {
            let row = options.width as usize * pixel(options.format);
            canvas.check_gaps(row, options.height as usize);
        }
    }

    /// Asks jobs and images.
    pub(crate) fn use_results(&mut self) {
        match self.input.below(8) {
            0 => self.jobs.release_any(&mut self.input),
            1 => self.poll(),
            2 | 3 => self.wait(),
            4 => self.look_at_image(),
            5 => self.save_image(),
            _ => self.copy_image(),
        }
    }

    fn poll(&mut self) {
        let job = self.job();
        let (mut place, size) = Place::to_fill(&mut self.input, size_of::<ptl_progress>());
        // SAFETY: a live handle or NULL, and a place that lives during the call.
        let status = unsafe { ptl_job_poll(job, place.as_ptr()) };
        let is_filled = matches!(status, PTL_OK | PTL_PENDING);
        place.check(size, size_of::<ptl_progress>(), is_filled);
    }

    fn wait(&mut self) {
        let job = self.job();
        let timeout = self.input.of(&[-1, 0, 1, i64::MAX, i64::MIN]);
        // SAFETY: a live handle or NULL, and places that live during the calls.
        unsafe {
            let image = self.call_for(|out, error| ptl_job_wait(job, timeout, out, error));
            if !image.is_null() {
                assert_eq!(ptl_job_poll(job, null_mut()), PTL_OK);
            }
            self.images.keep(image);
        }
    }

    fn look_at_image(&mut self) {
        let image = self.image();
        let (mut place, size) = Place::to_fill(&mut self.input, size_of::<ptl_image_info>());
        let mut count = usize::MAX;
        // SAFETY: a live handle or NULL, and places that live during the calls. The pixels live
        // as long as the image.
        unsafe {
            let status = ptl_image_get_info(image, place.as_ptr());
            place.check(size, size_of::<ptl_image_info>(), status == PTL_OK);
            let pixels = ptl_image_pixels(image, &raw mut count).cast::<u8>();
            if pixels.is_null() {
                assert_eq!(count, 0);
                return;
            }
            assert_eq!(pixels.addr() % 64, 0, "pixels are aligned");
            std::hint::black_box(std::slice::from_raw_parts(pixels, count).to_vec());
            if status == PTL_OK && size >= size_of::<ptl_image_info>() {
                let info = place.as_ptr::<ptl_image_info>().read();
                assert_eq!(info.size_bytes, count);
                assert_eq!(info.row_stride, info.width as usize * pixel(info.format));
                assert_eq!(count, info.row_stride * info.height as usize);
            }
        }
    }

    fn save_image(&mut self) {
        let image = self.image();
        let path = self.input.of(&[
            c"/nowhere/ptlib/a.png",
            c"/nowhere/ptlib/a.exr",
            c"/nowhere/ptlib/a",
            c"",
            c"\xff",
        ]);
        // SAFETY: a live handle or NULL, and a text.
        let status = self.call(|_, error| unsafe { ptl_image_save(image, path.as_ptr(), error) });
        assert_ne!(status, PTL_OK, "there is no such folder");
    }

    fn copy_image(&mut self) {
        let image = self.image();
        let format = self.input.of(FORMATS);
        let mut canvas = Canvas::new(&mut self.input);
        let (pixels, size, stride) = (canvas.as_mut_ptr(), canvas.size, canvas.stride);
        let mut place = [0u64; size_of::<ptl_image_info>() / 8];
        let info = place.as_mut_ptr().cast::<ptl_image_info>();
        // SAFETY: a live handle or NULL, as many pixels as told, and a place for the struct.
        unsafe {
            info.cast::<u32>().write(size_of::<ptl_image_info>() as u32);
            let is_known = ptl_image_get_info(image, info) == PTL_OK;
            let status = self
                .call(|_, error| ptl_image_copy(image, format, pixels.cast(), size, stride, error));
            canvas.check_margins();
            assert!(is_known || status == PTL_E_INVALID_ARGUMENT);
            if status == PTL_OK {
                let info = info.read();
                let format = if format == PTL_FORMAT_AUTO { info.format } else { format };
                canvas.check_gaps(info.width as usize * pixel(format), info.height as usize);
            } else {
                canvas.check_untouched();
            }
        }
    }
}
