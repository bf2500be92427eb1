//! Measures what steps cost on this machine.

use crate::effect::{Spring, UniformGravity};
use crate::error::{Error, Result};
use crate::freedom::{Freedom, Pivot, Planar};
use crate::integrator::{Control, Method};
use crate::math::{Matrix3, Vector3};
use crate::plan::cost::{BodyKind, CostTable, MethodCosts, StepCosts};
use crate::scene::{Body, RunOptions, Scene};
use crate::simulation::clock::thread_seconds;

/// Length of a step [s]; the body turns by 0.014 rad in it.
const STEP: f64 = 0.01;
/// Steps of a repetition.
const STEPS: u32 = 200;
/// Repetitions, of which the fastest counts: others slow a step down, nothing speeds it up.
const REPETITIONS: u32 = 15;

impl CostTable {
    /// Measures every method on every kind of body, in the processor time of this thread; a second or so.
    ///
    /// # Errors
    /// A step that breaks off, which none should.
    pub fn measure() -> Result<Self> {
        let mut methods = Vec::new();
        for &method in Method::ALL.iter().filter(|&&method| method != Method::Exact) {
            let costs = |kept| -> Result<StepCosts> {
                let time = |kind| time_of_step(method, kind, kept);
                Ok(StepCosts {
                    free: time(BodyKind::Free)?,
                    loaded: time(BodyKind::Loaded)?,
                    pivot: time(BodyKind::Pivot)?,
                    planar: time(BodyKind::Planar)?,
                    grouped: time(BodyKind::Grouped)?,
                })
            };
            methods.push(MethodCosts { method, step: costs(false)?, kept: costs(true)? });
        }
        Ok(Self { machine: machine(), methods })
    }
}

/// What the system calls this machine.
fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    let (arch, os) = (std::env::consts::ARCH, std::env::consts::OS);
    model.map_or_else(|| format!("{arch}, {os}"), |model| format!("{}, {arch}, {os}", model.trim()))
}

/// A scene with bodies of one kind.
fn scene(kind: BodyKind) -> Result<Scene> {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.8, 1.5, 2.1));
    let body = |name: &str| Body::with_inertia(name, 1.0, inertia);
    let tumbling = |body: Body| body.angular_velocity([0.7, -0.4, 1.1]);
    let point = Pivot { point_body: [0.0, 0.0, -0.5] };
    match kind {
        BodyKind::Free | BodyKind::Loaded => scene.add(tumbling(body("a")))?,
        BodyKind::Pivot => scene.add(tumbling(body("a")).freedom(Freedom::Pivot(point)))?,
        BodyKind::Planar => {
            let planar = Freedom::Planar(Planar { normal: [0.0, 0.0, 1.0] });
            scene.add(body("a").angular_velocity([0.0, 0.0, 1.1]).freedom(planar))?
        }
        BodyKind::Grouped => {
            scene.add_effect(Spring::between("a", "b", 1.0));
            scene.add(tumbling(body("a")))?;
            scene.add(tumbling(body("b")).position([1.0, 0.0, 0.0]))?
        }
    };
    if matches!(kind, BodyKind::Loaded | BodyKind::Pivot | BodyKind::Planar) {
        scene.add_effect(UniformGravity::new([0.0, -9.81, 0.0]));
    }
    Ok(scene)
}

/// Time of a step of one body [s]; where the method refuses what acts on bodies of this kind, that of a free one.
fn time_of_step(method: Method, kind: BodyKind, kept: bool) -> Result<f64> {
    let options = RunOptions::method(method).step(STEP);
    let wanted = scene(kind)?;
    let scene = if wanted.compile(&options).is_ok() { wanted } else { scene(BodyKind::Free)? };
    let plan = scene.compile(&options)?;
    let mut flight = plan.flight(0, 0.0, &Control::Step(STEP))?;
    let mut least = f64::INFINITY;
    let mut segments = Vec::new();
    for _ in 0..REPETITIONS {
        let began = thread_seconds();
        let broken = if kept {
            segments.clear();
            (0..STEPS).try_for_each(|_| {
                flight.advance(f64::INFINITY)?;
                flight.interpolate()?;
                segments.push(flight.segment().clone());
                Ok(())
            })
        } else {
            flight.advance_past(flight.front() + (f64::from(STEPS) - 0.5) * STEP, f64::INFINITY)
        };
        broken.map_err(|error| Error::refused("calibrate", format!("{method}: {error}")))?;
        least = least.min(thread_seconds() - began);
    }
    Ok(least / f64::from(STEPS) / scene.bodies.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_has_its_costs_here_and_in_the_shipped_table() {
        let stepping: Vec<_> = Method::ALL.iter().copied().filter(|&method| method != Method::Exact).collect();
        for table in [CostTable::measure().unwrap(), CostTable::shipped()] {
            assert_eq!(table.methods.iter().map(|costs| costs.method).collect::<Vec<_>>(), stepping);
            assert!(!table.machine.is_empty());
            let step = |method, kind, kept| table.step(method, kind, kept).unwrap();
            for (&method, &kind) in stepping.iter().flat_map(|m| BodyKind::ALL.iter().map(move |k| (m, k))) {
                for kept in [false, true] {
                    let time = step(method, kind, kept);
                    assert!(time > 0.0 && time.is_finite(), "{method}, {kind:?}: {time} s");
                }
            }
            assert_eq!(table.step(Method::Exact, BodyKind::Free, false), None);
        }
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_table_is_kept_in_a_file() {
        let path = std::env::temp_dir().join(format!("bryla-costs-{}", std::process::id())).join("costs.toml");
        let table = CostTable::shipped();
        table.save(&path).unwrap();
        assert_eq!(CostTable::load(&path).unwrap(), table);
        std::fs::write(&path, "machine = 3").unwrap();
        let refusal = CostTable::load(&path).unwrap_err().to_string();
        assert!(refusal.contains("costs.toml: TOML parse error"), "{refusal}");
        std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
    }
}
