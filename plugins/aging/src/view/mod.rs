//! The picture of a head.
