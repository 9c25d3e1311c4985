//! Inputs of a graph: the caller gives their values.

crate::family!("inputs":
    gradient_input, image_input, mesh_input, points_input, strands_input, text_input,
);
