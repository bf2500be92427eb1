//! Simultaneous impact with Coulomb friction: two phases, and one cone for the total impulse.
//!
//! ```text
//! compression   all approaching contacts stop:  p_n ≥ 0 ⟂ u_n ≥ 0, friction from the velocities then
//! restitution   p_n ≥ (1 + e) p_c ⟂ u_n ≥ 0     (Poisson: e times the impulse of compression comes back)
//!               |p_t| ≤ μ p_n for the total p, against the sliding that is left at the end
//! ```
//!
//! A second cone for the restitution alone, or none, would leave a sliding ball too fast by exactly `μ e u_n`.
//! Newton's law asks for `u_n ≥ −e u_n⁻` instead of the impulse. Several contacts with friction may have no
//! such motion, or one that makes energy; then Poisson's impulse is taken.
//!
//! Several contacts are answered in the rounds of [`reflection`](super::reflection), and a mixture of
//! restitutions in the same slices; what is mixed are normal impulses, then friction is solved once for all
//! of them. Without friction this is that answer.
//!
//! Energy. The compression alone never gains any. The restitution can, where friction couples normal and
//! tangent (Kane & Levinson 1985); then it is weakened to the largest part κ of it that gains none. Stronge's
//! law (1990) is the same with a stricter bound: what the normal impulses give back is at most `Σ e² ·` what
//! each took in compression.

use super::collision::Law;
use super::problem::PerContact;
use super::reflection::{energy_change, rounds_for, slices};
use super::solver::Coulomb;
use super::solver::dense::{Dense, Vector, dot, zeros};

/// A scaled problem with friction, three rows a contact.
pub(super) struct Rubbing<'a> {
    pub(super) w: &'a Dense,
    pub(super) q: &'a [f64],
    pub(super) friction: &'a [f64],
    /// Approach that rounding alone may leave, one a contact.
    pub(super) noise: &'a [f64],
    pub(super) law: Law,
}

/// Impulses of a problem with friction.
pub(super) struct Rubbed {
    pub(super) impulse: Vector,
    pub(super) residual: f64,
    pub(super) rounds: u32,
    /// The part of the restitution that was used [-].
    pub(super) kept: f64,
}

/// Halvings of the part of the restitution [-]: to 1e-12 of it.
const HALVINGS: usize = 40;
/// Energy that counts as none, as a fraction of `qᵀq` [-]: rounding of the sums.
const GAIN: f64 = 1.0e-14;

/// Residual above which a wish counts as not met [-]: the solvers end at 1e-11 or orders of magnitude above.
const MET: f64 = 1.0e-9;

/// Plastic impacts of what a solver has left [-].
const STOPS: usize = 8;

/// What the restitution asks for.
enum Wish {
    /// A least normal impulse at each contact.
    Impulse(Vector),
    /// A least normal velocity at each contact.
    Velocity(Vector),
}

impl Rubbing<'_> {
    /// The answer with these restitutions.
    pub(super) fn answer(&self, restitution: &[f64]) -> Rubbed {
        let n = self.friction.len();
        let (plastic, mut residual) = self.impact(&Wish::Impulse(zeros(n)));
        let mut rounds = 1;
        if restitution.iter().all(|&e| e == 0.0) {
            let mut plastic = plastic;
            self.stop(&mut plastic);
            return Rubbed { impulse: plastic, residual, rounds, kept: 1.0 };
        }

        // one contact alone: what the slices come to
        if let &[e] = restitution {
            let (impulses, speeds) = ([(1.0 + e) * plastic[0]], Vector::from_slice(&[(-e * self.q[0]).max(0.0)]));
            let limit = (self.law == Law::Stronge).then(|| self.stronge_limit(&plastic, restitution));
            let (impulse, last, kept) = self.restore(&plastic, &impulses, speeds, limit);
            return Rubbed { impulse, residual: residual.max(last), rounds: 2, kept };
        }

        // mix the normal impulses and velocities of the slices
        let (mut impulses, mut speeds) = (zeros(n), zeros(n));
        for (weight, elastic) in slices(restitution) {
            let p = if elastic.contains(&true) {
                let (p, worst, count) = self.rounds(&elastic);
                residual = residual.max(worst);
                rounds += count;
                p
            } else {
                plastic.clone()
            };
            let u = self.w.times_plus(&p, self.q);
            for i in 0..n {
                impulses[i] += weight * p[3 * i];
                speeds[i] += weight * u[3 * i];
            }
        }
        let returned = |(u, p): (&f64, &f64)| if *p > 0.0 { u.max(0.0) } else { 0.0 };
        let speeds = speeds.iter().zip(&impulses).map(returned).collect();
        let limit = (self.law == Law::Stronge).then(|| self.stronge_limit(&plastic, restitution));
        let (mut impulse, last, kept) = self.restore(&plastic, &impulses, speeds, limit);
        self.stop(&mut impulse);
        Rubbed { impulse, residual: residual.max(last), rounds: rounds + 1, kept }
    }

    /// Stops what still approaches, where a solver has ended short of its mark: each plastic impact of the
    /// rest makes it smaller, keeps the cone and makes no energy.
    fn stop(&self, p: &mut [f64]) {
        for _ in 0..STOPS {
            let u = self.w.times_plus(p, self.q);
            if (0..self.friction.len()).all(|i| u[3 * i] >= -self.noise[i]) {
                return;
            }
            let (rest, _) = Rubbing { q: &u, ..*self }.impact(&Wish::Impulse(zeros(self.friction.len())));
            for (p, s) in p.iter_mut().zip(&rest) {
                *p += s;
            }
        }
    }

    /// Rounds of elastic pairs of phases over the approaching contacts.
    fn rounds(&self, elastic: &[bool]) -> (Vector, f64, u32) {
        let n = self.friction.len();
        let mut p = zeros(3 * n);
        let mut worst = 0.0f64;
        let mut count = 0;
        for round in 1..=rounds_for(n) {
            let u = self.w.times_plus(&p, self.q);
            let approaching: Vec<usize> = (0..n).filter(|&i| u[3 * i] < -self.noise[i]).collect();
            if approaching.is_empty() {
                return (p, worst, count);
            }
            count = round;
            let rows: Vec<usize> = approaching.iter().flat_map(|&i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            let w = self.w.part(&rows);
            let q: Vector = rows.iter().map(|&r| u[r]).collect();
            let pick = |x: &[f64]| approaching.iter().map(|&i| x[i]).collect::<Vector>();
            let (friction, noise) = (pick(self.friction), pick(self.noise));
            let part = Rubbing { w: &w, q: &q, friction: &friction, noise: &noise, law: self.law };

            let (stop, residual) = part.impact(&Wish::Impulse(zeros(approaching.len())));
            let back = |i: usize| if elastic[approaching[i]] { 1.0 } else { 0.0 };
            let count = approaching.len();
            let impulses: Vector = (0..count).map(|i| (1.0 + back(i)) * stop[3 * i]).collect();
            let speeds = (0..count).map(|i| -back(i) * q[3 * i]).collect();
            let (pair, last, _) = part.restore(&stop, &impulses, speeds, None);
            worst = worst.max(residual).max(last);
            for (&r, x) in rows.iter().zip(&pair) {
                p[r] += x;
            }
        }

        // what the rounds have left is stopped
        let u = self.w.times_plus(&p, self.q);
        let rest = Rubbing { q: &u, ..*self };
        let (stop, last) = rest.impact(&Wish::Impulse(zeros(n)));
        for (p, s) in p.iter_mut().zip(&stop) {
            *p += s;
        }
        (p, worst.max(last), count + 1)
    }

    /// One impact that meets a wish.
    fn impact(&self, wish: &Wish) -> (Vector, f64) {
        let n = self.friction.len();
        let none = PerContact::from_elem(None, n);
        let mut q = Vector::from_slice(self.q);
        let none_least = zeros(n);
        let floor = match wish {
            Wish::Impulse(floor) => floor,
            Wish::Velocity(speeds) => {
                for i in 0..n {
                    q[3 * i] -= speeds[i];
                }
                &none_least
            }
        };
        let found = Coulomb { w: self.w, q: &q, friction: self.friction, floor, slide: &none }.solve();
        (found.impulse, found.residual)
    }

    /// The restitution that the law asks for: Newton's normal velocities where they can be met without
    /// making energy, else the normal impulses, of which the largest part is taken that makes none and gives
    /// back no more than `limit`.
    fn restore(&self, plastic: &[f64], impulses: &[f64], speeds: Vector, limit: Option<f64>) -> (Vector, f64, f64) {
        let slack = GAIN * dot(self.q, self.q);
        let fits = |p: &[f64], residual: f64| {
            residual <= MET
                && energy_change(self.w, self.q, p) <= slack
                && limit.is_none_or(|limit| self.given_back(plastic, p) <= limit + slack)
        };
        if self.law == Law::Newton {
            let (whole, residual) = self.impact(&Wish::Velocity(speeds));
            if fits(&whole, residual) {
                return (whole, residual, 1.0);
            }
        }
        let (whole, residual) = self.impact(&Wish::Impulse(Vector::from_slice(impulses)));
        if fits(&whole, residual) {
            return (whole, residual, 1.0);
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut best = (Vector::from_slice(plastic), 0.0, 0.0);
        for _ in 0..HALVINGS {
            let part = 0.5 * (low + high);
            let normal = plastic.iter().step_by(3);
            let wish = normal.zip(impulses).map(|(stop, p)| stop + part * (p - stop)).collect();
            let (p, residual) = self.impact(&Wish::Impulse(wish));
            if fits(&p, residual) {
                low = part;
                best = (p, residual, part);
            } else {
                high = part;
            }
        }
        best
    }

    /// Work of the normal impulses after compression [J].
    fn given_back(&self, plastic: &[f64], p: &[f64]) -> f64 {
        let (middle, after) = (self.w.times_plus(plastic, self.q), self.w.times_plus(p, self.q));
        let normal = (0..p.len()).step_by(3);
        normal.map(|k| 0.5 * (p[k] - plastic[k]) * (middle[k] + after[k])).sum()
    }

    /// Stronge's bound: `Σ e²` times what each normal impulse took in compression [J].
    fn stronge_limit(&self, plastic: &[f64], restitution: &[f64]) -> f64 {
        let middle = self.w.times_plus(plastic, self.q);
        let took = |i: usize| -0.5 * plastic[3 * i] * (self.q[3 * i] + middle[3 * i]);
        restitution.iter().enumerate().map(|(i, e)| e * e * took(i)).sum()
    }
}
