//! The pictures of this plug-in: what they are, to the bit, and what they have to show.

#[path = "../../examples/pictures/sheets.rs"]
mod sheets;

mod golden;
mod properties;
