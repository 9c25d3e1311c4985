//! What is at the ports of a block, as a plug-in sees it.

use std::ptr;

use ptlib_plugin_abi::{
    ptlp_tile, ptlp_wire,
    values::{PTL_KIND_IMAGE, PTL_KIND_NONE},
};

use super::view::View;
use crate::{
    math::convert::count,
    value::{Image, Value},
};

/// A tile of nothing.
pub(super) const NO_TILE: ptlp_tile = ptlp_tile {
    struct_size: count(size_of::<ptlp_tile>()),
    channels: 0,
    x: 0,
    y: 0,
    width: 0,
    height: 0,
    image_width: 0,
    image_height: 0,
    row_stride: 0,
    planes: [ptr::null_mut(); 4],
};

/// What is at an input that is not connected.
pub(super) const NO_WIRE: ptlp_wire = ptlp_wire {
    struct_size: count(size_of::<ptlp_wire>()),
    kind: PTL_KIND_NONE,
    value: ptr::null(),
};

/// A wire with a tile.
#[inline]
pub(super) fn image_wire(tile: *const ptlp_tile) -> ptlp_wire {
    ptlp_wire { kind: PTL_KIND_IMAGE, value: tile.cast(), ..NO_WIRE }
}

/// Whole values at ports, with the tables that describe them. Pointers lead from one box to
/// another, so the object may be moved.
pub(super) struct Wires {
    pointers: Box<[*const ptlp_wire]>,
    _wires: Box<[ptlp_wire]>,
    _tiles: Box<[ptlp_tile]>,
    _values: Vec<Option<Value>>,
    _views: Vec<Option<View>>,
}

// SAFETY: the pointers lead to boxes and values of the same object, which nobody changes.
unsafe impl Send for Wires {}
// SAFETY: as above.
unsafe impl Sync for Wires {}

impl Wires {
    /// Of the inputs of a block: `values` has those that exist as wholes, `planes` the planes of
    /// images, also of those that only come row by row.
    pub(super) fn of_inputs(
        values: &[Option<Value>],
        planes: &[usize],
        (width, height): (u32, u32),
    ) -> Self {
        let tiles = values.iter().zip(planes).map(|(value, planes)| match value {
            Some(Value::Image(image)) => whole(image),
            _ => ptlp_tile {
                channels: count(*planes),
                image_width: width,
                image_height: height,
                ..NO_TILE
            },
        });
        let tiles: Box<[ptlp_tile]> = tiles.collect();
        let views: Vec<_> = values.iter().map(|value| View::of(value.as_ref()?)).collect();
        let wires = values.iter().zip(&tiles).zip(&views).map(|((value, tile), view)| {
            match (value, view) {
                (Some(value), Some(view)) => {
                    ptlp_wire { kind: value.kind() as u32, value: view.as_ptr(), ..NO_WIRE }
                }
                (Some(_), None) => image_wire(tile),
                (None, _) if tile.channels > 0 => image_wire(tile),
                (None, _) => NO_WIRE,
            }
        });
        let wires: Box<[ptlp_wire]> = wires.collect();
        Self {
            pointers: wires.iter().map(ptr::from_ref).collect(),
            _wires: wires,
            _tiles: tiles,
            _values: values.to_vec(),
            _views: views,
        }
    }

    /// One pointer a port.
    #[inline]
    pub(super) fn pointers(&self) -> &[*const ptlp_wire] {
        &self.pointers
    }
}

/// An image as a tile, to be read.
fn whole(image: &Image) -> ptlp_tile {
    let channels = image.planes();
    let plane = |channel: usize| {
        let is_there = channel < channels || (channels == 1 && channel < 3);
        if is_there { image.channel(channel).as_ptr().cast_mut() } else { ptr::null_mut() }
    };
    ptlp_tile {
        channels: count(channels),
        width: image.width(),
        height: image.height(),
        image_width: image.width(),
        image_height: image.height(),
        row_stride: image.width() as usize,
        planes: std::array::from_fn(plane),
        ..NO_TILE
    }
}

/// An image as a tile, to be written: for its only owner.
pub(super) fn to_write(image: &mut Image) -> ptlp_tile {
    let (width, height, channels) = (image.width(), image.height(), image.planes());
    let mut planes = [ptr::null_mut(); 4];
    for (place, plane) in planes.iter_mut().zip(image.planes_mut()) {
        *place = plane.as_mut_ptr();
    }
    if channels == 1 {
        planes = [planes[0], planes[0], planes[0], ptr::null_mut()];
    }
    ptlp_tile {
        channels: count(channels),
        width,
        height,
        image_width: width,
        image_height: height,
        row_stride: width as usize,
        planes,
        ..NO_TILE
    }
}
