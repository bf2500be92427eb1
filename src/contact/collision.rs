//! The impact of a cluster: every touching contact answered at once.
//!
//! [`collide`] takes the bodies and contacts of a [cluster](super::cluster) at the instant of impact and
//! gives the impulses and the velocities after. What it promises:
//!
//! | promise | how far |
//! |---|---|
//! | momentum and angular momentum | to rounding: both bodies take one impulse at one point |
//! | no approach is left | to 1e-11 of the largest velocity, else [`ClusterError::Squeezed`] |
//! | energy never rises | to rounding; without friction and with e = 1 it stays |
//! | the cone of friction | holds for the **total** impulse, restitution included |
//! | symmetry | what is symmetric stays so; redundant contacts share by the shortest impulses |
//!
//! Contacts that separate, or rest while others are hit, may be in the list: they take an impulse only if
//! the impact reaches them.
//!
//! Without friction see `contact::reflection`, with friction `contact::friction`. The laws of restitution
//! agree for one contact without friction, and without friction the reflections answer for all three.
//!
//! # Contacts without a single normal
//! Where normals span a cone (vertex on vertex, parallel edges), the plastic impulse without friction is
//! found with every normal of the cone pushing on its own; its direction is the normal of that contact from
//! there on. A blow along the cone's axis is answered along the axis.

use super::cluster::{ClusterBody, ClusterError, Contact, Frame, Velocity, check, relative, velocities_after};
use super::friction::Rubbing;
use super::problem::{Scaled, choose_normals, noise_of};
use super::reflection::reflect;
use crate::math::Vector3;

/// What restitution means where friction couples the normal and the tangent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Law {
    /// The normal velocity comes back: `u_n⁺ = −e u_n⁻` (Newton 1687).
    Newton,
    /// The impulse of compression comes back: `p = (1 + e) p_c` (Poisson 1817).
    #[default]
    Poisson,
    /// The work of compression comes back: `W_r = −e² W_c` (Stronge 1990).
    Stronge,
}

impl Law {
    /// Every law.
    pub const ALL: &'static [Self] = &[Self::Newton, Self::Poisson, Self::Stronge];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Newton => "newton",
            Self::Poisson => "poisson",
            Self::Stronge => "stronge",
        }
    }
}

/// An impact that has been answered.
#[derive(Debug, Clone, PartialEq)]
pub struct Collision {
    /// Velocities after, in the order of the bodies.
    pub velocities: Vec<Velocity>,
    /// Impulse on b of each contact, friction included, world axes [N·s].
    pub impulses: Vec<Vector3>,
    /// The normal that each contact was answered along.
    pub normals: Vec<Vector3>,
    /// Kinetic energy before of the bodies that impulses move [J].
    pub energy_before: f64,
    /// The same after [J].
    pub energy_after: f64,
    /// Energy lost in the contacts [J]: `energy_before + work − energy_after`.
    pub energy_lost: f64,
    /// Work done by driven bodies on the others [J].
    pub work: f64,
    /// How far the impulses are from solving the contact laws, relative to the largest relative velocity [-].
    pub residual: f64,
    /// Rounds of reflections.
    pub rounds: u32,
    /// The part of the restitution that could be used without making energy [-]; 1 but for some impacts
    /// with friction.
    pub restitution_kept: f64,
}

/// How fast a contact may still approach, as a fraction of the largest relative velocity [-], before the
/// cluster counts as squeezed. Solvers end at 1e-11 or, where nothing helps, orders of magnitude above.
const SQUEEZED: f64 = 1.0e-9;

/// Answers the impact of a cluster; see the [module](self).
///
/// # Errors
/// Numbers that no contact has; a body squeezed between driven or fixed ones.
pub fn collide(bodies: &[ClusterBody], contacts: &[Contact], law: Law) -> Result<Collision, ClusterError> {
    check(bodies, contacts)?;
    let before: Vec<Velocity> = bodies.iter().map(ClusterBody::velocity).collect();
    let moved = |c: &Contact| !(bodies[c.a].mobility.is_none() && bodies[c.b].mobility.is_none());
    let active: Vec<usize> = (0..contacts.len()).filter(|&i| moved(&contacts[i])).collect();
    let speeds: Vec<Vector3> = contacts.iter().map(|c| relative(bodies, c, &before)).collect();
    let normals = choose_normals(bodies, contacts, &active, &speeds);

    // impulses of the contacts that anything can move
    let rows_per_contact = if active.iter().all(|&i| contacts[i].friction == 0.0) { 1 } else { 3 };
    let scaled = Scaled::new(bodies, contacts, &active, &normals, &speeds, rows_per_contact);
    let restitution: Vec<f64> = active.iter().map(|&i| contacts[i].restitution).collect();
    let friction: Vec<f64> = active.iter().map(|&i| contacts[i].friction).collect();
    let mut impulses = vec![Vector3::zeros(); contacts.len()];
    let (residual, rounds, restitution_kept) = if rows_per_contact == 1 {
        let answer = reflect(&scaled.w, &scaled.q, &restitution, &scaled.noise);
        for (k, &i) in active.iter().enumerate() {
            impulses[i] = scaled.size[k] * answer.impulse[k] * normals[i];
        }
        (answer.residual, answer.rounds, 1.0)
    } else {
        let problem = Rubbing { w: &scaled.w, q: &scaled.q, friction: &friction, noise: &scaled.noise, law };
        let answer = problem.answer(&restitution);
        for (k, &i) in active.iter().enumerate() {
            let p = [0, 1, 2].map(|c| scaled.size[k] * answer.impulse[3 * k + c]);
            impulses[i] = Frame::new(&normals[i]).vector(p);
        }
        (answer.residual, answer.rounds, answer.kept)
    };

    // velocities, energies, and what is left of the approach
    let velocities = velocities_after(bodies, contacts, &impulses);
    let scale = speeds.iter().map(Vector3::norm).fold(0.0, f64::max);
    let mut energy_lost = 0.0;
    for &i in &active {
        let after = relative(bodies, &contacts[i], &velocities);
        energy_lost -= 0.5 * impulses[i].dot(&(speeds[i] + after));
        let approach = -normals[i].dot(&after);
        if approach > SQUEEZED * scale + noise_of(bodies, &contacts[i]) {
            return Err(ClusterError::Squeezed { contact: i, approach });
        }
    }
    let energy = |velocities: &[Velocity]| -> f64 {
        let of = |(b, v): (&ClusterBody, &Velocity)| {
            if b.mobility.is_none() { 0.0 } else { b.moving(v).kinetic_energy() }
        };
        bodies.iter().zip(velocities).map(of).sum()
    };
    let (energy_before, energy_after) = (energy(&before), energy(&velocities));
    let work = work_of_driven(bodies, contacts, &impulses, &before);
    Ok(Collision {
        velocities,
        impulses,
        normals,
        energy_before,
        energy_after,
        energy_lost,
        work,
        residual,
        rounds,
        restitution_kept,
    })
}

/// Work that bodies without mobility do through the impulses [J].
fn work_of_driven(bodies: &[ClusterBody], contacts: &[Contact], impulses: &[Vector3], before: &[Velocity]) -> f64 {
    let mut work = 0.0;
    for (contact, impulse) in contacts.iter().zip(impulses) {
        for (k, sign) in [(contact.a, 1.0), (contact.b, -1.0)] {
            if bodies[k].mobility.is_none() {
                work += sign * impulse.dot(&before[k].at(&bodies[k].lever(&contact.point)));
            }
        }
    }
    work
}
