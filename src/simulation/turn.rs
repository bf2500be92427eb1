//! Kinks of loads: drag in proportion to |v| v at the turn of a motion.
//!
//! A step that holds a kink has an error of third order, whatever the method. So a step over one is taken
//! back, and taken again up to the kink. Its place is told from the motion of the bad step, so it is corrected
//! as long as a step still holds it.

use super::Lane;
use crate::integrator::{Front, Segment};
use crate::math::Vector3;
use crate::plan::FlightGroup;
use crate::state::BodyMotion;

/// A front that a step can be taken back to, and the vectors whose zeros are kinks.
pub(super) struct Begin {
    front: Front<Vec<f64>>,
    kinks: Vec<Vector3>,
}

/// Most corrections of one kink [-]; each leaves an error of third order in the one before.
pub(super) const CORRECTIONS: u32 = 4;
/// Rounds of bisection [-]: to the rounding of the step.
const ROUNDS: u32 = 52;
/// Part of a step at its ends in which a kink is left alone [-]: its error is of third order in this.
const END: f64 = 1.0e-6;

impl Lane {
    /// The vectors at the front, where there are any.
    pub(super) fn kinks_at_front(&self, spec: &FlightGroup) -> Option<Begin> {
        if !spec.has_kinks {
            return None;
        }
        let mut motions = self.motions.clone();
        self.flight.at(self.flight.front(), &mut motions);
        let mut kinks = Vec::new();
        spec.kinks(&motions, &mut kinks);
        Some(Begin { front: self.flight.saved_front(), kinks })
    }

    /// Whether a vector turned round within the step; then the step is taken back, to end at the first
    /// such instant when it is taken again.
    pub(super) fn found_kink(&mut self, spec: &FlightGroup, begin: &Begin) -> bool {
        let (mut motions, mut kinks) = (self.motions.clone(), Vec::new());
        let mut turned = |motions: &[BodyMotion]| {
            kinks.clear();
            spec.kinks(motions, &mut kinks);
            kinks.iter().zip(&begin.kinks).any(|(now, then)| now.dot(then) < 0.0)
        };
        self.flight.at(self.flight.front(), &mut motions);
        if !turned(&motions) {
            return false;
        }

        // the first instant at which any has turned, to rounding
        if self.flight.interpolate().is_err() {
            return false;
        }
        let h = self.flight.segment().length;
        let (mut before, mut after) = (0.0, h);
        for _ in 0..ROUNDS {
            let middle = 0.5 * (before + after);
            self.flight.at_offset(middle, &mut motions);
            if turned(&motions) {
                after = middle;
            } else {
                before = middle;
            }
        }
        if after < END * h || after > (1.0 - END) * h {
            return false;
        }
        let (start, kink) = (self.flight.segment().start, self.flight.segment().start + after);
        if kink <= start {
            return false; // no time lies between: a step up to it would not move on
        }
        let mut counts = *self.flight.counts();
        counts.steps -= 1;
        counts.rejected += 1;
        self.flight.resume(&begin.front, Segment::default(), counts);
        self.kink = Some(kink);
        self.corrections += 1;
        true
    }
}
