//! Heads: read, given frames and coordinates.
