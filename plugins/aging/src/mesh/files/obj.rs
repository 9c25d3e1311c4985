//! Wavefront OBJ, by `tobj`.
//!
//! The library reads lines, and this module stands before it: it lets through the lines that make a
//! mesh (`v`, `vt`, `vn`, `f`), counts them, and checks the numbers of faces. So groups and objects
//! become one mesh that shares its vertices, material files are never opened, comments may be in
//! any encoding, and errors have lines, which those of the library have not. A vertex's colour is
//! passed over.

use std::io::{self, BufRead, Read};

use super::{FileError, FileMesh, Limits, Outside, is_fine, limit};

/// Lines between two questions whether to stop.
const LINES: usize = 4096;

/// The largest index that is handed on: the library multiplies them.
const LARGEST_INDEX: i64 = 1 << 31;

/// Reads an OBJ file.
///
/// # Errors
/// What is wrong, and in which line.
pub fn read(bytes: &[u8], outside: &dyn Outside, limits: &Limits) -> Result<FileMesh, FileError> {
    let mut lines = Lines::new(bytes, outside, limits);
    let options = tobj::LoadOptions {
        triangulate: true,
        single_index: true,
        ignore_points: true,
        ignore_lines: true,
    };
    // Lines that name materials are not let through, so nothing is loaded here.
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::GenericFailure);
    let loaded = tobj::load_obj_buf(&mut lines, &options, no_materials);
    if let Some(fault) = lines.fault.take() {
        return Err(fault);
    }
    let (models, _) = match loaded {
        // Faces are put together behind the last line.
        Ok(loaded) => lines.check_indices().map(|()| loaded),
        Err(
            tobj::LoadError::FaceVertexOutOfBounds
            | tobj::LoadError::FaceTexCoordOutOfBounds
            | tobj::LoadError::FaceNormalOutOfBounds,
        ) => Err(lines.check_indices().err().unwrap_or_else(|| wrong(lines.line, "a wrong index"))),
        Err(error) => Err(wrong(lines.line, &error.to_string())),
    }?;
    let mesh = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    let mesh = FileMesh {
        positions: arrays(&mesh.positions),
        normals: arrays(&mesh.normals),
        texcoords: arrays(&mesh.texcoords),
        triangles: arrays(&mesh.indices),
    };
    limit("vertices", mesh.positions.len() as u64, limits.vertices)?;
    mesh.check().map_err(|error| unfit_line(bytes).unwrap_or(error))?;
    Ok(mesh)
}

fn wrong(line: usize, what: &str) -> FileError {
    FileError::Parse(format!("line {line}: {what}"))
}

/// Numbers in groups.
fn arrays<T: Copy + Default, const N: usize>(numbers: &[T]) -> Vec<[T; N]> {
    let array = |group: &[T]| {
        let mut array = [T::default(); N];
        array.copy_from_slice(group);
        array
    };
    numbers.chunks_exact(N).map(array).collect()
}

/// The first line with a number that no mesh may have.
fn unfit_line(bytes: &[u8]) -> Option<FileError> {
    for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let text = String::from_utf8_lossy(line);
        let mut words = text.split_whitespace();
        if !matches!(words.next(), Some("v" | "vt" | "vn")) {
            continue;
        }
        let is_unfit = |word: &&str| word.parse().is_ok_and(|number: f32| !is_fine(&number));
        if let Some(word) = words.find(is_unfit) {
            let message = format!("{word}, allowed are finite numbers from -1e18 to 1e18");
            return Some(wrong(number + 1, &message));
        }
    }
    None
}

/// Places, texture coordinates or normals.
#[derive(Debug, Clone, Copy, Default)]
struct Kind {
    count: i64,
    /// The largest number that a face had, and its line: it may come before what it names.
    largest: (i64, usize),
}

const NAMES: [&str; 3] = ["v", "vt", "vn"];

/// The lines that the library gets to see.
struct Lines<'a> {
    rest: &'a [u8],
    /// The line that is read, as far as it is of use.
    text: String,
    taken: usize,
    line: usize,
    next_line: usize,
    kinds: [Kind; 3],
    /// Whether corners have texture coordinates and normals.
    form: Option<[bool; 2]>,
    triangles: u64,
    fault: Option<FileError>,
    outside: &'a dyn Outside,
    limits: &'a Limits,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8], outside: &'a dyn Outside, limits: &'a Limits) -> Self {
        Self {
            rest: bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes),
            text: String::new(),
            taken: 0,
            line: 0,
            next_line: 1,
            kinds: [Kind::default(); 3],
            form: None,
            triangles: 0,
            fault: None,
            outside,
            limits,
        }
    }

    /// Goes to the next line of use; false at the end.
    fn advance(&mut self) -> Result<bool, FileError> {
        while !self.rest.is_empty() {
            self.next()?;
            if !self.text.is_empty() {
                self.text.push('\n');
                return Ok(true);
            }
        }
        self.text.clear();
        Ok(false)
    }

    /// Reads one line, with those that a backslash joins to it, and empties it if it is of no use.
    fn next(&mut self) -> Result<(), FileError> {
        self.text.clear();
        self.taken = 0;
        self.line = self.next_line;
        loop {
            let end = self.rest.iter().position(|byte| *byte == b'\n');
            let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
            self.rest = rest.get(1..).unwrap_or_default();
            if self.next_line.is_multiple_of(LINES) {
                self.outside.check()?;
            }
            self.next_line += 1;
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            // What is behind a "#" is for people, in whatever encoding they like.
            let line = line.split(|byte| *byte == b'#').next().unwrap_or_default();
            let (line, is_joined) = match line.strip_suffix(b"\\") {
                Some(line) => (line, true),
                None => (line, false),
            };
            let is_first = self.text.is_empty();
            if is_first && !matches!(line.trim_ascii_start().first(), Some(b'v' | b'f')) {
                // Joined lines of no use are read one by one: what follows cannot be told from
                // lines of use, so it is passed over here.
                if !is_joined {
                    return Ok(());
                }
                self.text.push('#');
            } else if !self.text.starts_with('#') {
                let text = str::from_utf8(line).map_err(|_| wrong(self.line, "is no UTF-8"))?;
                self.text.push_str(text);
                self.text.push(' ');
            }
            if !is_joined || self.rest.is_empty() {
                break;
            }
        }
        self.judge()
    }

    /// Checks and counts the line, and shortens it to what the library understands.
    fn judge(&mut self) -> Result<(), FileError> {
        let mut text = std::mem::take(&mut self.text);
        let mut words = text.split_ascii_whitespace();
        let word = words.next();
        let kind = NAMES.iter().position(|name| word == Some(name));
        let line = self.line;
        // Bytes of the line that are of use.
        let mut used = text.len();
        match (word, words.clone().count()) {
            (Some("v"), 3 | 4) | (Some("vt"), 2 | 3) | (Some("vn"), 3) => {}
            // The other three are a colour.
            (Some("v"), 6) => {
                let red = words.nth(3).map_or(0, |word| word.as_ptr().addr());
                used = red.saturating_sub(text.as_ptr().addr());
            }
            (Some("v"), count) => {
                let message = format!("v has {count} numbers, allowed are 3, 4 and 6");
                return Err(wrong(line, &message));
            }
            (Some("vt"), count) => {
                return Err(wrong(line, &format!("vt has {count} numbers, allowed are 2 and 3")));
            }
            (Some("vn"), count) => {
                return Err(wrong(line, &format!("vn has {count} numbers, allowed are 3")));
            }
            (Some("f"), corners @ 3..) => {
                words.try_for_each(|corner| self.corner(corner))?;
                self.triangles += corners as u64 - 2;
                limit("triangles", self.triangles, self.limits.triangles)?;
            }
            _ => used = 0,
        }
        text.truncate(used);
        self.text = text;
        if let Some(kind) = kind {
            self.kinds[kind].count += 1;
            let count = self.kinds[kind].count.unsigned_abs();
            limit(&format!("lines \"{}\"", NAMES[kind]), count, self.limits.vertices)?;
        }
        Ok(())
    }

    /// Checks a corner of a face: `place`, `place/texture`, `place//normal` or all three.
    fn corner(&mut self, corner: &str) -> Result<(), FileError> {
        let line = self.line;
        let mut numbers = corner.split('/');
        let mut form = [false; 2];
        for (kind, name) in NAMES.into_iter().enumerate() {
            let Some(number) = numbers.next().filter(|number| !number.is_empty()) else {
                if kind == 0 {
                    return Err(wrong(line, &format!("the corner \"{corner}\" has no place")));
                }
                continue;
            };
            if kind > 0 {
                form[kind - 1] = true;
            }
            let Kind { count, largest } = &mut self.kinds[kind];
            let number = match number.parse::<i64>() {
                Ok(number @ 1..=LARGEST_INDEX) => number,
                // Negative numbers count from the end.
                Ok(number) if number < 0 && number >= -*count => *count + 1 + number,
                _ => {
                    let allowed = format!("allowed {name} are 1 to {count}, and -1 to -{count}");
                    return Err(wrong(line, &format!("the corner is \"{corner}\", {allowed}")));
                }
            };
            if number > largest.0 {
                *largest = (number, line);
            }
        }
        if numbers.next().is_some() {
            return Err(wrong(line, &format!("the corner \"{corner}\" has more than 3 numbers")));
        }
        if *self.form.get_or_insert(form) != form {
            let message = "and corners before have another form; allowed is one in a file";
            return Err(wrong(line, &format!("a corner is \"{corner}\", {message}")));
        }
        Ok(())
    }

    /// That everything that faces named came.
    fn check_indices(&self) -> Result<(), FileError> {
        if self.kinds[0].count == 0 {
            let message = "has no line of the form \"v x y z\"; is it an OBJ file?";
            return Err(FileError::Parse(message.to_owned()));
        }
        for (Kind { count, largest: (largest, line) }, name) in self.kinds.iter().zip(NAMES) {
            if largest > count {
                let message = format!("a corner has {name} {largest}, allowed are 1 to {count}");
                return Err(wrong(*line, &message));
            }
        }
        Ok(())
    }
}

impl BufRead for Lines<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.taken == self.text.len()
            && self.fault.is_none()
            && let Err(fault) = self.advance()
        {
            self.fault = Some(fault);
        }
        if self.fault.is_some() {
            return Err(io::Error::other("there is a fault"));
        }
        Ok(self.text.as_bytes().get(self.taken..).unwrap_or_default())
    }

    fn consume(&mut self, bytes: usize) {
        self.taken = self.taken.saturating_add(bytes).min(self.text.len());
    }
}

impl Read for Lines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.fill_buf()?.read(buffer)?;
        self.consume(read);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::{Alone, testing::assert_fault},
        *,
    };

    fn mesh(text: &str) -> FileMesh {
        read(text.as_bytes(), &Alone, &Limits::default()).unwrap()
    }

    const CORNERS: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";

    #[test]
    fn a_polygon_becomes_a_fan() {
        let found = mesh(&format!("{CORNERS}v -1 1 0\nf 1 2 3 4 5\n"));
        assert_eq!(found.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        assert_eq!(found.positions[4], [-1.0, 1.0, 0.0]);
        assert!(found.normals.is_empty() && found.texcoords.is_empty());
    }

    #[test]
    fn vertices_are_shared_where_all_their_numbers_are_the_same() {
        let text = format!(
            "{CORNERS}vt 0 0\nvt 1 0.5 9\nvn 0 0 2\ng one\nf 1/1/1 2/2/1 3/1/1\n\
             o two\nusemtl skin\nf -4/1/1 3/2/1 4/1/1\n"
        );
        let found = mesh(&text);
        assert_eq!(found.triangles, [[0, 1, 2], [0, 3, 4]]);
        assert_eq!(found.texcoords[1], [1.0, 0.5]);
        assert_eq!(found.texcoords[3], [1.0, 0.5]);
        assert_eq!(found.positions[3], found.positions[2]);
        assert_eq!(found.normals, [[0.0, 0.0, 2.0]; 5]);
    }

    #[test]
    fn what_people_write_is_understood() {
        let text = b"\xEF\xBB\xBF# Gr\xF6\xDFe\r\nmtllib ../../etc/passwd\r\n  v 0 0 0 1 0 0\r\n\
            v 2 0 0 2 # a weight\r\nv 0 \\\r\n 2 0\r\np 1 \\\r\nf 9 9 9\r\nl 1 2\r\nf 1 2\r\n\
            s off\r\nf 1 2 3";
        let found = read(text, &Alone, &Limits::default()).unwrap();
        assert_eq!(found.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
        assert_eq!(found.triangles, [[0, 1, 2]]);
    }

    #[test]
    fn points_without_faces_are_an_empty_mesh() {
        assert_eq!(mesh(CORNERS), FileMesh::default());
    }

    #[test]
    fn faults_have_lines() {
        let fault = |text: &str, expected: &str| {
            assert_fault(format!("{CORNERS}vt 0 0\n{text}").as_bytes(), expected);
        };
        fault("f 1 2 5\nv 1 2", "line 7: v has 2 numbers");
        fault("f 1 2 5", "line 6: a corner has v 5, allowed are 1 to 4");
        fault("f 1 2 -5", "line 6: the corner is \"-5\", allowed v are 1 to 4");
        fault("f 1 0 3", "line 6: the corner is \"0\"");
        fault("f 1/2 2/1 3/1", "line 6: a corner has vt 2, allowed are 1 to 1");
        fault("f 1/-2 2/1 3/1", "line 6: the corner is \"1/-2\"");
        fault("f 1/9223372036854775807 2/1 3/1", "line 6: the corner");
        fault("f 1/-9223372036854775808 2/1 3/1", "line 6: the corner");
        fault("f 99999999999999999999 2 3", "line 6: the corner");
        fault("f 1//1 2//1 3//1", "line 6: a corner has vn 1, allowed are 1 to 0");
        fault("f 1/1/1/1 2 3", "more than 3 numbers");
        fault("f /1 2 3", "no place");
        fault("f 1/1 2/1 3", "line 6: a corner is \"3\", and corners before have another form");
        fault("v 1 x 3", "line 6");
        fault("v 1 2 3 0", "line 6");
        fault("v 1 2 3 4 5", "line 6: v has 5 numbers");
        fault("vn 1 2", "line 6: vn has 2 numbers");
        fault("vt 1", "line 6: vt has 1 numbers");
        fault("v 1 2 \\\n", "line 6: v has 2 numbers");
        assert_fault(b"v 1 2 \xFF", "line 1: is no UTF-8");
        assert_fault(b"a text that is no mesh", "is it an OBJ file?");
    }

    #[test]
    fn numbers_are_finite() {
        for number in ["nan", "inf", "-Infinity", "1e39", "1e19"] {
            let line = format!("line 3: {number}, allowed are finite");
            let face = "f 1/1/1 1/1/1 1/1/1\n";
            for streams in [
                format!("vn 0 0 1\nvt 0 0\nv 0 {number} 0\n{face}"),
                format!("v 0 0 0\nvt 0 0\nvn {number} 0 0\n{face}"),
                format!("v 0 0 0\nvn 0 0 1\nvt 0 {number}\n{face}"),
            ] {
                assert_fault(streams.as_bytes(), &line);
            }
        }
    }

    #[test]
    fn counts_have_limits() {
        let read = |text: &str, vertices, triangles| {
            let limits = Limits { vertices, triangles, ..Limits::default() };
            read(text.as_bytes(), &Alone, &limits).unwrap_err()
        };
        let text = format!("{CORNERS}f 1 2 3 4\n");
        assert_eq!(read(&text, 3, 9), FileError::Limit("4 lines \"v\", allowed 3".into()));
        assert_eq!(read(&text, 9, 1), FileError::Limit("2 triangles, allowed 1".into()));
        let text = format!("{CORNERS}vt 0 0\nvt 1 0\nf 1/1 2/1 3/1\nf 1/2 2/2 3/2\n");
        assert_eq!(read(&text, 5, 9), FileError::Limit("6 vertices, allowed 5".into()));
    }

    #[test]
    fn reading_stops_when_it_is_asked_to() {
        struct Stopping;
        impl Outside for Stopping {
            fn check(&self) -> Result<(), ptlib_plugin::BlockError> {
                Err(ptlib_plugin::BlockError::cancelled())
            }
            fn read(&self, _: &str) -> Result<Vec<u8>, ptlib_plugin::BlockError> {
                unreachable!("an OBJ file names no files")
            }
        }
        let text = "v 0 0 0\n".repeat(LINES + 1);
        let error = super::read(text.as_bytes(), &Stopping, &Limits::default()).unwrap_err();
        assert!(matches!(error, FileError::Stopped(_)));
    }
}
