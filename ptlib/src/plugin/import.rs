//! C structs from outside, turned into checked values.
//!
//! Every pointer, size and count is checked before it is used; that pointers lead where they say
//! is what the caller promises. What values may contain is checked by the values themselves.
#![allow(unsafe_code, reason = "pointers from outside are unsafe until they are checked")]

mod copied;

use std::{any::Any, cell::Cell, ffi::CStr, sync::Arc};

use ptlib_plugin_abi::values::{
    PTL_STREAM_CONSTANT, PTL_STREAM_F32, PTL_STREAM_U32, ptl_gradient_data, ptl_image_data,
    ptl_mesh_data, ptl_points_data, ptl_strands_data, ptl_stream, ptl_text_data,
};

use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    value::{
        Memory, Mesh, Points, Scalar, StrandParts, Strands, Stream, StreamShape, Words, WordsMut,
        check_bytes,
    },
};

/// Whoever gets the memory back when this is dropped for the last time.
pub(crate) type Owner = Arc<dyn Any + Send + Sync>;

/// A struct of the contract, which starts with its size.
///
/// # Safety
/// It is `repr(C)` and starts with `struct_size: u32`.
pub(crate) unsafe trait Sized32: Copy {
    /// Its name in messages.
    const NAME: &'static str;
}

// SAFETY: `repr(C)`, and the first field is the size.
unsafe impl Sized32 for ptl_stream {
    const NAME: &'static str = "ptl_stream";
}

// SAFETY: as above.
unsafe impl Sized32 for ptl_mesh_data {
    const NAME: &'static str = "ptl_mesh_data";
}

// SAFETY: as above.
unsafe impl Sized32 for ptl_points_data {
    const NAME: &'static str = "ptl_points_data";
}

// SAFETY: as above.
unsafe impl Sized32 for ptl_strands_data {
    const NAME: &'static str = "ptl_strands_data";
}

// SAFETY: as above.
unsafe impl Sized32 for ptl_gradient_data {
    const NAME: &'static str = "ptl_gradient_data";
}

// SAFETY: as above.
unsafe impl Sized32 for ptl_text_data {
    const NAME: &'static str = "ptl_text_data";
}

// SAFETY: as above.
unsafe impl Sized32 for ptl_image_data {
    const NAME: &'static str = "ptl_image_data";
}

/// Larger sizes are taken for uninitialised memory.
const MAX_STRUCT_SIZE: usize = 4096;

/// A struct from outside, checked.
///
/// # Safety
/// `raw` is NULL or points to a struct of the size in its first field.
pub(crate) unsafe fn read<T: Sized32>(raw: *const T, name: &str) -> Result<T, Error> {
    if raw.is_null() {
        return wrong(format!("`{name}` is NULL"));
    }
    if !raw.is_aligned() {
        return wrong(format!("`{name}` is not aligned for its type"));
    }
    // SAFETY: not null, aligned, and every struct starts with this field.
    let size = unsafe { raw.cast::<u32>().read() } as usize;
    let known = size_of::<T>();
    if !(known..=MAX_STRUCT_SIZE).contains(&size) {
        return wrong(format!("`{name}` has struct_size {size}, but a {} has {known}", T::NAME));
    }
    for place in known..size {
        // SAFETY: inside the struct, which has `size` bytes.
        if unsafe { raw.cast::<u8>().add(place).read() } != 0 {
            let message = format!(
                "`{name}` has struct_size {size} and uses what this version does not know: byte \
                 {place} is not 0"
            );
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
    }
    // SAFETY: not null, aligned, and at least as large as the type.
    Ok(unsafe { raw.read() })
}

fn wrong<T>(message: String) -> Result<T, Error> {
    Err(Error::new(ErrorKind::InvalidArgument, message))
}

/// That a field without a meaning is 0.
pub(crate) fn zero(number: u32, name: &str) -> Result<(), Error> {
    if number == 0 { Ok(()) } else { wrong(format!("`{name}` is {number}, allowed 0")) }
}

/// That a pointer is NULL exactly if it leads to nothing, and aligned.
fn check_array<T>(raw: *const T, count: usize, name: &str) -> Result<(), Error> {
    match (raw.is_null(), count) {
        (true, 1..) => wrong(format!("`{name}` is NULL, but has {count} elements")),
        (false, 0) => wrong(format!("`{name}` has no elements, allowed is NULL")),
        _ if !raw.is_aligned() => wrong(format!("`{name}` is not aligned to {}", align_of::<T>())),
        _ => Ok(()),
    }
}

/// What a stream is, without its data.
///
/// # Safety
/// `stream.id` is NULL or ends with NUL.
pub(crate) unsafe fn shape_of(stream: &ptl_stream, name: &str) -> Result<StreamShape, Error> {
    if stream.id.is_null() {
        return wrong(format!("`{name}.id` is NULL"));
    }
    // SAFETY: not null, and NUL-terminated (the caller's promise).
    let id = unsafe { CStr::from_ptr(stream.id) };
    let Ok(id) = id.to_str() else { return wrong(format!("`{name}.id` is not ASCII")) };
    let scalar = match stream.r#type {
        PTL_STREAM_F32 => Scalar::F32,
        PTL_STREAM_U32 => Scalar::U32,
        other => {
            return wrong(format!("`{name}.type` is {other}, allowed PTL_STREAM_F32 and _U32"));
        }
    };
    zero(stream.flags & !PTL_STREAM_CONSTANT, &format!("{name}.flags (unknown bits)"))?;
    let is_constant = stream.flags & PTL_STREAM_CONSTANT != 0;
    let shape = StreamShape { id: id.into(), scalar, components: stream.components, is_constant };
    shape.check()?;
    Ok(shape)
}

/// The pointers of an array of streams.
///
/// # Safety
/// `raw` is NULL or points to `count` pointers.
pub(crate) unsafe fn stream_pointers<'a>(
    raw: *const *const ptl_stream,
    count: u32,
    name: &str,
    limits: &Limits,
) -> Result<&'a [*const ptl_stream], Error> {
    check_array(raw, count as usize, name)?;
    if count > limits.streams {
        let message = format!("{count} streams are given, allowed {}", limits.streams);
        return Err(Error::new(ErrorKind::Limit, message));
    }
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not null, aligned, few, and `count` pointers (the caller's promise).
    Ok(unsafe { std::slice::from_raw_parts(raw, count as usize) })
}

/// Memory of somebody else.
struct Foreign {
    data: *const u32,
    len: usize,
    _owner: Owner,
}

// SAFETY: the memory does not change and stays until the owner is told (the promise of whoever
// lends it), whatever thread reads it.
unsafe impl Send for Foreign {}
// SAFETY: as above.
unsafe impl Sync for Foreign {}

impl Memory for Foreign {
    fn words(&self) -> &[u32] {
        // SAFETY: `len` words from `data` on are there, aligned and unchanged, until `_owner` is
        // dropped (the promise of whoever lends them).
        unsafe { std::slice::from_raw_parts(self.data, self.len) }
    }

    fn is_borrowed(&self) -> bool {
        true
    }
}

/// How structs become values.
pub(crate) struct Import<'a> {
    limits: &'a Limits,
    /// Who lends the memory; `None` to copy it.
    owner: Option<Owner>,
    /// Bytes that were copied.
    copied: Cell<u64>,
}

impl<'a> Import<'a> {
    /// Values of their own memory.
    pub(crate) fn copying(limits: &'a Limits) -> Self {
        Self { limits, owner: None, copied: Cell::new(0) }
    }

    /// Values of memory that `owner` gets back when the last of them is gone.
    pub(crate) fn borrowing(limits: &'a Limits, owner: Owner) -> Self {
        Self { limits, owner: Some(owner), copied: Cell::new(0) }
    }

    /// A mesh.
    ///
    /// # Safety
    /// All pointers are NULL or lead to what the header says; with an owner, until it is dropped.
    pub(crate) unsafe fn mesh(&self, raw: *const ptl_mesh_data) -> Result<Mesh, Error> {
        // SAFETY: the same promise.
        let data = unsafe { read(raw, "mesh") }?;
        zero(data.flags, "mesh.flags")?;
        zero(data.reserved0, "mesh.reserved0")?;
        let (vertices, indices) = (data.vertex_count, data.index_count as usize);
        Mesh::check_counts(vertices, indices, data.stream_count as usize, self.limits)?;
        // SAFETY: the same promise.
        let indices = unsafe { self.numbers(data.indices, indices, "mesh.indices") }?;
        let list = (data.streams, data.stream_count, "mesh.streams");
        // SAFETY: the same promise.
        let streams = unsafe { self.streams(list, vertices) }?;
        Mesh::new(vertices, indices, streams, self.limits)
    }

    /// Points.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    pub(crate) unsafe fn points(&self, raw: *const ptl_points_data) -> Result<Points, Error> {
        // SAFETY: the same promise.
        let data = unsafe { read(raw, "points") }?;
        zero(data.flags, "points.flags")?;
        Points::check_counts(data.point_count, data.stream_count as usize, self.limits)?;
        let list = (data.streams, data.stream_count, "points.streams");
        // SAFETY: the same promise.
        let streams = unsafe { self.streams(list, data.point_count) }?;
        Points::new(data.point_count, streams, self.limits)
    }

    /// Strands.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    pub(crate) unsafe fn strands(&self, raw: *const ptl_strands_data) -> Result<Strands, Error> {
        // SAFETY: the same promise.
        let data = unsafe { read(raw, "strands") }?;
        zero(data.flags, "strands.flags")?;
        let streams = data.point_stream_count as usize + data.strand_stream_count as usize;
        Strands::check_counts(data.strand_count, data.point_count, streams, self.limits)?;
        let entries = match (data.first_point.is_null(), data.strand_count) {
            (true, 0) => 0,
            _ => data.strand_count as usize + 1,
        };
        // SAFETY: the same promise.
        let first_point =
            unsafe { self.numbers(data.first_point, entries, "strands.first_point") }?;
        let list = (data.point_streams, data.point_stream_count, "strands.point_streams");
        // SAFETY: the same promise.
        let point_streams = unsafe { self.streams(list, data.point_count) }?;
        let list = (data.strand_streams, data.strand_stream_count, "strands.strand_streams");
        // SAFETY: the same promise.
        let strand_streams = unsafe { self.streams(list, data.strand_count) }?;
        let parts = StrandParts {
            point_count: data.point_count,
            first_point,
            point_streams,
            strand_streams,
        };
        Strands::new(parts, self.limits)
    }

    /// The streams of a value with `count` elements.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    unsafe fn streams(
        &self,
        (raw, streams, name): (*const *const ptl_stream, u32, &str),
        count: u32,
    ) -> Result<Vec<Stream>, Error> {
        // SAFETY: the same promise.
        let pointers = unsafe { stream_pointers(raw, streams, name, self.limits) }?;
        let stream = |(i, &raw): (usize, &*const ptl_stream)| {
            let name = format!("{name}[{i}]");
            // SAFETY: the same promise.
            let data = unsafe { read(raw, &name) }?;
            // SAFETY: the same promise.
            let shape = unsafe { shape_of(&data, &name) }?;
            // SAFETY: the same promise.
            unsafe { self.stream(&data, shape, count) }
        };
        pointers.iter().enumerate().map(stream).collect()
    }

    /// # Safety
    /// As [`mesh`](Self::mesh).
    unsafe fn stream(
        &self,
        raw: &ptl_stream,
        shape: StreamShape,
        count: u32,
    ) -> Result<Stream, Error> {
        let elements = shape.elements(count);
        shape.check_stride(raw.stride)?;
        let data = raw.data.cast::<u32>();
        check_array(data, elements, &format!("{}.data", shape.id))?;
        let stride = raw.stride / size_of::<u32>();
        let Some(extent) = shape.extent(stride, elements) else {
            return wrong(format!("stream \"{}\" is larger than memory can be", shape.id));
        };
        // SAFETY: `data` is not null unless it has no elements, aligned, and `extent` words long
        // (the caller's promise, which is about the elements).
        let words = unsafe { self.view(data, extent) };
        if let Some(owner) = &self.owner {
            let memory = Foreign { data: words.as_ptr(), len: extent, _owner: Arc::clone(owner) };
            return Stream::new(shape, Words::new(Arc::new(memory)), raw.stride, elements);
        }
        let components = shape.components as usize;
        let mut copy = self.new_words(shape.packed_words(count))?;
        let targets = copy.words_mut().chunks_exact_mut(components.max(1));
        for (target, i) in targets.zip(0..) {
            target.copy_from_slice(&words[i * stride..][..components]);
        }
        Stream::packed(shape, copy.freeze())
    }

    /// Whole numbers without gaps.
    ///
    /// # Safety
    /// As [`mesh`](Self::mesh).
    unsafe fn numbers(&self, raw: *const u32, count: usize, name: &str) -> Result<Words, Error> {
        check_array(raw, count, name)?;
        if isize::try_from(count.saturating_mul(size_of::<u32>())).is_err() {
            return wrong(format!("`{name}` is larger than memory can be"));
        }
        // SAFETY: not null unless empty, aligned, no larger than memory, and `count` numbers long
        // (the caller's promise).
        let words = unsafe { self.view(raw, count) };
        if let Some(owner) = &self.owner {
            let memory = Foreign { data: words.as_ptr(), len: count, _owner: Arc::clone(owner) };
            return Ok(Words::new(Arc::new(memory)));
        }
        let mut copy = self.new_words(count)?;
        copy.words_mut().copy_from_slice(words);
        Ok(copy.freeze())
    }

    /// # Safety
    /// `raw` is NULL and `len` 0, or it is aligned and leads to `len` words.
    unsafe fn view(&self, raw: *const u32, len: usize) -> &[u32] {
        if len == 0 {
            return &[];
        }
        // SAFETY: the same promise.
        unsafe { std::slice::from_raw_parts(raw, len) }
    }

    /// New memory, counted.
    fn new_words(&self, len: usize) -> Result<WordsMut, Error> {
        let bytes = (len as u64).saturating_mul(size_of::<u32>() as u64);
        let copied = self.copied.get().saturating_add(bytes);
        check_bytes(copied, self.limits)?;
        self.copied.set(copied);
        WordsMut::zeroed(len)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;
    use crate::{
        plugin::view::{Body, View},
        value::{Gradient, GradientStop, Value},
    };

    /// Tells when nobody needs the memory any more.
    struct Told(Arc<AtomicBool>);

    impl Drop for Told {
        fn drop(&mut self) {
            self.0.store(true, Ordering::SeqCst);
        }
    }

    fn stream(id: &CStr, components: u32, data: &[f32], stride: usize) -> ptl_stream {
        ptl_stream {
            struct_size: u32::try_from(size_of::<ptl_stream>()).unwrap(),
            r#type: PTL_STREAM_F32,
            components,
            flags: 0,
            id: id.as_ptr(),
            data: data.as_ptr().cast(),
            stride,
        }
    }

    fn strands(first_point: &[u32], streams: &[*const ptl_stream]) -> ptl_strands_data {
        ptl_strands_data {
            struct_size: u32::try_from(size_of::<ptl_strands_data>()).unwrap(),
            flags: 0,
            strand_count: 2,
            point_count: 4,
            first_point: first_point.as_ptr(),
            point_streams: streams.as_ptr(),
            strand_streams: std::ptr::null(),
            point_stream_count: u32::try_from(streams.len()).unwrap(),
            strand_stream_count: 0,
            bounds_min: [0.0; 3],
            bounds_max: [0.0; 3],
        }
    }

    #[test]
    fn strands_come_back_as_they_were_lent() {
        let limits = Limits::default();
        let interleaved: Vec<f32> = (0..15_u8).map(f32::from).collect();
        let first_point = [0, 2, 4];
        let position = stream(c"position", 3, &interleaved, 16);
        let list = [&raw const position];
        let data = strands(&first_point, &list);
        let is_back = Arc::new(AtomicBool::new(false));
        let owner: Owner = Arc::new(Told(Arc::clone(&is_back)));
        // SAFETY: all of it lives until the end of the test.
        let made = unsafe { Import::borrowing(&limits, owner).strands(&raw const data) }.unwrap();
        let value = Value::from(made);
        assert!(value.is_borrowed());
        let view = View::of(&value).unwrap();
        let content = value.content();
        drop(value);
        let Body::Strands(seen) = view.body() else { panic!("strands") };
        assert_eq!((seen.first_point, seen.bounds_max), (first_point.as_ptr(), [12.0, 13.0, 14.0]));
        assert!(seen.strand_streams.is_null() && view.as_ptr() == std::ptr::from_ref(seen).cast());
        // SAFETY: a view is what it says.
        let again = unsafe { Import::copying(&limits).strands(seen) }.unwrap();
        assert_eq!(*again.content(), content);
        assert!(!is_back.load(Ordering::SeqCst));
        drop(view);
        assert!(is_back.load(Ordering::SeqCst));
        assert!(!Value::from(again).is_borrowed());
    }

    #[test]
    fn what_is_copied_is_counted_before_it_is_allocated() {
        let limits = Limits { memory_bytes: 59, ..Limits::default() };
        let numbers = [0.0; 12];
        let position = stream(c"position", 3, &numbers, 12);
        let (list, first_point) = ([&raw const position], [0, 2, 4]);
        let data = strands(&first_point, &list);
        // SAFETY: all of it lives until the end of the test.
        let error = unsafe { Import::copying(&limits).strands(&raw const data) }.unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
        let limits = Limits { memory_bytes: 60, ..limits };
        // SAFETY: as above.
        unsafe { Import::copying(&limits).strands(&raw const data) }.unwrap();
    }

    #[test]
    fn texts_and_gradients_come_back() {
        let limits = Limits::default();
        for value in [Value::from("D(1)\0R".to_owned()), Value::from(String::new())] {
            let view = View::of(&value).unwrap();
            let Body::Text(seen) = view.body() else { panic!("a text") };
            // SAFETY: a view is what it says.
            let text = unsafe { Import::copying(&limits).text(seen) }.unwrap();
            assert_eq!(Value::from(text).content(), value.content());
            // SAFETY: a text of the library has a NUL behind it.
            assert_eq!(unsafe { seen.text.add(seen.size).read() }, 0);
        }
        let stop = GradientStop { position: 0.25, color: [0.0, 0.5, 1.0] };
        for value in [Gradient::new(vec![stop]), Gradient::default()].map(Value::from) {
            let view = View::of(&value).unwrap();
            let Body::Gradient(seen) = view.body() else { panic!("a gradient") };
            // SAFETY: a view is what it says.
            let gradient = unsafe { Import::copying(&limits).gradient(seen) }.unwrap();
            assert_eq!(Value::from(gradient).content(), value.content());
        }
    }
}
