//! A damped spring.

use super::{BodyMotion, Effect, Load, Moment, Target, finite, not_negative};
use crate::error::{Error, Result};
use crate::math::Vector3;

/// A damped spring between points of two bodies, or of a body and the world.
///
/// ```text
/// d = p_b − p_a,  ℓ = |d|,  n = d/ℓ,  u = n·(v_b − v_a)
/// F_a = (stiffness (ℓ − rest_length) + damping u) n        F_b = −F_a
/// U = ½ stiffness (ℓ − rest_length)²        dissipated power = damping u²
/// ```
///
/// With `rest_length = 0` the force is linear in `d` and has no corner at ℓ = 0; otherwise it has no
/// direction there, and is taken as 0.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Spring {
    /// The first body.
    pub a: String,
    /// The second body; the world if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub b: Option<String>,
    /// Where it holds on to `a`, body axes from the centre of mass [m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub anchor_a: [f64; 3],
    /// Where it holds on to `b`, its body axes from its centre of mass, or world axes [m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub anchor_b: [f64; 3],
    /// Force per length [N/m].
    pub stiffness: f64,
    /// Force per speed [N·s/m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub damping: f64,
    /// Length without force [m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub rest_length: f64,
}

impl Spring {
    /// A spring from the centre of mass of `a` to that of `b`, of this stiffness [N/m].
    pub fn between(a: impl Into<String>, b: impl Into<String>, stiffness: f64) -> Self {
        Self { b: Some(b.into()), ..Self::to_world(a, [0.0; 3], stiffness) }
    }

    /// A spring from the centre of mass of `a` to a point of the world [m], of this stiffness [N/m].
    pub fn to_world(a: impl Into<String>, point: impl Into<[f64; 3]>, stiffness: f64) -> Self {
        Self {
            a: a.into(),
            b: None,
            anchor_a: [0.0; 3],
            anchor_b: point.into(),
            stiffness,
            damping: 0.0,
            rest_length: 0.0,
        }
    }

    /// Where it holds on to both ends [m].
    #[must_use]
    pub fn anchors(mut self, anchor_a: impl Into<[f64; 3]>, anchor_b: impl Into<[f64; 3]>) -> Self {
        self.anchor_a = anchor_a.into();
        self.anchor_b = anchor_b.into();
        self
    }

    /// Force per speed [N·s/m].
    #[must_use]
    pub fn damping(mut self, damping: f64) -> Self {
        self.damping = damping;
        self
    }

    /// Length without force [m].
    #[must_use]
    pub fn rest_length(mut self, rest_length: f64) -> Self {
        self.rest_length = rest_length;
        self
    }

    /// Both ends in the world, the vector d between them and the relative velocity.
    fn ends(&self, bodies: &[BodyMotion]) -> (Vector3, Vector3, Vector3, Vector3) {
        let pa = bodies[0].point(&self.anchor_a.into());
        let va = bodies[0].velocity_at(&pa);
        let (pb, vb) = match bodies.get(1) {
            Some(b) => {
                let pb = b.point(&self.anchor_b.into());
                (pb, b.velocity_at(&pb))
            }
            None => (self.anchor_b.into(), Vector3::zeros()),
        };
        (pa, pb, pb - pa, vb - va)
    }
}

impl Effect for Spring {
    fn validate(&self, place: &str) -> Result<()> {
        finite(place, "anchor_a", self.anchor_a)?;
        finite(place, "anchor_b", self.anchor_b)?;
        not_negative(place, "stiffness", self.stiffness)?;
        not_negative(place, "damping", self.damping)?;
        not_negative(place, "rest_length", self.rest_length)?;
        if self.b.as_ref() == Some(&self.a) {
            return Err(Error::value(place, "b", "another body than a", &self.a));
        }
        Ok(())
    }

    fn target(&self) -> Target {
        Target::Together(std::iter::once(&self.a).chain(&self.b).cloned().collect())
    }

    fn idle(&self) -> Option<&'static str> {
        (self.stiffness == 0.0 && self.damping == 0.0).then_some("its stiffness and damping are 0")
    }

    fn conservative(&self) -> bool {
        self.damping == 0.0
    }

    fn add_to(&self, _at: Moment, bodies: &[BodyMotion], loads: &mut [Load]) {
        let (pa, pb, d, u) = self.ends(bodies);
        let length = d.norm();
        let force = if length > 0.0 {
            let n = d / length;
            self.stiffness * (d - self.rest_length * n) + self.damping * n.dot(&u) * n
        } else {
            Vector3::zeros()
        };
        loads[0].add_force_at(&force, &pa, &bodies[0]);
        if let Some(b) = bodies.get(1) {
            loads[1].add_force_at(&-force, &pb, b);
        }
    }

    fn potential_energy(&self, _at: Moment, bodies: &[BodyMotion]) -> f64 {
        let stretch = self.ends(bodies).2.norm() - self.rest_length;
        0.5 * self.stiffness * stretch * stretch
    }

    fn dissipated_power(&self, _at: Moment, bodies: &[BodyMotion]) -> f64 {
        let (_, _, d, u) = self.ends(bodies);
        let length = d.norm();
        if length > 0.0 { self.damping * (d.dot(&u) / length) * (d.dot(&u) / length) } else { 0.0 }
    }
}
