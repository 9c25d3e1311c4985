//! A plug-in for ptlib: wrinkles, skin and hair of an ageing head.
//!
//! A family is a folder: `wrinkles` draws and ages height maps, `skin` makes normals of them,
//! `region` says where hair grows and until which age, `mesh` reads heads and gives them frames,
//! `hair` grows strands on them, and `view` shows it all.

mod hair;
mod mesh;
mod region;
mod skin;
mod view;
mod wrinkles;

use ptlib_plugin::export_plugin;

pub use view::head_view::HeadView;
pub use wrinkles::age_height::AgeHeight;

export_plugin! {
    id: c"aging",
    name: c"Ageing heads",
    vendor: c"The ptlib project",
    license: c"MIT OR Apache-2.0",
    blocks: [
        AgeHeight,
        HeadView,
    ],
}

#[cfg(test)]
mod testing;
