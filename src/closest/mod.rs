//! Where two bodies come closest.

pub mod vertex_plane;
