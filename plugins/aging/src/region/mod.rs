//! Where hair grows, and until which age.
