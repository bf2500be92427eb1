//! A step of bodies that are [led](super::lead): what it is made of.

use super::Simulation;
use super::answer::ContactScales;
use super::cluster::Cluster;
use super::lasting::{Held, Part};
use crate::contact::rest::Hold;
use crate::freedom::Chart;
use crate::integrator::Segment;
use crate::math::sum::Time;
use crate::state::{BodyMotion, Moment};
use smallvec::SmallVec;

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

/// The numbers of one body's flight, or their rates.
pub(super) type Coordinates = SmallVec<[f64; 13]>;

/// A body that is led, in the numbers of its flight.
pub(super) struct Numbers {
    pub(super) place: usize,
    pub(super) lane: usize,
    pub(super) chart: Chart,
    pub(super) y: Coordinates,
}

/// Where a step starts, whatever its length.
pub(super) struct Start<'a> {
    pub(super) cluster: &'a Cluster,
    pub(super) part: &'a Part,
    pub(super) scales: &'a ContactScales,
    pub(super) time: Time,
    pub(super) led: Vec<Numbers>,
    /// Gap of each contact of the part [m].
    pub(super) gaps: Vec<f64>,
}

/// What the contacts do in a stage of a step, and the rates of the numbers.
pub(super) struct Stage {
    pub(super) held: Held,
    pub(super) rates: Vec<Coordinates>,
    /// Power of friction, and of bodies on prescribed motions [W].
    pub(super) power: [f64; 2],
}

/// A step before its gaps and contact speeds are put right.
pub(super) struct Predicted {
    pub(super) h: f64,
    pub(super) kind: Kind,
    pub(super) k0: Vec<Coordinates>,
    pub(super) y1: Vec<Coordinates>,
    /// Motions of the cluster's bodies at its end.
    pub(super) motions: Vec<BodyMotion>,
    pub(super) heat: Passed,
    pub(super) work: Passed,
    /// What each contact does at its start.
    pub(super) starts: Vec<Hold>,
    /// What the contacts do at its end.
    pub(super) held: Held,
    /// Which contacts had an impulse, where it was taken by impulses.
    pub(super) pushed: Vec<bool>,
}

/// The end of a step of one body, with the rates at both ends.
pub(super) struct End {
    pub(super) k0: Coordinates,
    pub(super) y1: Coordinates,
    pub(super) k1: Coordinates,
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
    /// Whether a contact is let go in it.
    pub(super) lets_go: bool,
}

impl Predicted {
    /// Whether a contact that carries at the start is let go at the end, or one that sticks slides.
    pub(super) fn lets_go(&self) -> bool {
        self.starts.iter().zip(&self.held.rest.holds).any(|hold| {
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
        y: &[Coordinates],
        at: (Time, f64),
    ) -> Vec<BodyMotion> {
        let mut motions = cluster.motions.clone();
        self.move_to(cluster, led, y, at, &mut motions);
        motions
    }

    /// Moves the bodies that are led, and those on prescribed motions, among a cluster's motions.
    fn move_to(
        &self,
        cluster: &Cluster,
        led: &[Numbers],
        y: &[Coordinates],
        (start, after): (Time, f64),
        motions: &mut [BodyMotion],
    ) {
        for (&body, motion) in cluster.bodies.iter().zip(&mut *motions) {
            if let Some(prescribed) = &self.body(body).motion {
                *motion = prescribed.at(&self.body(body).start, start + after, start.value);
            }
        }
        for (n, y) in led.iter().zip(y) {
            n.chart.decode(y, &mut motions[n.place]);
        }
    }
}

/// The motions within a step, by the cubics through both of its ends.
pub(super) struct Within<'a> {
    simulation: &'a Simulation,
    start: &'a Start<'a>,
    segments: Vec<Segment>,
    y: Vec<Coordinates>,
    motions: Vec<BodyMotion>,
}

impl<'a> Within<'a> {
    pub(super) fn new(simulation: &'a Simulation, start: &'a Start<'a>, step: &Step) -> Self {
        let segment = |(n, end): (&Numbers, &End)| {
            let mut segment = Segment::default();
            let at = Moment { time: 0.0, since: 0.0 };
            segment.set_hermite(at, step.h, [&n.y, &end.k0, &end.y1, &end.k1]);
            segment
        };
        let segments = start.led.iter().zip(&step.ends).map(segment).collect();
        let y = start.led.iter().map(|n| n.y.clone()).collect();
        Self { simulation, start, segments, y, motions: start.cluster.motions.clone() }
    }

    /// The motions of the cluster's bodies at a time [s] after the start.
    pub(super) fn at(&mut self, s: f64) -> &[BodyMotion] {
        for (segment, y) in self.segments.iter().zip(&mut self.y) {
            segment.at_offset(s, y);
        }
        let Start { cluster, led, time, .. } = self.start;
        self.simulation.move_to(cluster, led, &self.y, (*time, s), &mut self.motions);
        &self.motions
    }
}
