//! Streams: one kind of data of each vertex, point or strand, found by its id.

use std::{ffi::CStr, marker::PhantomData};

use ptlib_plugin_abi::values::{PTL_STREAM_CONSTANT, PTL_STREAM_F32, PTL_STREAM_U32, ptl_stream};

/// What a stream can hold for each element: `f32`, `u32`, and arrays of 2 to 4 of them.
///
/// # Safety
/// It is `COMPONENTS` numbers of that type and nothing else, for which all bits make sense.
pub unsafe trait Element: Copy + Send + Sync + 'static + sealed::Sealed {
    /// `PTL_STREAM_F32` or `PTL_STREAM_U32`.
    #[doc(hidden)]
    const TYPE: u32;

    /// Numbers of an element.
    #[doc(hidden)]
    const COMPONENTS: u32;
}

mod sealed {
    pub trait Sealed {}

    impl Sealed for f32 {}
    impl Sealed for u32 {}
    impl<T: Sealed, const N: usize> Sealed for [T; N] {}
}

// SAFETY: one number.
unsafe impl Element for f32 {
    const TYPE: u32 = PTL_STREAM_F32;
    const COMPONENTS: u32 = 1;
}

// SAFETY: one number.
unsafe impl Element for u32 {
    const TYPE: u32 = PTL_STREAM_U32;
    const COMPONENTS: u32 = 1;
}

// SAFETY: an array of numbers has nothing between them.
unsafe impl<T: Element> Element for [T; 2] {
    const TYPE: u32 = T::TYPE;
    const COMPONENTS: u32 = T::COMPONENTS * 2;
}

// SAFETY: as above.
unsafe impl<T: Element> Element for [T; 3] {
    const TYPE: u32 = T::TYPE;
    const COMPONENTS: u32 = T::COMPONENTS * 3;
}

// SAFETY: as above.
unsafe impl<T: Element> Element for [T; 4] {
    const TYPE: u32 = T::TYPE;
    const COMPONENTS: u32 = T::COMPONENTS * 4;
}

/// The id of a stream, with the type of its elements. The library knows those declared here, and
/// checks them; others pass through untouched.
#[derive(Debug)]
pub struct StreamId<T> {
    pub(crate) id: &'static CStr,
    elements: PhantomData<fn() -> T>,
}

impl<T> Clone for StreamId<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for StreamId<T> {}

impl<T: Element> StreamId<T> {
    /// The id of a stream of one's own: ASCII, such as `c"curl"`.
    #[must_use]
    pub const fn new(id: &'static CStr) -> Self {
        Self { id, elements: PhantomData }
    }
}

/// Where an element is. Every value has it.
pub const POSITION: StreamId<[f32; 3]> = StreamId::new(c"position");
/// The direction away from a surface, of length 1.
pub const NORMAL: StreamId<[f32; 3]> = StreamId::new(c"normal");
/// Where something at a point goes to, of length 1.
pub const DIRECTION: StreamId<[f32; 3]> = StreamId::new(c"direction");
/// Texture coordinates; the second points up.
pub const TEXCOORD: StreamId<[f32; 2]> = StreamId::new(c"texcoord");
/// A second set of texture coordinates.
pub const TEXCOORD1: StreamId<[f32; 2]> = StreamId::new(c"texcoord1");
/// The direction in which the first texture coordinate grows, and ±1: the side of the other.
pub const TANGENT: StreamId<[f32; 4]> = StreamId::new(c"tangent");
/// Red, green, blue, each 0 to 1.
pub const COLOR: StreamId<[f32; 3]> = StreamId::new(c"color");
/// Red, green, blue, alpha, each 0 to 1.
pub const COLOR_ALPHA: StreamId<[f32; 4]> = StreamId::new(c"color");
/// Half of a thickness.
pub const RADIUS: StreamId<f32> = StreamId::new(c"radius");
/// A random number, 0 to 1.
pub const RANDOM: StreamId<f32> = StreamId::new(c"random");
/// The age at which a hair is lost, 0 to 1.
pub const LOSS_AGE: StreamId<f32> = StreamId::new(c"loss age");
/// Two whole numbers that tell elements apart, such as a triangle and a number in it.
pub const ID: StreamId<[u32; 2]> = StreamId::new(c"id");

/// A stream of an input, with elements of any type.
#[derive(Debug, Clone, Copy)]
pub struct AnyStream<'a> {
    pub(crate) stream: &'a ptl_stream,
    len: usize,
}

// SAFETY: the contract: inputs are only read while they live.
unsafe impl Send for AnyStream<'_> {}
// SAFETY: as above.
unsafe impl Sync for AnyStream<'_> {}

impl<'a> AnyStream<'a> {
    /// # Safety
    /// The contract: the stream has `len` elements (one, if it is constant) for as long as `'a`.
    pub(crate) unsafe fn new(stream: &'a ptl_stream, len: usize) -> Self {
        Self { stream, len }
    }

    /// What it means.
    #[must_use]
    pub fn id(&self) -> &'a CStr {
        // SAFETY: the contract: an id ends with NUL.
        unsafe { CStr::from_ptr(self.stream.id) }
    }

    /// Elements: one a vertex, point or strand.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no elements.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Numbers of an element, 1 to 4.
    #[must_use]
    pub fn components(&self) -> usize {
        self.stream.components as usize
    }

    /// Whether all elements are the same one.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.stream.flags & PTL_STREAM_CONSTANT != 0
    }

    /// The stream with elements of that type, if it has such.
    #[must_use]
    pub fn typed<T: Element>(self) -> Option<Stream<'a, T>> {
        let is_same = self.stream.r#type == T::TYPE && self.stream.components == T::COMPONENTS;
        is_same.then_some(Stream { any: self, elements: PhantomData })
    }

    /// The numbers of an element, as the bits that they have in memory.
    ///
    /// # Panics
    /// If there is no such element.
    #[inline]
    #[must_use]
    pub fn bits(&self, element: usize) -> &'a [u32] {
        let start = self.element(element);
        // SAFETY: an element has as many numbers of 4 bytes, and is only read while inputs live.
        unsafe { std::slice::from_raw_parts(start, self.components()) }
    }

    /// Where an element starts.
    #[inline]
    fn element(&self, element: usize) -> *const u32 {
        assert!(element < self.len, "element {element} of {}", self.len);
        let place = if self.is_constant() { 0 } else { element * self.stream.stride };
        // SAFETY: inside of the stream, by the contract.
        unsafe { self.stream.data.byte_add(place).cast() }
    }
}

/// A stream of an input. Its elements may lie apart from each other in memory.
#[derive(Debug)]
pub struct Stream<'a, T> {
    pub(crate) any: AnyStream<'a>,
    elements: PhantomData<&'a [T]>,
}

impl<T> Clone for Stream<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Stream<'_, T> {}

impl<'a, T: Element> Stream<'a, T> {
    /// Elements: one a vertex, point or strand.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.any.len
    }

    /// Whether there are no elements.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.any.len == 0
    }

    /// An element.
    ///
    /// # Panics
    /// If there is no such element.
    #[inline]
    #[must_use]
    pub fn get(&self, element: usize) -> T {
        // SAFETY: the stream has elements of that type, 4-byte aligned.
        unsafe { self.any.element(element).cast::<T>().read() }
    }

    /// All elements, in order.
    #[inline]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = T> + Clone + 'a {
        let stream = *self;
        (0..self.len()).map(move |element| stream.get(element))
    }

    /// All elements, if they lie in memory one after the other.
    #[must_use]
    pub fn as_slice(&self) -> Option<&'a [T]> {
        let AnyStream { stream, len } = self.any;
        if len == 0 {
            return Some(&[]);
        }
        let is_packed = stream.stride == size_of::<T>() && (len == 1 || !self.any.is_constant());
        // SAFETY: `len` elements without gaps, which are only read while inputs live.
        is_packed.then(|| unsafe { std::slice::from_raw_parts(stream.data.cast(), len) })
    }
}
