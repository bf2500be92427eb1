//! Which method a flight group gets, and the closed form where there is one.

use super::{Binding, FlightGroup, PlannedBody, series};
use crate::effect::{AnyEffect, Frame};
use crate::error::{Error, Result};
use crate::freedom::{Chart, Freedom};
use crate::integrator::Method;
use crate::integrator::exact::{Pull, Start};
use crate::math::Vector3;
use crate::scene::RunOptions;
use crate::state::{BodyMotion, Load};

impl FlightGroup {
    /// Chooses the group's method: the one asked for, or the closed form where there is one, else the
    /// implicit method where drag is stiff, a splitting where a conservative motion is long, power series where loads are
    /// simple and the tolerance is small, else Dop853.
    pub(super) fn choose_method(&mut self, bodies: &[PlannedBody], options: &RunOptions) -> Result<()> {
        let closed = self.closed_form(bodies);
        (self.method, self.why) = match (options.method, closed) {
            (None, Ok(())) => (Method::Exact, "no torque, and a force with a closed form".to_owned()),
            (None, Err(reason)) => match (self.stiff(bodies, options), self.long(bodies, options)) {
                (Some(why), _) => (Method::Radau5, why),
                (None, Some(why)) => (Method::Split6, why),
                (None, None) if self.short_series(options) => {
                    (Method::Taylor, format!("{reason} has no closed form, but a power series that is cheap"))
                }
                (None, None) => (Method::Dop853, format!("{reason} has no closed form")),
            },
            (Some(Method::Exact), Err(reason)) => {
                let reason = format!("exact: {reason} has no closed form; leave the method out, or name another");
                return Err(Error::refused("run: method", reason));
            }
            (Some(Method::Dmv), Err(reason)) => {
                let reason = format!("dmv: {reason} may turn it or depend on its motion; use split4 or dop853");
                return Err(Error::refused("run: method", reason));
            }
            (Some(method), _) => (method, "as asked for".to_owned()),
        };
        let without = self.bindings.iter().find(|binding| !series::has_series(&binding.effect));
        if let (Method::Taylor, Some(binding)) = (self.method, without) {
            let reason = format!(
                "taylor: the load of {} on {} is no power series; leave the method out, or name dop853",
                binding.effect.name(),
                bodies[self.members[binding.members[0]]].name
            );
            return Err(Error::refused("run: method", reason));
        }
        let moving = self.bindings.iter().find(|binding| binding.effect.as_effect().depends_on_velocity());
        if let (Method::Dmv, Some(binding)) = (self.method, moving) {
            let reason =
                format!("dmv: the load of {} depends on velocities; use exact or dop853", binding.effect.name());
            return Err(Error::refused("run: method", reason));
        }
        if let (true, Some(binding)) = (self.method.needs_positional_loads(), moving) {
            let reason = format!(
                "{}: the load of {} depends on velocities, which leaves it order 4; use split4 or dop853",
                self.method,
                binding.effect.name()
            );
            return Err(Error::refused("run: method", reason));
        }
        Ok(())
    }

    /// Whether the motion has a closed form; else what stands against it.
    fn closed_form(&self, bodies: &[PlannedBody]) -> std::result::Result<(), String> {
        for (place, &index) in self.members.iter().enumerate() {
            let body = &bodies[index];
            for binding in self.bindings.iter().filter(|binding| binding.members.contains(&place)) {
                let closed = match (binding.effect.as_ref(), &body.freedom) {
                    (AnyEffect::UniformGravity(_), Freedom::Free | Freedom::Planar(_)) => true,
                    (AnyEffect::Drag(drag), Freedom::Free) => {
                        drag.quadratic == 0.0 && drag.angular_linear == 0.0 && drag.angular_quadratic == 0.0
                    }
                    _ => false,
                };
                if !closed {
                    return Err(format!("{} on {}", binding.effect.name(), body.name));
                }
            }
        }
        Ok(())
    }

    /// Whether drag wears motion off so much faster than the span that it would dictate an explicit step.
    fn stiff(&self, bodies: &[PlannedBody], options: &RunOptions) -> Option<String> {
        let [start, end] = options.t_span?;
        let mut fastest = (0.0, "");
        for binding in &self.bindings {
            let AnyEffect::Drag(drag) = binding.effect.as_ref() else { continue };
            for &place in &binding.members {
                let body = &bodies[self.members[place]];
                let (speed, turning) = (body.start.velocity.norm(), body.start.angular_velocity.norm());
                let slowing = (drag.linear + drag.quadratic * speed) / body.start.mass;
                let despinning =
                    (drag.angular_linear + drag.angular_quadratic * turning) * body.properties.inv_inertia().norm();
                let rate = if body.fixed { 0.0 } else { slowing.max(despinning) };
                if rate > fastest.0 {
                    fastest = (rate, body.name.as_str());
                }
            }
        }
        let (rate, name) = fastest;
        (rate * (end - start) > STIFF).then(|| format!("drag stops {name} within {:.1e} s", 1.0 / rate))
    }

    /// Whether the motion is conservative, and so long and wanted so exactly that a method pays which keeps the
    /// energy: its error grows with time, that of others with its square.
    fn long(&self, bodies: &[PlannedBody], options: &RunOptions) -> Option<String> {
        let [start, end] = options.t_span?;
        let positional = |binding: &Binding| {
            let effect = binding.effect.as_effect();
            effect.conservative() && !effect.depends_on_velocity() && !matches!(*binding.effect, AnyEffect::User(_))
        };
        let exact = options.tolerance.is_some_and(|tolerance| tolerance <= LONG_TOLERANCE);
        if !exact || self.meets || !self.bindings.iter().all(positional) {
            return None;
        }
        let fastest = self.members.iter().map(|&i| bodies[i].start.angular_velocity.norm()).fold(0.0, f64::max);
        let turns = fastest * (end - start) / std::f64::consts::TAU;
        (turns >= LONG_TURNS).then(|| format!("conservative loads over {turns:.0} turns"))
    }

    /// Whether power series are cheapest: loads that stay in the world or in the body, or follow its velocities, and a
    /// small tolerance. Where bodies may meet, shorter steps are looked through faster.
    fn short_series(&self, options: &RunOptions) -> bool {
        let simple = |binding: &Binding| match binding.effect.as_ref() {
            AnyEffect::Wrench(wrench) => {
                wrench.angular_frequency.is_none() && (wrench.frame == Frame::Body || wrench.point.is_none())
            }
            AnyEffect::PointGravity(_) => false,
            effect => series::has_series(effect),
        };
        let small = options.tolerance.is_some_and(|tolerance| tolerance <= SERIES_TOLERANCE);
        small && !self.meets && self.bindings.iter().all(simple)
    }

    /// What acts on the translation of a member, where it has a closed form.
    pub(super) fn pull(&self, place: usize, mass: f64) -> Pull {
        let (mut acceleration, mut drag, mut carried) = (Vector3::zeros(), 0.0, Vector3::zeros());
        for binding in self.bindings.iter().filter(|binding| binding.members.contains(&place)) {
            match binding.effect.as_ref() {
                AnyEffect::UniformGravity(gravity) => acceleration += Vector3::from(gravity.acceleration),
                AnyEffect::Drag(air) => {
                    drag += air.linear / mass;
                    carried += air.linear / mass * Vector3::from(air.wind);
                }
                _ => {}
            }
        }
        let wind = if drag > 0.0 { carried / drag } else { Vector3::zeros() };
        Pull { acceleration, drag, wind }
    }

    /// The closed motions of the group's bodies from these motions on.
    pub(super) fn starts(&self, charts: &[Chart], motions: &[BodyMotion]) -> Vec<Start> {
        // what pulls at a compound pulls at every part alike
        let part = charts.iter().position(|chart| matches!(chart, Chart::Riding(_)));
        let start = |(place, (chart, motion)): (usize, (&Chart, &BodyMotion))| match chart {
            Chart::Fixed | Chart::Riding(_) => Start::Fixed,
            Chart::Free(_) => Start::Free { motion: *motion, pull: self.pull(part.unwrap_or(place), motion.mass) },
            Chart::Pivot(pivot) => {
                let mut y = [0.0; 7];
                chart.encode(&motion.state(), &mut y);
                let momentum = Vector3::new(y[4], y[5], y[6]);
                Start::Pivot { inertia: pivot.inertia(motion), orientation: motion.orientation, momentum }
            }
            Chart::Planar(_) | Chart::Axle(_) => {
                // the loads are constant, and the rate without loads is linear in the momenta
                let zeros = vec![0.0; chart.dimension()];
                let (mut y, mut slope, mut bend) = (zeros.clone(), zeros.clone(), zeros);
                chart.encode(&motion.state(), &mut y);
                let force = motion.mass * self.pull(place, motion.mass).acceleration;
                let load = Load { force, torque: Vector3::zeros() };
                chart.rate(&y, motion, &load, &mut slope);
                chart.rate_unloaded(&slope, &mut bend);
                Start::Line { y, slope, bend }
            }
        };
        charts.iter().zip(motions).enumerate().map(start).collect()
    }
}

/// Tolerance from which on power series are cheaper than Dop853 where loads are simple [-]. Measured, time over that of
/// Dop853, without and with the estimate: a heavy top 0.91 and 1.17 at 1e-8, 0.81 and 1.00 at 1e-9, 0.56 and 0.70 at
/// 1e-11; a body with an engine and drag 0.78 and 0.84, 0.71 and 0.72, 0.53 and 0.57. Under a swinging wrench they get
/// even at 1e-11, around a point that attracts beyond 1e-12.
const SERIES_TOLERANCE: f64 = 1.0e-9;
/// Times that drag stops a body within the span above which the implicit method is cheaper [-]: an explicit
/// step of order 8 is stable up to some 6 of them, and an implicit step costs as much as some 20.
const STIFF: f64 = 2.0e4;
/// Turns of the fastest body from which the splitting of order 6 is cheaper than Dop853 for a conservative motion, at
/// a tolerance of [`LONG_TOLERANCE`] or less [-]. Measured on a heavy top at 1e-9, seconds with the estimate: 1,500
/// turns 0.50 against 0.84, 3,000 turns 2.4 against 2.1, 6,400 turns 15 (and the tolerance missed) against 3.2; at
/// 1e-6 Dop853 wins in all of them.
const LONG_TURNS: f64 = 3.0e3;
/// See [`LONG_TURNS`] [-].
const LONG_TOLERANCE: f64 = 2.0e-9;
