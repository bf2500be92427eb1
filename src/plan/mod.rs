//! What a scene calls for, and nothing else.
//!
//! Compiling checks a scene once, gives every body the coordinates of its freedom, binds effects to
//! the bodies they act on, and leaves out what does nothing. The step loop then asks no questions.
//! [`Plan::explain`] says what was kept, what was left out, and why.

use std::path::Path;
use std::sync::Arc;

use crate::closest::Collider;
use crate::contact::{BreakingLoad, Material, Response};
use crate::effect::{AnyEffect, Target};
use crate::error::{Error, Result};
use crate::freedom::{Chart, Freedom, Prescribed};
use crate::integrator::{ClosedFlight, ClosedMotion, Control, Flight, Limits, Method, taylor};
use crate::mass::MassProperties;
use crate::math::sum::Time;
use crate::math::{Matrix3, Vector3, quaternion};
use crate::scene::{Body, Finder, Orientation, RunOptions, Scene};
use crate::state::{BodyMotion, BodyState};
use smallvec::SmallVec;

mod compound;
pub mod cost;
mod explain;
mod group;
mod method;
mod series;
mod watch;

pub(crate) use compound::{Compound, Part};
pub use group::{Any, Group};
pub(crate) use watch::Toggle;

/// A body of the plan.
#[derive(Debug, Clone)]
pub struct PlannedBody {
    /// Its name.
    pub name: String,
    /// Mass [kg], centre of mass (shape axes) [m], inertia about it (body axes) [kg·m²]; 0 for a
    /// fixed body, whose mass matters to nothing.
    pub properties: MassProperties,
    /// How it may move.
    pub freedom: Freedom,
    /// Whether nothing integrates it: it stays where it is, or is moved.
    pub fixed: bool,
    /// The motion that it is moved along.
    pub motion: Option<Prescribed>,
    /// Mass, inertia, and the motion it starts with; of a body that is moved, that of time 0.
    pub start: BodyMotion,
    /// Largest distance of its matter from the centre of mass [m]; 0 without a shape.
    pub radius: f64,
    /// Its shape, prepared for queries, where it may meet another body.
    pub collider: Option<Arc<Collider>>,
}

impl PlannedBody {
    /// Whether it is moved along a prescribed motion that does not stand still from `t` [s] on.
    pub(crate) fn is_moved(&self, t: f64) -> bool {
        self.motion.as_ref().is_some_and(|motion| motion.moves(t))
    }

    /// The motion at the instant `t` of a body that nothing integrates.
    pub(crate) fn motion_at(&self, t: Time) -> BodyMotion {
        self.motion.as_ref().map_or(self.start, |motion| motion.at(&self.start, t, t.value))
    }

    /// The motion that a state of this body means at the time `t` [s].
    pub fn motion(&self, state: &BodyState, t: f64) -> BodyMotion {
        if self.motion.is_some() {
            return self.motion_at(Time::new(t));
        }
        let mut motion = self.start;
        if !self.fixed {
            motion.set_state(state, &self.properties.inv_inertia());
        }
        motion
    }
}

/// An effect and the bodies it acts on, as places in a group.
#[derive(Debug, Clone)]
pub(crate) struct Binding {
    pub(crate) effect: Arc<AnyEffect>,
    /// Its place in the scene.
    pub(crate) effect_index: usize,
    pub(crate) members: Vec<usize>,
    /// Whether the members stand in rising order, so that all of a group's are the group.
    pub(crate) in_order: bool,
    /// Whether the bodies are seen together; else the effect acts on each alone.
    pub(crate) together: bool,
}

impl Binding {
    /// The motions of those members of a group that the effect acts on.
    pub(crate) fn seen(&self, members: &[BodyMotion]) -> SmallVec<[BodyMotion; 1]> {
        self.members.iter().map(|&i| members[i]).collect()
    }
}

/// Bodies that share one integrator and one clock.
#[derive(Debug, Clone)]
pub struct FlightGroup {
    /// Its bodies, as places in the scene; fixed ones among them are only seen by effects.
    pub members: Vec<usize>,
    pub(crate) bindings: Vec<Binding>,
    /// Whether a load has kinks where a vector is 0.
    pub(crate) has_kinks: bool,
    /// The method that integrates it.
    pub method: Method,
    /// Why this one.
    pub(crate) why: String,
    /// Times at which a load jumps [s], rising.
    pub switches: Vec<f64>,
    /// The events that it watches for.
    pub(crate) watches: Vec<watch::Watch>,
    /// The loads that the state turns on and off.
    pub(crate) toggles: Vec<Toggle>,
    /// Whether a member may meet another body.
    pub(crate) meets: bool,
}

impl FlightGroup {
    /// The vectors at whose zeros loads have kinks, for these motions of the members.
    pub(crate) fn kinks(&self, motions: &[BodyMotion], kinks: &mut Vec<Vector3>) {
        for binding in &self.bindings {
            let effect = binding.effect.as_effect();
            kinks.extend(binding.members.iter().flat_map(|&i| effect.kinks(&motions[i])).flatten());
        }
    }
}

/// A scene after checking, with only what it calls for.
#[derive(Debug, Clone)]
pub struct Plan {
    scene: Scene,
    options: RunOptions,
    bodies: Vec<PlannedBody>,
    groups: Vec<Arc<FlightGroup>>,
    /// The coordinates of every group's bodies.
    charts: Vec<Vec<Chart>>,
    left_out: Vec<LeftOut>,
}

/// Two plans are equal when they were compiled from the same scene with the same options.
impl PartialEq for Plan {
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene && self.options == other.options
    }
}

/// Something that the scene names and the plan does without.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// What is left out.
    pub what: String,
    /// Why.
    pub why: String,
}

/// Default tolerance of a run that names neither tolerance nor step [-].
pub(crate) const DEFAULT_TOLERANCE: f64 = 1.0e-6;

impl Scene {
    /// Checks the scene and keeps what it calls for.
    ///
    /// # Errors
    /// The first thing found wrong, naming body or effect, field and value.
    pub fn compile(&self, options: &RunOptions) -> Result<Plan> {
        Plan::new(self, options)
    }

    /// The plan of the scene's own run options in words: what runs, what is left out, and why.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    pub fn explain(&self) -> Result<String> {
        Ok(self.compile(&self.run)?.explain())
    }
}

impl Plan {
    fn new(scene: &Scene, options: &RunOptions) -> Result<Self> {
        options.validate()?;
        if scene.bodies.is_empty() {
            return Err(Error::refused("scene", "there is no body in it"));
        }
        let scene = scene.clone().loaded(Path::new(""))?;
        let bodies = scene.bodies.iter().map(planned).collect::<Result<Vec<_>>>()?;
        for (index, body) in scene.bodies.iter().enumerate() {
            if scene.bodies[..index].iter().any(|other| other.name == body.name) {
                return Err(Error::value("scene", "body name", "one that no other body has", &body.name));
            }
        }
        let mut left_out = Vec::new();
        let watched = watch::watched(&scene, &bodies, options)?;
        let mut grouping = Grouping::new(&scene, &bodies, &mut left_out)?;
        for members in &watched {
            grouping.join(members, &bodies);
        }
        let mut groups = grouping.groups(&scene, &bodies);
        watch::bind(&watched, &bodies, &mut groups);
        let mut bodies = bodies;
        collisions(&scene, &mut bodies, &mut groups, options, &mut left_out)?;
        for group in &mut groups {
            group.choose_method(&bodies, options)?;
        }
        let charts_of = |group: &FlightGroup| {
            let form = group.method.form(options.orientation == Orientation::Matrix);
            let chart = |&index: &usize| match &bodies[index] {
                body if body.fixed => Ok(Chart::Fixed),
                body => Chart::new(&body.freedom, form, &body.start, &scene.bodies[index].place()),
            };
            group.members.iter().map(chart).collect::<Result<Vec<_>>>()
        };
        let charts = groups.iter().map(charts_of).collect::<Result<Vec<_>>>()?;
        let groups = groups.into_iter().map(Arc::new).collect();
        Ok(Self { scene, options: options.clone(), bodies, groups, charts, left_out })
    }

    /// The bodies, in the scene's order.
    pub fn bodies(&self) -> &[PlannedBody] {
        &self.bodies
    }

    /// The bodies that share an integrator, group by group.
    pub fn groups(&self) -> &[Arc<FlightGroup>] {
        &self.groups
    }

    /// What the scene names and the plan does without.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// The method of integration: the one asked for, or that of the first group without a closed form.
    pub fn method(&self) -> Method {
        let chosen = self.groups.iter().map(|group| group.method).find(|&method| method != Method::Exact);
        self.options.method.or(chosen).unwrap_or(Method::Exact)
    }

    /// Order of the method, of several the least; 0 where all is closed form.
    pub fn order(&self) -> u32 {
        let groups = self.groups.iter().filter(|group| group.method != Method::Exact);
        groups.map(|group| self.order_of(group.method)).min().unwrap_or(0)
    }

    /// Order of a method: the one asked for, of power series else that which the tolerance calls for.
    fn order_of(&self, method: Method) -> u32 {
        match (method, self.options.order, self.tolerance()) {
            (Method::Taylor | Method::Dmv, Some(order), _) => order,
            (Method::Taylor, None, Some(tolerance)) => taylor::order_for(tolerance, self.options.estimate),
            _ => method.order(),
        }
    }

    /// Work of a step of a method at its order, as a multiple of that at the order which costs are measured at [-].
    pub(crate) fn effort(&self, method: Method) -> f64 {
        match method {
            Method::Taylor => taylor::effort(self.order_of(method)),
            _ => 1.0,
        }
    }

    /// How to run it.
    pub fn options(&self) -> &RunOptions {
        &self.options
    }

    /// The scene it was compiled from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Refuses a plan that has no text, since it holds functions of the user.
    ///
    /// # Errors
    /// Names the effect or the event that is code.
    #[cfg(feature = "serde")]
    pub fn check_writable(&self) -> Result<()> {
        self.scene.check_writable()?;
        self.options.check_writable()
    }

    /// The tolerance that the run shall keep, if one was asked for or none of tolerance and step.
    pub fn tolerance(&self) -> Option<f64> {
        self.options.tolerance.or_else(|| self.options.step.is_none().then_some(DEFAULT_TOLERANCE))
    }

    /// The coordinates of a group's bodies; those in `held` rest.
    pub(crate) fn charts(&self, group: usize, held: &[usize]) -> Vec<Chart> {
        let mut charts = self.charts[group].clone();
        for (chart, index) in charts.iter_mut().zip(&self.groups[group].members) {
            if held.contains(index) {
                *chart = Chart::Fixed;
            }
        }
        charts
    }

    /// The flight of a group from its start at time `t` [s], for those who advance it themselves.
    ///
    /// # Errors
    /// A group that the plan does not have.
    pub fn flight(&self, group: usize, t: f64, control: &Control) -> Result<Box<dyn Flight>> {
        let Some(spec) = self.groups.get(group) else {
            return Err(Error::value("plan", "group", format!("below {}", self.groups.len()), group));
        };
        let motions: Vec<_> = spec.members.iter().map(|&i| self.bodies[i].start).collect();
        Ok(self.flight_for(group, t, control, &motions, &[]))
    }

    /// The flight of a group from time `t` [s] and these motions of its members; the bodies in `held`
    /// rest. Where the group may meet something, and the search of contacts looks at the ends of a step
    /// only, steps stay short enough for it.
    pub(crate) fn flight_for(
        &self,
        group: usize,
        t: f64,
        control: &Control,
        motions: &[BodyMotion],
        held: &[usize],
    ) -> Box<dyn Flight> {
        self.flight_of(&self.groups[group], t, control, self.charts(group, held), motions)
    }

    /// The flight of bodies with these coordinates and what acts on them.
    pub(crate) fn flight_of(
        &self,
        spec: &FlightGroup,
        t: f64,
        control: &Control,
        charts: Vec<Chart>,
        motions: &[BodyMotion],
    ) -> Box<dyn Flight> {
        let n = charts.iter().map(Chart::dimension).sum();
        let mut y = vec![0.0; n];
        let mut at = 0;
        for (chart, motion) in charts.iter().zip(motions) {
            chart.encode(&motion.state(), &mut y[at..at + chart.dimension()]);
            at += chart.dimension();
        }

        let control = match control {
            Control::Error(limits) if spec.meets && self.options.finder != Finder::Guaranteed => {
                // finer runs look more often, so that what the coarser missed shows in their difference
                let finer = libm::pow(limits.local / LOOKED_AT_LOCAL, 1.0 / 8.0);
                let longest = limits.longest.min(finer * self.first_step(limits.scales.time));
                Control::Error(Limits { longest, ..*limits })
            }
            other => other.clone(),
        };

        let motions = motions.to_vec();
        if spec.method == Method::Exact {
            // a closed form has no steps of its own: they follow the turning where events look along them
            let control = match control {
                Control::Error(limits) if !spec.watches.is_empty() => {
                    let longest = limits.longest.min(self.first_step(limits.scales.time));
                    Control::Error(Limits { longest, ..limits })
                }
                other => other,
            };
            let motion = ClosedMotion::new(Time::new(t), spec.starts(&charts, &motions));
            let problem = Group::<Any>::new(charts, motions, spec.bindings.clone());
            return Box::new(ClosedFlight::new(problem, motion, control));
        }
        let bodies = group::Bodies { charts, motions, bindings: spec.bindings.clone() };
        let course = group::Course { control, projection: self.options.projection, order: self.order_of(spec.method) };
        group::flight(bodies, spec.method, course, t, &y)
    }

    /// A step that follows every body's turning and the span, from which a tolerance is worked out [s].
    pub(crate) fn first_step(&self, length: f64) -> f64 {
        let turning = self.bodies.iter().map(|body| body.start.angular_velocity.norm()).fold(0.0, f64::max);
        let by_turning = if turning > 0.0 { FIRST_ANGLE / turning } else { f64::INFINITY };
        by_turning.min(length / FIRST_STEPS)
    }
}

/// Angle that the fastest body turns in the first try of a step [rad].
const FIRST_ANGLE: f64 = 0.25;
/// Error of a step at which groups that may meet something step as the first try does [-].
const LOOKED_AT_LOCAL: f64 = 1.0e-6;
/// Fewest steps of the first try [-].
const FIRST_STEPS: f64 = 32.0;

/// Checks one body and works out its mass and its start.
fn planned(body: &Body) -> Result<PlannedBody> {
    body.validate()?;
    let fixed = body.fixed || body.motion.is_some();
    let properties = if fixed {
        MassProperties { mass: 0.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::zeros() }
    } else {
        body.mass_properties()?
    };
    let mut start = BodyMotion::at_rest(properties.mass, properties.inertia);
    start.orientation = quaternion::normalized(&quaternion::from_scalar_first(body.orientation));
    start.rotation = quaternion::to_matrix(&start.orientation);
    start.position = match (body.position, body.origin) {
        (_, Some(origin)) => Vector3::from(origin) + start.rotation * properties.center_of_mass,
        (position, None) => position.unwrap_or_default().into(),
    };
    start.angular_velocity = match (body.angular_velocity, body.angular_velocity_body) {
        (_, Some(w)) => start.rotation * Vector3::from(w),
        (w, None) => w.unwrap_or_default().into(),
    };
    start.velocity = body.velocity.map_or_else(|| freedom_velocity(&body.freedom, &start), Vector3::from);
    let radius = match &body.shape {
        Some(shape) if !fixed => shape.bounding_radius(&properties.center_of_mass),
        _ => 0.0,
    };
    Ok(PlannedBody {
        name: body.name.clone(),
        properties,
        freedom: body.freedom.clone(),
        fixed,
        motion: body.motion.clone(),
        start,
        radius,
        collider: None,
    })
}

/// The velocity that a rotation about a resting point gives the centre of mass.
fn freedom_velocity(freedom: &Freedom, start: &BodyMotion) -> Vector3 {
    let point_body = match freedom {
        Freedom::Free | Freedom::Planar(_) => return Vector3::zeros(),
        Freedom::Pivot(pivot) => pivot.point_body,
        Freedom::Axle(axle) => axle.point_body,
    };
    start.angular_velocity.cross(&-(start.rotation * Vector3::from(point_body)))
}

/// Which bodies belong together, and which effect acts on whom.
struct Grouping {
    /// For each body the first body of its group.
    leader: Vec<usize>,
    /// Effects that are kept, with their bodies as places in the scene.
    bindings: Vec<Binding>,
}

impl Grouping {
    fn new(scene: &Scene, bodies: &[PlannedBody], left_out: &mut Vec<LeftOut>) -> Result<Self> {
        let mut grouping = Self { leader: (0..bodies.len()).collect(), bindings: Vec::new() };
        for (index, effect) in scene.effects.iter().enumerate() {
            let place = scene.effect_place(index);
            effect.as_effect().validate(&place)?;
            let target = effect.as_effect().target();
            let named = |names: &[String]| -> Result<Vec<usize>> {
                names.iter().map(|name| Ok(scene.find(name, &place, "body")?.index())).collect()
            };
            let (members, together) = match target {
                Target::All => ((0..bodies.len()).filter(|&i| !bodies[i].fixed).collect(), false),
                Target::Each(names) => (named(&names)?, false),
                Target::Together(names) => (named(&names)?, true),
            };
            if let Some(pair) = members.iter().enumerate().find(|(i, m)| members[..*i].contains(m)) {
                return Err(Error::value(place, "bodies", "different from each other", &bodies[*pair.1].name));
            }
            if let Some(&fixed) = members.iter().find(|&&i| bodies[i].fixed && !together) {
                return Err(Error::value(place, "body", "one that can move", &bodies[fixed].name));
            }
            if let Some(&moved) = members.iter().find(|&&i| bodies[i].motion.is_some()) {
                return Err(Error::value(place, "body", "one without a prescribed motion", &bodies[moved].name));
            }
            if let Some(why) = effect.as_effect().idle() {
                left_out.push(LeftOut { what: place, why: why.to_owned() });
                continue;
            }
            if members.iter().all(|&i| bodies[i].fixed) {
                left_out.push(LeftOut { what: place, why: "no body that it acts on can move".to_owned() });
                continue;
            }

            // bodies that an effect sees together join one group; fixed ones stay out of it
            if together {
                grouping.join(&members, bodies);
            }
            let in_order = members.is_sorted();
            let effect = Arc::new(effect.clone());
            grouping.bindings.push(Binding { effect, effect_index: index, members, in_order, together });
        }
        Ok(grouping)
    }

    /// Makes one group of those bodies that move.
    fn join(&mut self, members: &[usize], bodies: &[PlannedBody]) {
        let moving: Vec<usize> = members.iter().copied().filter(|&i| !bodies[i].fixed).collect();
        for pair in moving.windows(2) {
            let (a, b) = (self.leader[pair[0]], self.leader[pair[1]]);
            let (first, second) = (a.min(b), a.max(b));
            self.leader.iter_mut().filter(|l| **l == second).for_each(|l| *l = first);
        }
    }

    fn groups(&self, scene: &Scene, bodies: &[PlannedBody]) -> Vec<FlightGroup> {
        let mut groups = Vec::new();
        for first in (0..bodies.len()).filter(|&i| self.leader[i] == i && !bodies[i].fixed) {
            let mut members: Vec<usize> =
                (0..bodies.len()).filter(|&i| self.leader[i] == first && !bodies[i].fixed).collect();
            let moving = members.clone();
            let mut bindings = Vec::new();
            for binding in &self.bindings {
                let mut wanted: Vec<usize> = binding.members.clone();
                if binding.together {
                    if !wanted.iter().any(|i| moving.contains(i)) {
                        continue;
                    }
                } else {
                    wanted.retain(|i| moving.contains(i));
                    if wanted.is_empty() {
                        continue;
                    }
                }
                let mut place = |i: usize| {
                    members.iter().position(|&m| m == i).unwrap_or_else(|| {
                        members.push(i);
                        members.len() - 1
                    })
                };
                let local: Vec<usize> = wanted.into_iter().map(&mut place).collect();
                bindings.push(Binding {
                    effect: binding.effect.clone(),
                    effect_index: binding.effect_index,
                    in_order: local.is_sorted(),
                    members: local,
                    together: binding.together,
                });
            }
            let mut switches: Vec<f64> = bindings.iter().flat_map(|b| b.effect.as_effect().switches()).collect();
            switches.sort_by(f64::total_cmp);
            switches.dedup();
            let (method, why) = (Method::Exact, String::new());
            let (watches, toggles) = (Vec::new(), watch::toggles(&bindings, scene));
            let (has_kinks, meets) = (false, false);
            let mut group =
                FlightGroup { members, bindings, has_kinks, method, why, switches, watches, toggles, meets };
            let (starts, mut kinks) = (group.members.iter().map(|&i| bodies[i].start).collect::<Vec<_>>(), Vec::new());
            group.kinks(&starts, &mut kinks);
            group.has_kinks = !kinks.is_empty();
            groups.push(group);
        }
        groups
    }
}

/// Prepares the shapes of bodies that may meet, and refuses what this version cannot answer.
fn collisions(
    scene: &Scene,
    bodies: &mut [PlannedBody],
    groups: &mut [FlightGroup],
    options: &RunOptions,
    left_out: &mut Vec<LeftOut>,
) -> Result<()> {
    let solid: Vec<usize> =
        (0..bodies.len()).filter(|&i| scene.bodies[i].collides && scene.bodies[i].shape.is_some()).collect();
    let fixed: Vec<&str> = solid.iter().filter(|&&i| bodies[i].fixed).map(|&i| bodies[i].name.as_str()).collect();
    if fixed.len() > 1 {
        let what = format!("pairs of {}", fixed.join(", "));
        let why =
            if solid.iter().any(|&i| bodies[i].motion.is_some()) { "all are fixed or moved" } else { "all are fixed" };
        left_out.push(LeftOut { what, why: why.to_owned() });
    }
    if solid.len() < 2 || fixed.len() == solid.len() {
        return Ok(());
    }

    for &i in &solid {
        let place = scene.bodies[i].place();
        let never = "where it never meets another, say collides = false of it";
        if !bodies[i].fixed {
            let sticks = |&&j: &&usize| j != i && material(scene, i, j).response == Response::Stick;
            if bodies[i].freedom != Freedom::Free
                && let Some(&other) = solid.iter().find(sticks)
            {
                let (freedom, other) = (bodies[i].freedom.name(), &bodies[other].name);
                let reason = format!(
                    "with freedom {freedom} it cannot stick, as it would to {other}; let both bounce, or {never}"
                );
                return Err(Error::refused(place, reason));
            }
            if options.orientation == Orientation::Matrix && options.finder == Finder::Guaranteed {
                let reason = "the guaranteed finder bounds quaternions; with orientation = matrix name another finder";
                return Err(Error::refused("run: orientation", reason));
            }
            let rounding = EPS_ROUNDING * (bodies[i].start.position.amax() + bodies[i].radius);
            if let Some(eps) = options.eps.filter(|eps| *eps < rounding) {
                let allowed = format!("at least {rounding:e}, the rounding of the coordinates of {}", bodies[i].name);
                return Err(Error::value("run", "eps", allowed, eps));
            }
        }
        let Some(shape) = &scene.bodies[i].shape else { continue };
        let collider = Collider::new(shape).map_err(|error| Error::refused(place, format!("{error}; {never}")))?;
        bodies[i].collider = Some(Arc::new(collider));
    }
    for group in groups {
        group.meets = group.members.iter().any(|&i| bodies[i].collider.is_some() && !bodies[i].fixed);
    }
    Ok(())
}

/// What a pair of bodies does when they touch.
fn material(scene: &Scene, a: usize, b: usize) -> Material {
    Material::of_pair([a, b].map(|i| {
        let body = &scene.bodies[i];
        (body.restitution, body.friction, body.response)
    }))
}

impl Plan {
    /// What a pair of bodies does when they touch.
    pub(crate) fn material(&self, a: usize, b: usize) -> Material {
        material(&self.scene, a, b)
    }

    /// The coordinates of a member of a group, also where it is held.
    pub(crate) fn chart(&self, group: usize, member: usize) -> Option<&Chart> {
        self.charts.get(group)?.get(member)
    }

    /// The load under which two bodies that have stuck come apart.
    pub(crate) fn breaking_load(&self, pair: [usize; 2]) -> BreakingLoad {
        let of = |i: usize| self.scene.bodies[i].breaking_load.unwrap_or(BreakingLoad::NEVER);
        of(pair[0]).weaker(&of(pair[1]))
    }

    /// Whether two bodies may meet.
    pub(crate) fn may_meet(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.bodies[a], &self.bodies[b]);
        a.collider.is_some() && b.collider.is_some() && !(a.fixed && b.fixed)
    }
}

/// Rounding of a gap, in units of the coordinates it is worked out from [-]: a dozen operations.
pub(crate) const EPS_ROUNDING: f64 = 16.0 * f64::EPSILON;
