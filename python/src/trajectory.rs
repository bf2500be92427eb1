//! Trajectories, their events and their energies, as arrays.

use std::sync::Arc;

use bryla::math::{Vector3, quaternion};
use bryla::plan::{Plan, PlannedBody};
use bryla::trajectory::Energy;
use bryla::{BodyState, Event, Load, Trajectory};
use pyo3::prelude::*;
use pyo3::types::PyType;
use serde::{Deserialize, Serialize};

use crate::convert::{self, Array, List, Numbers, Reduced};
use crate::effect::check_raised;
use crate::error::Result;
use crate::event::passage;
use crate::math::PyPose;
use crate::plan::PyPlan;
use crate::report::PyReport;

/// What can be asked of a body in a state.
mod quantity {
    use super::{BodyState, PlannedBody, quaternion};

    pub(super) fn position(_: &PlannedBody, state: &BodyState, _: f64) -> [f64; 3] {
        state.position.into()
    }

    pub(super) fn orientation(_: &PlannedBody, state: &BodyState, _: f64) -> [f64; 4] {
        quaternion::to_scalar_first(&state.orientation)
    }

    pub(super) fn velocity(body: &PlannedBody, state: &BodyState, t: f64) -> [f64; 3] {
        body.motion(state, t).velocity.into()
    }

    pub(super) fn angular_velocity(body: &PlannedBody, state: &BodyState, t: f64) -> [f64; 3] {
        body.motion(state, t).angular_velocity.into()
    }

    pub(super) fn angular_velocity_body(body: &PlannedBody, state: &BodyState, t: f64) -> [f64; 3] {
        body.motion(state, t).angular_velocity_body().into()
    }

    pub(super) fn linear_momentum(_: &PlannedBody, state: &BodyState, _: f64) -> [f64; 3] {
        state.linear_momentum.into()
    }

    pub(super) fn spin_angular_momentum(_: &PlannedBody, state: &BodyState, _: f64) -> [f64; 3] {
        state.angular_momentum.into()
    }

    pub(super) fn angular_momentum_body(_: &PlannedBody, state: &BodyState, _: f64) -> [f64; 3] {
        quaternion::to_matrix(&state.orientation).tr_mul(&state.angular_momentum).into()
    }
}

/// The instants that states belong to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Instants {
    /// The samples of the run.
    Samples,
    /// One time [s].
    One(f64),
    /// Several times [s].
    Many(Vec<f64>),
}

/// Some instants of a run, and all of its bodies or one.
#[derive(Debug, Clone, PartialEq)]
struct Selection {
    run: Arc<Trajectory>,
    instants: Instants,
    body: Option<usize>,
}

impl Selection {
    fn samples(run: &Arc<Trajectory>) -> Self {
        Self { run: run.clone(), instants: Instants::Samples, body: None }
    }

    fn times(&self) -> &[f64] {
        match &self.instants {
            Instants::Samples => self.run.times(),
            Instants::One(t) => std::slice::from_ref(t),
            Instants::Many(times) => times,
        }
    }

    /// The bodies' places in the scene.
    fn bodies(&self) -> std::ops::Range<usize> {
        self.body.map_or(0..self.run.plan().bodies().len(), |body| body..body + 1)
    }

    fn names(&self) -> Vec<String> {
        self.run.plan().bodies()[self.bodies()].iter().map(|body| body.name.clone()).collect()
    }

    /// The numbers of every instant as an array.
    fn collected<'py>(
        &self,
        py: Python<'py>,
        width: usize,
        mut numbers_of: impl FnMut(usize, f64, &mut Vec<f64>) -> Result<()>,
    ) -> Result<Array<'py>> {
        let mut shape = Vec::new();
        if !matches!(self.instants, Instants::One(_)) {
            shape.push(self.times().len());
        }
        if self.body.is_none() {
            shape.push(self.bodies().len());
        }
        shape.push(width);
        let mut numbers = Vec::with_capacity(shape.iter().product());
        for (sample, &t) in self.times().iter().enumerate() {
            numbers_of(sample, t, &mut numbers)?;
        }
        Ok(convert::array(py, &shape, numbers)?)
    }

    /// A quantity of every state.
    fn array<'py, const N: usize>(
        &self,
        py: Python<'py>,
        quantity: fn(&PlannedBody, &BodyState, f64) -> [f64; N],
    ) -> Result<Array<'py>> {
        let bodies = &self.run.plan().bodies()[self.bodies()];
        self.collected(py, N, |sample, t, numbers| {
            let states = match self.instants {
                Instants::Samples => self.run.states(sample),
                _ => &self.run.at(t)?,
            };
            for (body, state) in bodies.iter().zip(&states[self.bodies()]) {
                numbers.extend(quantity(body, state, t));
            }
            Ok(())
        })
    }

    /// A part of the reaction at every state.
    fn reactions<'py>(&self, py: Python<'py>, part: fn(&Load) -> Vector3) -> Result<Array<'py>> {
        let array = self.collected(py, 3, |sample, t, numbers| {
            let reactions = match self.instants {
                Instants::Samples => self.run.reactions(sample),
                _ => self.run.reactions_at(t)?,
            };
            numbers.extend(reactions[self.bodies()].iter().flat_map(|load| <[f64; 3]>::from(part(load))));
            Ok(())
        })?;
        check_raised()?;
        Ok(array)
    }
}

/// A class with the arrays of a selection of states; `$axes` is how their shapes begin.
macro_rules! motion_class {
    ($(#[$doc:meta])* class $name:tt $Class:ident $axes:tt { $($methods:tt)* }) => {
        $(#[$doc])*
        #[pyclass(name = $name, module = "bryla", frozen, eq)]
        #[derive(Debug, Clone, PartialEq)]
        pub(crate) struct $Class(Selection);

        #[pymethods]
        impl $Class {
            #[doc = concat!("Centre of mass, world axes [m]: array ", $axes, "3).")]
            #[getter]
            fn position<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::position)
            }

            #[doc = concat!("Rotation from body to world axes, (w, x, y, z): array ", $axes, "4).")]
            #[getter]
            fn orientation<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::orientation)
            }

            #[doc = concat!("Velocity of the centre of mass, world axes [m/s]: array ", $axes, "3).")]
            #[getter]
            fn velocity<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::velocity)
            }

            #[doc = concat!("Angular velocity, world axes [rad/s]: array ", $axes, "3).")]
            #[getter]
            fn angular_velocity<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::angular_velocity)
            }

            #[doc = concat!("Angular velocity, body axes [rad/s]: array ", $axes, "3).")]
            #[getter]
            fn angular_velocity_body<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::angular_velocity_body)
            }

            #[doc = concat!("Linear momentum, world axes [kg·m/s]: array ", $axes, "3).")]
            #[getter]
            fn linear_momentum<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::linear_momentum)
            }

            #[doc = concat!("Angular momentum about each centre of mass, world axes [kg·m²/s]: array ", $axes, "3).")]
            #[getter]
            fn spin_angular_momentum<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::spin_angular_momentum)
            }

            #[doc = concat!("Angular momentum about each centre of mass, body axes [kg·m²/s]: array ", $axes, "3).")]
            #[getter]
            fn angular_momentum_body<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.array(py, quantity::angular_momentum_body)
            }

            #[doc = concat!("Force of the freedom against effects, world axes [N]: array ", $axes, "3).")]
            #[getter]
            fn reaction_force<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.reactions(py, |load| load.force)
            }

            #[doc = concat!("Torque of the freedom against effects, about the centre of mass [N·m]: array ", $axes, "3).")]
            #[getter]
            fn reaction_torque<'py>(&self, py: Python<'py>) -> Result<Array<'py>> {
                self.0.reactions(py, |load| load.torque)
            }

            $($methods)*
        }
    };
}

motion_class! {
    /// What a run leaves behind: samples, the motion of every step, and what happened on the way.
    ///
    /// Arrays are worked out when they are asked for, and are yours. Their body axis has the order of
    /// names. At an impact a sample shows the state after it; events have both.
    ///
    /// run["die"] is one body, run.at(t) are other times than the samples; both are States.
    class "Trajectory" PyTrajectory "(samples, bodies, " {
        /// Times of the samples [s]: array (samples,).
        #[getter]
        fn t<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
            convert::array(py, &[self.0.times().len()], self.0.times().to_vec())
        }

        /// How far the motion is known [s].
        #[getter]
        fn end(&self) -> f64 {
            self.run().end()
        }

        /// The name of the event that ended the run before its time, or None.
        #[getter]
        fn ended_by(&self) -> Option<&str> {
            self.run().ended_by()
        }

        /// Names of the bodies, in the order of the body axis.
        #[getter]
        fn names(&self) -> Vec<String> {
            self.0.names()
        }

        /// The plan that ran.
        #[getter]
        fn plan(&self) -> PyPlan {
            PyPlan::new(self.run().plan().clone())
        }

        /// What happened, by time: a list of Event.
        #[getter]
        fn events(&self) -> Vec<PyEvent> {
            self.run().events().iter().map(|event| PyEvent::new(self.run().plan(), event)).collect()
        }

        /// What ran, what it cost, and how far it is to be trusted.
        #[getter]
        fn report(&self) -> PyReport {
            PyReport(self.run().report().clone())
        }

        /// Energies of the whole scene at every sample [J].
        ///
        /// Raises Error for a run that kept samples only, of a scene in which something dissipates or
        /// works.
        #[getter]
        fn energy(&self) -> Result<PyEnergy> {
            let energy = self.run().energy();
            check_raised()?;
            Ok(PyEnergy(energy?))
        }

        /// Momenta of the whole scene at every sample, the angular one about a world point [m].
        #[pyo3(signature = (about=Numbers([0.0; 3])), text_signature = "($self, about=(0.0, 0.0, 0.0))")]
        fn total(&self, about: Numbers<3>) -> PyTotal {
            let totals = (0..self.0.times().len()).map(|sample| self.run().total(sample, Vector3::from(about.0)));
            let (linear, angular) = totals.map(|t| (<[f64; 3]>::from(t.linear_momentum), <[f64; 3]>::from(t.angular_momentum))).unzip();
            PyTotal { linear_momentum: linear, angular_momentum: angular }
        }

        /// The states at any time [s] of the run, or at several; the body axis comes after the time axis.
        ///
        /// Raises Error for a time outside of the run, and for a run that kept samples only.
        #[pyo3(signature = (t))]
        fn at(&self, t: &Bound<'_, PyAny>) -> Result<PyStates> {
            let instants = match t.extract::<List<f64>>() {
                Ok(times) => Instants::Many(times.0),
                Err(_) => Instants::One(t.extract()?),
            };
            let selection = Selection { instants, ..self.0.clone() };
            for &t in selection.times() {
                self.run().at(t)?;
            }
            Ok(PyStates(selection))
        }

        /// Pose of a body's shape axes at a time [s] of the run.
        #[pyo3(signature = (name, t))]
        fn pose(&self, name: &str, t: f64) -> Result<PyPose> {
            Ok(PyPose(self.run().pose(name, t)?))
        }

        /// Writes the samples to a file, .csv, .json or .npz, with the names that they have here.
        #[pyo3(signature = (path))]
        fn write(&self, path: std::path::PathBuf) -> Result<()> {
            let written = self.run().write(path);
            check_raised()?;
            Ok(written?)
        }

        /// Draws where the bodies are, how they turn, and where the energy goes, and returns the figure;
        /// needs matplotlib.
        ///
        /// Parameters
        /// ----------
        /// bodies : list of str, optional
        ///     The bodies that are drawn; those that move by default.
        /// figure : matplotlib.figure.Figure, optional
        ///     Where to draw; a new figure by default.
        #[pyo3(signature = (bodies=None, figure=None))]
        fn plot<'py>(
            slf: &Bound<'py, Self>,
            bodies: Option<&Bound<'py, PyAny>>,
            figure: Option<&Bound<'py, PyAny>>,
        ) -> PyResult<Bound<'py, PyAny>> {
            slf.py().import("bryla._plot")?.call_method1("trajectory", (slf, bodies, figure))
        }

        /// One body at all samples: run["die"].
        fn __getitem__(&self, name: &str) -> Result<PyStates> {
            one_body(&self.0, name)
        }

        /// Number of samples.
        fn __len__(&self) -> usize {
            self.0.times().len()
        }

        fn __repr__(&self) -> String {
            let run = self.run();
            format!(
                "<bryla.Trajectory: {} bodies, {} samples to t = {} s, {} events>",
                run.plan().bodies().len(),
                run.times().len(),
                run.end(),
                run.events().len()
            )
        }

        /// Refused where there is a user effect, which is code.
        fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>> {
            refuse_code(self.run())?;
            Ok(convert::reduce(&py.get_type::<Self>(), self.run())?)
        }

        #[classmethod]
        fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
            convert::from_bytes(bytes).map(Self::new)
        }
    }
}

impl PyTrajectory {
    pub(crate) fn new(run: Trajectory) -> Self {
        Self(Selection::samples(&Arc::new(run)))
    }

    fn run(&self) -> &Trajectory {
        &self.0.run
    }
}

motion_class! {
    /// States of bodies at times: of one body at all samples, run["die"], or at other times, run.at(t).
    ///
    /// The axes of the arrays: times, absent where one time was asked for; bodies, absent where one
    /// body was asked for; components.
    class "States" PyStates "([times,] [bodies,] " {
        /// The times [s]: array (times,), or a float where one time was asked for.
        #[getter]
        fn t<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
            match self.0.instants {
                Instants::One(t) => Ok(t.into_pyobject(py)?.into_any()),
                _ => Ok(convert::array(py, &[self.0.times().len()], self.0.times().to_vec())?.into_any()),
            }
        }

        /// Names of the bodies, in the order of the body axis.
        #[getter]
        fn names(&self) -> Vec<String> {
            self.0.names()
        }

        /// One body: run.at(t)["die"].
        fn __getitem__(&self, name: &str) -> Result<Self> {
            one_body(&self.0, name)
        }

        fn __repr__(&self) -> String {
            let times = match &self.0.instants {
                Instants::One(t) => format!("t = {t} s"),
                _ => format!("{} times", self.0.times().len()),
            };
            format!("<bryla.States: {} at {times}>", self.0.names().join(", "))
        }

        /// Refused where there is a user effect, which is code.
        fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>> {
            refuse_code(&self.0.run)?;
            let parts = (&*self.0.run, &self.0.instants, self.0.body);
            Ok(convert::reduce(&py.get_type::<Self>(), &parts)?)
        }

        #[classmethod]
        fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
            let (run, instants, body): (Trajectory, _, _) = convert::from_bytes(bytes)?;
            Ok(Self(Selection { run: Arc::new(run), instants, body }))
        }
    }
}

/// The body of this name, out of a selection that has it.
fn one_body(from: &Selection, name: &str) -> Result<PyStates> {
    let body = from.run.plan().scene().id(name)?.index();
    if !from.bodies().contains(&body) {
        let known = format!("is {}", from.names().join(", "));
        let place = "states".to_owned();
        return Err(bryla::Error::UnknownName { place, field: "body name", name: name.to_owned(), known }.into());
    }
    Ok(PyStates(Selection { body: Some(body), ..from.clone() }))
}

/// Refuses the run of a scene with functions of the user.
fn refuse_code(run: &Trajectory) -> Result<()> {
    Ok(run.plan().check_writable()?)
}

/// Something that happened at an instant. World axes; the normal points from the first body to the
/// second, and the impulse is that on the second.
#[pyclass(name = "Event", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct PyEvent {
    event: Event,
    bodies: (String, String),
}

impl PyEvent {
    pub(crate) fn new(plan: &Plan, event: &Event) -> Self {
        let [a, b] = event.bodies.map(|body| plan.bodies()[body].name.clone());
        Self { event: event.clone(), bodies: (a, b) }
    }
}

/// Two vectors, before and after: (2, 3).
fn before_and_after<'py>(py: Python<'py>, pair: &[Vector3; 2]) -> PyResult<Array<'py>> {
    convert::array(py, &[2, 3], pair.iter().flat_map(|v| <[f64; 3]>::from(*v)).collect())
}

#[pymethods]
impl PyEvent {
    /// When [s].
    #[getter]
    fn time(&self) -> f64 {
        self.event.time
    }

    /// What: "bounce", "stick", "break" (what had stuck came off), "contact" (they stay in contact and move),
    /// "rest", "user" or "switch".
    #[getter]
    fn kind(&self) -> &'static str {
        self.event.kind.name()
    }

    /// The name of a UserEvent, or which load was turned on or off; empty for impacts.
    #[getter]
    fn name(&self) -> &str {
        &self.event.name
    }

    /// How the measure behind a UserEvent or a switch met its value: "rising", "falling" or "touching"; None
    /// for impacts.
    #[getter]
    fn passage(&self) -> Option<&'static str> {
        passage(self.event.passage)
    }

    /// Names of the two bodies; the first and the last of a UserEvent or a switch, to which nothing of the
    /// below applies.
    #[getter]
    fn bodies(&self) -> (String, String) {
        self.bodies.clone()
    }

    /// Where the impulse acts [m]: array (3,); the point of contact, or the centroid of several; of a break the
    /// joint.
    #[getter]
    fn point<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.event.point)
    }

    /// Unit normal from the first body to the second: array (3,).
    #[getter]
    fn normal<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.event.normal)
    }

    /// Impulse on the second body [N·s]: array (3,).
    #[getter]
    fn impulse<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.event.impulse)
    }

    /// Force of the first body on the second that their joint carried when it broke [N]: array (3,).
    #[getter]
    fn force<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.event.force)
    }

    /// Torque of the first body on the second about the joint when it broke [N·m]: array (3,).
    #[getter]
    fn torque<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.event.torque)
    }

    /// Which features of the two bodies touched, in words.
    #[getter]
    fn features(&self) -> &str {
        &self.event.features
    }

    /// Rounds that the finder took to locate it.
    #[getter]
    fn iterations(&self) -> u32 {
        self.event.iterations
    }

    /// Velocity of the second body's centre of mass before and after [m/s]: array (2, 3).
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        before_and_after(py, &self.event.velocity)
    }

    /// Angular velocity of the second body before and after [rad/s]: array (2, 3).
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        before_and_after(py, &self.event.angular_velocity)
    }

    /// Kinetic energy lost [J].
    #[getter]
    fn energy_lost(&self) -> f64 {
        self.event.energy_lost
    }

    fn __repr__(&self) -> String {
        if let Some(passage) = self.passage() {
            return format!("<bryla.Event: {} {passage} at t = {} s>", self.name(), self.event.time);
        }
        let (a, b) = &self.bodies;
        format!("<bryla.Event: {} of {b} on {a} ({}) at t = {} s>", self.kind(), self.event.features, self.event.time)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), self)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes)
    }
}

/// Energies of the whole scene at every sample [J]; kinetic + potential + dissipated − work stays.
#[pyclass(name = "Energy", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyEnergy(Energy);

/// Numbers at the samples: (samples,).
fn series<'py>(py: Python<'py>, numbers: &[f64]) -> PyResult<Array<'py>> {
    convert::array(py, &[numbers.len()], numbers.to_vec())
}

#[pymethods]
impl PyEnergy {
    /// Kinetic energy [J]: array (samples,).
    #[getter]
    fn kinetic<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        series(py, &self.0.kinetic)
    }

    /// Potential energy [J]: array (samples,).
    #[getter]
    fn potential<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        series(py, &self.0.potential)
    }

    /// Energy turned into heat since the start, by drag, damping and impacts [J]: array (samples,).
    #[getter]
    fn dissipated<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        series(py, &self.0.dissipated)
    }

    /// Work brought in from outside since the start [J]: array (samples,).
    #[getter]
    fn work<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        series(py, &self.0.work)
    }

    /// Kinetic + potential + dissipated − work [J]: array (samples,).
    #[getter]
    fn balance<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let balance: Vec<_> = (0..self.0.kinetic.len()).map(|sample| self.0.balance(sample)).collect();
        series(py, &balance)
    }

    /// Largest change of the balance since the start [J]: the method's error in the energy.
    #[getter]
    fn drift(&self) -> f64 {
        self.0.drift()
    }

    fn __repr__(&self) -> String {
        format!("<bryla.Energy: {} samples, drift {:.1e} J>", self.0.kinetic.len(), self.0.drift())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// Momenta of the whole scene at every sample, world axes.
#[pyclass(name = "Total", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct PyTotal {
    linear_momentum: Vec<[f64; 3]>,
    angular_momentum: Vec<[f64; 3]>,
}

#[pymethods]
impl PyTotal {
    /// Linear momentum [kg·m/s]: array (samples, 3).
    #[getter]
    fn linear_momentum<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::array(py, &[self.linear_momentum.len(), 3], self.linear_momentum.as_flattened().to_vec())
    }

    /// Angular momentum about the point asked for [kg·m²/s]: array (samples, 3).
    #[getter]
    fn angular_momentum<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::array(py, &[self.angular_momentum.len(), 3], self.angular_momentum.as_flattened().to_vec())
    }

    fn __repr__(&self) -> String {
        format!("<bryla.Total: {} samples>", self.linear_momentum.len())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), self)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes)
    }
}

/// Adds the classes.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyTrajectory>()?;
    module.add_class::<PyStates>()?;
    module.add_class::<PyEvent>()?;
    module.add_class::<PyEnergy>()?;
    module.add_class::<PyTotal>()
}
