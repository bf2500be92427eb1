//! The recorded motions, as scenes.

use bryla::effect::Frame;
use bryla::math::{Matrix3, Quaternion, Vector3, quaternion};
use bryla::state::BodyMotion;
use bryla::{Body, Drag, Freedom, Method, Record, RunOptions, Scene, Trajectory, UniformGravity, Wrench};
use serde_json::Value;

/// A recorded rotation.
pub(crate) struct Case {
    pub(crate) name: String,
    /// Moments of inertia about the point that rests, or the centre of mass [kg·m²].
    pub(crate) moments: Vector3,
    /// Weight times the arm from the point that rests to the centre of mass, body axes [N·m].
    pub(crate) weight: Vector3,
    pub(crate) scene: Scene,
    pub(crate) states: Vec<State>,
}

/// What was recorded of it at an instant.
pub(crate) struct State {
    pub(crate) t: f64,
    /// Angle turned since the start [rad].
    pub(crate) turned: f64,
    pub(crate) orientation: Quaternion,
    /// Body axes [kg·m²/s].
    pub(crate) momentum: Vector3,
}

/// Acceleration of gravity where a top is recorded [m/s²]: with a mass of 1 kg its arms are millimetres, so that
/// every recorded inertia is that of a body about a point off its centre.
const G: f64 = 1000.0;

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list: Vec<f64> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    list.try_into().unwrap()
}

fn vector(value: &Value) -> Vector3 {
    if value.is_null() { Vector3::zeros() } else { Vector3::from(numbers(value)) }
}

fn read(file: &str) -> Vec<Case> {
    let file: Value = serde_json::from_str(file).unwrap();
    file["cases"].as_array().unwrap().iter().map(case).collect()
}

/// The rotations without torque.
pub(crate) fn free() -> Vec<Case> {
    read(include_str!("../data/free_rotation.json"))
}

/// The rotations under torques.
pub(crate) fn driven() -> Vec<Case> {
    read(include_str!("../data/references.json"))
}

fn case(value: &Value) -> Case {
    let (moments, weight) = (vector(&value["moments"]), vector(&value["weight"]));
    let q = quaternion::normalized(&quaternion::from_scalar_first(numbers(&value["orientation"])));
    let w = quaternion::rotate(&q, &vector(&value["angular_momentum_body"]).component_div(&moments));

    // Steiner: the inertia about the centre of mass
    let arm = weight / G;
    let inertia = Matrix3::from_diagonal(&moments) - (arm.norm_squared() * Matrix3::identity() - arm * arm.transpose());
    let freedom = if arm == Vector3::zeros() { Freedom::Free } else { Freedom::pivot(-arm) };
    let mut scene = Scene::new();
    let body = Body::with_inertia("body", 1.0, inertia).freedom(freedom);
    scene.add(body.orientation(quaternion::to_scalar_first(&q)).angular_velocity(w)).unwrap();

    if arm != Vector3::zeros() {
        scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    }
    if !value["world_torque"].is_null() {
        scene.add_effect(Wrench::new("body", [0.0; 3], vector(&value["world_torque"])));
    }
    if let Some(frequency) = value["sine"]["angular_frequency"].as_f64() {
        let torque = vector(&value["sine"]["amplitude"]);
        scene.add_effect(Wrench::new("body", [0.0; 3], torque).frame(Frame::Body).oscillating(frequency, 0.0));
    }
    if let Some(drag) = value["drag"].as_f64() {
        scene.add_effect(Drag::new(0.0, 0.0).angular(drag, 0.0));
    }
    let state = |state: &Value| State {
        t: state["t"].as_f64().unwrap(),
        turned: state["turned"].as_f64().unwrap(),
        orientation: quaternion::from_scalar_first(numbers(&state["orientation"])),
        momentum: vector(&state["angular_momentum_body"]),
    };
    Case {
        name: value["name"].as_str().unwrap().to_owned(),
        moments,
        weight,
        scene,
        states: value["states"].as_array().unwrap().iter().map(state).collect(),
    }
}

impl Case {
    /// The run that keeps a tolerance up to the last of these times [s], sampled at each.
    pub(crate) fn run(&self, times: &[f64], method: Option<Method>, tolerance: f64) -> Trajectory {
        let options = RunOptions { method, ..RunOptions::tolerance(tolerance) };
        let options = options.t_eval(times.to_vec()).record(Record::Samples);
        self.scene.run([0.0, times[times.len() - 1]], &options).unwrap()
    }

    /// The motion at the start, as the scene has it.
    pub(crate) fn start(&self) -> BodyMotion {
        self.scene.compile(&RunOptions::method(Method::Rk4).step(1.0)).unwrap().bodies()[0].start
    }

    /// L about the point that rests, body axes [kg·m²/s].
    pub(crate) fn momentum(&self, run: &Trajectory, sample: usize) -> Vector3 {
        self.moments.component_mul(&run.motions(sample)[0].angular_velocity_body())
    }

    /// Error of the orientation of a sample [rad], and of L over its size.
    pub(crate) fn errors(&self, run: &Trajectory, sample: usize, truth: &State) -> [f64; 2] {
        let angle = quaternion::angle_between(&run.states(sample)[0].orientation, &truth.orientation);
        [angle, (self.momentum(run, sample) - truth.momentum).norm() / truth.momentum.norm()]
    }
}
