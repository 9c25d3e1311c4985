//! Which files a graph may read and write.
//!
//! A graph file is untrusted: whoever opens one must not thereby hand out other files. A block may
//! read regular files below the folder of its graph and below the folders that the caller opened;
//! it may write only below folders that the caller opened for writing. What counts is where a path
//! leads after all symbolic links.

use std::{
    fs::{self, File},
    io::Read,
    path::{Component, Path, PathBuf},
    sync::Arc,
};

use super::picture;
use crate::{
    block::Files,
    error::{Error, ErrorKind},
    limits::Limits,
    value::{BufferPool, Image},
};

/// The files that one graph may read and write.
#[derive(Debug, Clone)]
pub(crate) struct FileAccess {
    /// The folder of the graph's file; paths are relative to it and files below it may be read.
    pub(crate) folder: Option<PathBuf>,
    /// Further folders below which files may be read.
    pub(crate) read_folders: Vec<PathBuf>,
    /// Folders below which files may be written.
    pub(crate) write_folders: Vec<PathBuf>,
    /// How large files and pictures may be.
    pub(crate) limits: Limits,
}

impl FileAccess {
    /// Where a path parameter of a block that writes leads to: below the folders opened for
    /// writing, relative to the first of them.
    ///
    /// # Errors
    /// [`ErrorKind::Denied`] for a path that leads elsewhere; [`ErrorKind::Io`] if its folder does
    /// not exist.
    pub(crate) fn resolve_write(&self, path: &str) -> Result<PathBuf, Error> {
        let Some(first) = self.write_folders.first() else {
            return Err(self.write_denied(path));
        };
        let target = first.join(native(path));
        let (Some(parent), Some(name)) = (target.parent(), target.file_name()) else {
            let message = format!("\"{path}\" names no file");
            return Err(Error::new(ErrorKind::Io, message));
        };
        let parent = fs::canonicalize(parent).map_err(|error| io_error(parent, &error))?;
        if !is_below_any(&parent, self.write_folders.iter()) {
            return Err(self.write_denied(path));
        }
        let target = parent.join(name);
        match fs::symlink_metadata(&target) {
            Ok(found) if !found.is_file() => {
                let message = format!("\"{path}\" is there and is no regular file");
                Err(Error::new(ErrorKind::Denied, message))
            }
            _ => Ok(target),
        }
    }

    /// The picture in the bytes of a file that was read from `path`.
    ///
    /// # Errors
    /// As [`Files::read_image`].
    pub(crate) fn decode(
        &self,
        path: &str,
        bytes: &[u8],
        pool: &Arc<BufferPool>,
    ) -> Result<Image, Error> {
        picture::decode(bytes, &native(path), &self.limits, pool).map_err(|error| {
            let named = Error::new(error.kind(), format!("\"{path}\": {}", error.message()));
            match error.hint() {
                Some(hint) => named.with_hint(hint),
                None => named,
            }
        })
    }

    /// Where a path parameter of a block that reads leads to.
    fn resolve_read(&self, path: &str) -> Result<PathBuf, Error> {
        let mut refusal = None;
        for candidate in self.candidates(path) {
            let Ok(found) = fs::canonicalize(&candidate) else { continue };
            if !is_below_any(&found, self.folder.iter().chain(&self.read_folders)) {
                refusal = refusal.or_else(|| Some(self.read_denied(path)));
            } else if found.is_file() {
                return Ok(found);
            } else {
                refusal = refusal.or_else(|| Some(irregular(path)));
            }
        }
        Err(refusal.unwrap_or_else(|| self.not_found(path)))
    }

    /// The files that a path may mean, the likeliest first: itself, or the file of that name beside
    /// the graph for an absolute path of another computer (specification 2.44).
    fn candidates(&self, path: &str) -> Vec<PathBuf> {
        let folders = self.folder.iter().chain(&self.read_folders);
        let mut candidates: Vec<_> = folders.map(|folder| folder.join(native(path))).collect();
        candidates.dedup();
        if let (Some(folder), true, Some(name)) = (&self.folder, is_absolute(path), file_name(path))
        {
            candidates.push(folder.join(name));
        }
        candidates
    }

    /// Without a folder nothing can be read; a path outside of all gets the same answer whether it
    /// exists or not, so that a graph cannot find out what there is.
    fn not_found(&self, path: &str) -> Error {
        if self.folder.is_none() && self.read_folders.is_empty() || leads_outside(path) {
            return self.read_denied(path);
        }
        let error = Error::new(ErrorKind::Io, format!("there is no file \"{path}\""));
        error.with_hint(format!("looked in {}", list(self.folder.iter().chain(&self.read_folders))))
    }

    fn read_denied(&self, path: &str) -> Error {
        let allowed = list(self.folder.iter().chain(&self.read_folders));
        let message = format!("may not read \"{path}\": files may be read below {allowed}");
        Error::new(ErrorKind::Denied, message).with_hint(
            "open its folder: `read_folders` of the engine's options, or `ptc --allow-read DIR`",
        )
    }

    fn write_denied(&self, path: &str) -> Error {
        let allowed = list(self.write_folders.iter());
        let message = format!("may not write \"{path}\": files may be written below {allowed}");
        Error::new(ErrorKind::Denied, message).with_hint(
            "open its folder: `write_folders` of the engine's options, or `ptc --allow-write DIR`",
        )
    }
}

impl Files for FileAccess {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, Error> {
        read_limited(&self.resolve_read(path)?, self.limits.read_bytes).map(Into::into)
    }

    fn read_image(&self, path: &str, pool: &Arc<BufferPool>) -> Result<Image, Error> {
        self.decode(path, &self.read(path)?, pool)
    }

    fn write(&self, path: &str, bytes: &[u8]) -> Result<(), Error> {
        let path = self.resolve_write(path)?;
        fs::write(&path, bytes).map_err(|error| io_error(&path, &error))
    }
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// [`ErrorKind::Io`]; [`ErrorKind::Limit`].
pub(crate) fn read_limited(path: &Path, limit: u64) -> Result<Vec<u8>, Error> {
    let error = |error: &std::io::Error| io_error(path, error);
    // Opening a pipe waits for its other end, so the kind is asked first; and again of the open
    // file, in case it was exchanged in between.
    let is_regular = |found: &fs::Metadata| found.is_file();
    if !fs::metadata(path).as_ref().map(is_regular).map_err(error)? {
        return Err(irregular(&path.to_string_lossy()));
    }
    let file = File::open(path).map_err(|e| error(&e))?;
    let metadata = file.metadata().map_err(|e| error(&e))?;
    if !is_regular(&metadata) {
        return Err(irregular(&path.to_string_lossy()));
    }
    // The length is a hint only: a file may grow while it is read.
    let mut bytes = Vec::new();
    let expected = usize::try_from(metadata.len().min(limit)).unwrap_or(0);
    bytes.try_reserve(expected).map_err(|_| {
        let message = format!("no memory for the {expected} bytes of {}", path.display());
        Error::new(ErrorKind::NoMemory, message)
    })?;
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(|e| error(&e))?;
    if bytes.len() as u64 > limit {
        let message = format!("{} has more than {limit} bytes, which is the limit", path.display());
        return Err(Error::new(ErrorKind::Limit, message)
            .with_hint("the caller can raise it: `Limits` in `EngineOptions`"));
    }
    Ok(bytes)
}

fn io_error(path: &Path, error: &std::io::Error) -> Error {
    Error::new(ErrorKind::Io, format!("{}: {error}", path.display()))
}

fn irregular(path: &str) -> Error {
    Error::new(ErrorKind::Denied, format!("\"{path}\" is no regular file"))
}

/// Whether a canonical path lies below one of `folders`.
fn is_below_any<'a>(path: &Path, mut folders: impl Iterator<Item = &'a PathBuf>) -> bool {
    folders.any(|folder| {
        // The folder of "graph.xml" is "", which stands for the current one.
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        fs::canonicalize(folder).is_ok_and(|folder| path.starts_with(folder))
    })
}

/// The path with the separators of this system. Files may come from Windows.
fn native(path: &str) -> PathBuf {
    path.replace('\\', "/").into()
}

/// Whether a path starts at a root or a drive, on this or another system.
fn is_absolute(path: &str) -> bool {
    let mut start = path.chars();
    match (start.next(), start.next()) {
        (Some('/' | '\\'), _) => true,
        (Some(drive), Some(':')) => drive.is_ascii_alphabetic(),
        _ => false,
    }
}

/// Whether a path may lead out of the folder that it is relative to.
fn leads_outside(path: &str) -> bool {
    is_absolute(path) || native(path).components().any(|part| part == Component::ParentDir)
}

/// What is behind the last separator of a path of any system.
fn file_name(path: &str) -> Option<&str> {
    let name = path.rsplit(['/', '\\']).next()?;
    (!matches!(name, "" | "." | "..")).then_some(name)
}

fn list<'a>(folders: impl Iterator<Item = &'a PathBuf>) -> String {
    let name = |folder: &'a PathBuf| {
        // The folder of a file that was named without one.
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        format!("\"{}\"", folder.display())
    };
    let mut names: Vec<_> = folders.map(name).collect();
    names.dedup();
    if names.is_empty() { "no folder".to_owned() } else { names.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::tests::Folder;

    #[test]
    fn folders_are_listed_by_name() {
        let listed =
            |folders: &[&str]| list(folders.iter().map(PathBuf::from).collect::<Vec<_>>().iter());
        assert_eq!(listed(&[]), "no folder");
        assert_eq!(listed(&["", "a b"]), "\".\", \"a b\"");
    }

    fn access(folder: &Folder) -> FileAccess {
        FileAccess {
            folder: Some(folder.path("graphs")),
            read_folders: Vec::new(),
            write_folders: Vec::new(),
            limits: Limits::default(),
        }
    }

    /// `graphs/` with a grammar, `outside/` with a secret, `more/` with another grammar.
    fn folder() -> Folder {
        let folder = Folder::new();
        for (name, text) in [
            ("graphs/logo.txt", "logo"),
            ("graphs/deep/er.txt", "deeper"),
            ("outside/secret.txt", "secret"),
            ("more/plant.txt", "plant"),
        ] {
            folder.write(name, text.as_bytes());
        }
        folder
    }

    fn read(access: &FileAccess, path: &str) -> Result<String, ErrorKind> {
        let bytes = access.read(path).map_err(|error| error.kind())?;
        Ok(String::from_utf8(bytes.to_vec()).unwrap())
    }

    #[test]
    fn files_below_the_folder_of_the_graph_are_read() {
        let folder = folder();
        let access = access(&folder);
        assert_eq!(read(&access, "logo.txt").unwrap(), "logo");
        assert_eq!(read(&access, "deep/er.txt").unwrap(), "deeper");
        assert_eq!(read(&access, "deep\\er.txt").unwrap(), "deeper");
        assert_eq!(read(&access, "deep/../logo.txt").unwrap(), "logo");
        assert_eq!(
            read(&access, &folder.path("graphs/logo.txt").display().to_string()).unwrap(),
            "logo"
        );
        assert_eq!(read(&access, "missing.txt"), Err(ErrorKind::Io));
        assert_eq!(read(&access, ""), Err(ErrorKind::Denied));
        assert_eq!(read(&access, "deep"), Err(ErrorKind::Denied));
    }

    #[test]
    fn paths_of_another_computer_mean_the_file_beside_the_graph() {
        let folder = folder();
        let access = access(&folder);
        for path in [
            "C:/Users/somebody/Documents/logo.txt",
            "c:\\Users\\somebody\\logo.txt",
            "/srv/somebody/logo.txt",
            "\\\\server\\share\\logo.txt",
            "C:logo.txt",
        ] {
            let expected = if path.contains(['/', '\\']) {
                Ok("logo".to_owned())
            } else {
                Err(ErrorKind::Denied)
            };
            assert_eq!(read(&access, path), expected, "{path}");
        }
        assert_eq!(read(&access, "elsewhere/logo.txt"), Err(ErrorKind::Io));
    }

    #[test]
    fn nothing_outside_is_read_or_found_out() {
        let folder = folder();
        let access = access(&folder);
        let secret = folder.path("outside/secret.txt").display().to_string();
        let missing = folder.path("outside/missing.txt").display().to_string();
        let denied = |path: &str| access.read(path).unwrap_err();
        for path in ["../outside/secret.txt", "../outside/missing.txt", &secret, &missing, ".."] {
            let error = denied(path);
            assert_eq!(error.kind(), ErrorKind::Denied, "{path}");
            assert!(error.to_string().contains("`ptc --allow-read DIR`"), "{error}");
        }
        let (found, not_found) = (denied(&secret), denied(&missing));
        let shape = |error: &Error, path: &str| error.to_string().replace(path, "?");
        assert_eq!(shape(&found, &secret), shape(&not_found, &missing));
    }

    #[test]
    fn opened_folders_are_read_too() {
        let folder = folder();
        let mut access = access(&folder);
        access.read_folders.push(folder.path("more"));
        assert_eq!(read(&access, "plant.txt").unwrap(), "plant");
        let plant = folder.path("more/plant.txt").display().to_string();
        assert_eq!(read(&access, &plant).unwrap(), "plant");
        access.folder = None;
        assert_eq!(read(&access, "plant.txt").unwrap(), "plant");
        assert_eq!(read(&access, "logo.txt"), Err(ErrorKind::Io));
        access.read_folders.clear();
        assert_eq!(read(&access, "plant.txt"), Err(ErrorKind::Denied));
        assert_eq!(read(&access, &plant), Err(ErrorKind::Denied));
    }

    #[cfg(unix)]
    #[test]
    fn links_and_special_files_do_not_lead_outside() {
        use std::os::unix::{fs::symlink, net::UnixListener};
        let folder = folder();
        let mut access = access(&folder);
        symlink(folder.path("outside/secret.txt"), folder.path("graphs/link.txt")).unwrap();
        symlink(folder.path("outside"), folder.path("graphs/linked")).unwrap();
        symlink(folder.path("graphs/logo.txt"), folder.path("graphs/inside.txt")).unwrap();
        let socket = folder.path("graphs/s");
        let _listener = UnixListener::bind(&socket).unwrap();
        for path in ["link.txt", "linked/secret.txt", "s"] {
            assert_eq!(read(&access, path), Err(ErrorKind::Denied), "{path}");
        }
        assert_eq!(read(&access, "inside.txt").unwrap(), "logo");
        assert_eq!(read_limited(&socket, 9).unwrap_err().kind(), ErrorKind::Denied);
        assert_eq!(read_limited(Path::new("/dev/zero"), 9).unwrap_err().kind(), ErrorKind::Denied);

        access.write_folders.push(folder.path("graphs"));
        for path in ["linked/new.png", "link.txt", "s"] {
            let error = access.resolve_write(path).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Denied, "{path}");
        }
    }

    #[test]
    fn files_have_a_limit() {
        let folder = folder();
        let path = folder.path("graphs/logo.txt");
        assert_eq!(read_limited(&path, 4).unwrap(), b"logo");
        let error = read_limited(&path, 3).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
        let limits = Limits { read_bytes: 3, ..Limits::default() };
        let access = FileAccess { limits, ..access(&folder) };
        assert_eq!(read(&access, "logo.txt"), Err(ErrorKind::Limit));
        assert_eq!(read_limited(&folder.path("none"), 3).unwrap_err().kind(), ErrorKind::Io);
        assert_eq!(read_limited(&folder.path("graphs"), 3).unwrap_err().kind(), ErrorKind::Denied);
    }

    #[test]
    fn nothing_is_written_unless_a_folder_is_open() {
        let folder = folder();
        let mut access = access(&folder);
        let error = access.resolve_write("out.png").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Denied);
        assert!(error.to_string().contains("below no folder"), "{error}");
        assert!(error.to_string().contains("`write_folders`"), "{error}");

        access.write_folders = vec![folder.path("more"), folder.path("graphs")];
        let expected = fs::canonicalize(folder.path("more")).unwrap().join("out.png");
        assert_eq!(access.resolve_write("out.png").unwrap(), expected);
        let absolute = folder.path("graphs/deep/out.png").display().to_string();
        assert!(access.resolve_write(&absolute).unwrap().ends_with("graphs/deep/out.png"));
        let kind = |path: &str| access.resolve_write(path).unwrap_err().kind();
        assert_eq!(kind("../outside/out.png"), ErrorKind::Denied);
        assert_eq!(kind(&folder.path("outside/out.png").display().to_string()), ErrorKind::Denied);
        assert_eq!(kind("new/out.png"), ErrorKind::Io);
        assert_eq!(kind(".."), ErrorKind::Io);
        assert_eq!(kind("../graphs/deep"), ErrorKind::Denied);
    }
}
