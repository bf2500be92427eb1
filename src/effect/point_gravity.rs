//! Attraction by a point.

use super::series::{Place, SeriesBody, SeriesLoad, add};
use super::{BodyMotion, Effect, Load, Moment, Target, finite, not_negative};
use crate::error::Result;
use crate::math::series::Tape;
use crate::math::{Matrix3, Vector3};

/// Attraction by a point, with the torque of its gradient on an extended body.
///
/// ```text
/// r = x − c,  ρ = |r|,  J = R I Rᵀ,  s = r·J r
/// U = −μ m/ρ − ½ μ (tr J/ρ³ − 3 s/ρ⁵)                      MacCullagh's formula
/// F = −μ m r/ρ³ + ½ μ (15 s r/ρ⁷ − 3 tr J r/ρ⁵ − 6 J r/ρ⁵)
/// M = 3 μ (r × J r)/ρ⁵
/// ```
///
/// The series of the potential ends after its second term, whose torque is the gravity gradient;
/// its small force belongs to it, so that energy and angular momentum about the centre stay.
/// The next term is smaller by size/ρ. Nothing is right inside the attracting body.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PointGravity {
    /// Gravitational parameter μ = G M [m³/s²].
    pub mu: f64,
    /// The attracting point c, world axes [m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub center: [f64; 3],
    /// Whether the second term, with the gradient's torque, is kept.
    #[cfg_attr(feature = "serde", serde(default = "kept"))]
    pub gradient_torque: bool,
    /// The bodies it acts on; all if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub bodies: Option<Vec<String>>,
}

#[cfg(feature = "serde")]
fn kept() -> bool {
    true
}

impl PointGravity {
    /// Attraction by a point at `center` [m] with the parameter `mu` [m³/s²] on all bodies, gradient kept.
    pub fn new(mu: f64, center: impl Into<[f64; 3]>) -> Self {
        Self { mu, center: center.into(), gradient_torque: true, bodies: None }
    }

    /// With the gradient's torque, or without.
    #[must_use]
    pub fn gradient_torque(mut self, kept: bool) -> Self {
        self.gradient_torque = kept;
        self
    }

    /// The same on the named bodies only.
    #[must_use]
    pub fn on<S: Into<String>>(mut self, bodies: impl IntoIterator<Item = S>) -> Self {
        self.bodies = Some(bodies.into_iter().map(Into::into).collect());
        self
    }
}

impl Effect for PointGravity {
    fn validate(&self, place: &str) -> Result<()> {
        not_negative(place, "mu", self.mu)?;
        finite(place, "center", self.center).map(drop)
    }

    fn target(&self) -> Target {
        Target::each(self.bodies.as_ref())
    }

    fn idle(&self) -> Option<&'static str> {
        (self.mu == 0.0).then_some("mu is 0")
    }

    fn conservative(&self) -> bool {
        true
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_series(&self) -> bool {
        true
    }

    fn add_series(&self, _at: Moment, body: &mut SeriesBody, load: &mut SeriesLoad, tape: &mut Tape) {
        let center = Vector3::from(self.center);
        if let (Place::Moving(position, _), false) = (body.place, self.gradient_torque) {
            let center = tape.constant(center);
            let r = tape.sum(position, -1.0, center);
            let rho2 = tape.dot(r, r);
            let k = tape.power(rho2, -1.5);
            let force = tape.product(k, r);
            let force = tape.scaled(-self.mu * body.mass, force);
            return add(tape, &mut load.force, force);
        }

        // in own axes the inertia stays: J r = I r
        let r = body.offset_own(tape, &center);
        let rho2 = tape.dot(r, r);
        let k = tape.power(rho2, -1.5);
        let force = tape.product(k, r);
        let force = tape.scaled(-self.mu * body.mass, force);
        add(tape, &mut load.force_own, force);
        if self.gradient_torque {
            let jr = tape.linear(r, body.inertia);
            let s = tape.dot(r, jr);
            let [k5, k7] = [-2.5, -3.5].map(|power| tape.power(rho2, power));
            let [squeeze, pull] = [tape.product(k7, s), tape.product(k5, jr)];
            let squeeze = tape.sum(squeeze, -0.2 * body.inertia.trace(), k5);
            let squeeze = tape.product(squeeze, r);
            let squeeze = tape.scaled(7.5 * self.mu, squeeze);
            let force = tape.sum(squeeze, -3.0 * self.mu, pull);
            add(tape, &mut load.force_own, force);
            let torque = tape.cross(r, pull);
            let torque = tape.scaled(3.0 * self.mu, torque);
            add(tape, &mut load.torque_own, torque);
        }
    }

    fn add_to_one(&self, _at: Moment, body: &BodyMotion, load: &mut Load) {
        let r = body.position - Vector3::from(self.center);
        let rho2 = r.norm_squared();
        let k = self.mu / (rho2 * rho2.sqrt());
        load.force -= k * body.mass * r;
        if self.gradient_torque {
            let (j, jr, s) = second_moment(body, &r);
            let k5 = k / rho2;
            load.force += 0.5 * k5 * ((15.0 * s / rho2 - 3.0 * j.trace()) * r - 6.0 * jr);
            load.torque += 3.0 * k5 * r.cross(&jr);
        }
    }

    fn potential_energy(&self, _at: Moment, bodies: &[BodyMotion]) -> f64 {
        let energy = |body: &BodyMotion| {
            let r = body.position - Vector3::from(self.center);
            let rho2 = r.norm_squared();
            let k = self.mu / (rho2 * rho2.sqrt());
            let mut u = -k * body.mass * rho2;
            if self.gradient_torque {
                let (j, _, s) = second_moment(body, &r);
                u -= 0.5 * k * (j.trace() - 3.0 * s / rho2);
            }
            u
        };
        bodies.iter().map(energy).sum()
    }
}

/// World inertia J, `J r`, and `r·J r`.
fn second_moment(body: &BodyMotion, r: &Vector3) -> (Matrix3, Vector3, f64) {
    let j = body.rotation * body.inertia_body * body.rotation.transpose();
    let jr = j * r;
    (j, jr, r.dot(&jr))
}
