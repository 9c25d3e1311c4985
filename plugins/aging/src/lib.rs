//! A plug-in for ptlib: wrinkles, skin and hair of an ageing head.
//!
//! A family is a folder: `wrinkles` draws and ages height maps, `skin` makes normals of them,
//! `region` says where hair grows and until which age, `mesh` reads heads and gives them frames,
//! `hair` grows strands on them, and `view` shows it all.

mod hair;
pub mod mesh;
mod region;
mod skin;
mod view;
mod wrinkles;

use ptlib_plugin::export_plugin;

pub use hair::{
    grey_hair::GreyHair, grow_strands::GrowStrands, hair_at_age::HairAtAge,
    save_strands::SaveStrands, scatter_hair::ScatterHair,
};
pub use mesh::{
    load_mesh::LoadMesh, mesh_frames::MeshFrames, mesh_input::MeshInput,
    sphere_coordinates::SphereCoordinates,
};
pub use region::{hair_mask::HairMask, hair_transition::HairTransition};
pub use skin::{
    blend_normals::BlendNormals, fine_wrinkles::FineWrinkles, height_to_normal::HeightToNormal,
};
pub use view::head_view::HeadView;
pub use wrinkles::{age_height::AgeHeight, grammar, wrinkle_map::WrinkleMap};

export_plugin! {
    id: c"aging",
    name: c"Ageing heads",
    vendor: c"The ptlib project",
    license: c"MIT OR Apache-2.0",
    blocks: [
        AgeHeight,
        BlendNormals,
        FineWrinkles,
        GreyHair,
        GrowStrands,
        HairAtAge,
        HairMask,
        HairTransition,
        HeadView,
        HeightToNormal,
        LoadMesh,
        MeshFrames,
        SaveStrands,
        ScatterHair,
        SphereCoordinates,
        WrinkleMap,
    ],
    inputs: [MeshInput],
}

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
