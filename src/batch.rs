//! Many free bodies at once, by the classical Runge–Kutta method.
//!
//! Bodies on which nothing acts do not know of each other, so their numbers stand side by side, and the processor
//! works on as many as its vector registers hold:
//!
//! ```text
//! one body     x P q L        another     x P q L         a structure each
//! a batch      x x x x …  P P P P …  q q q q …  L L L L …   an array each, in chunks that stay in the nearest cache
//! ```
//!
//! The arithmetic is that of [`Method::Rk4`](crate::integrator::Method::Rk4) on one body, operation by operation:
//! a body in a batch has the same bits as on its own, whatever the vector width and the number of threads.

use std::num::NonZero;
use std::thread;

use crate::error::{Error, Result};
use crate::freedom::spin::{SMALL_STRAY, large_correction, small_correction};
use crate::freedom::{Chart, Form, Freedom};
use crate::mass::MassProperties;
use crate::math::Vector3;
use crate::math::sum::two_sum;
use crate::state::BodyMotion;

/// Bodies of a chunk [-]: its numbers, 13 KB, stay in the nearest cache, and any vector width divides it.
const LANES: usize = 32;

/// One number of every body of a chunk.
type Lane = [f64; LANES];

/// What a step changes: `[x, q, L]`, q and L in principal axes, and what rounding dropped of them.
#[derive(Debug, Clone)]
struct State {
    y: [Lane; 10],
    rest: [Lane; 10],
}

/// Bodies side by side. Lanes behind the last body hold copies of it.
#[derive(Debug, Clone)]
struct Chunk {
    state: State,
    momentum: [Lane; 3],
    inv_mass: Lane,
    inv_moments: [Lane; 3],
    gaps: [Lane; 3],
}

/// Free bodies that fly on their own, advanced together.
#[derive(Debug, Clone)]
pub struct Batch {
    chunks: Vec<Chunk>,
    /// Reads and writes the numbers of each body.
    charts: Vec<Chart>,
    /// Mass and inertia of each body, and the motion it started with.
    bodies: Vec<BodyMotion>,
}

impl Batch {
    /// Bodies with these masses, inertias and motions.
    ///
    /// # Errors
    /// Mass and inertia that no body can have, and motions that are not finite; the message names the body's place.
    pub fn new(bodies: Vec<BodyMotion>) -> Result<Self> {
        let chart = |(index, body): (usize, &BodyMotion)| {
            let place = format!("body {index}");
            MassProperties { mass: body.mass, center_of_mass: Vector3::zeros(), inertia: body.inertia_body }
                .validate(&place)?;
            if !body.is_finite() {
                return Err(Error::value(place, "motion", "finite", body.state()));
            }
            Chart::new(&Freedom::Free, Form::Body, body, &place)
        };
        let charts = bodies.iter().enumerate().map(chart).collect::<Result<Vec<_>>>()?;

        let mut chunks = Vec::with_capacity(bodies.len().div_ceil(LANES));
        for (bodies, charts) in bodies.chunks(LANES).zip(charts.chunks(LANES)) {
            let zero = [0.0; LANES];
            let state = State { y: [zero; 10], rest: [zero; 10] };
            let [momentum, inv_moments, gaps] = [[zero; 3]; 3];
            let mut chunk = Chunk { state, momentum, inv_mass: zero, inv_moments, gaps };
            for lane in 0..LANES {
                let place = lane.min(bodies.len() - 1);
                let mut y = [0.0; 13];
                charts[place].encode(&bodies[place].state(), &mut y);
                for (i, y) in y.into_iter().enumerate() {
                    match i {
                        0..3 => chunk.state.y[i][lane] = y,
                        3..6 => chunk.momentum[i - 3][lane] = y,
                        _ => chunk.state.y[i - 3][lane] = y,
                    }
                }
                if let Chart::Free(free) = &charts[place] {
                    let (inv_mass, inv_moments, gaps) = free.inverses();
                    chunk.inv_mass[lane] = inv_mass;
                    for i in 0..3 {
                        (chunk.inv_moments[i][lane], chunk.gaps[i][lane]) = (inv_moments[i], gaps[i]);
                    }
                }
            }
            chunks.push(chunk);
        }
        Ok(Self { chunks, charts, bodies })
    }

    /// How many bodies there are.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// The motion of a body as it stands; none behind the last.
    pub fn motion(&self, index: usize) -> Option<BodyMotion> {
        let (chart, mut motion) = (self.charts.get(index)?, *self.bodies.get(index)?);
        let chunk = &self.chunks[index / LANES];
        let lane = |i: usize| match i {
            0..3 => &chunk.state.y[i],
            3..6 => &chunk.momentum[i - 3],
            _ => &chunk.state.y[i - 3],
        };
        let y: [f64; 13] = std::array::from_fn(|i| lane(i)[index % LANES]);
        chart.decode(&y, &mut motion);
        Some(motion)
    }

    /// The motions of all bodies as they stand, in their order.
    pub fn motions(&self) -> impl Iterator<Item = BodyMotion> + '_ {
        (0..self.len()).filter_map(|index| self.motion(index))
    }

    /// Takes steps of `step` [s], on as many threads as are asked for; the bits do not depend on them.
    ///
    /// # Errors
    /// A step that is not finite; a body whose numbers are not finite any more, as with steps that are far too long.
    pub fn advance(&mut self, step: f64, steps: u64, threads: NonZero<usize>) -> Result<()> {
        if !step.is_finite() {
            return Err(Error::value("batch", "step", "a finite number", step));
        }
        let part = self.chunks.len().div_ceil(threads.get()).max(1);
        thread::scope(|scope| {
            let mut parts = self.chunks.chunks_mut(part);
            let own = parts.next();
            for others in parts {
                scope.spawn(move || others.iter_mut().for_each(|chunk| chunk.advance(step, steps)));
            }
            own.into_iter().flatten().for_each(|chunk| chunk.advance(step, steps));
        });
        let finite = |i: usize| self.chunks[i / LANES].state.y.iter().all(|lane| lane[i % LANES].is_finite());
        match (0..self.len()).find(|&i| !finite(i)) {
            Some(body) => Err(Error::refused(
                format!("body {body}"),
                format!("its motion is not finite any more after {steps} steps of {step} s"),
            )),
            None => Ok(()),
        }
    }
}

impl Chunk {
    fn advance(&mut self, h: f64, steps: u64) {
        // nothing acts: P stays, and x moves by the same in every step
        let mut drift = [[0.0; LANES]; 3];
        for (drift, momentum) in drift.iter_mut().zip(&self.momentum) {
            for (drift, (p, inverse)) in drift.iter_mut().zip(momentum.iter().zip(&self.inv_mass)) {
                let v = inverse * p;
                *drift = h / 6.0 * (v + 2.0 * (v + v) + v);
            }
        }

        // from one state into another, and back
        let (mut other, mut stray) = (self.state.clone(), [0.0; LANES]);
        let (mut from, mut to) = (&mut self.state, &mut other);
        for _ in 0..steps {
            step::<false>(from, to, h, &drift, &self.inv_moments, &self.gaps, &mut stray);
            if !stray.iter().fold(true, |near, e| near & (e.abs() < SMALL_STRAY)) {
                step::<true>(from, to, h, &drift, &self.inv_moments, &self.gaps, &mut stray);
            }
            std::mem::swap(&mut from, &mut to);
        }
        if steps % 2 == 1 {
            self.state = other;
        }
    }
}

/// One step of every body of a chunk; `|q|² − 1` of its start, which it takes away, is left in `stray`. Only where it
/// may be `far` is a square root taken.
#[inline(never)]
fn step<const FAR: bool>(
    from: &State,
    to: &mut State,
    h: f64,
    drift: &[Lane; 3],
    inv_moments: &[Lane; 3],
    gaps: &[Lane; 3],
    stray: &mut Lane,
) {
    for l in 0..LANES {
        let mut add = |i: usize, dy: f64| (to.y[i][l], to.rest[i][l]) = two_sum(from.y[i][l], dy + from.rest[i][l]);
        for (i, drift) in drift.iter().enumerate() {
            add(i, drift[l]);
        }

        // the four stages
        let at: [f64; 7] = std::array::from_fn(|i| from.y[3 + i][l]);
        let inverse = std::array::from_fn(|i| inv_moments[i][l]);
        let stage = |a: f64, k: &[f64; 7]| std::array::from_fn::<f64, 7, _>(|i| at[i] + a * k[i]);
        let gap = std::array::from_fn(|i| gaps[i][l]);
        let k1 = rate(&at, &inverse, &gap);
        let k2 = rate(&stage(0.5 * h, &k1), &inverse, &gap);
        let k3 = rate(&stage(0.5 * h, &k2), &inverse, &gap);
        let k4 = rate(&stage(h, &k3), &inverse, &gap);
        let mut dy: [f64; 7] = std::array::from_fn(|i| h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));

        // the change of q is amended as the projection of one body does
        let e = (at[0] * at[0] + at[1] * at[1]) + (at[2] * at[2] + at[3] * at[3]) - 1.0;
        stray[l] = e;
        let near = !FAR || e.abs() < SMALL_STRAY;
        let c = if near { small_correction(e) } else { large_correction(e) };
        for (dy, q) in dy[..4].iter_mut().zip(at) {
            *dy = (1.0 + c) * *dy + c * q;
        }
        for (i, dy) in dy.into_iter().enumerate() {
            add(3 + i, dy);
        }
    }
}

/// Rates of q and L in principal axes: `dq/dt = ½ q [0, ω]`, `dL_i/dt = (1/I_k − 1/I_j) L_j L_k`, `ω_i = L_i/I_i`.
#[inline(always)]
fn rate(&[s, x, y, z, a, b, c]: &[f64; 7], inverse: &[f64; 3], gaps: &[f64; 3]) -> [f64; 7] {
    let (u, v, w) = (0.5 * (inverse[0] * a), 0.5 * (inverse[1] * b), 0.5 * (inverse[2] * c));
    [
        -(u * x + v * y + w * z),
        s * u - v * z + w * y,
        s * v - w * x + u * z,
        v * x + s * w - u * y,
        gaps[0] * (b * c),
        gaps[1] * (c * a),
        gaps[2] * (a * b),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::{Control, Method};
    use crate::math::{Matrix3, Quaternion, quaternion};
    use crate::{Body, Plan, RunOptions, Scene};

    fn bodies(n: u32) -> Vec<BodyMotion> {
        let body = |i: u32| {
            let i = f64::from(i);
            let mut motion = BodyMotion::at_rest(1.0 + 0.1 * i, Matrix3::zeros());
            // moments of a box, turned away from its axes in every other body
            let moments = Vector3::new(0.8, 1.5 + 0.01 * (i % 50.0), 2.1);
            let axes = quaternion::to_matrix(&quaternion::normalized(&Quaternion::new(1.0, 0.3, -0.2, 0.1 * i)));
            let diagonal = Matrix3::from_diagonal(&moments);
            motion.inertia_body = if i % 2.0 == 0.0 { diagonal } else { axes * diagonal * axes.transpose() };
            motion.inertia_body = 0.5 * (motion.inertia_body + motion.inertia_body.transpose());
            motion.position = Vector3::new(i, -i, 0.5);
            motion.orientation = quaternion::normalized(&Quaternion::new(1.0, 0.1 * i, -0.3, 0.2));
            motion.rotation = quaternion::to_matrix(&motion.orientation);
            motion.velocity = Vector3::new(0.3, -0.2 * i, 0.1);
            motion.angular_velocity = Vector3::new(0.7 - 0.02 * i, -0.4, 1.1);
            motion
        };
        (0..n).map(body).collect()
    }

    /// The plan of a body on its own.
    fn alone(motion: &BodyMotion, step: f64) -> Plan {
        let mut scene = Scene::new();
        let q = quaternion::to_scalar_first(&motion.orientation);
        let body = Body::with_inertia("body", motion.mass, motion.inertia_body)
            .position(motion.position)
            .orientation(q)
            .velocity(motion.velocity)
            .angular_velocity(motion.angular_velocity);
        scene.add(body).unwrap();
        scene.compile(&RunOptions::method(Method::Rk4).step(step)).unwrap()
    }

    #[test]
    fn a_body_in_a_batch_has_the_bits_it_has_alone() {
        // chunks that are full, and one that is not; steps from fine to so long that q strays far
        for (step, steps) in [(1e-3, 1000), (0.05, 300), (0.9, 20)] {
            let plans: Vec<_> = bodies(70).iter().map(|motion| alone(motion, step)).collect();
            let mut batch = Batch::new(plans.iter().map(|plan| plan.bodies()[0].start).collect()).unwrap();
            batch.advance(step, steps, NonZero::<usize>::MIN).unwrap();
            for (index, plan) in plans.iter().enumerate() {
                let mut flight = plan.flight(0, 0.0, &Control::Step(step)).unwrap();
                (0..steps).for_each(|_| flight.advance(f64::INFINITY).unwrap());
                let mut motions = [plan.bodies()[0].start];
                flight.at(flight.front(), &mut motions);
                assert_eq!(batch.motion(index), Some(motions[0]), "body {index}, h = {step}");
            }
        }
    }

    #[test]
    fn the_bits_do_not_depend_on_threads_or_pieces() {
        let run = |threads: usize, pieces: u64| {
            let mut batch = Batch::new(bodies(200)).unwrap();
            for _ in 0..pieces {
                batch.advance(0.01, 120 / pieces, NonZero::new(threads).unwrap()).unwrap();
            }
            batch.motions().collect::<Vec<_>>()
        };
        let one = run(1, 1);
        for (threads, pieces) in [(2, 1), (3, 4), (64, 1)] {
            assert_eq!(run(threads, pieces), one);
        }
    }

    #[test]
    fn what_is_no_body_is_refused_and_what_breaks_is_named() {
        let mut starts = bodies(3);
        starts[1].mass = -1.0;
        let message = Batch::new(starts.clone()).unwrap_err().to_string();
        assert!(message.starts_with("body 1: mass must be"), "{message}");
        starts[1].mass = 1.0;
        starts[2].velocity.x = f64::NAN;
        assert!(Batch::new(starts.clone()).unwrap_err().to_string().starts_with("body 2: motion must be finite"));

        // 200 rad a step: the method is unstable
        starts[2].velocity.x = 0.0;
        let mut batch = Batch::new(starts).unwrap();
        let error = batch.advance(200.0, 100, NonZero::<usize>::MIN).unwrap_err().to_string();
        assert_eq!(error, "body 0: its motion is not finite any more after 100 steps of 200 s");
        assert!(Batch::new(Vec::new()).unwrap().is_empty());
    }
}
