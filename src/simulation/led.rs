//! The flight of a body that is [led](super::lead).

use super::Lane;
use crate::freedom::Chart;
use crate::integrator::{Counts, Flight, FlightError, Front, Segment};
use crate::math::sum::Time;
use crate::state::BodyMotion;
use crate::trajectory::decode;

/// The flight of a lane whose steps are taken together with those of other bodies.
#[derive(Debug)]
pub(super) struct Led {
    charts: Vec<Chart>,
    front: Front<Vec<f64>>,
    segment: Segment,
    counts: Counts,
}

impl Led {
    /// A flight that stands at `t` [s] with these motions.
    pub(super) fn new(charts: Vec<Chart>, t: Time, motions: &[BodyMotion]) -> Self {
        let mut y = vec![0.0; charts.iter().map(Chart::dimension).sum()];
        let mut at = 0;
        for (chart, motion) in charts.iter().zip(motions) {
            chart.encode(&motion.state(), &mut y[at..at + chart.dimension()]);
            at += chart.dimension();
        }
        let rest = vec![0.0; y.len()];
        let front = Front { time: t, since: t.value, y, rest };
        Self { charts, front, segment: Segment::default(), counts: Counts::default() }
    }
}

impl Flight for Led {
    fn front(&self) -> f64 {
        self.front.time.value
    }

    /// Never asked for: its steps are taken by [`Simulation::lead`].
    fn advance(&mut self, limit: f64) -> Result<(), FlightError> {
        Err(FlightError::StepTooShort(limit - self.front.time.value))
    }

    fn interpolate(&mut self) -> Result<(), FlightError> {
        Ok(())
    }

    fn segment(&self) -> &Segment {
        &self.segment
    }

    fn at(&self, t: f64, motions: &mut [BodyMotion]) {
        if self.segment.dimension == 0 || t >= self.front.time.value {
            return decode(&self.charts, &self.front.y, motions);
        }
        self.at_offset(t - self.segment.start, motions);
    }

    fn at_offset(&self, offset: f64, motions: &mut [BodyMotion]) {
        let mut y = vec![0.0; self.front.y.len()];
        self.segment.at_offset(offset, &mut y);
        decode(&self.charts, &y, motions);
    }

    fn cut(&mut self, offset: f64) {
        let start = Time::new(self.segment.start);
        self.segment.at_offset(offset, &mut self.front.y);
        self.front.time = start + offset;
        self.segment.end = self.front.time.value;
    }

    fn set_clock(&mut self, time: Time, since: f64) {
        (self.front.time, self.front.since) = (time, since);
    }

    fn pass_switch(&mut self) -> Result<(), FlightError> {
        self.front.since = self.front.time.value;
        Ok(())
    }

    fn counts(&self) -> &Counts {
        &self.counts
    }

    fn clock(&self) -> (Time, f64) {
        (self.front.time, self.front.since)
    }

    fn saved_front(&self) -> Front<Vec<f64>> {
        self.front.clone()
    }

    fn resume(&mut self, front: &Front<Vec<f64>>, segment: Segment, counts: Counts) {
        self.front = front.clone();
        self.segment = segment;
        self.counts = counts;
    }
}

impl Lane {
    /// Whether its steps are taken together with those of other bodies.
    pub(super) fn is_led(&self) -> bool {
        self.led.is_some()
    }
}
