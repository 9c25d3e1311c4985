//! The kinds of values, and a value of any kind.

use std::sync::Arc;

use super::{Gradient, Image, Mesh, Points, Strands, Words};

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
    /// [`Points`].
    Points = 4,
    /// A [`Mesh`].
    Mesh = 5,
    /// [`Strands`].
    Strands = 6,
}

impl Kind {
    /// All kinds, by number.
    pub const ALL: [Self; 6] =
        [Self::Image, Self::Gradient, Self::Text, Self::Points, Self::Mesh, Self::Strands];

    /// The kind's name in messages and in the documentation.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Image => "image",
            Self::Gradient => "gradient",
            Self::Text => "text",
            Self::Points => "points",
            Self::Mesh => "mesh",
            Self::Strands => "strands",
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
    /// Points.
    Points(Arc<Points>),
    /// A mesh.
    Mesh(Arc<Mesh>),
    /// Strands.
    Strands(Arc<Strands>),
}

impl Value {
    /// The value's kind.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self {
            Self::Image(_) => Kind::Image,
            Self::Gradient(_) => Kind::Gradient,
            Self::Text(_) => Kind::Text,
            Self::Points(_) => Kind::Points,
            Self::Mesh(_) => Kind::Mesh,
            Self::Strands(_) => Kind::Strands,
        }
    }

    /// The memory that the value holds, in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        match self {
            Self::Image(image) => image.bytes(),
            Self::Gradient(gradient) => size_of_val(gradient.stops()) as u64,
            Self::Text(text) => text.len() as u64,
            Self::Points(points) => points.memory().map(Words::bytes).sum(),
            Self::Mesh(mesh) => mesh.memory().map(Words::bytes).sum(),
            Self::Strands(strands) => strands.memory().map(Words::bytes).sum(),
        }
    }

    /// Whether memory of it belongs to somebody who waits to get it back. Such values are not kept
    /// longer than they are used.
    #[must_use]
    pub fn is_borrowed(&self) -> bool {
        match self {
            Self::Image(_) | Self::Gradient(_) | Self::Text(_) => false,
            Self::Points(points) => points.memory().any(Words::is_borrowed),
            Self::Mesh(mesh) => mesh.memory().any(Words::is_borrowed),
            Self::Strands(strands) => strands.memory().any(Words::is_borrowed),
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

impl From<Points> for Value {
    fn from(points: Points) -> Self {
        Self::Points(Arc::new(points))
    }
}

impl From<Mesh> for Value {
    fn from(mesh: Mesh) -> Self {
        Self::Mesh(Arc::new(mesh))
    }
}

impl From<Strands> for Value {
    fn from(strands: Strands) -> Self {
        Self::Strands(Arc::new(strands))
    }
}
