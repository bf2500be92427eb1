//! The closed form of free rotation against motions integrated in multi-precision arithmetic
//! (`tests/data/make_free_rotation.py`, `make_free_rotation_far.py`; no formula in common), and against
//! what must hold for any of them.
#![cfg(feature = "serde")]

use bryla::integrator::free_rotation::FreeRotation;
use bryla::math::{Matrix3, Quaternion, Vector3, quaternion};
use serde_json::Value;

const EPS: f64 = f64::EPSILON;

struct Case {
    name: String,
    motion: FreeRotation,
    moments: Vector3,
    states: Vec<State>,
}

struct State {
    t: f64,
    /// Radians turned since t = 0.
    turned: f64,
    /// How much a relative change of the initial momentum is multiplied.
    growth: f64,
    orientation: Quaternion,
    momentum: Vector3,
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list: Vec<f64> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    list.try_into().unwrap()
}

fn read(text: &str) -> Vec<Case> {
    let file: Value = serde_json::from_str(text).unwrap();
    // the truth must be far below what it judges
    assert!(file["accuracy"].as_f64().unwrap() < 1e-22);
    let cases = file["cases"].as_array().unwrap();
    cases
        .iter()
        .map(|case| {
            let moments = Vector3::from(numbers(&case["moments"]));
            let orientation = quaternion::from_scalar_first(numbers(&case["orientation"]));
            let momentum = Vector3::from(numbers(&case["angular_momentum_body"]));
            let states = case["states"].as_array().unwrap().iter().map(|state| State {
                t: state["t"].as_f64().unwrap(),
                turned: state["turned"].as_f64().unwrap(),
                growth: state["growth"].as_f64().unwrap(),
                orientation: quaternion::from_scalar_first(numbers(&state["orientation"])),
                momentum: Vector3::from(numbers(&state["angular_momentum_body"])),
            });
            Case {
                name: case["name"].as_str().unwrap().to_owned(),
                motion: FreeRotation::new(moments, Matrix3::identity(), orientation, momentum),
                moments,
                states: states.collect(),
            }
        })
        .collect()
}

fn cases() -> Vec<Case> {
    read(include_str!("data/free_rotation.json"))
}

fn far_cases() -> Vec<Case> {
    read(include_str!("data/free_rotation_far.json"))
}

/// Error of the orientation [rad] and of the momentum over |L|, the larger.
fn error(motion: &FreeRotation, state: &State) -> f64 {
    let (q, l) = motion.at(state.t);
    let angle = quaternion::angle_between(&q, &state.orientation);
    angle.max((l - state.momentum).norm() / state.momentum.norm())
}

/// The promise: 4 ε for each radian turned and one more, or what rounding of the input grows to.
fn promised(state: &State) -> f64 {
    4.0 * EPS * (1.0 + state.turned).max(state.growth)
}

#[test]
fn every_recorded_motion_is_met_to_four_ulp_per_radian() {
    let mut failures = Vec::new();
    for case in cases().iter().chain(&far_cases()) {
        for state in &case.states {
            let error = error(&case.motion, state);
            let promise = promised(state);
            if std::env::var_os("BRYLA_PRINT").is_some() {
                println!(
                    "{:40} t {:8} turned {:9.3e} growth {:9.2e} error {error:9.2e} = {:5.2} of promise",
                    case.name,
                    state.t,
                    state.turned,
                    state.growth,
                    error / promise
                );
            }
            if error.is_nan() || error > promise {
                failures.push(format!("{} t = {}: {error:.2e} of {promise:.2e}", case.name, state.t));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
