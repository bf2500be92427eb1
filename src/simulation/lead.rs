//! Bodies in contacts that last are led: they slide, roll and tip on each other, step by step.
//!
//! ```text
//! lead     a step of Runge and Kutta of order 4 with the contacts' forces in every stage, to its end or to the
//!          first instant at which a slip turns round or begins, a contact passes one of its walls or carries no
//!          more, or another point of a pair touches
//! ```
//!
//! After a step the gaps are what they were, and contacts that carry have no speed along their normals: what
//! the step's error of fifth order has left of either is taken away by the smallest displacement, and the
//! smallest impulse, which takes energy. Between the ends of a step the motion is the cubic through both.
//! Heat of friction is the integral of −f·u by the same stages.

use super::answer::ContactScales;
use super::cluster::Cluster;
use super::lasting::{Held, Part, Together, across, shift_by, tangents};
use super::step::{Coordinates, End, Kind, Numbers, Passed, Predicted, Slips, Stage, Start, Step, Within};
use super::{Failure, Simulation, SimulationError};
use crate::contact::anchor::Anchor;
use crate::contact::cluster::Contact;
use crate::contact::collision::{Law, collide};
use crate::contact::rest::{Hold, align};
use crate::integrator::{Control, FlightError, Front, Segment};
use crate::math::Vector3;
use crate::math::sum::Time;
use crate::state::{BodyMotion, Moment};
use crate::trajectory::Heat;

/// Length of a contact's step, in times that its loads take for its size, and in radians [-]. Smaller: errors of
/// sliding, rolling and tipping fall with its fourth power.
const STEP: f64 = 0.04;
/// How much faster than μ a friction may change a slip, at a corner far from the centre of mass [-].
const STIFF: f64 = 4.0;
/// Turn of a slip about the normal, in a step, up to which it counts as going straight on [rad].
const STRAIGHT: f64 = 1.0e-6;
/// How often a step is shortened for what happens within it [-]: a slip that ends, then a touch before it.
const SHORTER: usize = 8;
/// A step is short below this part of its length [-]; so many in a row are too many.
const SHORT: f64 = 1.0e-3;
const SHORTS: u32 = 10_000;
/// Halvings to an instant within a step [-]: to 1e-12 of it.
const HALVINGS: usize = 40;
/// Shortest step, in the rounding of the time and of a whole step [-]: what ends sooner ends after it. In a shorter one
/// the rounded times of its ends would lie outside of it, where its cubic means nothing.
const LEAST: f64 = 16.0;
/// A step this much shorter than the one before is the same [-].
const SAME: f64 = 1.0 - 1.0e-9;

impl Simulation {
    /// Leads a part of a cluster, which stands where its bodies are at `time`, through one step. Its lanes fly
    /// [`Led`](super::led::Led).
    pub(super) fn lead(
        &mut self,
        cluster: &Cluster,
        part: &Part,
        scales: &ContactScales,
        time: Time,
    ) -> Result<(), SimulationError> {
        let mut led = Vec::new();
        for &place in &part.places {
            let body = cluster.bodies[place];
            let Some((lane, member)) = self.places[body] else { continue };
            let flown = &self.lanes[lane];
            let shares = flown.spec.members.iter().filter(|&&i| !self.body(i).fixed).count() > 1;
            if shares && flown.compound.is_none() {
                let why = format!(
                    "{} shares its flight with other bodies, to which an effect joins it",
                    self.body(body).name
                );
                return Err(self.lasting(cluster, &cluster.contacts[part.contacts[0]], time, &why));
            }
            let chart = self.lanes[lane].charts[member].clone();
            let mut y = Coordinates::from_elem(0.0, chart.dimension());
            chart.encode(&cluster.motions[place].state(), &mut y);
            led.push(Numbers { place, lane, chart, y });
        }
        let gaps = part.contacts.iter().map(|&i| cluster.gaps[i]).collect();
        let start = Start { cluster, part, scales, time, led, gaps };

        let (own, left, next) = self.length(&start);
        let full = if own < left { own } else { left };
        let mut h = full;

        // shorter, where a slip turns round or another point touches within it, or where a slip that dies is
        // slow: its direction changes in u/(μ a). What begins to slide takes the whole step at once
        let least = least_step(time, full);
        let mut kind = Kind::Explicit;
        let begun = self.begin(&start, None)?;
        let mut step = self.try_step(&start, &begun, h, kind)?;
        for _ in 0..SHORTER {
            let shorter = self.first_end(&start, &step)?;
            if shorter < SAME * h && shorter > 0.0 && h > least {
                h = shorter.max(least);
                step = self.try_step(&start, &begun, h, kind)?;
                continue;
            }
            if kind == Kind::Implicit {
                break;
            }
            match slips(&start, &step) {
                Slips::Fast => break,
                Slips::Dying(suits) => h = suits.max(least).min(h),
                Slips::Beginning if kind == Kind::Explicit => kind = Kind::Straight,
                Slips::Beginning => kind = Kind::Implicit,
            }
            step = self.try_step(&start, &begun, h, kind)?;
        }

        if step.lets_go {
            step = self.until_let_go(&start, &begun, step)?;
            h = step.h;
        }

        // steps that stay short for ever: touches that follow each other without end
        let shorts = start.led.iter().map(|n| self.lanes[n.lane].short).fold(0, u32::max);
        let shorts = if h < SHORT * full { shorts + 1 } else { 0 };
        if shorts > SHORTS {
            let why = format!("{SHORTS} steps in a row end in new touches, the last one after {h:e} s");
            return Err(self.lasting(cluster, &cluster.contacts[part.contacts[0]], time, &why));
        }

        // the numbers and their polynomials
        let front = if h == left { Time::new(next) } else { time + h };
        self.together_number += 1;
        let number = self.together_number;
        for (n, end) in start.led.iter().zip(&step.ends) {
            let since = self.moment(n.lane, time.value).since;
            let mut segment = Segment::default();
            segment.set_hermite(Moment { time: time.value, since }, h, [&n.y, &end.k0, &end.y1, &end.k1]);
            segment.end = front.value;
            let lane = &mut self.lanes[n.lane];
            let mut counts = *lane.flight.counts();
            counts.steps += 1;
            counts.evaluations += 4;
            let rest = vec![0.0; end.y1.len()];
            lane.short = shorts;
            lane.flight.resume(&Front { time: front, since, y: end.y1.to_vec(), rest }, segment, counts);
            lane.pending = Some(f64::INFINITY);
        }
        let [heat, work] = [(&mut self.heat, &step.heat), (&mut self.work, &step.work)].map(|(list, passed)| {
            let place = (passed.joules != 0.0).then_some(list.len());
            let Passed { joules, power } = *passed;
            list.extend(place.map(|_| Heat { from: time.value, to: front.value, joules, power }));
            place
        });
        let pairs = cluster.touching.iter().filter(|t| part.contacts.iter().any(|i| t.contacts.contains(i)));
        let pairs = pairs.map(|t| t.bodies).collect();
        let bodies: Vec<usize> = part.places.iter().map(|&place| cluster.bodies[place]).collect();
        let sliding = go_on_sliding(&start, &step);
        let slot = self.together.iter().position(Option::is_none).unwrap_or(self.together.len());
        if slot == self.together.len() {
            self.together.push(None);
        }
        for &body in &bodies {
            if let Some((lane, _)) = self.places[body] {
                self.lanes[lane].led = Some(slot);
            }
        }
        self.together[slot] = Some(Together { number, bodies, pairs, sliding, heat, work });
        self.near.due.push(super::near::Due { time: front, what: super::near::What::Step { slot, number } });
        Ok(())
    }

    /// The step to the instant at which a contact is let go or begins to slip in it. It is found by steps of several
    /// lengths: forces that end within a step make its polynomials useless for that.
    fn until_let_go(&self, start: &Start<'_>, begun: &Stage, whole: Step) -> Result<Step, SimulationError> {
        let (mut low, mut high, mut last) = (0.0, whole.h, None);
        let least = least_step(start.time, whole.h);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle < least {
                break;
            }
            let tried = self.predict(start, begun, middle, whole.kind)?;
            if tried.lets_go() {
                (high, last) = (middle, Some(tried));
            } else {
                low = middle;
            }
        }
        Ok(last.filter(|_| low > 0.0).map_or(whole, |predicted| self.put_right(start, predicted)))
    }

    /// How long a step of a part may be: as its loads and turning allow, and what is left up to the next switch
    /// [s]; and when that is.
    fn length(&self, start: &Start<'_>) -> (f64, f64, f64) {
        let &Start { cluster, part, scales, time, ref led, .. } = start;
        let switches = led.iter().flat_map(|n| &self.lanes[n.lane].spec.switches);
        let jumps = cluster.bodies.iter().map(|&body| self.next_jump(body, time.value));
        let next = switches.copied().filter(|&s| s > time.value).chain(jumps).fold(self.end, f64::min);
        let touched = part.contacts.iter().flat_map(|&i| [cluster.contacts[i].a, cluster.contacts[i].b]);
        let turning = touched.map(|p| cluster.motions[p].angular_velocity.norm());
        let running = part.contacts.iter().filter_map(|&i| {
            let [a, b] = [cluster.contacts[i].a, cluster.contacts[i].b].map(|p| &cluster.motions[p]);
            Some(cluster.anchors[i]?.running(a, b))
        });
        let fastest = turning.chain(running).fold(0.0, f64::max);
        let by_load = if scales.pull > 0.0 { (scales.size / scales.pull).sqrt() } else { f64::INFINITY };
        let by_turning = if fastest > 0.0 { 1.0 / fastest } else { f64::INFINITY };
        let own = self.grain.step * STEP * by_load.min(by_turning);
        let own = match &self.controls[self.lanes[led[0].lane].group] {
            Control::Step(step) => own.min(*step),
            Control::Error(_) | Control::Mesh(_) => own,
        };
        let left = time.until(next);
        (own, left, next)
    }

    /// One step of length `h` [s], with its gaps and contact speeds put right at its end.
    fn try_step(&self, start: &Start<'_>, begun: &Stage, h: f64, kind: Kind) -> Result<Step, SimulationError> {
        Ok(self.put_right(start, self.predict(start, begun, h, kind)?))
    }

    /// What the contacts do at the start of a step; a straight one has this length [s].
    fn begin(&self, start: &Start<'_>, straight: Option<f64>) -> Result<Stage, SimulationError> {
        let y: Vec<Coordinates> = start.led.iter().map(|n| n.y.clone()).collect();
        let motions = self.stage(start.cluster, &start.led, &y, (start.time, 0.0));
        self.rates(start, &motions, &y, straight, start.time)
    }

    /// One step of length `h` [s] by its method alone; `begun` is what the contacts do at its start.
    fn predict(&self, start: &Start<'_>, begun: &Stage, h: f64, kind: Kind) -> Result<Predicted, SimulationError> {
        let &Start { cluster, part, time, ref led, .. } = start;
        let (mut heat, mut work, mut pushed) = (Passed::default(), Passed::default(), Vec::new());
        let straight = (kind == Kind::Straight).then_some(h);
        let mut y1: Vec<Coordinates> = led.iter().map(|n| n.y.clone()).collect();

        // the start, which depends on how the step is taken
        let own = match kind {
            Kind::Explicit => None,
            Kind::Straight => Some(self.begin(start, straight)?),
            Kind::Implicit => Some(self.rates(start, &cluster.motions, &y1, None, time)?),
        };
        let first = own.as_ref().unwrap_or(begun);
        [heat.power[0], work.power[0]] = first.power;

        // the numbers at the end
        if kind == Kind::Implicit {
            let motions;
            (motions, heat.joules, work.joules, pushed) = self.implicit(cluster, part, time, h)?;
            for (n, y) in led.iter().zip(&mut y1) {
                n.chart.encode(&motions[n.place].state(), y);
            }
        } else {
            let mut pass = |stage: &Stage, weight: f64| {
                heat.joules += weight / 6.0 * h * stage.power[0];
                work.joules += weight / 6.0 * h * stage.power[1];
                for (y, k) in y1.iter_mut().zip(&stage.rates) {
                    y.iter_mut().zip(k).for_each(|(y, k)| *y += weight / 6.0 * h * k);
                }
            };
            pass(first, 1.0);
            let mut last: Option<Stage> = None;
            for (at, weight) in [(0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
                let slopes = &last.as_ref().unwrap_or(first).rates;
                let along = |(n, k): (&Numbers, &Coordinates)| n.y.iter().zip(k).map(|(y, k)| y + at * h * k).collect();
                let y: Vec<Coordinates> = led.iter().zip(slopes).map(along).collect();
                let motions = self.stage(cluster, led, &y, (time, at * h));
                let stage = self.rates(start, &motions, &y, straight, time + at * h)?;
                pass(&stage, weight);
                last = Some(stage);
            }
        }
        let (k0, starts) = (first.rates.clone(), first.held.rest.holds.clone());

        // the motions there, and what the contacts do
        let motions = self.stage(cluster, led, &y1, (time, h));
        if motions.iter().any(|motion| !motion.is_finite()) {
            return Err(self.failure_of(&cluster.bodies, time.value, Failure::Flight(FlightError::NotFinite)));
        }
        let held = self.laws(start, &motions, straight, time + h)?;
        [heat.power[1], work.power[1]] = self.power(cluster, &held, &motions);
        Ok(Predicted { h, kind, k0, y1, motions, heat, work, starts, held, pushed })
    }

    /// The step with its gaps as they were, no speed along the normals of what carries, none at all where it sticks.
    fn put_right(&self, start: &Start<'_>, predicted: Predicted) -> Step {
        let Start { cluster, part, scales, time, led, gaps } = start;
        let lets_go = predicted.lets_go();
        let Predicted { h, kind, k0, mut y1, mut motions, mut heat, work, held, pushed, .. } = predicted;
        let (mut rows, mut lifts, mut stops, mut carrying) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (i, &c) in part.contacts.iter().enumerate() {
            let (contact, slip) = (&held.contacts[i], &held.slips[i]);
            let n = held.rest.normals[i];
            let opens = n.dot(slip) > scales.slip && !pushed.get(i).is_some_and(|pushed| *pushed);
            if held.rest.holds[i] == Hold::Separate || opens {
                continue;
            }
            let gap = cluster.anchors[c].map_or(gaps[i], |a| a.gap(&motions[contact.a], &motions[contact.b]));
            carrying.push(c);
            rows.push((i, n));
            lifts.push(gaps[i] - gap);
            stops.push(-n.dot(slip));
            if held.rest.holds[i] == Hold::Stick {
                let [_, s, t] = tangents(&n);
                for way in [s, t] {
                    rows.push((i, way));
                    lifts.push(0.0);
                    stops.push(-way.dot(slip));
                }
            }
        }
        let bodies = self.cluster_bodies(cluster, &motions);
        for (motion, shift) in motions.iter_mut().zip(align(&bodies, &held.contacts, &rows, &lifts)) {
            shift_by(motion, &shift.linear, &shift.angular);
        }
        let before: f64 = led.iter().map(|n| motions[n.place].kinetic_energy()).sum();
        for (motion, change) in motions.iter_mut().zip(align(&bodies, &held.contacts, &rows, &stops)) {
            motion.velocity += change.linear;
            motion.angular_velocity += change.angular;
        }
        heat.joules += before - led.iter().map(|n| motions[n.place].kinetic_energy()).sum::<f64>();
        for (n, y) in led.iter().zip(&mut y1) {
            n.chart.encode(&motions[n.place].state(), y);
        }
        let k1 = self.rates_under(led, &motions, &y1, &held, *time + h);
        let ends = k0.into_iter().zip(y1).zip(k1).map(|((k0, y1), k1)| End { k0, y1, k1 }).collect();
        Step { h, kind, ends, motions, heat, work, carrying, lets_go }
    }

    /// The motions after one plastic impact of what the loads give in the time `h` [s], with the bodies and
    /// contacts half way, the heat and the work of its impulses [J], and which contacts have some. Momenta stay where
    /// nothing acts:
    ///
    /// ```text
    /// L⁺ = L + h M + Σ r × j        ω = I⁻¹ L with I half way        x⁺ = x + ½ h (v + v⁺)
    /// ```
    fn implicit(
        &self,
        cluster: &Cluster,
        part: &Part,
        time: Time,
        h: f64,
    ) -> Result<(Vec<BodyMotion>, f64, f64, Vec<bool>), SimulationError> {
        // half way, with the momenta of the start, and then with what the loads add to them
        let moves = |body: usize| self.places[body].filter(|_| !self.is_driven(body));
        let inverse = |body: usize, motion: &BodyMotion, l: &Vector3| {
            let own = motion.rotation.tr_mul(l);
            motion.rotation * (self.body(body).properties.inv_inertia() * own)
        };
        let mut half = self.stage(cluster, &[], &[], (time, 0.5 * h));
        let reduced = |body: usize| self.chart(body).filter(|chart| chart.is_reduced());
        for (&body, motion) in cluster.bodies.iter().zip(&mut half).filter(|(body, _)| moves(**body).is_some()) {
            if let Some(chart) = reduced(body) {
                chart.drift(motion, 0.5 * h);
                continue;
            }
            let l = motion.angular_momentum();
            let (v, w) = (motion.velocity, motion.angular_velocity);
            shift_by(motion, &(0.5 * h * v), &(0.5 * h * w));
            motion.angular_velocity = inverse(body, motion, &l);
        }
        let mut pushed = half.clone();
        for (&body, motion) in cluster.bodies.iter().zip(&mut pushed) {
            let Some((lane, _)) = moves(body) else { continue };
            let load = self.load_on(lane, motion, self.moment(lane, time.value + 0.5 * h));
            if reduced(body).is_some() {
                let more = self.cluster_body(body, motion).mobility.times(&(h * load.force), &(h * load.torque));
                (motion.velocity, motion.angular_velocity) =
                    (motion.velocity + more.linear, motion.angular_velocity + more.angular);
                continue;
            }
            motion.velocity += h / motion.mass * load.force;
            motion.angular_velocity += h * inverse(body, motion, &load.torque);
        }
        let bodies = self.cluster_bodies(cluster, &pushed);
        let contacts: Vec<Contact> = part
            .contacts
            .iter()
            .map(|&i| {
                let contact = &cluster.contacts[i];
                cluster.anchors[i].map_or_else(|| contact.clone(), |anchor| anchor.support(contact, &pushed).contact)
            })
            .collect();
        let contacts: Vec<Contact> = contacts.into_iter().map(|contact| contact.restitution(0.0)).collect();
        let after = collide(&bodies, &contacts, Law::Newton).map_err(|why| {
            let why = Failure::Refused(format!("the contact forces of a step cannot be found: {why}"));
            self.failure_of(&cluster.bodies, time.value, why)
        })?;

        let mut ends = half.clone();
        let mut motions = cluster.motions.clone();
        for (k, &body) in cluster.bodies.iter().enumerate().filter(|(_, body)| moves(**body).is_some()) {
            (ends[k].velocity, ends[k].angular_velocity) = (after.velocities[k].linear, after.velocities[k].angular);
            if let Some(chart) = reduced(body) {
                motions[k] = ends[k];
                chart.drift(&mut motions[k], 0.5 * h);
                continue;
            }
            let l = ends[k].angular_momentum();
            let (v, w) = (half[k].velocity + ends[k].velocity, half[k].angular_velocity + ends[k].angular_velocity);
            shift_by(&mut motions[k], &(0.5 * h * v), &(0.5 * h * w));
            motions[k].velocity = ends[k].velocity;
            motions[k].angular_velocity = inverse(body, &motions[k], &l);
        }
        let slips = contacts.iter().map(|contact| contact.slip(&half) + contact.slip(&ends));
        let heat = -slips.zip(&after.impulses).map(|(u, j)| 0.5 * j.dot(&u)).sum::<f64>();
        let pushed = after.impulses.iter().map(|j| *j != Vector3::zeros()).collect();
        Ok((motions, heat, after.work, pushed))
    }

    /// What the contacts do at these motions, and the rates of the numbers; see [`laws`](Self::laws).
    fn rates(
        &self,
        start: &Start<'_>,
        motions: &[BodyMotion],
        y: &[Coordinates],
        straight: Option<f64>,
        time: Time,
    ) -> Result<Stage, SimulationError> {
        let held = self.laws(start, motions, straight, time)?;
        let power = self.power(start.cluster, &held, motions);
        Ok(Stage { rates: self.rates_under(&start.led, motions, y, &held, time), held, power })
    }

    /// Power of friction, and of bodies on prescribed motions [W].
    fn power(&self, cluster: &Cluster, held: &Held, motions: &[BodyMotion]) -> [f64; 2] {
        [held.heat(), held.drive(motions, |k| self.body(cluster.bodies[k]).motion.is_some())]
    }

    /// What the contacts do at these motions; in a straight step of this length [s], what slides slowly goes on as it
    /// began.
    fn laws(
        &self,
        start: &Start<'_>,
        motions: &[BodyMotion],
        straight: Option<f64>,
        time: Time,
    ) -> Result<Held, SimulationError> {
        // friction opposes the slip, on the side of the step's beginning
        let &Start { cluster, part, scales, .. } = start;
        let slide = |(i, way): (&usize, &Option<Vector3>)| {
            let (contact, way) = (&cluster.contacts[*i], (*way)?);
            let now = cluster.anchors[*i].map(|anchor| anchor.support(contact, motions).contact);
            let contact = now.as_ref().unwrap_or(contact);
            let slip = across(&contact.slip(motions), &contact.normals[0]);
            let speed = slip.norm();
            let least = straight.map_or(0.0, |h| STIFF * contact.friction * scales.pull * h);
            Some(if speed > scales.slip.max(least) { slip / speed * slip.dot(&way).signum() } else { way })
        };
        let slides: Vec<Option<Vector3>> = part.contacts.iter().zip(&part.slides).map(slide).collect();
        self.held(cluster, motions, &part.contacts, &slides, time)
    }

    /// The rates of the numbers under the loads and these contact forces.
    fn rates_under(
        &self,
        led: &[Numbers],
        motions: &[BodyMotion],
        y: &[Coordinates],
        held: &Held,
        time: Time,
    ) -> Vec<Coordinates> {
        led.iter()
            .zip(y)
            .map(|(n, y)| {
                let motion = &motions[n.place];
                let mut load = self.load_on(n.lane, motion, self.moment(n.lane, time.value));
                for (contact, force) in held.contacts.iter().zip(&held.rest.forces) {
                    for (k, sign) in [(contact.a, -1.0), (contact.b, 1.0)] {
                        if k == n.place {
                            load.add_force_at(&(sign * force), &contact.point, motion);
                        }
                    }
                }
                let mut dy = Coordinates::from_elem(0.0, y.len());
                n.chart.rate(y, motion, &load, &mut dy);
                dy
            })
            .collect()
    }

    /// The first instant within a step, from its start [s], at which a slip turns round, a contact comes to its end, or
    /// another point of a pair touches; else its length.
    fn first_end(&self, start: &Start<'_>, step: &Step) -> Result<f64, SimulationError> {
        let &Start { cluster, part, time, .. } = start;
        let mut within = Within::new(self, start, step);
        let mut first = step.h;

        // slips
        let sliding = if step.kind == Kind::Implicit { &[] } else { &part.slides[..] };
        for (&i, way) in part.contacts.iter().zip(sliding) {
            let (Some(way), Some(anchor)) = (way, &cluster.anchors[i]) else { continue };
            let along = |motions: &[BodyMotion]| {
                let contact = anchor.support(&cluster.contacts[i], motions).contact;
                way.dot(&contact.slip(motions))
            };
            if along(&step.motions) >= 0.0 || along(&cluster.motions) <= 0.0 {
                continue;
            }
            first = first.min(end_of(step.h, |s| along(within.at(s)) > 0.0));
        }

        // walls that a contact passes
        for touching in &cluster.touching {
            let slack = self.eps(touching.bodies[0], touching.bodies[1]);
            for i in touching.contacts.clone().filter(|i| part.contacts.contains(i)) {
                let (Some(anchor), contact) = (&cluster.anchors[i], &cluster.contacts[i]) else { continue };
                for wall in &cluster.walls[i] {
                    let goes_on =
                        |motions: &[BodyMotion]| anchor.inside(wall, &motions[contact.a], &motions[contact.b]) > -slack;
                    if goes_on(&cluster.motions) && !goes_on(&step.motions) {
                        first = first.min(end_of(step.h, |s| goes_on(within.at(s))));
                    }
                }
            }
        }

        // touches: points that come below the surface, by more than those that carry seem to within the step
        for touching in cluster.touching.iter().filter(|t| part.contacts.iter().any(|i| t.contacts.contains(i))) {
            let pair = touching.bodies;
            let [Some(a), Some(b)] = pair.map(|i| cluster.place(self.unit(i))) else { continue };
            let carrying = step.carrying.iter().filter(|i| touching.contacts.contains(i));
            let anchors: Vec<_> = carrying.filter_map(|&i| Some((i, cluster.anchors[i]?))).collect();
            let below = |motions: &[BodyMotion]| {
                let poses = [(pair[0], a), (pair[1], b)]
                    .map(|(i, place)| self.pose_of(i, &self.part_motion(i, &motions[place])));
                let gap = self.closest_at(pair, poses, time.value)?.signed_distance;
                let sunk = |(i, anchor): &(usize, Anchor)| {
                    let contact = &cluster.contacts[*i];
                    cluster.gaps[*i] - anchor.gap(&motions[contact.a], &motions[contact.b])
                };
                Ok::<f64, SimulationError>(-gap - anchors.iter().map(sunk).fold(0.0, f64::max))
            };
            let level = BELOW * self.eps(pair[0], pair[1]);
            let end = if first < step.h { within.at(first) } else { &step.motions };
            if below(end)? <= level {
                continue;
            }
            let (mut low, mut high) = (0.0, first);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if below(within.at(middle))? <= level {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            first = low;
        }
        Ok(first)
    }
}

/// The shortest step that is taken from `time`, where a whole one has the length `full` [s].
fn least_step(time: Time, full: f64) -> f64 {
    LEAST * f64::EPSILON * full.max(time.value.abs())
}

/// The contacts that go on sliding after a step, with their directions.
fn go_on_sliding(start: &Start<'_>, step: &Step) -> Vec<([usize; 2], Vector3, Vector3)> {
    let &Start { cluster, part, scales, .. } = start;
    let mut sliding = Vec::new();
    for (&i, way) in part.contacts.iter().zip(&part.slides) {
        let (Some(way), Some(anchor)) = (way, &cluster.anchors[i]) else { continue };
        let contact = &cluster.contacts[i];
        let start = contact.slip(&cluster.motions);
        let contact = anchor.support(contact, &step.motions).contact;
        let end = contact.slip(&step.motions);
        if way.dot(&end) > scales.slip || way.dot(&end) > way.dot(&start) {
            let slip = across(&end, &contact.normals[0]);
            let way = if way.dot(&slip) > 0.0 { slip.normalize() } else { *way };
            sliding.push(([contact.a, contact.b].map(|k| cluster.bodies[k]), contact.point, way));
        }
    }
    sliding
}

/// How the slips of a step compare with what friction changes in it.
fn slips(start: &Start<'_>, step: &Step) -> Slips {
    let &Start { cluster, part, scales, .. } = start;
    let (mut shortest, mut begins) = (f64::INFINITY, false);
    for (&i, way) in part.contacts.iter().zip(&part.slides) {
        let (Some(way), Some(anchor)) = (way, &cluster.anchors[i]) else { continue };
        let contact = &cluster.contacts[i];
        let change = STIFF * contact.friction * scales.pull;
        let start = contact.slip(&cluster.motions);
        let moved = anchor.support(contact, &step.motions).contact;
        let end = moved.slip(&step.motions);
        let speed = across(&start, &contact.normals[0]).norm();
        if speed >= change * step.h || (way.dot(&end) < way.dot(&start) && end.norm() <= scales.slip) {
            continue; // fast enough, or come to its end
        }
        if way.dot(&end) < way.dot(&start) && speed > scales.slip {
            shortest = shortest.min(speed / change);
        } else {
            let turns = moved.normals[0].cross(way).dot(&end).abs() > STRAIGHT * end.norm();
            begins |= turns || step.kind == Kind::Explicit;
        }
    }
    if begins {
        Slips::Beginning
    } else if shortest.is_finite() {
        Slips::Dying(shortest)
    } else {
        Slips::Fast
    }
}

/// The end of what holds at the start of a step and not after the time `end` [s]: just behind it.
fn end_of(end: f64, mut holds: impl FnMut(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, end);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// How far below the surface a point must come to count as touching, in ε [-].
const BELOW: f64 = 2.0;
