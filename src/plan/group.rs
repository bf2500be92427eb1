//! The equations of motion of a flight group: Y′ = f(t, Y), lecture (24).

use super::Binding;
use crate::freedom::{Chart, RotationSplit, Scales};
use crate::integrator::{Problem, StateVector};
use crate::state::{BodyMotion, Load, Moment};

/// Bodies with their coordinates and what acts on them.
///
/// ```text
/// y ──charts──▶ motions ──effects──▶ loads ──charts──▶ y′
/// ```
#[derive(Debug)]
pub struct Group<Y> {
    charts: Vec<Chart>,
    bindings: Vec<Binding>,
    motions: Vec<BodyMotion>,
    loads: Vec<Load>,
    /// What an effect on some of the bodies is shown.
    shown: Vec<BodyMotion>,
    shown_loads: Vec<Load>,
    depends_on_velocity: bool,
    numbers: std::marker::PhantomData<fn() -> Y>,
}

impl<Y> Group<Y> {
    /// Bodies with these coordinates; of `motions`, mass, inertia and what no coordinate moves stay.
    pub(crate) fn new(charts: Vec<Chart>, motions: Vec<BodyMotion>, bindings: Vec<Binding>) -> Self {
        let n = motions.len();
        let depends_on_velocity = bindings.iter().any(|binding| binding.effect.as_effect().depends_on_velocity());
        Self {
            depends_on_velocity,
            charts,
            bindings,
            motions,
            loads: vec![Load::zero(); n],
            shown: Vec::with_capacity(n),
            shown_loads: Vec::with_capacity(n),
            numbers: std::marker::PhantomData,
        }
    }

    /// Reads the motion of every body from the numbers.
    fn decode_into(charts: &[Chart], y: &[f64], motions: &mut [BodyMotion]) {
        let mut at = 0;
        for (chart, motion) in charts.iter().zip(motions) {
            let n = chart.dimension();
            chart.decode(&y[at..at + n], motion);
            at += n;
        }
    }

    /// What holds each body in its freedom, the motions being as they were given.
    pub(crate) fn reactions(&mut self, at: Moment) -> Vec<Load> {
        self.add_loads(at);
        let bodies = self.charts.iter().zip(&self.motions).zip(&self.loads);
        bodies.map(|((chart, motion), load)| chart.reaction(motion, load)).collect()
    }

    /// Loads of all effects on the motions as they stand.
    fn add_loads(&mut self, at: Moment) {
        self.loads.fill(Load::zero());
        for binding in &self.bindings {
            let effect = binding.effect.as_effect();
            if binding.members.len() == self.motions.len() && binding.in_order {
                effect.add_to(at, &self.motions, &mut self.loads);
                continue;
            }

            // an effect on some of the bodies sees just these
            self.shown.clear();
            self.shown.extend(binding.members.iter().map(|&i| self.motions[i]));
            self.shown_loads.clear();
            self.shown_loads.resize(binding.members.len(), Load::zero());
            effect.add_to(at, &self.shown, &mut self.shown_loads);
            for (&i, load) in binding.members.iter().zip(&self.shown_loads) {
                self.loads[i].force += load.force;
                self.loads[i].torque += load.torque;
            }
        }
    }
}

impl<Y: StateVector> Problem for Group<Y> {
    type Y = Y;

    fn dimension(&self) -> usize {
        self.charts.iter().map(Chart::dimension).sum()
    }

    fn bodies(&self) -> usize {
        self.charts.len()
    }

    #[inline(always)]
    fn rate(&mut self, at: Moment, y: &Y, dy: &mut Y) {
        if self.bindings.is_empty() {
            return self.drift(y, dy);
        }
        Self::decode_into(&self.charts, y.as_ref(), &mut self.motions);
        self.add_loads(at);
        let (y, dy) = (y.as_ref(), dy.as_mut());
        let mut at = 0;
        for ((chart, motion), load) in self.charts.iter().zip(&self.motions).zip(&self.loads) {
            let n = chart.dimension();
            chart.rate(&y[at..at + n], motion, load, &mut dy[at..at + n]);
            at += n;
        }
    }

    #[inline(always)]
    fn drift(&mut self, y: &Y, dy: &mut Y) {
        let (y, dy) = (y.as_ref(), dy.as_mut());
        let mut at = 0;
        for chart in &self.charts {
            let n = chart.dimension();
            chart.rate_unloaded(&y[at..at + n], &mut dy[at..at + n]);
            at += n;
        }
    }

    fn is_loaded(&self) -> bool {
        !self.bindings.is_empty()
    }

    fn depends_on_velocity(&self) -> bool {
        self.depends_on_velocity
    }

    #[inline]
    fn flow(&mut self, y: &mut Y, rest: &mut Y, h: f64, split: RotationSplit) {
        let (y, rest, mut at) = (y.as_mut(), rest.as_mut(), 0);
        for chart in &self.charts {
            let n = chart.dimension();
            chart.flow(&mut y[at..at + n], &mut rest[at..at + n], h, split);
            at += n;
        }
    }

    #[inline]
    fn to_generator(&self, y: &Y, k: &mut Y) {
        let (y, k, mut at) = (y.as_ref(), k.as_mut(), 0);
        for chart in &self.charts {
            if let Some((part, spin)) = chart.spin_part(at) {
                spin.to_generator(&y[part.clone()], &mut k[part]);
            }
            at += chart.dimension();
        }
    }

    #[inline]
    fn act(&self, y: &mut Y, h: f64, v: &Y) {
        let (y, v, mut at) = (y.as_mut(), v.as_ref(), 0);
        for chart in &self.charts {
            let end = at + chart.dimension();
            let part = chart.spin_part(at);
            let straight = part.as_ref().map_or(end, |(part, _)| part.start);
            for i in at..straight {
                y[i] += h * v[i];
            }
            if let Some((part, spin)) = part {
                spin.act(&mut y[part.clone()], h, &v[part]);
            }
            at = end;
        }
    }

    #[inline]
    fn add_bracket(&self, c: f64, a: &mut Y, b: &Y) {
        let (a, b, mut at) = (a.as_mut(), b.as_ref(), 0);
        for chart in &self.charts {
            if let Some((part, spin)) = chart.spin_part(at) {
                spin.add_bracket(c, &mut a[part.clone()], &b[part]);
            }
            at += chart.dimension();
        }
    }

    #[inline(always)]
    fn project(&mut self, y: &mut Y, rest: &mut Y) -> f64 {
        let (y, rest) = (y.as_mut(), rest.as_mut());
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in &self.charts {
            let part = at..at + chart.dimension();
            worst = worst.max(chart.project(&mut y[part.clone()], &mut rest[part.clone()]));
            at = part.end;
        }
        worst
    }

    fn orientation_error(&self, y: &Y) -> f64 {
        let y = y.as_ref();
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in &self.charts {
            let part = at..at + chart.dimension();
            worst = worst.max(chart.orientation_error(&y[part.clone()]));
            at = part.end;
        }
        worst
    }

    #[inline]
    fn error_size(&self, y0: &Y, y1: &Y, e: &Y, scales: &Scales) -> f64 {
        let (y0, y1, e) = (y0.as_ref(), y1.as_ref(), e.as_ref());
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in &self.charts {
            let part = at..at + chart.dimension();
            worst = worst.max(chart.error_size(&y0[part.clone()], &y1[part.clone()], &e[part.clone()], scales));
            at = part.end;
        }
        worst
    }

    fn decode(&self, y: &[f64], motions: &mut [BodyMotion]) {
        Self::decode_into(&self.charts, y, motions);
    }

    fn take_failure(&mut self) -> Option<String> {
        self.bindings.iter().find_map(|binding| binding.effect.as_effect().take_failure())
    }
}
