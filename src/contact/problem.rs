//! The contact problem as solvers see it: rows, scaled, with one normal for each contact.

use super::cluster::{ClusterBody, Contact, Frame, Row, matrix};
use super::solver::active_set;
use super::solver::dense::{Dense, Vector, largest};
use crate::math::Vector3;
use smallvec::SmallVec;

/// What rounding leaves of a relative velocity, as a fraction of the velocities it is the difference of [-].
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// What rounding may leave of the relative velocity at a contact [m/s].
pub(super) fn noise_of(bodies: &[ClusterBody], contact: &Contact) -> f64 {
    let size = |k: usize| {
        let motion = &bodies[k].motion;
        motion.velocity.norm() + motion.angular_velocity.norm() * bodies[k].lever(&contact.point).norm()
    };
    ROUNDING * (size(contact.a) + size(contact.b))
}

/// One entry a contact, on the stack up to four.
pub(super) type PerContact<T> = SmallVec<[T; 4]>;

/// The contact problem with each contact scaled to a diagonal near 1: `p = s p′, u′ = s u, W′ = s W s`.
pub(super) struct Scaled {
    pub(super) w: Dense,
    pub(super) q: Vector,
    /// s, one a contact.
    pub(super) size: Vector,
    /// What rounding may leave of an approach, one a contact.
    pub(super) noise: Vector,
}

impl Scaled {
    /// The rows of these contacts: the normal one, or all three of its frame; `speeds` are the relative
    /// velocities (or accelerations) without impulse.
    pub(super) fn new(
        bodies: &[ClusterBody],
        contacts: &[Contact],
        active: &[usize],
        normals: &[Vector3],
        speeds: &[Vector3],
        rows_per_contact: usize,
    ) -> Self {
        let mut rows = Vec::with_capacity(active.len() * rows_per_contact);
        for &contact in active {
            let frame = Frame::new(&normals[contact]);
            rows.extend(frame.0[..rows_per_contact].iter().map(|&direction| Row { contact, direction }));
        }
        let (w, size) = scale_rows(matrix(bodies, contacts, &rows), rows_per_contact);
        let q = rows
            .iter()
            .enumerate()
            .map(|(r, row)| size[r / rows_per_contact] * row.direction.dot(&speeds[row.contact]));
        let q = q.collect();
        let noise = active.iter().zip(&size).map(|(&i, s)| s * noise_of(bodies, &contacts[i])).collect();
        Self { w, q, size, noise }
    }
}

/// W scaled by one number per contact, its diagonal then near 1; and those numbers.
fn scale_rows(mut w: Dense, rows_per_contact: usize) -> (Dense, Vector) {
    let count = w.size() / rows_per_contact;
    let mean = |k: usize| {
        let rows = k * rows_per_contact..(k + 1) * rows_per_contact;
        rows.map(|r| w.at(r, r)).sum::<f64>() / rows_per_contact as f64
    };
    let scale = |mean: f64| if mean > 0.0 { 1.0 / mean.sqrt() } else { 0.0 };
    let size: Vector = (0..count).map(|k| scale(mean(k))).collect();
    w.scale(&size, rows_per_contact);
    (w, size)
}

/// One normal for each contact: of a cone the direction of the plastic impulse without friction, in which each
/// normal pushes on its own.
pub(super) fn choose_normals(
    bodies: &[ClusterBody],
    contacts: &[Contact],
    active: &[usize],
    speeds: &[Vector3],
) -> Vec<Vector3> {
    let mut chosen: Vec<Vector3> = contacts.iter().map(|c| mean_direction(&c.normals)).collect();
    if active.iter().all(|&i| contacts[i].normals.len() == 1) {
        return chosen;
    }
    let rows: Vec<Row> = active
        .iter()
        .flat_map(|&contact| contacts[contact].normals.iter().map(move |&direction| Row { contact, direction }))
        .collect();
    let (w, size) = scale_rows(matrix(bodies, contacts, &rows), 1);
    let q: Vector = rows.iter().zip(&size).map(|(row, s)| s * row.direction.dot(&speeds[row.contact])).collect();
    let found = active_set::solve(&w, &q).impulse;
    let floor = CHOICE * largest(&found);
    for &i in active.iter().filter(|&&i| contacts[i].normals.len() > 1) {
        let own = rows.iter().zip(&size).zip(&found).filter(|((row, _), _)| row.contact == i);
        let (mut sum, mut any) = (Vector3::zeros(), false);
        for ((row, s), p) in own {
            sum += s * p * row.direction;
            any |= *p > floor;
        }
        let length = sum.norm();
        if any && length > 0.0 {
            chosen[i] = sum / length;
        }
    }
    chosen
}

/// Impulse below which a contact does not choose its own normal, as a fraction of the largest [-]:
/// rounding has no direction.
const CHOICE: f64 = 1.0e-12;

/// The middle of a cone's normals; of one normal itself.
fn mean_direction(normals: &[Vector3]) -> Vector3 {
    let sum: Vector3 = normals.iter().sum();
    let length = sum.norm();
    if normals.len() == 1 || length == 0.0 { normals[0] } else { sum / length }
}
