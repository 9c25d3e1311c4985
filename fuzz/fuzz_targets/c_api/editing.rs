//! Calls that change a graph.

use std::ptr::{null, null_mut};

use ptlib::ffi::*;

use super::{input::Text, structs::Place, tables::Session};

impl Session<'_> {
    /// Adds, removes, connects.
    pub(crate) fn edit_blocks(&mut self) {
        let graph = self.graph();
        let (block, other) = (self.block(), self.block());
        let (port, other_port) = (self.input.index(), self.input.index() % 4);
        // SAFETY: live handles or NULL.
        let _ = match self.input.below(8) {
            0..3 => return self.add_block(graph),
            3 => self.call(|_, error| unsafe { ptl_graph_remove_block(graph, block, error) }),
            4 => self.call(|_, error| unsafe { ptl_graph_disconnect(graph, block, port, error) }),
            _ => self.call(|_, error| unsafe {
                ptl_graph_connect(graph, other, port % 3, block, other_port, error)
            }),
        };
    }

    fn add_block(&mut self, graph: *mut ptl_graph) {
        let text = self.input.text();
        let mut type_id = text.as_ptr();
        if !self.input.once_in(4) {
            let engine = self.engines.any(&mut self.input);
            // SAFETY: a live handle or NULL; the texts live as long as the engine.
            unsafe {
                let count = ptl_engine_block_type_count(engine).max(1);
                let index = u32::from(self.input.byte()) % count;
                type_id = ptl_block_type_id(ptl_engine_block_type_at(engine, index));
            }
        }
        let mut block = 0;
        let out = if self.input.once_in(32) { null_mut() } else { &raw mut block };
        // SAFETY: a live handle or NULL, a text or NULL, and a place or NULL.
        let status =
            self.call(|_, error| unsafe { ptl_graph_add_block(graph, type_id, out, error) });
        assert_eq!(block != 0, status == PTL_OK);
        self.saw(block);
    }

    /// The id of a parameter: mostly one that `block` has.
    fn parameter(&mut self, graph: *const ptl_graph, block: ptl_block) -> Text {
        if self.input.once_in(8) {
            return self.input.text();
        }
        let mut block_type = null();
        let index = self.input.index();
        let mut place = Place::to_fill(&mut self.input, size_of::<ptl_param_info>()).0;
        let info = place.as_ptr::<ptl_param_info>();
        // SAFETY: a live handle or NULL, and places that live during the calls. The texts live as
        // long as the engine, which the graph keeps alive.
        unsafe {
            info.write_bytes(0, 1);
            info.cast::<u32>().write(size_of::<ptl_param_info>() as u32);
            let status = self
                .call(|_, error| ptl_graph_block_type(graph, block, &raw mut block_type, error));
            assert_eq!(block_type.is_null(), status != PTL_OK);
            let count = ptl_block_type_param_count(block_type).max(1);
            match ptl_block_type_param_info(block_type, index % count, info) {
                PTL_OK => Text(Some(std::ffi::CStr::from_ptr((*info).id).to_owned())),
                _ => Text(Some(c"size".to_owned())),
            }
        }
    }

    /// Changes parameters and seeds.
    pub(crate) fn edit_parameters(&mut self) {
        let (graph, block) = (self.graph(), self.block());
        let parameter = self.parameter(graph, block);
        let id = parameter.as_ptr();
        // SAFETY: live handles or NULL, texts or NULL, and as many values as are told.
        let _ = match self.input.below(7) {
            0 => {
                let values = [self.input.float(), self.input.float()];
                let (from, count) = self.input.of(&[
                    (values.as_ptr(), 1),
                    (values.as_ptr(), 1),
                    (values.as_ptr(), 2),
                    (values.as_ptr(), 0),
                    (null(), 1),
                    (null(), u32::MAX),
                ]);
                self.call(|_, error| unsafe {
                    ptl_graph_set_float(graph, block, id, from, count, error)
                })
            }
            1 => {
                let value = self.input.integer();
                self.call(|_, error| unsafe { ptl_graph_set_int(graph, block, id, value, error) })
            }
            2 => {
                let text = self.input.text();
                self.call(|_, error| unsafe {
                    ptl_graph_set_text(graph, block, id, text.as_ptr(), error)
                })
            }
            3 => self.call(|_, error| unsafe { ptl_graph_reset_param(graph, block, id, error) }),
            4 => {
                let seed = self.input.integer().cast_unsigned();
                self.call(|_, error| unsafe { ptl_graph_set_block_seed(graph, block, seed, error) })
            }
            5 => self.call(|_, error| unsafe { ptl_graph_reset_block_seed(graph, block, error) }),
            _ => return self.get_parameter(graph, block, &parameter),
        };
    }

    /// Gets a parameter as everything; its text sets it to the same.
    fn get_parameter(&mut self, graph: *mut ptl_graph, block: ptl_block, parameter: &Text) {
        let id = parameter.as_ptr();
        let (mut numbers, mut count, mut integer) = ([0.25; 2], 77, 77);
        let capacity = self.input.of(&[1, 2, 0]);
        let count_place = if self.input.once_in(4) { null_mut() } else { &raw mut count };
        // SAFETY: live handles or NULL, texts or NULL, and places that live during the calls.
        unsafe {
            let to = numbers.as_mut_ptr();
            let status = self.call(|_, error| {
                ptl_graph_get_float(graph, block, id, to, capacity, count_place, error)
            });
            if status == PTL_OK {
                assert!(numbers[0].is_finite(), "no parameter holds {numbers:?}");
            } else {
                assert_eq!((numbers, count), ([0.25; 2], 77), "untouched");
            }
            let _ =
                self.call(|_, error| ptl_graph_get_int(graph, block, id, &raw mut integer, error));
            let text = self.call_for(|out, error| ptl_graph_get_text(graph, block, id, out, error));
            if !text.is_null() {
                let utf8 = ptl_bytes_data(text, null_mut()).cast();
                let status =
                    self.call(|_, error| ptl_graph_set_text(graph, block, id, utf8, error));
                assert_eq!(status, PTL_OK, "a parameter takes the text that it gave");
            }
            self.bytes.keep(text);
        }
    }

    /// Changes what holds for a graph as a whole.
    pub(crate) fn edit_settings(&mut self) {
        let graph = self.graph();
        let (a, b) = (self.input.integer() as u32, self.input.integer() as u32);
        // SAFETY: live handles or NULL, and texts or NULL.
        let _ = match self.input.below(6) {
            0 => self.call(|_, error| unsafe { ptl_graph_set_size(graph, a, b, error) }),
            1 => self.call(|_, error| unsafe { ptl_graph_set_size(graph, a % 17, b % 17, error) }),
            2 => self.call(|_, error| unsafe { ptl_graph_set_seed(graph, a.into(), error) }),
            3 => self.call(|_, error| unsafe { ptl_graph_set_supersampling(graph, a % 3, error) }),
            4 => self.call(|_, error| unsafe { ptl_graph_set_precision(graph, a % 4, error) }),
            _ => {
                let folder = self.input.of(&[c"/nowhere/ptlib".as_ptr(), c"".as_ptr(), null()]);
                self.call(|_, error| unsafe { ptl_graph_set_folder(graph, folder, error) })
            }
        };
    }
}
