//! How much a graph file may ask for. Files are untrusted: each limit stops an attack, and the
//! caller may raise it.

/// The limits of an engine. [`Limits::default`] suits programs that open files of strangers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of a graph file. Real ones have 1 to 5 KB.
    pub file_bytes: u64,
    /// Blocks of a graph: bounds the time of everything that walks it.
    pub blocks: u32,
    /// Connections of a graph.
    pub connections: u32,
    /// Bytes of one text parameter.
    pub text_bytes: u32,
    /// Depth of nested elements in a graph file: ours need 3.
    pub nesting: u32,
    /// Faults that are collected from one file before reading stops.
    pub faults: u32,
    /// Width and height of an image in pixels, supersampling included.
    pub image_side: u32,
    /// Bytes that one computation may take at its peak. A 50-byte file can ask for a terabyte.
    pub memory_bytes: u64,
    /// Bytes of a file that a block reads (a picture, a grammar).
    pub read_bytes: u64,
    /// Symbols and values of the text of an L-system: it grows exponentially. The grammar may have
    /// as many bytes; rewriting may take 64 times as many steps, for rules may replace a text for
    /// ever; and a turtle may draw 1024 times as many pixels, for one step can have billions.
    pub text_symbols: u32,
    /// Stops of a colour transition that is given from outside.
    pub gradient_stops: u32,
    /// Vertices of a mesh: a file of a few bytes can claim billions.
    pub mesh_vertices: u32,
    /// Triangles of a mesh.
    pub mesh_triangles: u32,
    /// Points of a value of kind points.
    pub points: u32,
    /// Strands of a value of kind strands.
    pub strands: u32,
    /// Points of all strands of a value together.
    pub strand_points: u32,
    /// Streams of one value: what looks for an id walks them.
    pub streams: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 16 << 20,
            blocks: 10_000,
            connections: 50_000,
            text_bytes: 1 << 20,
            nesting: 16,
            faults: 100,
            image_side: 65_536,
            memory_bytes: 4 << 30,
            read_bytes: 256 << 20,
            text_symbols: 16 << 20,
            gradient_stops: 65_536,
            mesh_vertices: 16 << 20,
            mesh_triangles: 32 << 20,
            points: 64 << 20,
            strands: 64 << 20,
            strand_points: 256 << 20,
            streams: 32,
        }
    }
}
