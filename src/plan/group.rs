//! The equations of motion of a flight group: Y′ = f(t, Y), lecture (24).

use super::{Binding, series};
use crate::freedom::riding::{follow, gather};
use crate::freedom::{Chart, Form, RotationSplit, Scales};
use crate::integrator::{Control, Flight, Integration, Method, Problem, StateVector, of_order};
use crate::math::series::Tape;
use crate::state::{BodyMotion, Load, Moment};
use std::fmt::Debug;
use std::ops::Range;

/// What is known of a group's coordinates where its step is compiled.
///
/// Most groups are one body. Their vectors have a fixed length then, and the coordinates are known too,
/// so that nothing is left to ask or to loop over in the step.
pub trait Kind: Debug + Send + 'static {
    /// The numbers that are integrated.
    type Y: StateVector;

    /// The forms of orientation that such groups have: world axes, body axes.
    const WORLD_AXES: bool = true;
    /// See [`WORLD_AXES`](Self::WORLD_AXES).
    const BODY_AXES: bool = true;

    /// What is known of what acts on the bodies.
    const LOADS: Loads = Loads::Any;

    /// The same charts, of which the compiler knows more afterwards.
    fn narrow(charts: &[Chart]) -> &[Chart];

    /// The rates where nothing acts.
    #[inline(always)]
    fn rate_unloaded(charts: &[Chart], y: &Self::Y, dy: &mut Self::Y) {
        let (y, dy, mut at) = (y.as_ref(), dy.as_mut(), 0);
        for chart in Self::narrow(charts) {
            let n = chart.dimension();
            chart.rate_unloaded(&y[at..at + n], &mut dy[at..at + n]);
            at += n;
        }
    }

    /// Amends a change so that orientations do not leave their sphere; returns how far the worst had strayed [-].
    #[inline(always)]
    fn project(charts: &[Chart], y: &Self::Y, rest: &Self::Y, dy: &mut Self::Y) -> f64 {
        let (y, rest, dy) = (y.as_ref(), rest.as_ref(), dy.as_mut());
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in Self::narrow(charts) {
            let part = at..at + chart.dimension();
            worst = worst.max(chart.project(&y[part.clone()], &rest[part.clone()], &mut dy[part.clone()]));
            at = part.end;
        }
        worst
    }
}

/// What may act on the bodies of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loads {
    /// Nothing.
    None,
    /// What depends neither on time nor on the motion, such as gravity.
    Constant,
    /// Whatever there is.
    Any,
}

impl Loads {
    /// Whether no more than this acts on the bodies, and the method's steps are worth a step compiled apart.
    fn suit(self, bodies: &Bodies, method: Method) -> bool {
        match self {
            Self::None => bodies.bindings.is_empty() && method.has_short_steps(),
            Self::Constant => {
                !bodies.bindings.is_empty()
                    && bodies.bindings.iter().all(|binding| binding.effect.as_effect().is_constant())
            }
            Self::Any => true,
        }
    }
}

/// Any bodies.
#[derive(Debug)]
pub struct Any;

impl Kind for Any {
    type Y = Vec<f64>;

    #[inline(always)]
    fn narrow(charts: &[Chart]) -> &[Chart] {
        charts
    }
}

/// The numbers of a free body on which nothing acts, x, P, q, L. P stays, and so does L in world axes:
/// nothing is spent on them.
#[derive(Debug, Clone)]
pub(crate) struct Unloaded<const WORLD_AXES: bool>([f64; 13]);

impl<const WORLD_AXES: bool> AsRef<[f64]> for Unloaded<WORLD_AXES> {
    #[inline(always)]
    fn as_ref(&self) -> &[f64] {
        &self.0
    }
}

impl<const WORLD_AXES: bool> AsMut<[f64]> for Unloaded<WORLD_AXES> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl<const WORLD_AXES: bool> StateVector for Unloaded<WORLD_AXES> {
    fn zeros(n: usize) -> Self {
        Self(StateVector::zeros(n))
    }

    #[inline(always)]
    fn moving(&self) -> [Range<usize>; 2] {
        if WORLD_AXES { [0..3, 6..10] } else { [0..3, 6..13] }
    }

    #[inline(always)]
    fn set_steady(&mut self, y: &Self) {
        self.0[3..6].copy_from_slice(&y.0[3..6]);
        if WORLD_AXES {
            self.0[10..].copy_from_slice(&y.0[10..]);
        }
    }

    #[inline(always)]
    fn lend(&mut self) -> Self {
        Self([0.0; 13])
    }

    #[inline(always)]
    fn take_back(&mut self, _lent: Self) {}

    #[inline(always)]
    fn take(&mut self) -> Self {
        self.clone()
    }
}

/// Declares the kinds of single bodies: how many numbers they have, whether world axes and body
/// axes are meant, what may act on them, and what their only chart is.
macro_rules! single {
    ($($(#[$doc:meta])* $kind:ident: [$y:ty, $world:literal, $body:literal, $loads:ident] $pattern:pat $(if $known:expr)?,)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug)]
            pub(crate) struct $kind;

            impl Kind for $kind {
                type Y = $y;
                const WORLD_AXES: bool = $world;
                const BODY_AXES: bool = $body;
                const LOADS: Loads = Loads::$loads;

                #[inline(always)]
                fn narrow(charts: &[Chart]) -> &[Chart] {
                    match charts {
                        [$pattern] $(if $known)? => charts,
                        _ => unreachable!("{} was given {charts:?}", stringify!($kind)),
                    }
                }
            }
        )*

        /// The flight by a method of bodies that start at `t` [s] with the numbers `y`; each kind of group has
        /// a step of its own.
        pub(super) fn flight(bodies: Bodies, method: Method, course: Course, t: f64, y: &[f64]) -> Box<dyn Flight> {
            if matches!(method, Method::Taylor | Method::Dmv) {
                return fly_to_order(bodies, method, course, t, y);
            }
            match bodies.charts.as_slice() {
                $([$pattern] if $($known &&)? Loads::$loads.suit(&bodies, method) => fly::<$kind>(bodies, method, course, t, y),)*
                _ => fly::<Any>(bodies, method, course, t, y),
            }
        }
    };
}

single! {
    /// A free body on which nothing acts, with q and L in body axes, in short steps.
    UnloadedBodyAxes: [Unloaded<false>, false, true, None] Chart::Free(c) if c.spin().form() == Form::Body,
    /// A free body on which nothing acts, with q and L in world axes, in short steps.
    UnloadedWorldAxes: [Unloaded<true>, true, false, None] Chart::Free(c) if c.spin().form() == Form::WorldQuaternion,
    /// A free body with q and L in body axes.
    FreeBodyAxes: [[f64; 13], false, true, Any] Chart::Free(c) if c.spin().form() == Form::Body,
    /// A free body with q and L in world axes.
    FreeWorldAxes: [[f64; 13], true, false, Any] Chart::Free(c) if c.spin().form() == Form::WorldQuaternion,
    /// A top on which only what is constant acts, with q and L in body axes.
    ConstantPivotBodyAxes: [[f64; 7], false, true, Constant] Chart::Pivot(c) if c.spin().form() == Form::Body,
    /// A top with q and L in body axes.
    PivotBodyAxes: [[f64; 7], false, true, Any] Chart::Pivot(c) if c.spin().form() == Form::Body,
    /// A body in a plane.
    InPlane: [[f64; 6], true, true, Any] Chart::Planar(_),
}

/// Bodies of a group: their coordinates, their motions at the start, and what acts on them.
pub(super) struct Bodies {
    pub(super) charts: Vec<Chart>,
    pub(super) motions: Vec<BodyMotion>,
    pub(super) bindings: Vec<Binding>,
}

/// How a flight is led: what decides the steps, and whether orientations are put back on their sphere.
pub(super) struct Course {
    pub(super) control: Control,
    pub(super) projection: bool,
    /// Order of methods that take one.
    pub(super) order: u32,
}

fn fly<K: Kind>(bodies: Bodies, method: Method, course: Course, t: f64, y: &[f64]) -> Box<dyn Flight> {
    let problem = Group::<K>::new(bodies.charts, bodies.motions, bodies.bindings);
    debug_assert_eq!(problem.dimension(), y.len());
    let integrator = method.integrator(&problem, course.control, course.projection);
    Box::new(Integration::new(problem, integrator.expect("a method in the axes of the charts"), t, y))
}

/// The flight by a method whose order was asked for.
fn fly_to_order(bodies: Bodies, method: Method, course: Course, t: f64, y: &[f64]) -> Box<dyn Flight> {
    let problem = Group::<Any>::new(bodies.charts, bodies.motions, bodies.bindings);
    let integrator = of_order(method, &problem, course.order, course.control, course.projection);
    Box::new(Integration::new(problem, integrator.expect("a method that takes an order"), t, y))
}

/// Bodies with their coordinates and what acts on them.
///
/// ```text
/// y ──charts──▶ motions ──effects──▶ loads ──charts──▶ y′
/// ```
#[derive(Debug)]
pub struct Group<K> {
    charts: Vec<Chart>,
    bindings: Vec<Binding>,
    /// Effects that are left out, by their places in the scene; none of them is constant.
    off: Vec<usize>,
    motions: Vec<BodyMotion>,
    loads: Vec<Load>,
    /// Of these, what depends neither on time nor on the motion.
    constant: Vec<Load>,
    /// What an effect on some of the bodies is shown.
    shown: Vec<BodyMotion>,
    shown_loads: Vec<Load>,
    is_loaded: bool,
    depends_on_velocity: bool,
    /// Whether the first of the bodies is a compound of others.
    has_parts: bool,
    kind: std::marker::PhantomData<fn() -> K>,
}

impl<K: Kind> Group<K> {
    /// Bodies with these coordinates; of `motions`, mass, inertia and what no coordinate moves stay.
    pub(crate) fn new(charts: Vec<Chart>, motions: Vec<BodyMotion>, bindings: Vec<Binding>) -> Self {
        let n = motions.len();
        let is_loaded = !bindings.is_empty();
        // a constant load on a part turns its compound with a lever that turns
        let has_parts = charts.iter().any(|chart| matches!(chart, Chart::Riding(_)));
        let (constant, changing): (Vec<_>, Vec<_>) =
            bindings.into_iter().partition(|binding| !has_parts && binding.effect.as_effect().is_constant());
        let depends_on_velocity = changing.iter().any(|binding| binding.effect.as_effect().depends_on_velocity());
        let mut group = Self {
            is_loaded,
            depends_on_velocity,
            has_parts,
            charts,
            bindings: constant,
            off: Vec::new(),
            motions,
            loads: vec![Load::zero(); n],
            constant: vec![Load::zero(); n],
            shown: Vec::with_capacity(n),
            shown_loads: Vec::with_capacity(n),
            kind: std::marker::PhantomData,
        };
        group.add_loads(Moment { time: 0.0, since: 0.0 });
        group.constant.clone_from(&group.loads);
        group.bindings = changing;
        group
    }

    /// Reads the motion of every body from the numbers.
    fn decode_into(charts: &[Chart], y: &[f64], motions: &mut [BodyMotion]) {
        let mut at = 0;
        for (chart, motion) in K::narrow(charts).iter().zip(&mut *motions) {
            let n = chart.dimension();
            chart.decode(&y[at..at + n], motion);
            at += n;
        }
        follow(K::narrow(charts), motions);
    }

    /// What holds each body in its freedom, the motions being as they were given.
    pub(crate) fn reactions(&mut self, at: Moment) -> Vec<Load> {
        self.add_loads(at);
        let bodies = self.charts.iter().zip(&self.motions).zip(&self.loads);
        bodies.map(|((chart, motion), load)| chart.reaction(motion, load)).collect()
    }

    /// [`Problem::project`] where something may act; apart, as are the rates: such a step is long anyway, and is
    /// compiled for every method.
    #[inline(never)]
    fn project_apart(&self, y: &K::Y, rest: &K::Y, dy: &mut K::Y) -> f64 {
        K::project(&self.charts, y, rest, dy)
    }

    /// `dy = f(t, y)` where something acts.
    #[inline(never)]
    fn rate_loaded(&mut self, at: Moment, y: &K::Y, dy: &mut K::Y) {
        if self.bindings.is_empty() {
            return self.rate_constant(y.as_ref(), dy.as_mut());
        }
        Self::decode_into(&self.charts, y.as_ref(), &mut self.motions);
        self.add_loads(at);
        if self.has_parts {
            gather(&self.charts, &self.motions, &mut self.loads);
        }
        let (y, dy) = (y.as_ref(), dy.as_mut());
        let mut at = 0;
        for ((chart, motion), load) in K::narrow(&self.charts).iter().zip(&self.motions).zip(&self.loads) {
            let n = chart.dimension();
            chart.rate(&y[at..at + n], motion, load, &mut dy[at..at + n]);
            at += n;
        }
    }

    /// `dy = f(t, y)` where all loads are constant: no motion is written down to be read again.
    #[inline(always)]
    fn rate_constant(&mut self, y: &[f64], dy: &mut [f64]) {
        let mut at = 0;
        for ((chart, motion), load) in K::narrow(&self.charts).iter().zip(&mut self.motions).zip(&self.constant) {
            let n = chart.dimension();
            chart.rate_constant(&y[at..at + n], motion, load, &mut dy[at..at + n]);
            at += n;
        }
    }

    /// Loads of all effects on the motions as they stand.
    fn add_loads(&mut self, at: Moment) {
        self.loads.copy_from_slice(&self.constant);
        for binding in &self.bindings {
            if self.off.contains(&binding.effect_index) {
                continue;
            }
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

impl<K: Kind> Problem for Group<K> {
    type Y = K::Y;
    const WORLD_AXES: bool = K::WORLD_AXES;
    const BODY_AXES: bool = K::BODY_AXES;
    const SHORT_STEPS: bool = matches!(K::LOADS, Loads::None);

    fn dimension(&self) -> usize {
        self.charts.iter().map(Chart::dimension).sum()
    }

    fn bodies(&self) -> usize {
        self.charts.len()
    }

    #[inline(always)]
    fn rate(&mut self, at: Moment, y: &K::Y, dy: &mut K::Y) {
        match K::LOADS {
            Loads::None => K::rate_unloaded(&self.charts, y, dy),
            Loads::Constant => self.rate_constant(y.as_ref(), dy.as_mut()),
            Loads::Any if self.is_loaded => self.rate_loaded(at, y, dy),
            Loads::Any => self.drift(y, dy),
        }
    }

    #[inline(never)]
    fn drift(&mut self, y: &K::Y, dy: &mut K::Y) {
        K::rate_unloaded(&self.charts, y, dy);
    }

    fn is_loaded(&self) -> bool {
        K::LOADS != Loads::None && self.is_loaded
    }

    fn depends_on_velocity(&self) -> bool {
        self.depends_on_velocity
    }

    #[inline]
    fn flow(&mut self, y: &mut K::Y, rest: &mut K::Y, h: f64, split: RotationSplit) {
        let (y, rest, mut at) = (y.as_mut(), rest.as_mut(), 0);
        for chart in K::narrow(&self.charts) {
            let n = chart.dimension();
            chart.flow(&mut y[at..at + n], &mut rest[at..at + n], h, split);
            at += n;
        }
    }

    #[inline]
    fn to_generator(&self, y: &K::Y, k: &mut K::Y) {
        let (y, k, mut at) = (y.as_ref(), k.as_mut(), 0);
        for chart in K::narrow(&self.charts) {
            if let Some((part, spin)) = chart.spin_part(at) {
                spin.to_generator(&y[part.clone()], &mut k[part]);
            }
            at += chart.dimension();
        }
    }

    #[inline]
    fn act(&self, y: &mut K::Y, h: f64, v: &K::Y) {
        let (y, v, mut at) = (y.as_mut(), v.as_ref(), 0);
        for chart in K::narrow(&self.charts) {
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
    fn add_bracket(&self, c: f64, a: &mut K::Y, b: &K::Y) {
        let (a, b, mut at) = (a.as_mut(), b.as_ref(), 0);
        for chart in K::narrow(&self.charts) {
            if let Some((part, spin)) = chart.spin_part(at) {
                spin.add_bracket(c, &mut a[part.clone()], &b[part]);
            }
            at += chart.dimension();
        }
    }

    #[inline(always)]
    fn project(&mut self, y: &K::Y, rest: &K::Y, dy: &mut K::Y) -> f64 {
        if K::LOADS == Loads::Any { self.project_apart(y, rest, dy) } else { K::project(&self.charts, y, rest, dy) }
    }

    fn orientation_error(&self, y: &K::Y) -> f64 {
        let y = y.as_ref();
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in K::narrow(&self.charts) {
            let part = at..at + chart.dimension();
            worst = worst.max(chart.orientation_error(&y[part.clone()]));
            at = part.end;
        }
        worst
    }

    #[inline]
    fn error_size(&self, y0: &K::Y, y1: &K::Y, e: &K::Y, scales: &Scales) -> f64 {
        let (y0, y1, e) = (y0.as_ref(), y1.as_ref(), e.as_ref());
        let (mut at, mut worst) = (0, 0.0_f64);
        for chart in K::narrow(&self.charts) {
            let part = at..at + chart.dimension();
            worst = worst.max(chart.error_size(&y0[part.clone()], &y1[part.clone()], &e[part.clone()], scales));
            at = part.end;
        }
        worst
    }

    fn decode(&self, y: &[f64], motions: &mut [BodyMotion]) {
        Self::decode_into(&self.charts, y, motions);
    }

    fn leave_out(&mut self, effects: &[usize]) -> bool {
        let changes = self.off != effects;
        if changes {
            self.off = effects.to_vec();
        }
        changes
    }

    fn tape(&self, at: Moment, order: usize) -> Tape {
        series::tape(&self.charts, &self.motions, (&self.constant, &self.bindings, &self.off), at, order)
    }

    fn take_failure(&mut self) -> Option<String> {
        self.bindings.iter().find_map(|binding| binding.effect.as_effect().take_failure())
    }
}
