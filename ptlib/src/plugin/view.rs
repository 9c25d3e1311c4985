//! Values as C structs: views that borrow everything from the value.
#![allow(unsafe_code, reason = "C structs are made of pointers")]

use std::{
    ffi::{CString, c_void},
    ptr,
};

use ptlib_plugin_abi::values::{
    PTL_STREAM_CONSTANT, ptl_gradient_data, ptl_gradient_stop, ptl_mesh_data, ptl_points_data,
    ptl_strands_data, ptl_stream, ptl_text_data,
};

use crate::value::{Bounds, Gradient, Mesh, Points, Strands, Stream, Value, Words};

/// A value as a C struct. The struct and everything that it points to live as long as this.
#[derive(Debug)]
pub(crate) struct View {
    body: Box<Body>,
    /// What `body` points to.
    _parts: Parts,
    _value: Value,
}

/// The struct.
#[derive(Debug)]
pub(crate) enum Body {
    Gradient(ptl_gradient_data),
    Text(ptl_text_data),
    Points(ptl_points_data),
    Mesh(ptl_mesh_data),
    Strands(ptl_strands_data),
}

/// What a struct points to besides the memory of its value. Boxed: moving this moves none of it.
#[derive(Debug, Default)]
struct Parts {
    streams: [List; 2],
    stops: Box<[ptl_gradient_stop]>,
    text: Box<[u8]>,
}

/// An array of pointers to streams.
#[derive(Debug, Default)]
struct List {
    pointers: Box<[*const ptl_stream]>,
    _streams: Box<[ptl_stream]>,
    _ids: Vec<CString>,
}

// SAFETY: the pointers lead to memory that this owns or keeps alive through its value, and that
// nobody changes.
unsafe impl Send for View {}
// SAFETY: as above.
unsafe impl Sync for View {}

impl View {
    /// The value as a struct; `None` for an image, which is seen through tiles and pixels.
    pub(crate) fn of(value: &Value) -> Option<Self> {
        let mut parts = Parts::default();
        let body = match value {
            Value::Image(_) => return None,
            Value::Gradient(gradient) => Body::Gradient(parts.gradient(gradient)),
            Value::Text(text) => Body::Text(parts.text(text)),
            Value::Points(points) => Body::Points(parts.points(points)),
            Value::Mesh(mesh) => Body::Mesh(parts.mesh(mesh)),
            Value::Strands(strands) => Body::Strands(parts.strands(strands)),
        };
        Some(Self { body: Box::new(body), _parts: parts, _value: value.clone() })
    }

    /// The struct.
    pub(crate) fn body(&self) -> &Body {
        &self.body
    }

    /// The struct as a wire holds it.
    #[allow(dead_code, reason = "the wires of plug-ins take it")]
    pub(crate) fn as_ptr(&self) -> *const c_void {
        match &*self.body {
            Body::Gradient(data) => ptr::from_ref(data).cast(),
            Body::Text(data) => ptr::from_ref(data).cast(),
            Body::Points(data) => ptr::from_ref(data).cast(),
            Body::Mesh(data) => ptr::from_ref(data).cast(),
            Body::Strands(data) => ptr::from_ref(data).cast(),
        }
    }
}

impl Parts {
    fn gradient(&mut self, gradient: &Gradient) -> ptl_gradient_data {
        let stop = |stop: &crate::value::GradientStop| ptl_gradient_stop {
            position: stop.position,
            color: stop.color,
        };
        self.stops = gradient.stops().iter().map(stop).collect();
        ptl_gradient_data {
            struct_size: size::<ptl_gradient_data>(),
            stop_count: count(self.stops.len()),
            stops: pointer(&self.stops),
        }
    }

    fn text(&mut self, text: &str) -> ptl_text_data {
        self.text = text.bytes().chain([0]).collect();
        ptl_text_data {
            struct_size: size::<ptl_text_data>(),
            flags: 0,
            text: self.text.as_ptr().cast(),
            size: text.len(),
        }
    }

    fn points(&mut self, points: &Points) -> ptl_points_data {
        self.streams[0] = List::of(points.streams());
        let Bounds { min, max } = points.bounds();
        ptl_points_data {
            struct_size: size::<ptl_points_data>(),
            flags: 0,
            point_count: points.count(),
            stream_count: self.streams[0].count(),
            streams: self.streams[0].pointer(),
            bounds_min: min,
            bounds_max: max,
        }
    }

    fn mesh(&mut self, mesh: &Mesh) -> ptl_mesh_data {
        self.streams[0] = List::of(mesh.streams());
        let Bounds { min, max } = mesh.bounds();
        ptl_mesh_data {
            struct_size: size::<ptl_mesh_data>(),
            flags: 0,
            vertex_count: mesh.vertex_count(),
            index_count: count(mesh.indices().len()),
            indices: words(mesh.indices()),
            streams: self.streams[0].pointer(),
            stream_count: self.streams[0].count(),
            reserved0: 0,
            bounds_min: min,
            bounds_max: max,
        }
    }

    fn strands(&mut self, strands: &Strands) -> ptl_strands_data {
        self.streams = [strands.point_streams(), strands.strand_streams()].map(List::of);
        let [points, of_strands] = &self.streams;
        let Bounds { min, max } = strands.bounds();
        ptl_strands_data {
            struct_size: size::<ptl_strands_data>(),
            flags: 0,
            strand_count: strands.count(),
            point_count: strands.point_count(),
            first_point: words(strands.first_point()),
            point_streams: points.pointer(),
            strand_streams: of_strands.pointer(),
            point_stream_count: points.count(),
            strand_stream_count: of_strands.count(),
            bounds_min: min,
            bounds_max: max,
        }
    }
}

impl List {
    fn of(streams: &[Stream]) -> Self {
        let id = |stream: &Stream| CString::new(stream.id()).unwrap_or_default();
        let ids: Vec<CString> = streams.iter().map(id).collect();
        let structs = streams.iter().zip(&ids).map(|(stream, id)| ptl_stream {
            struct_size: size::<ptl_stream>(),
            r#type: stream.shape().scalar as u32,
            components: stream.shape().components,
            flags: if stream.shape().is_constant { PTL_STREAM_CONSTANT } else { 0 },
            id: id.as_ptr(),
            data: if stream.elements() == 0 { ptr::null() } else { words(stream.data()).cast() },
            stride: stream.stride(),
        });
        let structs: Box<[ptl_stream]> = structs.collect();
        let pointers = structs.iter().map(ptr::from_ref).collect();
        Self { pointers, _streams: structs, _ids: ids }
    }

    fn pointer(&self) -> *const *const ptl_stream {
        pointer(&self.pointers)
    }

    fn count(&self) -> u32 {
        count(self.pointers.len())
    }
}

fn size<T>() -> u32 {
    count(size_of::<T>())
}

fn count(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Where a list starts; NULL for an empty one.
fn pointer<T>(list: &[T]) -> *const T {
    if list.is_empty() { ptr::null() } else { list.as_ptr() }
}

fn words(words: &Words) -> *const u32 {
    pointer(words)
}
