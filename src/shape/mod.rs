//! Shapes.

pub mod convex_polygon;
pub mod convex_polyhedron;
pub mod hull;
