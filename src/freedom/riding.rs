//! A body that has become part of another: it has no numbers of its own.
//!
//! ```text
//! x = X + R p        q = Q q_p        v = V + Ω × R p        ω = Ω
//! F → F        M → M + R p × F                            its loads are those of the compound
//! ```
//!
//! The compound is the first body of its group, and moves freely.

use super::Chart;
use crate::math::{Pose, quaternion};
use crate::state::{BodyMotion, Load};

/// Where a part stands in its compound.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Riding {
    /// Its centre of mass and axes, in the axes of the compound, from the compound's centre of mass.
    pub pose: Pose,
}

impl Riding {
    /// The part's own motion while the compound moves with `whole`; mass and inertia are those of `own`.
    pub fn motion(&self, whole: &BodyMotion, own: &BodyMotion) -> BodyMotion {
        let lever = whole.rotation * self.pose.position;
        let orientation = quaternion::normalized(&(whole.orientation * self.pose.orientation));
        BodyMotion {
            mass: own.mass,
            inertia_body: own.inertia_body,
            position: whole.position + lever,
            orientation,
            rotation: quaternion::to_matrix(&orientation),
            velocity: whole.velocity + whole.angular_velocity.cross(&lever),
            angular_velocity: whole.angular_velocity,
        }
    }
}

/// Lets the parts of a group follow their compound.
#[inline(always)]
pub(crate) fn follow(charts: &[Chart], motions: &mut [BodyMotion]) {
    let Some((whole, parts)) = motions.split_first_mut() else { return };
    for (chart, part) in charts.iter().skip(1).zip(parts) {
        if let Chart::Riding(riding) = chart {
            *part = riding.motion(whole, part);
        }
    }
}

/// Moves the loads on the parts of a group to their compound.
pub(crate) fn gather(charts: &[Chart], motions: &[BodyMotion], loads: &mut [Load]) {
    let (Some(whole), Some((total, parts))) = (motions.first(), loads.split_first_mut()) else { return };
    for ((chart, motion), load) in charts.iter().zip(motions).skip(1).zip(parts) {
        if let Chart::Riding(_) = chart {
            let load = std::mem::replace(load, Load::zero());
            total.torque += load.torque;
            total.add_force_at(&load.force, &motion.position, whole);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Matrix3, Vector3};

    #[test]
    fn loads_on_parts_do_the_work_on_the_compound_that_they_do_on_the_parts() {
        // power F·v + M·ω, whatever the motion
        let mut whole = BodyMotion::at_rest(3.0, Matrix3::identity());
        whole.position = Vector3::new(1.0, -2.0, 0.5);
        whole.velocity = Vector3::new(0.3, 0.7, -0.2);
        whole.angular_velocity = Vector3::new(-1.0, 0.4, 2.0);
        whole.orientation = quaternion::exp(&Vector3::new(0.3, -0.2, 0.9));
        whole.rotation = quaternion::to_matrix(&whole.orientation);
        let own = BodyMotion::at_rest(1.0, 0.1 * Matrix3::identity());
        let pose = Pose::new([0.2, -0.1, 0.4], [0.5, 0.5, -0.5, 0.5]);
        let charts = [Chart::Fixed, Chart::Riding(Riding { pose })];
        let mut motions = [whole, own];
        follow(&charts, &mut motions);
        assert_eq!(motions[1].mass, 1.0);
        let load = Load { force: Vector3::new(2.0, 1.0, -3.0), torque: Vector3::new(0.1, 0.2, 0.3) };
        let mut loads = [Load::zero(), load];
        gather(&charts, &motions, &mut loads);
        assert_eq!(loads[1], Load::zero());
        // a dozen operations on numbers of size 5
        assert!((loads[0].power(&whole) - load.power(&motions[1])).abs() < 64.0 * f64::EPSILON * 5.0);
    }
}
