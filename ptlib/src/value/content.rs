//! What a value contains, as a number: values of the same content have the same hash.

use super::{Gradient, Image, Stream, Value};

/// A hash of the content of a value, whatever its layout in memory. It is cryptographic: contents
/// come from strangers, and two results with one key would show one in place of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ContentHash([u8; 32]);

impl ContentHash {
    /// The hash as bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8; 32] {
        &self.0
    }
}

/// Collects contents. Every part is written with its length, so that no two different contents
/// give the same bytes.
pub(super) struct Content(blake3::Hasher);

/// Words that are hashed at a time: the hash takes several of its chunks of 1024 bytes side by side.
const PIECE: usize = 4096;

impl Content {
    pub(super) fn new(value: &str) -> Self {
        let mut content = Self(blake3::Hasher::new());
        content.text(value);
        content
    }

    pub(super) fn number(&mut self, number: u64) {
        self.0.update(&number.to_le_bytes());
    }

    pub(super) fn text(&mut self, text: &str) {
        self.number(text.len() as u64);
        self.0.update(text.as_bytes());
    }

    pub(super) fn words(&mut self, words: &[u32]) {
        self.number(words.len() as u64);
        self.whole(words);
    }

    /// Takes the hash of words that lie without gaps in their place.
    fn whole(&mut self, words: &[u32]) {
        if cfg!(target_endian = "little") {
            let hash = blake3::hash(bytemuck::cast_slice(words));
            self.0.update(hash.as_bytes());
        } else {
            self.raw(words.iter().copied());
        }
    }

    pub(super) fn streams(&mut self, streams: &[Stream]) {
        self.number(streams.len() as u64);
        for stream in streams {
            let shape = stream.shape();
            self.text(&shape.id);
            self.number(shape.scalar as u64);
            self.number(u64::from(shape.components));
            self.number(u64::from(shape.is_constant));
            self.number(stream.elements() as u64);
            match stream.without_gaps() {
                Some(numbers) => self.whole(bytemuck::cast_slice(numbers)),
                None => self.raw(stream.words().all().flatten().copied()),
            }
        }
    }

    /// Takes the hash of words in their place. Their own hash starts at a chunk's start, which is what
    /// lets it take chunks side by side.
    fn raw(&mut self, words: impl Iterator<Item = u32>) {
        let mut content = blake3::Hasher::new();
        let mut piece = [0; PIECE * size_of::<u32>()];
        let mut words = words.peekable();
        while words.peek().is_some() {
            let mut used = 0;
            for (place, word) in piece.chunks_exact_mut(size_of::<u32>()).zip(&mut words) {
                place.copy_from_slice(&word.to_le_bytes());
                used += size_of::<u32>();
            }
            content.update(&piece[..used]);
        }
        self.0.update(content.finalize().as_bytes());
    }

    pub(super) fn finish(self) -> ContentHash {
        ContentHash(*self.0.finalize().as_bytes())
    }
}

impl Value {
    /// The hash of the content. It is taken now; that of a mesh, points or strands is kept with them.
    #[must_use]
    pub fn content(&self) -> ContentHash {
        match self {
            Self::Image(image) => of_image(image),
            Self::Gradient(gradient) => of_gradient(gradient),
            Self::Text(text) => {
                let mut content = Content::new("text");
                content.text(text);
                content.finish()
            }
            Self::Points(points) => *points.content(),
            Self::Mesh(mesh) => *mesh.content(),
            Self::Strands(strands) => *strands.content(),
        }
    }
}

fn of_image(image: &Image) -> ContentHash {
    let mut content = Content::new("image");
    content.number(u64::from(image.width()));
    content.number(u64::from(image.height()));
    content.number(image.planes() as u64);
    for channel in 0..image.planes() {
        content.words(bytemuck::cast_slice(image.channel(channel)));
    }
    content.finish()
}

fn of_gradient(gradient: &Gradient) -> ContentHash {
    let mut content = Content::new("gradient");
    content.number(gradient.stops().len() as u64);
    for stop in gradient.stops() {
        content.words(&[stop.position.to_bits()]);
        content.words(&stop.color.map(f32::to_bits));
    }
    content.finish()
}

#[cfg(test)]
mod tests {
    use super::{super::GradientStop, *};

    #[test]
    fn equal_contents_have_equal_hashes() {
        let text = |text: &str| Value::from(text.to_owned()).content();
        assert_eq!(text("F+F"), text("F+F"));
        assert_ne!(text("F+F"), text("F-F"));
        let gradient = |position| {
            Value::from(Gradient::new(vec![GradientStop { position, color: [0.0; 3] }])).content()
        };
        assert_eq!(gradient(0.5), gradient(0.5));
        assert_ne!(gradient(0.5), gradient(0.25));
        assert_ne!(Value::from(Gradient::default()).content(), text(""));
    }

    #[test]
    fn long_contents_are_hashed_to_their_ends() {
        let hash = |words: &[u32]| {
            let mut content = Content::new("words");
            content.words(words);
            content.finish()
        };
        let mut words = vec![7; 3 * PIECE];
        let before = hash(&words);
        words[3 * PIECE - 1] = 8;
        assert_ne!(before, hash(&words));
        assert_ne!(before, hash(&words[..3 * PIECE - 1]));
    }
}
