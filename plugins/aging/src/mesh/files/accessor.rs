//! The numbers in a glTF's buffers (glTF 2.0, section 3.6), read with checks of our own.
//!
//! An accessor says where its elements are; here it must be true. In 64-bit numbers: at least one
//! element, the stride no less than an element, and offset + stride·(count - 1) + element within
//! the view, the view within its buffer, the buffer within the bytes that are there.

use std::rc::Rc;

use gltf::json::{
    Index, Root,
    accessor::{Accessor, ComponentType, Type},
    buffer::{Buffer, View},
    validation::Checked,
};

use super::{FileError, Limits, Outside, limit, uri};

/// The buffers of a file, each read when it is wanted first.
pub(super) struct Buffers<'a> {
    root: &'a Root,
    /// The bytes behind the description in a GLB.
    blob: Option<Rc<Vec<u8>>>,
    read: Vec<Option<Rc<Vec<u8>>>>,
    bytes: u64,
    outside: &'a dyn Outside,
    limits: &'a Limits,
}

/// Where the elements of an accessor are.
struct Elements {
    bytes: Rc<Vec<u8>>,
    start: usize,
    stride: usize,
    count: usize,
    component: ComponentType,
    normalized: bool,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        root: &'a Root,
        blob: Option<Vec<u8>>,
        outside: &'a dyn Outside,
        limits: &'a Limits,
    ) -> Self {
        let read = vec![None; root.buffers.len()];
        Self { root, blob: blob.map(Rc::new), read, bytes: 0, outside, limits }
    }

    /// How many elements an accessor claims.
    pub(super) fn count(&self, accessor: Index<Accessor>) -> u64 {
        self.root.get(accessor).map_or(0, |accessor| accessor.count.0)
    }

    /// The vectors of an accessor: floats, or whole numbers that stand for 0 to 1.
    pub(super) fn floats<const N: usize>(
        &mut self,
        index: Index<Accessor>,
    ) -> Result<Vec<[f32; N]>, FileError> {
        let r#type = if N == 2 { Type::Vec2 } else { Type::Vec3 };
        let elements = self.elements(index, r#type, N)?;
        let size = size_of_component(elements.component);
        let number: fn(&[u8]) -> f32 = match (elements.component, elements.normalized) {
            (ComponentType::F32, _) => |bytes| f32::from_le_bytes(array(bytes)),
            (ComponentType::U8, true) => |bytes| f32::from(array::<1>(bytes)[0]) / 255.0,
            (ComponentType::U16, true) => {
                |bytes| f32::from(u16::from_le_bytes(array(bytes))) / 65_535.0
            }
            (other, _) => {
                let allowed = "allowed are floats, and normalized unsigned bytes and shorts";
                return Err(wrong(index, &format!("has numbers of type {other:?}, {allowed}")));
            }
        };
        let vector = |element: &[u8]| {
            std::array::from_fn(|i| number(element.get(i * size..).unwrap_or_default()))
        };
        Ok(elements.iter().map(vector).collect())
    }

    /// The whole numbers of an accessor.
    pub(super) fn indices(&mut self, index: Index<Accessor>) -> Result<Vec<u32>, FileError> {
        let elements = self.elements(index, Type::Scalar, 1)?;
        let number: fn(&[u8]) -> u32 = match elements.component {
            ComponentType::U8 => |bytes| u32::from(array::<1>(bytes)[0]),
            ComponentType::U16 => |bytes| u32::from(u16::from_le_bytes(array(bytes))),
            ComponentType::U32 => |bytes| u32::from_le_bytes(array(bytes)),
            other => {
                let allowed = "allowed for indices are unsigned whole numbers";
                return Err(wrong(index, &format!("has numbers of type {other:?}, {allowed}")));
            }
        };
        Ok(elements.iter().map(number).collect())
    }

    /// Where the elements of an accessor are, if they are all there.
    fn elements(
        &mut self,
        index: Index<Accessor>,
        r#type: Type,
        components: usize,
    ) -> Result<Elements, FileError> {
        let wrong = |what: &str| wrong(index, what);
        let accessor = self.root.get(index).ok_or_else(|| wrong("does not exist"))?;
        if accessor.sparse.is_some() {
            return Err(wrong("is sparse, which is not allowed here"));
        }
        let view = accessor.buffer_view.and_then(|view| self.root.get(view));
        let view = view.ok_or_else(|| wrong("has no view of a buffer"))?;
        let (Checked::Valid(found), Checked::Valid(component)) =
            (accessor.type_, accessor.component_type)
        else {
            return Err(wrong("has an unknown type"));
        };
        if found != r#type {
            return Err(wrong(&format!("has the type {found:?}, allowed is {:?}", r#type)));
        }
        let size = size_of_component(component.0) * components;
        let stride = span(accessor, view, size as u64).map_err(|what| wrong(&what))?;
        let bytes = self.buffer(view.buffer)?;
        let length = view.byte_length.0;
        let view_start = view.byte_offset.map_or(0, |offset| offset.0);
        let view_end = view_start.checked_add(length);
        if view_end.is_none_or(|end| end > bytes.len() as u64) {
            let message = format!(
                "has a view of {length} bytes from {view_start} on, but buffer {} has {}",
                view.buffer.value(),
                bytes.len()
            );
            return Err(wrong(&message));
        }
        // All of it lies within `bytes`, whose length is a `usize`.
        let place = |number: u64| usize::try_from(number).map_err(|_| wrong("is too large"));
        Ok(Elements {
            bytes,
            start: place(view_start + accessor.byte_offset.map_or(0, |offset| offset.0))?,
            stride: place(stride)?,
            count: place(accessor.count.0)?,
            component: component.0,
            normalized: accessor.normalized,
        })
    }

    /// The bytes of a buffer, as many as it claims.
    fn buffer(&mut self, index: Index<Buffer>) -> Result<Rc<Vec<u8>>, FileError> {
        let number = index.value();
        if let Some(Some(bytes)) = self.read.get(number) {
            return Ok(bytes.clone());
        }
        let wrong = |what: &str| FileError::Parse(format!("buffer {number} {what}"));
        let buffer = self.root.get(index).ok_or_else(|| wrong("does not exist"))?;
        let claimed = buffer.byte_length.0;
        limit("bytes in buffers", self.bytes.saturating_add(claimed), self.limits.bytes)?;
        let mut bytes = match (&buffer.uri, self.blob.take_if(|_| number == 0)) {
            (Some(uri), _) => match uri::place(uri)? {
                uri::Place::Here(bytes) => Rc::new(bytes),
                uri::Place::Beside(name) => Rc::new(self.outside.read(&name)?),
            },
            (None, Some(blob)) => blob,
            (None, _) => return Err(wrong("is neither here nor in a file")),
        };
        if (bytes.len() as u64) < claimed {
            return Err(wrong(&format!("has {} bytes, but claims {claimed}", bytes.len())));
        }
        self.bytes = self.bytes.saturating_add(bytes.len() as u64);
        limit("bytes in buffers", self.bytes, self.limits.bytes)?;
        if let (Some(whole), Ok(claimed)) = (Rc::get_mut(&mut bytes), usize::try_from(claimed)) {
            whole.truncate(claimed);
        }
        if let Some(place) = self.read.get_mut(number) {
            *place = Some(bytes.clone());
        }
        Ok(bytes)
    }
}

impl Elements {
    /// The bytes from each element on.
    fn iter(&self) -> impl Iterator<Item = &[u8]> {
        (0..self.count).map(|i| self.bytes.get(self.start + i * self.stride..).unwrap_or_default())
    }
}

/// The bytes from one element to the next, if all of them lie within the view.
fn span(accessor: &Accessor, view: &View, size: u64) -> Result<u64, String> {
    let count = accessor.count.0;
    let stride = view.byte_stride.map_or(size, |stride| stride.0 as u64);
    if count == 0 {
        return Err("has 0 elements, allowed from 1 on".to_owned());
    }
    if stride < size {
        return Err(format!("has stride {stride}, allowed from {size} on"));
    }
    let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
    let end = (count - 1)
        .checked_mul(stride)
        .and_then(|bytes| bytes.checked_add(size)?.checked_add(offset));
    let length = view.byte_length.0;
    if end.is_some_and(|end| end <= length) {
        return Ok(stride);
    }
    Err(format!(
        "has {count} elements {stride} bytes apart from byte {offset} on, but its view has \
         {length} bytes"
    ))
}

fn wrong(index: Index<Accessor>, what: &str) -> FileError {
    FileError::Parse(format!("accessor {} {what}", index.value()))
}

/// The first bytes; zeros behind the end, which no checked accessor reaches.
fn array<const N: usize>(bytes: &[u8]) -> [u8; N] {
    std::array::from_fn(|i| bytes.get(i).copied().unwrap_or_default())
}

fn size_of_component(component: ComponentType) -> usize {
    match component {
        ComponentType::I8 | ComponentType::U8 => 1,
        ComponentType::I16 | ComponentType::U16 => 2,
        ComponentType::U32 | ComponentType::F32 => 4,
    }
}
