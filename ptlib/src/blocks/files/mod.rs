//! Blocks that read and write files.

crate::family!("files": load_file, save_file);
