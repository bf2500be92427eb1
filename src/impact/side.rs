//! One body of a pair: where it is, how far it reaches, and what its turning does to a bound.

use super::motion::{Instant, MotionBounds, Moving};
use super::swept::Swept;
use crate::closest::{Feature, Piece};
use crate::math::{Matrix3, Vector3, quaternion};

/// A convex body and its motion.
pub(super) struct Side<'a> {
    pub(super) piece: Piece<'a>,
    pub(super) motion: &'a dyn Moving,
    /// From the moving point to the piece's centre, shape axes [m].
    offset: Vector3,
    /// Largest distance of the core from the moving point [m].
    pub(super) radius: f64,
    /// Whether it is a half space: all of it on one side of a plane.
    pub(super) is_plane: bool,
    /// Where the last climb ended.
    vertex: u32,
    /// Its corners from the moving point, shape axes [m]; none of a curved body, or before they are asked for.
    pub(super) corners: Option<Vec<Vector3>>,
    /// What a steady spin sweeps.
    swept: Option<Swept>,
}

/// A body at an instant.
pub(super) struct Placed {
    pub(super) instant: Instant,
    pub(super) rotation: Matrix3,
}

impl<'a> Side<'a> {
    pub(super) fn new(piece: Piece<'a>, motion: &'a dyn Moving) -> Self {
        let offset = piece.center - motion.center();
        let is_plane = piece.plane().is_some();
        let radius = if is_plane { 0.0 } else { offset.norm() + piece.reach - piece.rounding() };
        Self { piece, motion, offset, radius, is_plane, vertex: 0, corners: None, swept: None }
    }

    pub(super) fn at(&self, t: f64) -> Placed {
        let instant = self.motion.at(t);
        Placed { rotation: quaternion::to_matrix(&instant.pose.orientation), instant }
    }

    /// The support `max d·(a − c)` of the core, from the moving point; of a half space its plane's.
    pub(super) fn height(&mut self, placed: &Placed, d: &Vector3) -> f64 {
        let d = placed.rotation.tr_mul(d);
        let about_center = if self.is_plane { 0.0 } else { self.piece.height(&d, &mut self.vertex) };
        d.dot(&self.offset) + about_center
    }

    /// Works out the corners; whether there are any.
    pub(super) fn has_corners(&mut self) -> bool {
        if self.corners.is_none() {
            let mut corners = self.piece.corners();
            corners.iter_mut().flatten().for_each(|v| *v += self.offset);
            self.corners = corners;
        }
        self.corners.is_some()
    }

    /// What the spin at this instant sweeps; none of a curved body.
    pub(super) fn swept(&mut self, placed: &Placed) -> Option<&Swept> {
        let spin = placed.instant.angular_velocity;
        if self.swept.as_ref().is_none_or(|swept| swept.spin != spin && swept.spin != -spin) && self.has_corners() {
            self.swept = self.corners.as_ref().map(|corners| Swept::new(corners, placed));
        }
        self.swept.as_ref()
    }

    /// A point as good as farthest along `d`, from the moving point [m]: of half of what is swept, or of the body
    /// itself.
    pub(super) fn farthest(&self, placed: &Placed, half: Option<usize>, d: &Vector3) -> Vector3 {
        if let (Some(half), Some(swept)) = (half, &self.swept) {
            return swept.farthest(half, d);
        }
        let d = placed.rotation.tr_mul(d);
        let mut top = (f64::NEG_INFINITY, Vector3::zeros());
        for v in self.corners.iter().flatten() {
            let height = d.dot(v);
            if height > top.0 {
                top = (height, *v);
            }
        }
        placed.rotation * top.1
    }

    /// The support of the same along `d`, from the moving point [m].
    pub(super) fn height_of(&mut self, placed: &Placed, half: Option<usize>, d: &Vector3) -> f64 {
        match (half, &self.swept) {
            (Some(half), Some(swept)) => swept.height_of(half, d),
            _ => self.height(placed, d),
        }
    }

    /// Direction of the straight line that the body has where a feature faces along `outward`, world axes.
    pub(super) fn line(&self, placed: &Placed, feature: Feature, outward: &Vector3) -> Option<Vector3> {
        let line = self.piece.line(feature, &placed.rotation.tr_mul(outward))?;
        Some(placed.rotation * line)
    }

    /// Direction of an edge, world axes.
    pub(super) fn edge(&self, placed: &Placed, edge: u32) -> Vector3 {
        self.piece.edge(edge).map_or_else(Vector3::zeros, |e| placed.rotation * e)
    }
}

/// A body's part of the bound: its support is at most the chord from `start` to `end` plus `½ bend τ²`.
pub(super) struct Part {
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) bend: f64,
}

impl Side<'_> {
    /// The part along `d` = ±n, which turns with Ω, over `h` [s].
    #[expect(clippy::too_many_arguments, reason = "the symbols of one formula")]
    pub(super) fn part(
        &mut self,
        placed: &Placed,
        bounds: &MotionBounds,
        d: &Vector3,
        height: f64,
        turning: &Vector3,
        resting: bool,
        h: f64,
    ) -> Part {
        let w = &placed.instant.angular_velocity;
        let r = self.radius;

        // in axes that turn with Ω: a′ = ρ × a and a″ = ρ × (ρ × a) + ρ′ × a with ρ = ω − Ω
        if self.is_plane && bounds.angular_acceleration > 0.0 {
            return Part { start: height, end: f64::INFINITY, bend: 0.0 }; // a plane without end: nothing is proved
        }
        let relative = w - turning;
        let across = relative.cross(d).norm();
        let change = bounds.angular_acceleration * (1.0 + turning.norm() * h) + turning.cross(w).norm();
        let drift = change * h;
        let bend = r * ((across + drift) * (relative.norm() + drift) + change);

        // without Ω: the plain bound, or all that is swept
        let mut plain = f64::INFINITY;
        if resting && !self.is_plane {
            let fastest = (across + bounds.angular_acceleration * h).min(bounds.angular_speed);
            plain = height + h * fastest * r;
            let is_steady = bounds.angular_acceleration == 0.0 && h * bounds.angular_speed >= SWEEPS;
            let all = if is_steady { self.swept(placed).map_or(r, |swept| swept.height(d)) } else { r };
            if all <= plain && all <= height + 0.5 * bend * h * h {
                return Part { start: all, end: all, bend: 0.0 };
            }
        }
        let end = if across == 0.0 { height } else { self.height(placed, &(d + h * d.cross(&relative))) };
        if plain < end + 0.5 * bend * h * h {
            return Part { start: height, end: plain, bend: 0.0 };
        }
        Part { start: height, end, bend }
    }
}

/// Angle from which on a spin is taken for all that it sweeps [rad].
pub(super) const SWEEPS: f64 = 1.0;
