//! Streams: one kind of data of each element of a mesh, of points or of strands.
//!
//! A stream is found by its id, so that new data needs no new kind of value. Its elements lie
//! anywhere in some [`Words`], a constant distance apart: the streams of a renderer's interleaved
//! vertices are read where they are.

use std::sync::Arc;

use super::{Words, WordsMut};
use crate::error::{Error, ErrorKind};

/// What the numbers of a stream are. The numbers are those of the C ABI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scalar {
    /// 32-bit floating-point numbers.
    F32 = 1,
    /// Unsigned 32-bit whole numbers.
    U32 = 2,
}

impl Scalar {
    /// Its name in messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::U32 => "u32",
        }
    }
}

/// What a stream is, without its data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StreamShape {
    /// What it means: ASCII. Some ids are known, see [`StreamShape::known`].
    pub id: Arc<str>,
    /// What its numbers are.
    pub scalar: Scalar,
    /// Numbers of an element, 1 to 4.
    pub components: u32,
    /// Whether one element serves all.
    pub is_constant: bool,
}

impl StreamShape {
    /// The most numbers of an element.
    pub const MAX_COMPONENTS: u32 = 4;

    /// A stream of floating-point numbers with an element for each.
    #[must_use]
    pub fn floats(id: &str, components: u32) -> Self {
        Self { id: id.into(), scalar: Scalar::F32, components, is_constant: false }
    }

    /// A stream of whole numbers with an element for each.
    #[must_use]
    pub fn whole(id: &str, components: u32) -> Self {
        Self { scalar: Scalar::U32, ..Self::floats(id, components) }
    }

    /// The stream, with one element for all.
    #[must_use]
    pub fn constant(self) -> Self {
        Self { is_constant: true, ..self }
    }

    /// What the numbers of a stream of that id have to be, and how many (from, to); `None` for
    /// ids that pass through untouched.
    #[must_use]
    pub fn known(id: &str) -> Option<(Scalar, u32, u32)> {
        Some(match id {
            "position" | "normal" | "direction" => (Scalar::F32, 3, 3),
            "texcoord" | "texcoord1" => (Scalar::F32, 2, 2),
            "tangent" => (Scalar::F32, 4, 4),
            "color" => (Scalar::F32, 3, 4),
            "loss age" | "random" | "radius" => (Scalar::F32, 1, 1),
            "id" => (Scalar::U32, 2, 2),
            _ => return None,
        })
    }

    /// How many elements the stream of a value with `count` elements has.
    #[must_use]
    pub fn elements(&self, count: u32) -> usize {
        if self.is_constant { 1 } else { count as usize }
    }

    /// The words that its elements take without gaps.
    #[must_use]
    pub fn packed_words(&self, count: u32) -> usize {
        self.elements(count).saturating_mul(self.components as usize)
    }

    /// Whether id, type and number of components go together.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`].
    pub fn check(&self) -> Result<(), Error> {
        if self.id.is_empty() || !self.id.bytes().all(|byte| (b' '..=b'~').contains(&byte)) {
            let message =
                format!("stream id \"{}\" is not printable ASCII", self.id.escape_debug());
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let most = Self::MAX_COMPONENTS;
        let (scalar, from, to) = Self::known(&self.id).unwrap_or((self.scalar, 1, most));
        if self.scalar == scalar && (from..=to).contains(&self.components) {
            return Ok(());
        }
        let allowed = if from == to { format!("{from}") } else { format!("{from} to {to}") };
        Err(self.wrong(&format!(
            "has {} components of {}, allowed {allowed} of {}",
            self.components,
            self.scalar.name(),
            scalar.name()
        )))
    }

    /// An error about the stream.
    pub(crate) fn wrong(&self, what: &str) -> Error {
        Error::new(ErrorKind::InvalidArgument, format!("stream \"{}\" {what}", self.id))
    }
}

/// One kind of data of each element.
#[derive(Debug, Clone)]
pub struct Stream {
    shape: StreamShape,
    data: Words,
    /// Words from one element to the next.
    stride: usize,
    elements: usize,
    /// Whether its numbers keep the rules of its id, which hold for every kind of value.
    is_checked: bool,
}

/// The numbers of a stream.
#[derive(Debug, Clone, Copy)]
pub struct Elements<'a, T> {
    numbers: &'a [T],
    stride: usize,
    components: usize,
    elements: usize,
}

impl<'a, T> Elements<'a, T> {
    /// The numbers of element `i`; of a constant stream, those of its one element.
    ///
    /// # Panics
    /// If the value has no element `i`.
    #[inline]
    #[must_use]
    pub fn at(&self, i: usize) -> &'a [T] {
        &self.numbers[i * self.stride..][..self.components]
    }

    /// The elements that are stored: one, of a constant stream.
    pub fn all(self) -> impl Iterator<Item = &'a [T]> {
        (0..self.elements).map(move |i| self.at(i))
    }
}

impl Stream {
    /// A stream of the `elements` elements at the start of `data`, `stride` bytes apart.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`] if that is not the layout of such a stream.
    pub fn new(
        shape: StreamShape,
        data: Words,
        stride: usize,
        elements: usize,
    ) -> Result<Self, Error> {
        shape.check()?;
        shape.check_stride(stride)?;
        if shape.is_constant && elements != 1 {
            return Err(shape.wrong(&format!("is constant and has {elements} elements, allowed 1")));
        }
        let stride = stride / size_of::<u32>();
        let needed = shape.extent(stride, elements);
        if needed.is_none_or(|needed| needed > data.len()) {
            return Err(shape.wrong(&format!(
                "has {} words, but its {elements} elements take {}",
                data.len(),
                needed.map_or("more than memory has".into(), |needed| needed.to_string())
            )));
        }
        Ok(Self { shape, data, stride, elements, is_checked: false })
    }

    /// A stream of elements without gaps.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`] as [`new`](Self::new).
    pub fn packed(shape: StreamShape, data: Words) -> Result<Self, Error> {
        let components = shape.components as usize;
        let elements = data.len() / components.max(1);
        if elements * components != data.len() {
            return Err(shape.wrong(&format!("has {} words, not a multiple", data.len())));
        }
        Self::new(shape, data, components * size_of::<u32>(), elements)
    }

    /// What it is.
    #[must_use]
    pub fn shape(&self) -> &StreamShape {
        &self.shape
    }

    /// What it means.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.shape.id
    }

    /// How many elements are stored: 1 if it is constant.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.elements
    }

    /// Bytes from one element to the next.
    #[must_use]
    pub fn stride(&self) -> usize {
        self.stride * size_of::<u32>()
    }

    /// The words that the elements lie in; the first starts at the first.
    #[must_use]
    pub fn data(&self) -> &Words {
        &self.data
    }

    /// Its elements for the first `count` of those that a value has.
    pub(super) fn beginning(self, count: u32) -> Self {
        let elements = self.elements.min(self.shape.elements(count));
        Self { elements, ..self }
    }

    /// Whether its numbers were checked: streams are shared, and never change.
    pub(super) fn is_checked(&self) -> bool {
        self.is_checked
    }

    /// Notes that its numbers keep the rules.
    pub(super) fn note_checked(&mut self) {
        self.is_checked = true;
    }

    /// All numbers in one slice, if they lie without gaps.
    pub(super) fn without_gaps(&self) -> Option<&[f32]> {
        let components = self.shape.components as usize;
        (self.stride == components || self.elements <= 1)
            .then(|| &self.data.floats()[..self.elements * components])
    }

    /// The numbers as floating-point numbers, which they are if the shape says so.
    #[must_use]
    pub fn floats(&self) -> Elements<'_, f32> {
        self.view(self.data.floats())
    }

    /// The numbers as whole numbers, which they are if the shape says so; otherwise their bits.
    #[must_use]
    pub fn words(&self) -> Elements<'_, u32> {
        self.view(&self.data)
    }

    fn view<'a, T>(&self, numbers: &'a [T]) -> Elements<'a, T> {
        Elements {
            numbers,
            stride: if self.shape.is_constant { 0 } else { self.stride },
            components: self.shape.components as usize,
            elements: self.elements,
        }
    }

    /// The stream with each element changed: a copy without gaps.
    pub(super) fn changed(&self, mut change: impl FnMut(usize, &mut [f32])) -> Result<Self, Error> {
        let components = self.shape.components as usize;
        let mut copy = WordsMut::zeroed(self.elements.saturating_mul(components))?;
        let targets = copy.floats_mut().chunks_exact_mut(components.max(1));
        for (i, (target, element)) in targets.zip(self.floats().all()).enumerate() {
            target.copy_from_slice(element);
            change(i, target);
        }
        Self::packed(self.shape.clone(), copy.freeze())
    }
}

impl StreamShape {
    /// Whether `stride` bytes may lie between the starts of two elements.
    pub(crate) fn check_stride(&self, stride: usize) -> Result<(), Error> {
        let least = self.components as usize * size_of::<u32>();
        let is_one = self.is_constant && stride == 0;
        if is_one || (stride.is_multiple_of(size_of::<u32>()) && stride >= least) {
            return Ok(());
        }
        let zero = if self.is_constant { ", or 0" } else { "" };
        let message =
            format!("has stride {stride}, allowed are multiples of 4 from {least} on{zero}");
        Err(self.wrong(&message))
    }

    /// The words from the start of the first of `elements` elements to the end of the last, if
    /// memory can have as many. `stride` is in words.
    pub(crate) fn extent(&self, stride: usize, elements: usize) -> Option<usize> {
        let Some(gaps) = elements.checked_sub(1) else { return Some(0) };
        let words = gaps.checked_mul(stride)?.checked_add(self.components as usize)?;
        let bytes = words.checked_mul(size_of::<u32>())?;
        isize::try_from(bytes).ok().map(|_| words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(numbers: &[f32]) -> Words {
        Words::copy_of(bytemuck::cast_slice(numbers)).unwrap()
    }

    #[test]
    fn elements_are_read_where_they_are() {
        let data = words(&[1.0, 2.0, 9.0, 3.0, 4.0]);
        let stream = Stream::new(StreamShape::floats("texcoord", 2), data.clone(), 12, 2).unwrap();
        let all: Vec<_> = stream.floats().all().collect();
        assert_eq!(all, [[1.0, 2.0], [3.0, 4.0]]);
        assert_eq!(stream.floats().at(1).as_ptr(), data.floats()[3..].as_ptr());
        assert_eq!(stream.words().at(0), [1.0_f32.to_bits(), 2.0_f32.to_bits()]);
        let changed = stream.changed(|i, element| element[1] = if i == 0 { 7.0 } else { 8.0 });
        let changed = changed.unwrap();
        assert_eq!((changed.stride(), changed.data().floats()), (8, &[1.0, 7.0, 3.0, 8.0][..]));
    }

    #[test]
    fn a_constant_stream_serves_every_element() {
        let shape = StreamShape::floats("radius", 1).constant();
        let stream = Stream::new(shape.clone(), words(&[0.5]), 0, 1).unwrap();
        assert_eq!(stream.floats().at(77), [0.5]);
        assert_eq!(shape.elements(1000), 1);
        assert!(Stream::new(shape, words(&[0.5, 0.5]), 4, 2).is_err());
    }

    #[test]
    fn layouts_that_do_not_fit_are_refused() {
        let shape = StreamShape::floats("position", 3);
        let message = |stride, elements| {
            let result = Stream::new(shape.clone(), words(&[0.0; 6]), stride, elements);
            result.unwrap_err().to_string()
        };
        assert_eq!(
            message(10, 1),
            "stream \"position\" has stride 10, allowed are multiples of 4 from 12 on"
        );
        assert!(message(8, 1).contains("stride 8"));
        assert!(message(0, 1).contains("stride 0"));
        assert!(message(16, 2).contains("6 words, but its 2 elements take 7"));
        assert!(message(usize::MAX - 3, 3).contains("more than memory has"));
        assert!(Stream::new(shape, words(&[]), 12, 0).is_ok());
    }

    #[test]
    fn ids_say_what_their_numbers_are() {
        let error = |shape: StreamShape| shape.check().unwrap_err().to_string();
        assert_eq!(
            error(StreamShape::floats("normal", 4)),
            "stream \"normal\" has 4 components of f32, allowed 3 of f32"
        );
        assert!(error(StreamShape::whole("color", 3)).contains("allowed 3 to 4 of f32"));
        assert!(error(StreamShape::floats("weights", 5)).contains("allowed 1 to 4"));
        assert!(error(StreamShape::floats("größe", 1)).contains("not printable ASCII"));
        assert!(error(StreamShape::floats("", 1)).contains("not printable ASCII"));
        StreamShape::whole("anything", 4).check().unwrap();
    }
}
