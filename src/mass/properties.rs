//! Mass, centre of mass and inertia of one body.

use crate::error::{Error, Result};
use crate::math::{Matrix3, Quaternion, Vector3, quaternion};
use crate::tolerance;

/// What a body's motion needs to know of its matter: `m`, the centre of mass, and the tensor `I` of
/// lecture (20), (21) about the centre of mass.
///
/// All in the shape's own axes: moving a body in the world changes none of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass, shape axes [m].
    pub center_of_mass: Vector3,
    /// Inertia about the centre of mass, shape axes [kg m²]; its off-diagonal entries carry the
    /// minus of lecture (21): `I₁₂ = −∫ x₁ x₂ dm`.
    pub inertia: Matrix3,
}

impl MassProperties {
    /// Mass properties from given numbers: `mass` [kg], `center_of_mass` [m] and `inertia` about it
    /// [kg m²], shape axes.
    ///
    /// # Errors
    /// Whatever no body can have; see [`MassProperties::validate`]. `place` is named in the message.
    pub fn new(place: &str, mass: f64, center_of_mass: impl Into<Vector3>, inertia: Matrix3) -> Result<Self> {
        let given = Self { mass, center_of_mass: center_of_mass.into(), inertia };
        given.validate(place)?;
        Ok(Self { inertia: 0.5 * (given.inertia + given.inertia.transpose()), ..given })
    }

    /// Mass properties from an inertia about another `point` [m] of the body, such as the origin of
    /// its shape axes: the parallel-axis rule backwards.
    ///
    /// Digits are lost where the point is far away, `m |d|²` being taken off.
    ///
    /// # Errors
    /// As [`MassProperties::new`]; an inertia that was about the centre of mass all along comes out too
    /// small and is often refused for that.
    pub fn from_inertia_about(
        place: &str,
        point: impl Into<Vector3>,
        mass: f64,
        center_of_mass: impl Into<Vector3>,
        inertia: Matrix3,
    ) -> Result<Self> {
        let center_of_mass = center_of_mass.into();
        let central = inertia - point_inertia(mass, &(point.into() - center_of_mass));
        Self::new(place, mass, center_of_mass, central)
    }

    /// A body of diagonal inertia, which is what closed forms give.
    pub(crate) fn diagonal(mass: f64, center_of_mass: Vector3, moments: Vector3) -> Self {
        Self { mass, center_of_mass, inertia: Matrix3::from_diagonal(&moments) }
    }

    /// Refuses what no body can have.
    ///
    /// ```text
    /// m > 0      I = Iᵀ      I₁ > 0      I₃ ≤ I₁ + I₂      for the principal moments I₁ ≤ I₂ ≤ I₃
    /// ```
    ///
    /// The last is the triangle inequality: `I₁ + I₂ − I₃ = 2 ∫ x₃² dm`. Symmetry and triangle are
    /// asked to within [`tolerance::INERTIA`].
    ///
    /// # Errors
    /// Names `place`, the field and the value.
    pub fn validate(&self, place: &str) -> Result<()> {
        if !(self.mass.is_normal() && self.mass > 0.0) {
            return Err(Error::value(place, "mass", "positive and finite", self.mass));
        }
        if !self.center_of_mass.iter().all(|x| x.is_finite()) {
            return Err(Error::value(place, "center_of_mass", "finite", <[f64; 3]>::from(self.center_of_mass)));
        }
        let refuse = |allowed: &str| {
            let rows: [[f64; 3]; 3] = self.inertia.transpose().into();
            Err(Error::value(place, "inertia", allowed, rows))
        };
        if !self.inertia.iter().all(|x| x.is_finite()) {
            return refuse("finite");
        }
        let slack = tolerance::INERTIA * self.inertia.amax();
        if (self.inertia - self.inertia.transpose()).amax() > slack {
            return refuse("symmetric");
        }

        let moments = self.principal_moments();
        if !(moments[0].is_normal() && moments[0] > 0.0) {
            return refuse(&format!("positive definite (its principal moments are {})", listed(&moments)));
        }
        if moments[2] - moments[1] - moments[0] > slack {
            return refuse(&format!(
                "such that no principal moment exceeds the sum of the two others (they are {})",
                listed(&moments)
            ));
        }
        Ok(())
    }

    /// Inertia about another `point` [m] of the shape axes [kg m²]: the parallel-axis rule.
    ///
    /// ```text
    /// I(p) = I + m (|d|² 1 − d dᵀ)      d = p − c
    /// ```
    pub fn about(&self, point: impl Into<Vector3>) -> Matrix3 {
        self.inertia + point_inertia(self.mass, &(point.into() - self.center_of_mass))
    }

    /// The same matter moved by `translation` [m]: only the centre of mass moves.
    #[must_use]
    pub fn moved(&self, translation: impl Into<Vector3>) -> Self {
        Self { center_of_mass: self.center_of_mass + translation.into(), ..*self }
    }

    /// The same matter turned about the origin by `rotation`, of which `q/|q|` is taken:
    /// `c → R c`, `I → R I Rᵀ`.
    #[must_use]
    pub fn turned(&self, rotation: &Quaternion) -> Self {
        let r = quaternion::to_matrix(rotation);
        let inertia = r * self.inertia * r.transpose();
        Self {
            mass: self.mass,
            center_of_mass: r * self.center_of_mass,
            inertia: 0.5 * (inertia + inertia.transpose()),
        }
    }

    /// `I⁻¹` [1/(kg m²)], symmetric to the last bit; of a diagonal tensor exactly the reciprocals.
    ///
    /// By `I = L D Lᵀ`, which needs no pivoting for a positive definite tensor.
    pub fn inv_inertia(&self) -> Matrix3 {
        let i = &self.inertia;
        let d1 = i[(0, 0)];
        let (l21, l31) = (i[(1, 0)] / d1, i[(2, 0)] / d1);
        let d2 = i[(1, 1)] - l21 * i[(1, 0)];
        let b = i[(2, 1)] - l31 * i[(1, 0)];
        let l32 = b / d2;
        let d3 = i[(2, 2)] - l31 * i[(2, 0)] - l32 * b;

        // I⁻¹ = Σ k kᵀ / d over the rows k of L⁻¹
        let rows = [
            (Vector3::new(1.0, 0.0, 0.0), d1),
            (Vector3::new(-l21, 1.0, 0.0), d2),
            (Vector3::new(l21 * l32 - l31, -l32, 1.0), d3),
        ];
        Matrix3::from_fn(|r, c| rows.iter().map(|(k, d)| k[r.min(c)] * k[r.max(c)] / d).sum())
    }
}

/// Inertia of a point mass at the distance `d` [m], `m (|d|² 1 − d dᵀ)` [kg m²].
pub(super) fn point_inertia(mass: f64, d: &Vector3) -> Matrix3 {
    let (xx, yy, zz) = (mass * d.x * d.x, mass * d.y * d.y, mass * d.z * d.z);
    let (xy, xz, yz) = (-mass * d.x * d.y, -mass * d.x * d.z, -mass * d.y * d.z);
    Matrix3::new(yy + zz, xy, xz, xy, xx + zz, yz, xz, yz, xx + yy)
}

/// Three numbers as a phrase.
fn listed(v: &Vector3) -> String {
    format!("{:?}, {:?}, {:?}", v[0], v[1], v[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(mass: f64, inertia: [[f64; 3]; 3]) -> String {
        MassProperties::new("body die", mass, [0.0; 3], Matrix3::from(inertia).transpose()).unwrap_err().to_string()
    }

    const GOOD: [[f64; 3]; 3] = [[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.3, 4.0]];

    #[test]
    fn given_numbers_that_no_body_has_are_refused() {
        MassProperties::new("body die", 1.0, [0.0; 3], Matrix3::from(GOOD)).unwrap();
        for (mass, shown) in [(0.0, "0.0"), (-1.0, "-1.0"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
            assert_eq!(refusal(mass, GOOD), format!("body die: mass must be positive and finite, got {shown}"));
        }
        assert_eq!(
            refusal(1.0, [[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.4, 4.0]]),
            "body die: inertia must be symmetric, got [[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.4, 4.0]]"
        );
        assert_eq!(
            refusal(1.0, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]),
            "body die: inertia must be positive definite (its principal moments are 0.0, 1.0, 1.0), \
             got [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]"
        );
        assert_eq!(
            refusal(1.0, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.5]]),
            "body die: inertia must be such that no principal moment exceeds the sum of the two others \
             (they are 1.0, 1.0, 2.5), got [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.5]]"
        );
        let mut infinite = GOOD;
        infinite[2][0] = f64::NAN;
        assert!(refusal(1.0, infinite).starts_with("body die: inertia must be finite, got [["));
        let adrift = MassProperties::new("body die", 1.0, [0.0, f64::INFINITY, 0.0], Matrix3::from(GOOD));
        assert_eq!(adrift.unwrap_err().to_string(), "body die: center_of_mass must be finite, got [0.0, inf, 0.0]");
    }

    #[test]
    fn what_rounding_leaves_is_accepted() {
        // a lamina: the largest moment is the sum of the others, and rounding may put it above
        let lamina = Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.1 + 0.2));
        MassProperties::new("plate", 1.0, [0.0; 3], lamina).unwrap();
        // half a symmetric pair's difference goes to each
        let mut printed = Matrix3::from(GOOD);
        printed[(0, 1)] += 1e-10;
        let read = MassProperties::new("die", 1.0, [0.0; 3], printed).unwrap();
        assert_eq!(read.inertia, read.inertia.transpose());
        assert!((read.inertia[(0, 1)] - 0.1 - 0.5e-10).abs() < 1e-16);
    }

    #[test]
    fn the_inverse_is_symmetric_and_of_a_diagonal_the_reciprocals() {
        let diagonal = MassProperties::diagonal(1.0, Vector3::zeros(), Vector3::new(3.0, 7.0, 1e-9));
        let reciprocals = Vector3::new(1.0 / 3.0, 1.0 / 7.0, 1.0 / 1e-9);
        assert_eq!(diagonal.inv_inertia(), Matrix3::from_diagonal(&reciprocals));

        let full = MassProperties { inertia: Matrix3::from(GOOD), ..diagonal };
        let inverse = full.inv_inertia();
        assert_eq!(inverse, inverse.transpose());
        // condition number 2.4
        assert!((inverse * full.inertia - Matrix3::identity()).amax() < 4.0 * f64::EPSILON);
    }
}
