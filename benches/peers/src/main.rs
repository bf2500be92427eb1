//! What one step of a free tumbling body costs in bryla and in rapier, and how far off the body ends.
//!
//! bryla is timed by its whole run, from the scene on and without keeping the motion; rapier by its steps
//! alone, in a world built before. Both run in turns in this process, and times are those of the thread's
//! processor clock, so that other programs do not count.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use bryla::math::{Matrix3, Quaternion, Vector3, quaternion};
use bryla::{Body, Method, Record, RunOptions, Scene};
use cpu_time::ThreadTime;
use rapier3d_f64::prelude as rapier;

/// Principal moments of inertia [kg·m²].
const MOMENTS: [f64; 3] = [0.8, 1.5, 2.1];

/// Angular velocity at the start [rad/s]; body and world axes coincide there.
const ANGULAR_VELOCITY: [f64; 3] = [0.7, -0.4, 1.1];

/// End of the motion [s].
const END: f64 = 10.0;

/// Steps of a motion [-].
const STEPS: [u32; 3] = [1_000, 10_000, 100_000];

/// Steps in one measurement [-]: long enough for the clock, short enough for turns under the same load.
const MEASURED: u32 = 100_000;

/// Measurements of each contestant [-].
const REPEATS: usize = 7;

/// Who steps, and how.
#[derive(Clone, Copy)]
enum Contestant {
    /// This method of bryla.
    Bryla(Method),
    /// Rapier with so many solver iterations, each of which is a substep of the motion.
    Rapier(usize),
}

impl Contestant {
    fn name(self) -> String {
        match self {
            Self::Bryla(method) => format!("bryla, {method}"),
            Self::Rapier(1) => "rapier, 1 substep".into(),
            Self::Rapier(substeps) => format!("rapier, {substeps} substeps"),
        }
    }

    /// Time of a motion in so many steps, and the orientation at its end.
    fn run(self, steps: u32) -> Result<(Duration, Quaternion), Box<dyn Error>> {
        let step = END / f64::from(steps);
        match self {
            Self::Bryla(method) => bryla(method, step),
            Self::Rapier(substeps) => rapier(substeps, step, steps),
        }
    }
}

fn bryla(method: Method, step: f64) -> Result<(Duration, Quaternion), Box<dyn Error>> {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::from(MOMENTS));
    scene.add(Body::with_inertia("body", 1.0, inertia).angular_velocity(ANGULAR_VELOCITY))?;
    let options = RunOptions::method(method).step(step).estimate(false).record(Record::End);

    let clock = ThreadTime::now();
    let trajectory = black_box(&scene).run(0.0..END, &options)?;
    let time = clock.elapsed();

    let end = trajectory.states(trajectory.times().len() - 1);
    Ok((time, end[0].orientation))
}

fn rapier(substeps: usize, step: f64, steps: u32) -> Result<(Duration, Quaternion), Box<dyn Error>> {
    let mut parameters = rapier::IntegrationParameters { dt: step, ..Default::default() };
    parameters.num_solver_iterations = substeps;
    let mass = rapier::MassProperties::new(rapier::Vector::ZERO, 1.0, rapier::Vector::from(MOMENTS));
    let body = rapier::RigidBodyBuilder::dynamic()
        .additional_mass_properties(mass)
        .angvel(rapier::Vector::from(ANGULAR_VELOCITY))
        .gyroscopic_forces_enabled(true)
        .can_sleep(false);
    let mut bodies = rapier::RigidBodySet::new();
    let body = bodies.insert(body);

    let mut pipeline = rapier::PhysicsPipeline::new();
    let mut islands = rapier::IslandManager::new();
    let mut broad_phase = rapier::BroadPhaseBvh::new();
    let mut narrow_phase = rapier::NarrowPhase::new();
    let mut colliders = rapier::ColliderSet::new();
    let mut impulse_joints = rapier::ImpulseJointSet::new();
    let mut multibody_joints = rapier::MultibodyJointSet::new();
    let mut soft_bodies = rapier::SoftBodySet::new();
    let mut ccd = rapier::CCDSolver::new();

    let clock = ThreadTime::now();
    for _ in 0..steps {
        pipeline.step(
            rapier::Vector::ZERO,
            &parameters,
            &mut islands,
            &mut broad_phase,
            &mut narrow_phase,
            &mut bodies,
            &mut colliders,
            &mut impulse_joints,
            &mut multibody_joints,
            &mut soft_bodies,
            &mut ccd,
            &(),
            &(),
        );
    }
    let time = clock.elapsed();

    let q = bodies[body].rotation();
    Ok((time, quaternion::from_scalar_first([q.w, q.x, q.y, q.z])))
}

fn main() -> Result<(), Box<dyn Error>> {
    let contestants = [
        Contestant::Rapier(rapier::IntegrationParameters::default().num_solver_iterations),
        Contestant::Rapier(1),
        Contestant::Bryla(Method::Euler),
        Contestant::Bryla(Method::Heun),
        Contestant::Bryla(Method::Rk4),
    ];
    let (_, exact) = bryla(Method::Exact, END)?;

    println!(
        "| step [s] | contestant | min [ns/step] | median [ns/step] | ratio to rapier's default | error at the end [rad] |"
    );
    println!("|---|---|--:|--:|--:|--:|");
    for steps in STEPS {
        let motions = (MEASURED / steps).max(1);
        let mut times = contestants.map(|_| Vec::with_capacity(REPEATS));
        let mut errors = contestants.map(|_| 0.0);

        // one round to warm up, then all of them in turns
        for round in 0..=REPEATS {
            for (i, contestant) in contestants.iter().enumerate() {
                let mut time = Duration::ZERO;
                for _ in 0..motions {
                    let (taken, end) = contestant.run(steps)?;
                    time += taken;
                    errors[i] = quaternion::angle_between(&end, &exact);
                }
                if round > 0 {
                    times[i].push(1e9 * time.as_secs_f64() / f64::from(motions * steps));
                }
            }
        }

        for times in &mut times {
            times.sort_by(f64::total_cmp);
        }
        let median = |times: &[f64]| times[REPEATS / 2];
        for (i, contestant) in contestants.iter().enumerate() {
            println!(
                "| {} | {} | {:.1} | {:.1} | {:.3} | {:.1e} |",
                END / f64::from(steps),
                contestant.name(),
                times[i][0],
                median(&times[i]),
                median(&times[i]) / median(&times[0]),
                errors[i],
            );
        }
    }
    Ok(())
}
