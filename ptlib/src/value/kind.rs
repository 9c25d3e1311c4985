//! The kinds of values, and a value of any kind.

use std::sync::Arc;

use super::{Gradient, Image};

/// What a port takes or gives. The numbers are those of the C ABI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// An [`Image`].
    Image = 1,
    /// A [`Gradient`].
    Gradient = 2,
    /// A text, such as the string of an L-system.
    Text = 3,
}

impl Kind {
    /// The kind's name in messages and in the documentation.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Image => "image",
            Self::Gradient => "gradient",
            Self::Text => "text",
        }
    }
}

/// A value of any kind.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Value {
    /// An image.
    Image(Image),
    /// A gradient.
    Gradient(Arc<Gradient>),
    /// A text.
    Text(Arc<str>),
}

impl Value {
    /// The value's kind.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self {
            Self::Image(_) => Kind::Image,
            Self::Gradient(_) => Kind::Gradient,
            Self::Text(_) => Kind::Text,
        }
    }

    /// The memory that the value holds, in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        match self {
            Self::Image(image) => image.bytes(),
            Self::Gradient(gradient) => size_of_val(gradient.stops()) as u64,
            Self::Text(text) => text.len() as u64,
        }
    }
}

impl From<Image> for Value {
    fn from(image: Image) -> Self {
        Self::Image(image)
    }
}

impl From<Gradient> for Value {
    fn from(gradient: Gradient) -> Self {
        Self::Gradient(Arc::new(gradient))
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text.into())
    }
}
