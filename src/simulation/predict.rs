//! What a run is predicted to take.

use std::fmt::Write;

use super::clock::thread_seconds;
use super::run::Pace;
use crate::effect::AnyEffect;
use crate::integrator::{Control, Method};
use crate::plan::cost::{BodyKind, CostTable};
use crate::plan::{Binding, Plan};
use crate::scene::{Record, Span};
use crate::text::short;

/// Steps and time of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Steps of the run whose result is kept [-].
    pub steps: f64,
    /// Time of that run [s].
    pub run: f64,
    /// Time of the runs from which its error is estimated [s].
    pub estimate: f64,
}

/// Most steps of a probe [-].
const PROBE: u32 = 256;
/// Fewest steps of a probe, and the least part of the span that it covers [-].
const PROBE_LEAST: (u32, f64) = (16, 1.0 / 64.0);

impl Plan {
    /// What a run over a span takes by these costs, if its first try keeps the tolerance. Where the steps follow the
    /// error, a few are taken to see how long they are; where a function of the user has its own price, to see what they
    /// take. None where contacts cannot be foreseen, and where a step breaks off.
    pub fn predict(&self, span: impl Into<Span>, costs: &CostTable) -> Option<Prediction> {
        let span = span.into();
        let options = self.options();
        let mut prediction = Prediction { steps: 0.0, run: 0.0, estimate: 0.0 };
        for (index, group) in self.groups().iter().enumerate() {
            if group.meets {
                return None;
            }
            if group.method == Method::Exact {
                continue;
            }
            let control = match (options.step, self.tolerance()) {
                (Some(step), _) => Control::Step(step),
                (None, tolerance) => Pace::first(self, span, tolerance?).control,
            };
            let calls_user = |binding: &Binding| matches!(binding.effect.as_ref(), AnyEffect::User(_));
            let calls_user = group.bindings.iter().any(calls_user);
            let (first, timed) = match control {
                Control::Step(step) if !calls_user => ((span.end - span.start) / step, None),
                control => {
                    let (steps, seconds) = self.probe(index, span, &control)?;
                    (steps, calls_user.then_some(seconds))
                }
            };

            // with a step the estimate takes half of them; to a tolerance the result takes four times as many as
            // the first of three runs, and the others three times
            let (run, estimate) = match (options.estimate, options.step) {
                (false, _) => (1.0, 0.0),
                (true, Some(_)) => (1.0, 0.5),
                (true, None) => (4.0, 3.0),
            };
            let kind = BodyKind::of(group, self.bodies());
            let moving = group.members.iter().filter(|&&i| !self.bodies()[i].fixed).count() as f64;
            let priced = |kept| Some(costs.step(group.method, kind, kept)? * moving * self.effort(group.method));
            let kept = options.record == Record::Dense;
            let step = match timed {
                // the motion of the steps that were timed was not kept
                Some(seconds) if kept => seconds + (priced(true)? - priced(false)?).max(0.0),
                Some(seconds) => seconds,
                None => priced(kept)?,
            };
            prediction.steps += run * first;
            prediction.run += run * first * step;
            prediction.estimate += estimate * first * step;
        }
        Some(prediction)
    }

    /// Steps that the first try takes in a group, and the time of one [s], by taking some.
    fn probe(&self, group: usize, span: Span, control: &Control) -> Option<(f64, f64)> {
        let length = span.end - span.start;
        let mut flight = self.flight(group, span.start, control).ok()?;
        let (mut steps, began) = (0, thread_seconds());
        while flight.front() < span.end && steps < PROBE {
            flight.advance(span.end).ok()?;
            steps += 1;
            if steps >= PROBE_LEAST.0 && flight.front() - span.start >= PROBE_LEAST.1 * length {
                break;
            }
        }
        let taken = thread_seconds() - began;
        Some((f64::from(steps) * length / (flight.front() - span.start), taken / f64::from(steps)))
    }

    /// [`explain`](Self::explain), and what a run over the span of the options is predicted to take by these costs.
    pub fn explain_priced(&self, costs: &CostTable) -> String {
        let mut text = self.explain();
        let Some(span) = self.options().t_span else { return text };
        // writing to a string cannot fail
        let _ = match self.predict(span, costs) {
            Some(Prediction { steps: 0.0, .. }) => write!(text, "\n  predicted  no steps"),
            Some(Prediction { steps, run, estimate }) => write!(
                text,
                "\n  predicted  {} steps, {} s run, {} s estimate ({})",
                short(libm::round(steps)),
                short(run),
                short(estimate),
                costs.machine
            ),
            None if self.groups().iter().any(|group| group.meets) => {
                write!(text, "\n  predicted  nothing: contacts are not foreseen")
            }
            None => write!(text, "\n  predicted  nothing: a step breaks off"),
        };
        text
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::*;
    use crate::catalogue;
    use crate::effect::UserEffect;
    use crate::math::Vector3;
    use crate::scene::RunOptions;

    #[test]
    fn what_bodies_that_meet_will_take_is_not_predicted() {
        let options = RunOptions { t_span: Some([0.0, 1.0]), ..RunOptions::tolerance(1e-6) };
        let plan = catalogue::scene("bouncing_die").unwrap().unwrap().compile(&options).unwrap();
        assert_eq!(plan.predict(0.0..1.0, &CostTable::shipped()), None);
        assert!(plan.explain_priced(&CostTable::shipped()).ends_with("predicted  nothing: contacts are not foreseen"));
    }

    #[test]
    fn steps_that_call_the_user_are_taken_to_see_what_they_take() {
        let mut scene = catalogue::scene("heavy_top").unwrap().unwrap();
        let span = scene.run.t_span.unwrap();
        let called = Arc::new(AtomicU32::new(0));
        let counter = called.clone();
        scene.add_effect(UserEffect::new(move |_, bodies| {
            counter.fetch_add(1, Ordering::Relaxed);
            Ok(vec![(Vector3::zeros(), Vector3::zeros()); bodies.len()])
        }));
        let options = [
            RunOptions { t_span: Some(span), ..RunOptions::tolerance(1e-8) },
            RunOptions { t_span: Some(span), ..RunOptions::method(Method::Rk4).step((span[1] - span[0]) / 1000.0) },
        ];
        for options in options {
            let plan = scene.compile(&options).unwrap();
            called.store(0, Ordering::Relaxed);
            let predicted = plan.predict(span, &CostTable::shipped()).unwrap();
            assert!(called.load(Ordering::Relaxed) >= 16, "{options:?}: not called");
            assert!(predicted.run > 0.0 && predicted.estimate > 0.0, "{predicted:?}");
            let ratio = predicted.steps / plan.run(span).unwrap().report().counts.steps as f64;
            assert!((0.5..2.0).contains(&ratio), "{options:?}: {ratio:.2} times what was taken, {predicted:?}");
        }

        scene.add_effect(UserEffect::new(|_, _| Err("no".into())));
        let plan = scene.compile(&RunOptions { t_span: Some(span), ..RunOptions::tolerance(1e-8) }).unwrap();
        assert!(plan.explain_priced(&CostTable::shipped()).ends_with("predicted  nothing: a step breaks off"));
    }

    #[test]
    fn the_steps_predicted_are_those_that_are_taken_within_a_factor_of_two() {
        for name in ["heavy_top", "thrown_ball", "spinning_book"] {
            let scene = catalogue::scene(name).unwrap().unwrap();
            let span = scene.run.t_span.unwrap();
            let ways = [
                RunOptions { t_span: Some(span), ..RunOptions::tolerance(1e-8) },
                RunOptions { t_span: Some(span), estimate: false, ..RunOptions::tolerance(1e-8) },
                RunOptions { t_span: Some(span), ..RunOptions::method(Method::Rk4).step((span[1] - span[0]) / 1000.0) },
            ];
            for options in ways {
                let plan = scene.compile(&options).unwrap();
                let predicted = plan.predict(span, &CostTable::shipped()).unwrap();
                let taken = plan.run(span).unwrap().report().counts.steps as f64;
                // a closed form has no steps, but the one that the run looks at it in
                let ratio = (predicted.steps + 1.0) / taken;
                assert!((0.5..2.0).contains(&ratio), "{name}, {options:?}: {predicted:?}, taken {taken}");
                assert!(plan.explain_priced(&CostTable::shipped()).contains("\n  predicted  "));
            }
        }
    }
}
