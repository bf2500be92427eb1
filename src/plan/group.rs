//! The equations of motion of a flight group: Y′ = f(t, Y), lecture (24).

use super::Binding;
use crate::freedom::{Chart, Scales};
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
    numbers: std::marker::PhantomData<fn() -> Y>,
}

impl<Y> Group<Y> {
    /// Bodies with these coordinates; of `motions`, mass, inertia and what no coordinate moves stay.
    pub(crate) fn new(charts: Vec<Chart>, motions: Vec<BodyMotion>, bindings: Vec<Binding>) -> Self {
        let n = motions.len();
        Self {
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
            if binding.members.iter().copied().eq(0..self.motions.len()) {
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

    #[inline]
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

    #[inline]
    fn drift(&mut self, y: &Y, dy: &mut Y) {
        let (y, dy) = (y.as_ref(), dy.as_mut());
        let mut at = 0;
        for chart in &self.charts {
            let n = chart.dimension();
            chart.rate_unloaded(&y[at..at + n], &mut dy[at..at + n]);
            at += n;
        }
    }

    #[inline]
    fn correction(&self, y: &Y, dy: &mut Y) -> f64 {
        let (y, dy) = (y.as_ref(), dy.as_mut());
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in &self.charts {
            let n = chart.dimension();
            worst = worst.max(chart.correction(&y[at..at + n], &mut dy[at..at + n]));
            at += n;
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
