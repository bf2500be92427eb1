//! What bryla promises, as sentences. Each test says where its truth and its tolerance come from.

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]
#![allow(clippy::disallowed_methods, reason = "no bits are promised of tests")]

mod accuracy;
mod bad_input;
mod breaking;
mod collision;
mod edges;
mod effects;
mod events;
mod files;
mod freedoms;
mod impacts;
mod layers;
mod meeting;
mod order;
mod prescribed;
mod promises;
mod reduced;
mod rest;
mod rolling;
mod series;
mod sticking;
mod switching;

use bryla::{Body, BodyState, Method, RunOptions, Scene, Trajectory};

/// A free body without symmetry: three different moments, turning about no principal axis.
fn free_body() -> Scene {
    let mut scene = Scene::new();
    let inertia = [[0.8, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 2.1]];
    let body = Body::with_inertia("body", 2.0, inertia).velocity([0.3, -0.2, 0.5]);
    scene.add(body.orientation([0.8, 0.1, -0.5, 0.316227766016838]).angular_velocity([1.1, -0.7, 0.9])).unwrap();
    scene
}

/// The slope of a method is measured where the error lies between 1e3 times the rounding of the run and 1e-2.
const LARGEST_ERROR: f64 = 1e-2;
const SMALLEST_ERROR: f64 = 1e-11;

/// The methods that take steps: all but the closed form, which has no step and no slope.
fn stepping() -> impl Iterator<Item = Method> {
    Method::ALL.iter().copied().filter(|&method| method != Method::Exact)
}

/// Those of them that take the loads of a scene: all but `dmv` where a torque acts.
fn stepping_through(scene: &Scene) -> impl Iterator<Item = Method> {
    let torque = !scene.effects.is_empty();
    stepping().filter(move |&method| !(torque && method == Method::Dmv))
}

/// Runs with a method and a step, without an estimate.
fn run(scene: &Scene, end: f64, method: Method, step: f64) -> Trajectory {
    scene.run(0.0..end, &RunOptions::method(method).step(step).estimate(false)).unwrap()
}

/// State of the first body at the end.
fn last(run: &Trajectory) -> BodyState {
    run.states(run.times().len() - 1)[0]
}

/// Difference of two states: position [m], orientation [rad], momenta, whichever is largest.
fn distance(a: &BodyState, b: &BodyState) -> f64 {
    (a.position - b.position)
        .norm()
        .max(bryla::math::quaternion::angle_between(&a.orientation, &b.orientation))
        .max((a.linear_momentum - b.linear_momentum).norm())
        .max((a.angular_momentum - b.angular_momentum).norm())
}
