//! The recorded driven rotations (`tests/data/make_references.py`) against the classical Runge–Kutta method,
//! which shares neither arithmetic nor code with the program that made them: the truth is itself tested.
#![cfg(feature = "serde")]
#![allow(clippy::unwrap_used)] // a panic is how a test fails

use bryla::math::{Quaternion, Vector3, quaternion};
use serde_json::Value;

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list: Vec<f64> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    list.try_into().unwrap()
}

fn vector(value: &Value) -> Vector3 {
    if value.is_null() { Vector3::zeros() } else { Vector3::from(numbers(value)) }
}

/// A recorded problem: `L′ = L × ω + M_body`, `q′ = ½ q [0, ω]`.
struct Problem {
    moments: Vector3,
    weight: Vector3,
    world_torque: Vector3,
    sine: Vector3,
    frequency: f64,
    drag: f64,
}

impl Problem {
    fn slope(&self, t: f64, q: &Quaternion, l: &Vector3) -> (Quaternion, Vector3) {
        let w = l.component_div(&self.moments);
        let to_body = |v: &Vector3| quaternion::rotate(&quaternion::normalized(q).conjugate(), v);
        let torque = self.weight.cross(&to_body(&-Vector3::z()))
            + to_body(&self.world_torque)
            + libm::sin(self.frequency * t) * self.sine
            - self.drag * w;
        (quaternion::rate_body(&w, q), l.cross(&w) + torque)
    }

    fn advance(&self, t: f64, q: Quaternion, l: Vector3, span: f64, steps: u32) -> (Quaternion, Vector3) {
        let h = span / f64::from(steps);
        let (mut q, mut l) = (q, l);
        for step in 0..steps {
            let t = t + h * f64::from(step);
            let k1 = self.slope(t, &q, &l);
            let k2 = self.slope(t + 0.5 * h, &(q + k1.0 * (0.5 * h)), &(l + k1.1 * (0.5 * h)));
            let k3 = self.slope(t + 0.5 * h, &(q + k2.0 * (0.5 * h)), &(l + k2.1 * (0.5 * h)));
            let k4 = self.slope(t + h, &(q + k3.0 * h), &(l + k3.1 * h));
            q = quaternion::normalized(&(q + (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) * (h / 6.0)));
            l += (k1.1 + (k2.1 + k3.1) * 2.0 + k4.1) * (h / 6.0);
        }
        (q, l)
    }
}

#[test]
fn recorded_driven_motions_are_those_of_the_equations() {
    let file: Value = serde_json::from_str(include_str!("data/references.json")).unwrap();
    assert!(file["accuracy"].as_f64().unwrap() < 1e-25);
    for case in file["cases"].as_array().unwrap() {
        let sine = &case["sine"];
        let problem = Problem {
            moments: vector(&case["moments"]),
            weight: vector(&case["weight"]),
            world_torque: vector(&case["world_torque"]),
            sine: vector(&sine["amplitude"]),
            frequency: sine["angular_frequency"].as_f64().unwrap_or(0.0),
            drag: case["drag"].as_f64().unwrap_or(0.0),
        };
        let mut q = quaternion::normalized(&quaternion::from_scalar_first(numbers(&case["orientation"])));
        let (mut l, mut t, mut turned) = (vector(&case["angular_momentum_body"]), 0.0, 0.0);
        for state in case["states"].as_array().unwrap() {
            let end = state["t"].as_f64().unwrap();
            // a thousand steps a radian: (1e-3)⁴/100 of error for each, far below what a wrong sign would do;
            // it is multiplied by e^(2 t) at most where a top falls over
            let more = state["turned"].as_f64().unwrap() - turned;
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few hundred radians at most
            let steps = (1000.0 * more) as u32 + 1000;
            (q, l) = problem.advance(t, q, l, end - t, steps);
            (t, turned) = (end, turned + more);

            let truth = quaternion::from_scalar_first(numbers(&state["orientation"]));
            let off = quaternion::angle_between(&q, &truth);
            let momentum = vector(&state["angular_momentum_body"]);
            let off_l = (l - momentum).norm() / momentum.norm();
            assert!(off < 1e-9 && off_l < 1e-9, "{} t = {t}: {off:e} rad, {off_l:e}", case["name"]);
        }
    }
}
