//! Hair: roots, their ages and colours, strands and their files.
