//! A step of bodies that are [led](super::lead): what it is made of.

use super::Simulation;
use super::cluster::Cluster;
use crate::contact::rest::Hold;
use crate::freedom::Chart;
use crate::math::sum::Time;
use crate::state::BodyMotion;

/// How a step is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// By the method of Runge and Kutta.
    Explicit,
    /// By the same where friction opposes the way in which a slow slip began, not the slip: for one that goes straight on.
    Straight,
    /// By one plastic impact of what the loads give in the step, so that friction opposes the slip at its end,
    /// whose direction is stiff where the slip is slow.
    Implicit,
}

/// How fast the contacts of a part slide, by what friction changes in a step: a direction that it can turn
/// round is stiff.
pub(super) enum Slips {
    /// Faster, or about to stop.
    Fast,
    /// Slower, and ever more so; in a step of this length [s] it is not.
    Dying(f64),
    /// Slower, and about to be faster.
    Beginning,
}

/// A body that is led, in the numbers of its flight.
pub(super) struct Numbers {
    pub(super) place: usize,
    pub(super) lane: usize,
    pub(super) chart: Chart,
    pub(super) y: Vec<f64>,
}

/// The end of a step of one body, with the rates at both ends.
pub(super) struct End {
    pub(super) k0: Vec<f64>,
    pub(super) y1: Vec<f64>,
    pub(super) k1: Vec<f64>,
}

/// Energy that passes in a step [J], and its power at both ends [W].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Passed {
    pub(super) joules: f64,
    pub(super) power: [f64; 2],
}

/// A step of a part.
pub(super) struct Step {
    pub(super) h: f64,
    pub(super) kind: Kind,
    pub(super) ends: Vec<End>,
    /// Motions of the cluster's bodies at its end.
    pub(super) motions: Vec<BodyMotion>,
    /// Heat of friction, and work of bodies on prescribed motions.
    pub(super) heat: Passed,
    pub(super) work: Passed,
    /// The contacts that carry at its end, as places in the cluster's list.
    pub(super) carrying: Vec<usize>,
    /// What each contact does at its start and at its end.
    pub(super) holds: [Vec<Hold>; 2],
}

impl Step {
    /// Whether a contact that carries at the start is let go at the end, or one that sticks slides.
    pub(super) fn lets_go(&self) -> bool {
        let [starts, ends] = &self.holds;
        starts.iter().zip(ends).any(|hold| {
            matches!(hold, (Hold::Stick, Hold::Slide(_) | Hold::Separate) | (Hold::Slide(_), Hold::Separate))
        })
    }
}

impl Simulation {
    /// The motions of a cluster's bodies at a time [s] after the start of a step: of those that are led by their
    /// numbers, of those on prescribed motions with the velocity that they have in it.
    pub(super) fn stage(
        &self,
        cluster: &Cluster,
        led: &[Numbers],
        y: &[Vec<f64>],
        (start, after): (Time, f64),
    ) -> Vec<BodyMotion> {
        let mut motions = cluster.motions.clone();
        for (&body, motion) in cluster.bodies.iter().zip(&mut motions) {
            if let Some(prescribed) = &self.body(body).motion {
                *motion = prescribed.at(&self.body(body).start, start + after, start.value);
            }
        }
        for (n, y) in led.iter().zip(y) {
            n.chart.decode(y, &mut motions[n.place]);
        }
        motions
    }
}
