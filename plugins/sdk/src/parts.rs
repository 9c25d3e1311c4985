//! Which streams a block gives a value, and what it writes them through.
//!
//! A part is a new stream ([`StreamId`]), a constant ([`StreamId::constant`]), a stream of an input
//! ([`Stream`], [`AnyStream`], [`Streams`]), one like that of an input ([`AnyStream::like`]), or
//! several parts: a tuple, a `Vec`, an `Option`.

use std::{ffi::CStr, slice};

use ptlib_plugin_abi::values::{PTL_STREAM_CONSTANT, ptl_stream};

use crate::{AnyStream, Element, Stream, StreamId, Streams, private::count};

/// What a value is made of.
pub trait Parts: Sync {
    /// What they are written through: a slice for each new stream, in the same tuples.
    type Out<'b>: Split + Send;

    /// Adds what the host shall make.
    #[doc(hidden)]
    fn plan(&self, streams: &mut Vec<ptl_stream>);

    /// Takes what the host made, in the same order.
    ///
    /// # Safety
    /// The streams are those that were planned, and nobody else uses them for as long as `'b`.
    #[doc(hidden)]
    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b>;
}

/// Slices of the same number of elements, which can be cut.
pub trait Split: Sized {
    /// The first `elements`, and the others.
    #[must_use]
    fn split(self, elements: usize) -> (Self, Self);
}

/// A stream as the host made it.
#[doc(hidden)]
#[derive(Debug, Clone, Copy)]
pub struct Made {
    data: *mut u32,
    len: usize,
}

// SAFETY: only `take` uses the pointer, whose caller answers for it.
unsafe impl Send for Made {}
// SAFETY: as above.
unsafe impl Sync for Made {}

impl Made {
    /// # Safety
    /// The contract: a stream that the host made, of `len` elements.
    pub(crate) unsafe fn new(stream: &ptl_stream, len: usize) -> Self {
        Self { data: stream.data.cast_mut().cast(), len }
    }

    /// # Safety
    /// `data` leads to `len` elements that the host made, or `len` is 0.
    pub(crate) unsafe fn of(data: *mut u32, len: usize) -> Self {
        Self { data, len }
    }

    /// # Safety
    /// As [`Parts::take`]; `numbers` of an element.
    pub(crate) unsafe fn slice<'b, T>(&self, numbers: usize) -> &'b mut [T] {
        if self.len == 0 || self.data.is_null() {
            return &mut [];
        }
        // SAFETY: the host gives that many elements without gaps, 64-byte aligned and zeroed.
        unsafe { slice::from_raw_parts_mut(self.data.cast(), self.len * numbers) }
    }
}

/// The next stream.
fn next(made: &mut slice::Iter<'_, Made>) -> Made {
    *made.next().expect("the host makes as many streams as are planned")
}

fn new_stream(id: &CStr, r#type: u32, components: u32, flags: u32) -> ptl_stream {
    ptl_stream {
        struct_size: count(size_of::<ptl_stream>()),
        r#type,
        components,
        flags,
        id: id.as_ptr(),
        data: std::ptr::null(),
        stride: 0,
    }
}

impl<T: Element> Parts for StreamId<T> {
    type Out<'b> = &'b mut [T];

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        streams.push(new_stream(self.id, T::TYPE, T::COMPONENTS, 0));
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> &'b mut [T] {
        // SAFETY: the caller's promise.
        unsafe { next(made).slice(1) }
    }
}

/// One element for all: [`StreamId::constant`].
#[derive(Debug, Clone, Copy)]
pub struct Constant<T> {
    id: StreamId<T>,
    value: T,
}

impl<T: Element> StreamId<T> {
    /// A stream of one element that serves all.
    #[must_use]
    pub const fn constant(self, value: T) -> Constant<T> {
        Constant { id: self, value }
    }
}

impl<T: Element> Parts for Constant<T> {
    type Out<'b> = ();

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        streams.push(new_stream(self.id.id, T::TYPE, T::COMPONENTS, PTL_STREAM_CONSTANT));
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
        let made = Made { len: 1, ..next(made) };
        // SAFETY: the caller's promise; a constant has one element.
        unsafe { made.slice::<T>(1) }.iter_mut().for_each(|element| *element = self.value);
    }
}

impl Parts for AnyStream<'_> {
    type Out<'b> = ();

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        streams.push(*self.stream);
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
        let _ = next(made);
    }
}

impl<T: Element> Parts for Stream<'_, T> {
    type Out<'b> = ();

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        self.any.plan(streams);
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
        let _ = next(made);
    }
}

impl Parts for Streams<'_> {
    type Out<'b> = ();

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        self.iter().for_each(|stream| stream.plan(streams));
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
        // SAFETY: the caller's promise.
        self.iter().for_each(|stream| unsafe { stream.take(made) });
    }
}

/// A new stream with the id and the type of an input's: [`AnyStream::like`].
#[derive(Debug, Clone, Copy)]
pub struct Like<'a>(AnyStream<'a>);

/// Elements of a new stream of any type, as the bits of their numbers.
#[derive(Debug)]
pub struct Bits<'b> {
    components: usize,
    numbers: &'b mut [u32],
}

impl<'a> AnyStream<'a> {
    /// A new stream of the same id and type, whose bits are written.
    #[must_use]
    pub fn like(self) -> Like<'a> {
        Like(self)
    }
}

impl Bits<'_> {
    /// How many elements.
    #[must_use]
    pub fn count(&self) -> usize {
        self.numbers.len() / self.components
    }

    /// The numbers of an element, to be written.
    ///
    /// # Panics
    /// If there is no such element.
    #[inline]
    pub fn element(&mut self, element: usize) -> &mut [u32] {
        &mut self.numbers[element * self.components..][..self.components]
    }
}

impl Parts for Like<'_> {
    type Out<'b> = Bits<'b>;

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        let Self(AnyStream { stream, .. }) = self;
        streams.push(new_stream(self.0.id(), stream.r#type, stream.components, 0));
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Bits<'b> {
        let components = self.0.components();
        // SAFETY: the caller's promise.
        Bits { components, numbers: unsafe { next(made).slice(components) } }
    }
}

impl<P: Parts> Parts for Option<P> {
    type Out<'b> = Option<P::Out<'b>>;

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        self.iter().for_each(|part| part.plan(streams));
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
        // SAFETY: the caller's promise.
        self.as_ref().map(|part| unsafe { part.take(made) })
    }
}

impl<P: Parts> Parts for Vec<P> {
    type Out<'b> = Vec<P::Out<'b>>;

    fn plan(&self, streams: &mut Vec<ptl_stream>) {
        self.iter().for_each(|part| part.plan(streams));
    }

    unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
        // SAFETY: the caller's promise.
        self.iter().map(|part| unsafe { part.take(made) }).collect()
    }
}

impl<T> Split for &mut [T] {
    fn split(self, elements: usize) -> (Self, Self) {
        self.split_at_mut(elements)
    }
}

impl Split for Bits<'_> {
    fn split(self, elements: usize) -> (Self, Self) {
        let components = self.components;
        let (first, others) = self.numbers.split_at_mut(elements * components);
        (Self { components, numbers: first }, Self { components, numbers: others })
    }
}

impl<S: Split> Split for Option<S> {
    fn split(self, elements: usize) -> (Self, Self) {
        self.map(|slice| slice.split(elements)).unzip()
    }
}

impl<S: Split> Split for Vec<S> {
    fn split(self, elements: usize) -> (Self, Self) {
        self.into_iter().map(|slice| slice.split(elements)).unzip()
    }
}

impl Split for () {
    fn split(self, _: usize) -> (Self, Self) {
        ((), ())
    }
}

impl Parts for () {
    type Out<'b> = ();

    fn plan(&self, _: &mut Vec<ptl_stream>) {}

    unsafe fn take<'b>(&self, _: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {}
}

/// Tuples of parts.
macro_rules! tuple_parts {
    ($($part:ident $place:tt),+) => {
        impl<$($part: Parts),+> Parts for ($($part,)+) {
            type Out<'b> = ($($part::Out<'b>,)+);

            fn plan(&self, streams: &mut Vec<ptl_stream>) {
                $(self.$place.plan(streams);)+
            }

            unsafe fn take<'b>(&self, made: &mut slice::Iter<'_, Made>) -> Self::Out<'b> {
                // SAFETY: the caller's promise.
                unsafe { ($(self.$place.take(made),)+) }
            }
        }

        impl<$($part: Split),+> Split for ($($part,)+) {
            fn split(self, elements: usize) -> (Self, Self) {
                let pairs = ($(self.$place.split(elements),)+);
                (($(pairs.$place.0,)+), ($(pairs.$place.1,)+))
            }
        }
    };
}

tuple_parts!(A 0);
tuple_parts!(A 0, B 1);
tuple_parts!(A 0, B 1, C 2);
tuple_parts!(A 0, B 1, C 2, D 3);
tuple_parts!(A 0, B 1, C 2, D 3, E 4);
tuple_parts!(A 0, B 1, C 2, D 3, E 4, F 5);
tuple_parts!(A 0, B 1, C 2, D 3, E 4, F 5, G 6);
tuple_parts!(A 0, B 1, C 2, D 3, E 4, F 5, G 6, H 7);
