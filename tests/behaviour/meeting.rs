//! Bodies that meet: what the tests of their runs share.

use bryla::math::Vector3;
use bryla::{Body, BodyMotion, RunOptions, Scene, Trajectory};

pub(super) fn scene(bodies: impl IntoIterator<Item = Body>) -> Scene {
    let mut scene = Scene::new();
    for body in bodies {
        scene.add(body).unwrap();
    }
    scene
}

/// The run from 0 to `end` [s] at a tolerance of 1e-9.
pub(super) fn run(scene: &Scene, end: f64) -> Trajectory {
    match scene.run(0.0..end, &RunOptions::tolerance(1e-9)) {
        Ok(run) => run,
        Err(error) => panic!("{error}"),
    }
}

/// The motions at the end of a run.
pub(super) fn last(run: &Trajectory) -> Vec<BodyMotion> {
    run.motions(run.times().len() - 1)
}

#[track_caller]
pub(super) fn close(a: Vector3, b: impl Into<Vector3>, tolerance: f64) {
    let b = b.into();
    assert!((a - b).norm() <= tolerance, "{:?} is not {:?}: {:e}", a.as_slice(), b.as_slice(), (a - b).norm());
}
