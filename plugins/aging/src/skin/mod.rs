//! Normals of height maps, and fine detail.
