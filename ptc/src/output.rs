//! Pictures on disk.

use std::{fs, path::Path};

use ptlib::{
    Error, ErrorKind, Image,
    io::{BitDepth, check_picture_name, save_image},
};

use crate::exit::Fault;

/// Refuses a name that tells no format, before anything is computed.
pub(crate) fn check_name(path: &Path) -> Result<(), Fault> {
    check_picture_name(path)
        .map_err(|error| Fault::usage(error.message(), error.hint().unwrap_or("end it in .png")))
}

/// Saves a picture, making its folder where it is missing. The file appears complete or not at
/// all, see [`save_image`].
pub(crate) fn save(image: &Image, path: &Path, depth: BitDepth) -> Result<(), Error> {
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|error| {
            let message = format!("cannot make the folder {}: {error}", folder.display());
            Error::new(ErrorKind::Io, message)
        })?;
    }
    save_image(image, path, depth)
}
