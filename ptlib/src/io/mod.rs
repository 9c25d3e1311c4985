//! Files: graph files, pictures, and the policy that says which files may be touched.

mod picture;
mod policy;
mod value;
mod xml;

pub use picture::{BitDepth, check_picture_name, save_image};
pub(crate) use policy::{FileAccess, read_limited};
pub use value::read_value;
pub(crate) use xml::read_graph;
pub use xml::{Reading, write_graph};

#[cfg(test)]
mod tests {
    use std::{
        env, fs,
        path::PathBuf,
        process,
        sync::atomic::{AtomicU32, Ordering},
    };

    /// A folder of one test, removed at its end.
    pub(super) struct Folder(PathBuf);

    impl Folder {
        pub(super) fn new() -> Self {
            static COUNT: AtomicU32 = AtomicU32::new(0);
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let folder = env::temp_dir().join(format!("ptlib-io-{}-{number}", process::id()));
            fs::create_dir_all(&folder).unwrap();
            Self(folder)
        }

        pub(super) fn path(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }

        pub(super) fn write(&self, name: &str, bytes: &[u8]) {
            fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
            fs::write(self.path(name), bytes).unwrap();
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            fs::remove_dir_all(&self.0).unwrap();
        }
    }
}
