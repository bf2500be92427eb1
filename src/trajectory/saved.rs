//! A trajectory as data, in any format of serde that keeps every `f64`; JSON loses infinities.

use std::borrow::Cow;
use std::sync::Arc;

use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Event, Heat, Phase, Trajectory};
use crate::freedom::Chart;
use crate::plan::Plan;
use crate::report::Report;
use crate::scene::{RunOptions, Scene};
use crate::state::BodyState;

/// What is written. The plan follows from its scene and its options, and is compiled again.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Saved<'a> {
    scene: Cow<'a, Scene>,
    options: Cow<'a, RunOptions>,
    times: Cow<'a, [f64]>,
    states: Cow<'a, [BodyState]>,
    phases: Cow<'a, [Phase]>,
    events: Cow<'a, [Event]>,
    heat: Cow<'a, [Heat]>,
    work: Cow<'a, [Heat]>,
    report: Cow<'a, Report>,
    end: f64,
    ended_by: Option<Cow<'a, str>>,
}

impl Saved<'_> {
    /// Whether the numbers fit the plan.
    fn fits(&self, plan: &Plan) -> bool {
        let bodies = plan.bodies().len();
        let phase_fits = |phase: &Phase| {
            let n: usize = phase.charts.iter().map(Chart::dimension).sum();
            plan.groups().get(phase.group).is_some_and(|group| {
                let members = group.members.len() + usize::from(phase.has_parts());
                phase.charts.len() == members && phase.motions.len() == members
            }) && phase.segments.iter().all(|s| s.fits(n))
        };
        self.states.len() == self.times.len() * bodies
            && self.phases.iter().all(phase_fits)
            && self.events.iter().all(|event| event.bodies.iter().all(|&body| body < bodies))
    }
}

impl Serialize for Trajectory {
    /// Refuses the trajectory of a scene with user effects, which are code.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.plan.check_writable().map_err(S::Error::custom)?;
        let saved = Saved {
            scene: Cow::Borrowed(self.plan.scene()),
            options: Cow::Borrowed(self.plan.options()),
            times: Cow::Borrowed(&self.times),
            states: Cow::Borrowed(&self.states),
            phases: Cow::Borrowed(&self.phases),
            events: Cow::Borrowed(&self.events),
            heat: Cow::Borrowed(&self.heat),
            work: Cow::Borrowed(&self.work),
            report: Cow::Borrowed(&self.report),
            end: self.end,
            ended_by: self.ended_by.as_deref().map(Cow::Borrowed),
        };
        saved.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Trajectory {
    /// Refuses numbers that do not belong to the scene.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let saved = Saved::deserialize(deserializer)?;
        let plan = saved.scene.compile(&saved.options).map_err(D::Error::custom)?;
        if !saved.fits(&plan) {
            return Err(D::Error::custom("the trajectory does not belong to its scene"));
        }
        Ok(Self {
            plan: Arc::new(plan),
            times: saved.times.into_owned(),
            states: saved.states.into_owned(),
            phases: saved.phases.into_owned(),
            events: saved.events.into_owned(),
            heat: saved.heat.into_owned(),
            work: saved.work.into_owned(),
            report: saved.report.into_owned(),
            end: saved.end,
            ended_by: saved.ended_by.map(Cow::into_owned),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Body, Cuboid, HalfSpace, Response, UniformGravity};

    /// A die that is thrown on a sticky table, so that there are events and two phases.
    fn run() -> Trajectory {
        let mut scene = Scene::new();
        scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
        scene.add(Body::new("table", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed()).unwrap();
        let die = Body::new("die", Cuboid::new([0.01; 3])).density(1200.0).response(Response::Stick);
        scene.add(die.position([0.0, 0.0, 0.1]).angular_velocity([1.0, 2.0, 3.0])).unwrap();
        scene.run(0.0..0.3, &RunOptions::tolerance(1e-8)).unwrap()
    }

    #[test]
    fn a_trajectory_reads_back_equal_and_answers_the_same() {
        let run = run();
        assert_eq!(run.events().len(), 1);
        let back: Trajectory = serde_json::from_str(&serde_json::to_string(&run).unwrap()).unwrap();
        assert_eq!(back, run);
        for t in [0.0, 0.05, 0.14, 0.2, 0.3] {
            assert_eq!(back.at(t).unwrap(), run.at(t).unwrap());
        }
        assert_eq!(back.energy().unwrap(), run.energy().unwrap());
    }

    #[test]
    fn numbers_that_do_not_belong_to_the_scene_are_refused() {
        let mut value = serde_json::to_value(run()).unwrap();
        value["times"].as_array_mut().unwrap().pop();
        let error = serde_json::from_value::<Trajectory>(value).unwrap_err();
        assert!(error.to_string().contains("does not belong to its scene"), "{error}");
    }
}
