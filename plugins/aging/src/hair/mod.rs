//! Hair: roots, their ages and colours, strands and their files.

pub mod grey_hair;
pub mod grow_strands;
pub mod hair_at_age;
pub mod save_strands;
pub mod scatter_hair;

mod files;
mod random;
mod scatter;
mod vector;

#[cfg(test)]
mod testing;
