//! PLY, text and binary of both byte orders, by `ply-rs-bw`.
//!
//! Of vertices the properties `x y z`, `nx ny nz` and one pair of `s t`, `u v` and
//! `texture_u texture_v` are read, of faces the list `vertex_indices` or `vertex_index`; others are
//! passed over. Elements are read one by one into structs of our own, so that an error knows its
//! line or byte, and a header that lies about their number is found out before memory is taken.

use ply_rs_bw::{
    parser::{Parser, Reader},
    ply::{
        BeginList, ElementDef, Encoding, Header, Property, PropertyAccess,
        PropertyAccessResult as Access, PropertyType, ScalarType,
    },
};

use super::{FileError, FileMesh, Limits, Outside, is_fine, limit, one_line};

/// Elements between two questions whether to stop.
const ELEMENTS: usize = 4096;

/// Lines of a header, and bytes of one: a short declaration takes a hundred times its bytes in
/// memory.
const HEADER_LINES: usize = 10_000;
const HEADER_LINE: usize = 4096;

/// Bytes of a line of text.
const LINE: usize = 1 << 20;

/// The properties of vertices that are read.
const NAMES: [&str; 12] =
    ["x", "y", "z", "nx", "ny", "nz", "s", "t", "u", "v", "texture_u", "texture_v"];

/// Reads a PLY file.
///
/// # Errors
/// What is wrong, and in which line or at which byte.
pub fn read(bytes: &[u8], outside: &dyn Outside, limits: &Limits) -> Result<FileMesh, FileError> {
    check_header_size(bytes)?;
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new()
        .read_header(&mut reader)
        .map_err(|error| FileError::Parse(one_line(&format!("in the header: {error}"))))?;
    let line = reader.line();
    let rest = reader.into_inner();
    check_header(&header, &bytes[..bytes.len() - rest.len()])?;
    let mut body = Body { total: bytes.len(), rest, line, encoding: header.encoding, outside };
    let mut mesh = FileMesh::default();
    for element in header.elements.values() {
        match element.name.as_str() {
            "vertex" => vertices(&mut body, element, limits, &mut mesh)?,
            "face" => {
                let vertices = header.elements.get("vertex").map_or(0, |element| element.count);
                faces(&mut body, element, vertices, limits, &mut mesh)?;
            }
            _ => body.each::<Other>(element, |_, _| Ok(()))?,
        }
    }
    mesh.check()?;
    Ok(mesh)
}

/// That the header can be read.
fn check_header_size(bytes: &[u8]) -> Result<(), FileError> {
    let is_end = |line: &&[u8]| line.trim_ascii() == b"end_header";
    let lines = bytes.split(|byte| *byte == b'\n').take_while(|line| !is_end(line));
    for (number, line) in (1..).zip(lines) {
        if number > HEADER_LINES {
            let message = format!("in the header: more than {HEADER_LINES} lines");
            return Err(FileError::Limit(message));
        }
        if line.len() > HEADER_LINE {
            let allowed = format!("{} bytes, allowed {HEADER_LINE}", line.len());
            return Err(FileError::Limit(format!("in the header: line {number}: {allowed}")));
        }
    }
    Ok(())
}

/// That the header says everything once: the library takes the last of two that have one name.
fn check_header(header: &Header, text: &[u8]) -> Result<(), FileError> {
    let wrong = |what: String| Err(FileError::Parse(format!("in the header: {what}")));
    let lines = |word: &[u8]| {
        let is_such = |line: &&[u8]| line.starts_with(word);
        text.split(|byte| *byte == b'\n').filter(is_such).count()
    };
    let properties: usize = header.elements.values().map(|element| element.properties.len()).sum();
    if lines(b"element ") > header.elements.len() || lines(b"property ") > properties {
        return wrong("an element or property is declared twice, allowed once".to_owned());
    }
    if !header.elements.contains_key("vertex") {
        return wrong("there is no element \"vertex\"".to_owned());
    }
    for element in header.elements.values() {
        if element.properties.is_empty() && element.count > 0 {
            return wrong(format!("element \"{}\" has no properties", element.name));
        }
    }
    Ok(())
}

/// Reads all vertices.
fn vertices(
    body: &mut Body<'_>,
    element: &ElementDef,
    limits: &Limits,
    mesh: &mut FileMesh,
) -> Result<(), FileError> {
    limit("vertices", element.count as u64, limits.vertices)?;
    body.check_room(element)?;
    let has = |names: &[&str]| names.iter().all(|name| element.properties.contains_key(*name));
    if !has(&NAMES[..3]) {
        let message = "in the header: element \"vertex\" needs the properties x, y and z";
        return Err(FileError::Parse(message.to_owned()));
    }
    let has_normals = has(&NAMES[3..6]);
    let pair = [6, 8, 10].into_iter().find(|place| has(&NAMES[*place..place + 2]));
    mesh.positions.reserve_exact(element.count);
    mesh.normals.reserve_exact(if has_normals { element.count } else { 0 });
    mesh.texcoords.reserve_exact(if pair.is_some() { element.count } else { 0 });
    body.each::<Vertex>(element, |place, Vertex(numbers)| {
        if let Some(wrong) = numbers.iter().position(|number| !is_fine(number)) {
            let (name, number) = (NAMES[wrong], numbers[wrong]);
            let allowed = "allowed are finite numbers from -1e18 to 1e18";
            return Err(place.wrong(&format!("{name} is {number}, {allowed}")));
        }
        let [x, y, z, nx, ny, nz, ..] = numbers;
        mesh.positions.push([x, y, z]);
        if has_normals {
            mesh.normals.push([nx, ny, nz]);
        }
        if let Some(pair) = pair {
            mesh.texcoords.push([numbers[pair], numbers[pair + 1]]);
        }
        Ok(())
    })
}

/// Reads all faces as fans of triangles.
fn faces(
    body: &mut Body<'_>,
    element: &ElementDef,
    vertices: usize,
    limits: &Limits,
    mesh: &mut FileMesh,
) -> Result<(), FileError> {
    limit("faces", element.count as u64, limits.triangles)?;
    body.check_room(element)?;
    mesh.triangles.reserve(element.count);
    body.each::<Face>(element, |place, face| {
        let corners = face.corners();
        let is_wrong = |corner: &&Option<u32>| corner.is_none_or(|i| i as usize >= vertices);
        if let Some(wrong) = corners.iter().find(is_wrong) {
            let wrong = wrong.map_or("negative".to_owned(), |corner| corner.to_string());
            let message = format!("a corner is vertex {wrong}, allowed below {vertices}");
            return Err(place.wrong(&message));
        }
        let triangles = (mesh.triangles.len() + corners.len().saturating_sub(2)) as u64;
        limit("triangles", triangles, limits.triangles)?;
        let corner = |i: usize| corners.get(i).copied().flatten().unwrap_or_default();
        for last in 2..corners.len() {
            mesh.triangles.push([corner(0), corner(last - 1), corner(last)]);
        }
        Ok(())
    })
}

/// What is behind the header.
struct Body<'a> {
    /// Bytes of the whole file.
    total: usize,
    rest: &'a [u8],
    line: usize,
    encoding: Encoding,
    outside: &'a dyn Outside,
}

/// Where an element is in the file.
#[derive(Clone, Copy)]
struct Place<'e> {
    element: &'e str,
    number: usize,
    line: Option<usize>,
    byte: usize,
}

impl Place<'_> {
    fn wrong(self, what: &str) -> FileError {
        let Self { element, number, line, byte } = self;
        let place = line.map_or_else(|| format!("byte {byte}"), |line| format!("line {line}"));
        FileError::Parse(format!("{place}: {element} {number}: {}", one_line(what)))
    }
}

impl<'a> Body<'a> {
    /// That the file has as many bytes as elements take at least.
    fn check_room(&self, element: &ElementDef) -> Result<(), FileError> {
        let properties = element.properties.values();
        let least = match self.encoding {
            // A digit for each, and blanks between.
            Encoding::Ascii => (2 * properties.len()).saturating_sub(1),
            _ => properties.map(|property| least(&property.data_type)).sum(),
        };
        let room = self.rest.len() / least.max(1);
        if element.count <= room {
            return Ok(());
        }
        let ElementDef { name, count, .. } = element;
        Err(FileError::Parse(format!(
            "in the header: {count} elements \"{name}\", but the file ends after at most {room}"
        )))
    }

    /// Reads all elements of a kind.
    fn each<E: PropertyAccess>(
        &mut self,
        element: &ElementDef,
        mut take: impl FnMut(Place<'_>, E) -> Result<(), FileError>,
    ) -> Result<(), FileError> {
        self.check_room(element)?;
        let parser = Parser::<E>::new();
        for number in 0..element.count {
            if number.is_multiple_of(ELEMENTS) {
                self.outside.check()?;
            }
            let is_text = self.encoding == Encoding::Ascii;
            let line: &[u8] = if is_text { self.next_line() } else { &[] };
            let place = Place {
                element: &element.name,
                number,
                line: is_text.then_some(self.line),
                byte: self.total - self.rest.len(),
            };
            if line.len() > LINE {
                let message = format!("the line has {} bytes, allowed {LINE}", line.len());
                return Err(place.wrong(&message));
            }
            let read = match self.encoding {
                Encoding::Ascii => match str::from_utf8(line) {
                    Ok(line) => parser.read_ascii_element(line, element),
                    Err(_) => return Err(place.wrong("is no UTF-8")),
                },
                Encoding::BinaryLittleEndian => {
                    parser.read_little_endian_element(&mut self.rest, element)
                }
                Encoding::BinaryBigEndian => {
                    parser.read_big_endian_element(&mut self.rest, element)
                }
            };
            take(place, read.map_err(|error| place.wrong(&error.to_string()))?)?;
            self.line += usize::from(is_text);
        }
        Ok(())
    }

    /// The next line that is not blank, without its end; nothing at the end of the file.
    fn next_line(&mut self) -> &'a [u8] {
        loop {
            let end = self.rest.iter().position(|byte| *byte == b'\n');
            let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
            self.rest = rest.get(1..).unwrap_or_default();
            let line = line.trim_ascii();
            if !line.is_empty() || self.rest.is_empty() {
                return line;
            }
            self.line += 1;
        }
    }
}

/// The bytes that a property takes at least.
fn least(r#type: &PropertyType) -> usize {
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = r#type;
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// The numbers of a vertex, in the order of [`NAMES`].
struct Vertex([f32; NAMES.len()]);

impl Vertex {
    fn set(&mut self, name: &str, number: Option<f32>) -> Access {
        let Some(place) = NAMES.iter().position(|known| *known == name) else {
            return Access::Ignored;
        };
        let Some(number) = number else { return Access::UnsupportedType };
        self.0[place] = number;
        Access::Set
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self([0.0; NAMES.len()])
    }

    fn set_property(&mut self, name: &str, property: Property) -> Access {
        self.set(name, property.to_f32_lossy())
    }

    fn set_float(&mut self, name: &str, value: f32) -> Access {
        self.set(name, Some(value))
    }
}

/// The corners of a face; the types that files use are read in place.
#[derive(Default)]
struct Face {
    signed: Vec<i32>,
    unsigned: Vec<u32>,
}

fn is_corners(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

impl Face {
    /// The numbers of its vertices, none for a negative one.
    fn corners(self) -> Vec<Option<u32>> {
        if self.signed.is_empty() {
            return self.unsigned.into_iter().map(Some).collect();
        }
        self.signed.into_iter().map(|corner| u32::try_from(corner).ok()).collect()
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> Access {
        if !is_corners(name) {
            return Access::Ignored;
        }
        let Some(corners) = property.to_u32_list() else { return Access::UnsupportedType };
        self.unsigned = corners;
        Access::Set
    }

    fn begin_list_int(&mut self, name: &str, _: usize) -> BeginList<'_, i32> {
        if is_corners(name) { BeginList::Fill(&mut self.signed) } else { BeginList::UseSetter }
    }

    fn begin_list_uint(&mut self, name: &str, _: usize) -> BeginList<'_, u32> {
        if is_corners(name) { BeginList::Fill(&mut self.unsigned) } else { BeginList::UseSetter }
    }
}

/// An element that is passed over.
struct Other;

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::{Alone, testing::assert_fault},
        *,
    };

    fn mesh(bytes: &[u8]) -> FileMesh {
        read(bytes, &Alone, &Limits::default()).unwrap()
    }

    /// A header of that encoding, with the properties of vertices.
    fn header(encoding: &str, vertices: &str, properties: &[&str], faces: &str) -> String {
        let properties: String = properties.iter().map(|p| format!("property {p}\n")).collect();
        format!(
            "ply\nformat {encoding} 1.0\ncomment made by hand\nelement vertex {vertices}\n\
             {properties}element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        )
    }

    const XYZ: [&str; 3] = ["float x", "float y", "float z"];

    #[test]
    fn text_is_read() {
        let properties =
            [&XYZ[..], &["uchar red", "float s", "float t", "int nx", "double ny", "char nz"]];
        let text = header("ascii", "4", &properties.concat(), "2")
            + "0 0 0 255 0.5 1 0 0 1\n1 0 0 255 1 1 0 0 1\r\n\n1 1 0 0 1 0.25 0 1e0 0\n\
               0 1 0 9 0 0 0 0 -1\n4 0 1 2 3\n2 0 1";
        let found = mesh(text.as_bytes());
        assert_eq!(found.positions[2], [1.0, 1.0, 0.0]);
        assert_eq!(found.normals[2], [0.0, 1.0, 0.0]);
        assert_eq!(found.texcoords[2], [1.0, 0.25]);
        assert_eq!(found.triangles, [[0, 1, 2], [0, 2, 3]]);
    }

    fn body(floats: &[f32], faces: &[&[i32]], bytes: impl Fn([u8; 4]) -> [u8; 4]) -> Vec<u8> {
        let mut body: Vec<u8> = floats.iter().flat_map(|x| bytes(x.to_le_bytes())).collect();
        for face in faces {
            body.push(u8::try_from(face.len()).unwrap());
            body.extend(face.iter().flat_map(|corner| bytes(corner.to_le_bytes())));
        }
        body
    }

    #[test]
    fn both_byte_orders_are_read() {
        let floats: Vec<f32> = (0..15_u8).map(f32::from).collect();
        let properties = [&XYZ[..], &["float texture_u", "float texture_v"]].concat();
        let faces: [&[i32]; 2] = [&[0, 1, 2], &[2, 1]];
        let same = |bytes: [u8; 4]| bytes;
        let swapped = |[a, b, c, d]: [u8; 4]| [d, c, b, a];
        let little = [
            header("binary_little_endian", "3", &properties, "2").into_bytes(),
            body(&floats, &faces, same),
        ];
        let big = [
            header("binary_big_endian", "3", &properties, "2").into_bytes(),
            body(&floats, &faces, swapped),
        ];
        let found = mesh(&little.concat());
        assert_eq!(found.positions[1], [5.0, 6.0, 7.0]);
        assert_eq!(found.texcoords, [[3.0, 4.0], [8.0, 9.0], [13.0, 14.0]]);
        assert_eq!(found.triangles, [[0, 1, 2]]);
        assert_eq!(mesh(&big.concat()), found);
    }

    #[test]
    fn any_type_of_index_and_any_order_of_elements_is_read() {
        for kind in ["char", "uchar", "short", "ushort", "int", "uint"] {
            let text = format!(
                "ply\nformat ascii 1.0\nelement mystery 1\nproperty list uchar {kind} things\n\
                 element face 1\nproperty uchar flags\nproperty list uint {kind} vertex_index\n\
                 element vertex 3\nproperty int x\nproperty int y\nproperty int z\nend_header\n\
                 2 7 7\n9 3 2 1 0\n0 0 0\n1 0 0\n0 1 0\n"
            );
            assert_eq!(mesh(text.as_bytes()).triangles, [[2, 1, 0]], "{kind}");
        }
    }

    #[test]
    fn a_header_that_lies_is_found_out() {
        for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let lie = |vertices: &str, faces: &str, expected: &str| {
                let text = header(encoding, vertices, &XYZ, faces);
                assert_fault(text.as_bytes(), expected);
            };
            lie("1000000000000000000", "0", "1000000000000000000 vertices, allowed 16777216");
            lie("0", "1000000000000000000", "1000000000000000000 faces, allowed 33554432");
            lie("16777216", "0", "16777216 elements \"vertex\", but the file ends");
            lie("99999999999999999999", "0", "in the header: Line 4");
            lie("-1", "0", "in the header: Line 4");
            let mystery =
                format!("ply\nformat {encoding} 1.0\nelement mystery 1000000000000000000\n");
            let rest = "element vertex 0\nproperty float x\nend_header\n";
            assert_fault((mystery.clone() + rest).as_bytes(), "\"mystery\" has no properties");
            let one = mystery + "property uchar a\n" + rest;
            assert_fault(one.as_bytes(), "1000000000000000000 elements \"mystery\"");
        }
        let list = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n\
            property float y\nproperty float z\nelement face 1\n\
            property list uint int vertex_indices\nend_header\n";
        let mut bytes = [list.as_bytes(), &[0; 12], &[0xFF; 4], &[0; 64]].concat();
        assert_fault(&bytes, "face 0");
        bytes.truncate(list.len() + 12);
        assert_fault(&bytes, "1 elements \"face\", but the file ends after at most 0");
    }

    #[test]
    fn faults_have_places() {
        let text = |vertex: &str, face: &str| {
            let rest = format!("0 0 0\n{vertex}\n0 1 0\n{face}\n");
            header("ascii", "3", &XYZ, "1") + &rest
        };
        let fault = |vertex, face, expected| assert_fault(text(vertex, face).as_bytes(), expected);
        fault("0 x 0", "3 0 1 2", "line 12: vertex 1");
        fault("0 nan 0", "3 0 1 2", "line 12: vertex 1");
        fault("0 1e39 0", "3 0 1 2", "line 12: vertex 1: y is inf");
        fault("0 0", "3 0 1 2", "line 12: vertex 1");
        fault("1 0 0", "3 0 1 3", "line 14: face 0: a corner is vertex 3, allowed below 3");
        fault("1 0 0", "3 0 1 -1", "line 14: face 0: a corner is vertex negative");
        fault("1 0 0", "3 0 1", "line 14: face 0");
        fault("1 0 0", "1000000000000000000 0 1 2", "line 14: face 0");
        assert_fault(b"ply\nformat ascii 1.0\nelement ver", "in the header");
        assert_fault(b"ply\nformat ascii 1.0\nend_header\n", "no element \"vertex\"");
        let twice = header("ascii", "1", &[&XYZ[..], &["float x"]].concat(), "0");
        assert_fault((twice + "0 0 0 0").as_bytes(), "declared twice");
        let list = header("ascii", "1", &["list uchar float x", "float y", "float z"], "0");
        assert_fault((list + "1 0 0 0").as_bytes(), "line 11: vertex 0");
        assert_fault(header("ascii", "0", &XYZ[..2], "0").as_bytes(), "needs the properties");
    }

    #[test]
    fn numbers_of_every_stream_are_finite() {
        let properties = [&XYZ[..], &["float nx", "float ny", "float nz", "float u", "float v"]];
        let properties = properties.concat();
        for place in 0..8 {
            for number in [f32::NAN, f32::INFINITY, -1e19] {
                let mut floats = [0.5; 8];
                floats[place] = number;
                let head = header("binary_little_endian", "1", &properties, "0");
                let bytes = [head.as_bytes(), &body(&floats, &[], |bytes| bytes)].concat();
                let name = properties[place].trim_start_matches("float ");
                let byte = head.len();
                assert_fault(&bytes, &format!("byte {byte}: vertex 0: {name} is {number}"));
            }
        }
    }

    #[test]
    fn lines_have_limits() {
        assert_fault(&b"ply\n".repeat(HEADER_LINES + 1), "in the header: more than 10000 lines");
        let long = ["ply\ncomment ", &"a".repeat(HEADER_LINE)].concat();
        assert_fault(long.as_bytes(), "in the header: line 2: 4104 bytes, allowed 4096");
        let numbers = header("ascii", "1", &XYZ, "0") + &"0 ".repeat(LINE / 2 + 1);
        assert_fault(numbers.as_bytes(), "line 11: vertex 0: the line has 1048577 bytes");
    }

    #[test]
    fn triangles_have_limits() {
        let text = header("ascii", "3", &XYZ, "1") + "0 0 0\n0 0 0\n0 0 0\n5 0 1 2 0 1\n";
        let limits = Limits { triangles: 2, ..Limits::default() };
        let error = read(text.as_bytes(), &Alone, &limits).unwrap_err();
        assert_eq!(error, FileError::Limit("3 triangles, allowed 2".into()));
    }
}
