//! Effects: what acts on bodies.

use std::cell::RefCell;
use std::sync::Arc;

use bryla::effect::{AnyEffect, Drag, Frame, PointGravity, Spring, Thruster, UniformGravity, UserEffect, Wrench};
use bryla::math::Vector3;
use bryla::{BodyMotion, Schedule};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyException, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::body::PyBodyMotion;
use crate::convert::{self, List, Numbers, Plain, plain_class};
use crate::error::{Failure, Result};

/// The list of effects: the class of each, and the way from any object to an effect and back.
macro_rules! effects {
    ($(
        $(#[$doc:meta])*
        class $name:tt $Class:ident($Core:ident) $signature:tt as $text:tt { $($fields:tt)* }
    )*) => {
        $(plain_class! {
            $(#[$doc])*
            class $name $Class($Core) $signature as $text { $($fields)* }
        })*

        /// The effect that an object is.
        pub(crate) fn from_python(obj: &Bound<'_, PyAny>) -> PyResult<AnyEffect> {
            $(if let Ok(effect) = obj.cast::<$Class>() {
                return Ok(effect.get().0.clone().into());
            })*
            if let Ok(effect) = obj.cast::<PyUserEffect>() {
                return Ok(effect.get().effect.clone().into());
            }
            Err(PyTypeError::new_err(format!("an effect wanted, got {}", obj.repr()?)))
        }

        /// The object that an effect is.
        pub(crate) fn to_python<'py>(py: Python<'py>, effect: &AnyEffect) -> PyResult<Bound<'py, PyAny>> {
            Ok(match effect {
                $(AnyEffect::$Core(effect) => Bound::new(py, $Class(effect.clone()))?.into_any(),)*
                AnyEffect::User(effect) => Bound::new(py, PyUserEffect::of(effect)?)?.into_any(),
            })
        }

        /// Adds the classes.
        pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_class::<$Class>()?;)*
            module.add_class::<PyUserEffect>()
        }
    };
}

effects! {
    /// Uniform gravity: the same acceleration everywhere.
    ///
    ///     F = m g        M = 0        U = −m g·x
    ///
    /// Parameters
    /// ----------
    /// acceleration : 3 numbers
    ///     Acceleration g, world axes [m/s²].
    /// bodies : list of str, optional
    ///     The bodies it acts on; all if absent.
    class "UniformGravity" PyUniformGravity(UniformGravity) (acceleration, bodies=None) as "(acceleration, bodies=None)" {
        /// Acceleration, world axes [m/s²].
        acceleration: [f64; 3],
        /// The bodies it acts on; None for all.
        bodies: Option<Vec<String>>,
    }

    /// Attraction by a point, with the torque of its gradient on an extended body.
    ///
    ///     r = x − center,  ρ = |r|,  J = R I Rᵀ
    ///     U = −μ m/ρ − ½ μ (tr J/ρ³ − 3 r·J r/ρ⁵)        MacCullagh's formula
    ///     M = 3 μ (r × J r)/ρ⁵
    ///
    /// Parameters
    /// ----------
    /// mu : float
    ///     Gravitational parameter μ = G M [m³/s²].
    /// center : 3 numbers
    ///     The attracting point, world axes [m].
    /// gradient_torque : bool
    ///     Whether the second term, with the gradient's torque, is kept.
    /// bodies : list of str, optional
    ///     The bodies it acts on; all if absent.
    class "PointGravity" PyPointGravity(PointGravity)
    (mu, center=Numbers([0.0; 3]), gradient_torque=true, bodies=None)
    as "(mu, center=(0.0, 0.0, 0.0), gradient_torque=True, bodies=None)"
    {
        /// Gravitational parameter μ = G M [m³/s²].
        mu: f64,
        /// The attracting point, world axes [m].
        center: [f64; 3],
        /// Whether the second term, with the gradient's torque, is kept.
        gradient_torque: bool,
        /// The bodies it acts on; None for all.
        bodies: Option<Vec<String>>,
    }

    /// Drag on translation and rotation, linear and quadratic.
    ///
    ///     u = v − wind
    ///     F = −(linear + quadratic |u|) u
    ///     M = −(angular_linear + angular_quadratic |ω|) ω
    ///
    /// Parameters
    /// ----------
    /// linear : float
    ///     Force per speed [N·s/m].
    /// quadratic : float
    ///     Force per speed squared [N·s²/m²]; for air ½ ρ c_d A.
    /// angular_linear : float
    ///     Torque per angular speed [N·m·s].
    /// angular_quadratic : float
    ///     Torque per angular speed squared [N·m·s²].
    /// wind : 3 numbers
    ///     Velocity of the medium, world axes [m/s].
    /// bodies : list of str, optional
    ///     The bodies it acts on; all if absent.
    class "Drag" PyDrag(Drag)
    (linear=0.0, quadratic=0.0, angular_linear=0.0, angular_quadratic=0.0, wind=Numbers([0.0; 3]), bodies=None)
    as "(linear=0.0, quadratic=0.0, angular_linear=0.0, angular_quadratic=0.0, wind=(0.0, 0.0, 0.0), bodies=None)"
    {
        /// Force per speed [N·s/m].
        linear: f64,
        /// Force per speed squared [N·s²/m²].
        quadratic: f64,
        /// Torque per angular speed [N·m·s].
        angular_linear: f64,
        /// Torque per angular speed squared [N·m·s²].
        angular_quadratic: f64,
        /// Velocity of the medium, world axes [m/s].
        wind: [f64; 3],
        /// The bodies it acts on; None for all.
        bodies: Option<Vec<String>>,
    }

    /// An engine: a force fixed in the body at a point fixed in the body.
    ///
    ///     F = k R force_body        M = R (point_body × k force_body)        k the schedule's factor
    ///
    /// Parameters
    /// ----------
    /// body : str
    ///     The body that carries the engine.
    /// point_body : 3 numbers
    ///     Where the force acts, body axes from the centre of mass [m].
    /// force_body : 3 numbers
    ///     The force at factor 1, body axes [N].
    /// schedule : list of (time, factor), optional
    ///     Times [s] and the factor of the force from then on: 0 before the first time, held after the
    ///     last, switched exactly at its times. Factor 1 always, if absent.
    class "Thruster" PyThruster(Thruster) (body, point_body, force_body, schedule=None)
    as "(body, point_body, force_body, schedule=None)"
    {
        /// The body that carries the engine.
        body: String,
        /// Where the force acts, body axes from the centre of mass [m].
        point_body: [f64; 3],
        /// The force at factor 1, body axes [N].
        force_body: [f64; 3],
        /// Pairs (time [s], factor), or None.
        schedule: Option<Schedule>,
    }

    /// A force and a torque, constant, scheduled or oscillating.
    ///
    ///     F = k s force        M = k s torque + (point − x) × F        s = sin(angular_frequency·t + phase), or 1
    ///
    /// Parameters
    /// ----------
    /// body : str
    ///     The body it acts on.
    /// force : 3 numbers
    ///     Force [N].
    /// torque : 3 numbers
    ///     Torque about the centre of mass [N·m].
    /// frame : {"world", "body"}
    ///     The axes of force, torque and point: the world's, or the body's from the centre of mass.
    /// point : 3 numbers, optional
    ///     Where the force acts [m]; the centre of mass if absent.
    /// schedule : list of (time, factor), optional
    ///     Times [s] and the factor k from then on; factor 1 always, if absent.
    /// angular_frequency : float, optional
    ///     Angular frequency of the oscillation [rad/s]; none if absent.
    /// phase : float
    ///     Phase of the oscillation at t = 0 [rad].
    class "Wrench" PyWrench(Wrench)
    (body, force=Numbers([0.0; 3]), torque=Numbers([0.0; 3]), frame=Frame::World.to_python(), point=None, schedule=None,
     angular_frequency=None, phase=0.0)
    as "(body, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0), frame='world', point=None, schedule=None, angular_frequency=None, phase=0.0)"
    {
        /// The body it acts on.
        body: String,
        /// Force [N].
        force: [f64; 3],
        /// Torque about the centre of mass [N·m].
        torque: [f64; 3],
        /// The axes of force, torque and point: "world" or "body".
        frame: Frame,
        /// Where the force acts [m]; None for the centre of mass.
        point: Option<[f64; 3]>,
        /// Pairs (time [s], factor), or None.
        schedule: Option<Schedule>,
        /// Angular frequency of the oscillation [rad/s], or None.
        angular_frequency: Option<f64>,
        /// Phase of the oscillation at t = 0 [rad].
        phase: f64,
    }

    /// A damped spring between points of two bodies, or of a body and the world.
    ///
    ///     d = p_b − p_a,  ℓ = |d|,  n = d/ℓ,  u = n·(v_b − v_a)
    ///     F_a = (stiffness (ℓ − rest_length) + damping u) n        F_b = −F_a
    ///
    /// Parameters
    /// ----------
    /// a : str
    ///     The first body.
    /// b : str, optional
    ///     The second body; the world if absent.
    /// anchor_a : 3 numbers
    ///     Where it holds on to a, body axes from the centre of mass [m].
    /// anchor_b : 3 numbers
    ///     Where it holds on to b, its body axes from its centre of mass, or world axes [m].
    /// stiffness : float
    ///     Force per length [N/m].
    /// damping : float
    ///     Force per speed [N·s/m].
    /// rest_length : float
    ///     Length without force [m].
    class "Spring" PySpring(Spring)
    (a, b=None, anchor_a=Numbers([0.0; 3]), anchor_b=Numbers([0.0; 3]), *, stiffness, damping=0.0, rest_length=0.0)
    as "(a, b=None, anchor_a=(0.0, 0.0, 0.0), anchor_b=(0.0, 0.0, 0.0), *, stiffness, damping=0.0, rest_length=0.0)"
    {
        /// The first body.
        a: String,
        /// The second body; None for the world.
        b: Option<String>,
        /// Where it holds on to a, body axes from the centre of mass [m].
        anchor_a: [f64; 3],
        /// Where it holds on to b, its body axes from its centre of mass, or world axes [m].
        anchor_b: [f64; 3],
        /// Force per length [N/m].
        stiffness: f64,
        /// Force per speed [N·s/m].
        damping: f64,
        /// Length without force [m].
        rest_length: f64,
    }
}

/// The Python side of a user effect.
#[derive(Debug)]
struct Functions {
    loads: Py<PyAny>,
    energy: Option<Py<PyAny>>,
    couples: Option<Vec<String>>,
    bodies: Option<Vec<String>>,
}

thread_local! {
    /// The last exception that a user's function raised on this thread; the core keeps only its text.
    static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// Takes the last exception that a user's function raised on this thread.
pub(crate) fn take_raised() -> Option<PyErr> {
    RAISED.take()
}

/// A function of yours as an effect.
///
///     (force, torque) = function(t, bodies)
///
/// It acts on each body alone: bodies then holds the one, and a pair is returned. With couples it acts
/// on these bodies together, and returns a list of one pair for each. World axes, the torque about
/// the centre of mass. It is called several times a step, at any time within it, and must depend on
/// nothing but its arguments. What it raises ends the run and becomes the cause of its SimulationError.
///
/// It is code, so it can neither be written to a file nor pickled.
///
/// Parameters
/// ----------
/// function : callable
///     function(t, bodies) -> (force, torque) [N], [N·m], or a list of such pairs; bodies is a tuple
///     of BodyMotion, t a time [s].
/// couples : list of str, optional
///     The bodies it acts on together, in this order.
/// bodies : list of str, optional
///     The bodies it acts on, each alone; all if neither is given.
/// energy : callable, optional
///     energy(t, bodies) -> potential energy [J]. With it the forces are taken to be conservative;
///     without, what they do is booked as work.
#[pyclass(name = "UserEffect", module = "bryla", frozen)]
#[derive(Debug)]
pub(crate) struct PyUserEffect {
    effect: UserEffect,
    functions: Arc<Functions>,
}

#[pymethods]
impl PyUserEffect {
    #[new]
    #[pyo3(signature = (function, couples=None, bodies=None, energy=None))]
    fn new(
        py: Python<'_>,
        function: Py<PyAny>,
        couples: Option<List<String>>,
        bodies: Option<List<String>>,
        energy: Option<Py<PyAny>>,
    ) -> Result<Self> {
        for (field, given) in [("function", Some(&function)), ("energy", energy.as_ref())] {
            if let Some(given) = given.filter(|given| !given.bind(py).is_callable()) {
                return Err(
                    PyTypeError::new_err(format!("{field} must be callable, got {}", given.bind(py).repr()?)).into()
                );
            }
        }
        let [couples, bodies] = [couples, bodies].map(|names| names.map(|names| names.0));
        let functions = Arc::new(Functions { loads: function, energy, couples, bodies });

        let callee = functions.clone();
        let mut effect = UserEffect::new(move |t, bodies| callee.loads(t, bodies)).attach(functions.clone());
        if let Some(names) = &functions.couples {
            effect = effect.couples(names);
        }
        if let Some(names) = &functions.bodies {
            effect = effect.on(names);
        }
        if functions.energy.is_some() {
            let callee = functions.clone();
            effect = effect.energy(move |t, bodies| callee.energy(t, bodies));
        }
        Ok(Self { effect, functions })
    }

    /// The function: function(t, bodies) -> (force, torque).
    #[getter]
    fn function(&self, py: Python<'_>) -> Py<PyAny> {
        self.functions.loads.clone_ref(py)
    }

    /// The bodies it acts on together, or None.
    #[getter]
    fn couples(&self) -> Option<Vec<String>> {
        self.functions.couples.clone()
    }

    /// The bodies it acts on, each alone, or None.
    #[getter]
    fn bodies(&self) -> Option<Vec<String>> {
        self.functions.bodies.clone()
    }

    /// The potential energy: energy(t, bodies) -> float, or None.
    #[getter]
    fn energy(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        self.functions.energy.as_ref().map(|energy| energy.clone_ref(py))
    }

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        let (a, b) = (&self.functions, &other.functions);
        let same_energy = match (&a.energy, &b.energy) {
            (Some(a), Some(b)) => a.bind(py).eq(b)?,
            (a, b) => a.is_none() && b.is_none(),
        };
        Ok(same_energy && a.loads.bind(py).eq(&b.loads)? && a.couples == b.couples && a.bodies == b.bodies)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let fields = vec![
            ("function", Ok(self.function(py))),
            ("couples", self.couples().into_py_any(py)),
            ("bodies", self.bodies().into_py_any(py)),
            ("energy", self.energy(py).into_py_any(py)),
        ];
        convert::call_text(py, "UserEffect", fields)
    }

    /// Refuses: a function is code.
    #[expect(clippy::unused_self, reason = "pickle calls it as a method")]
    fn __reduce__(&self) -> Result<()> {
        Err(bryla::Error::refused("user_effect", "a user effect is code and cannot be pickled").into())
    }
}

impl PyUserEffect {
    /// The object of an effect that was made here.
    fn of(effect: &UserEffect) -> PyResult<Self> {
        let made_here = || PyTypeError::new_err("a user effect without a Python function");
        let functions = effect.attached().ok_or_else(made_here)?;
        let functions = functions.downcast().map_err(|_| made_here())?;
        Ok(Self { effect: effect.clone(), functions })
    }
}

impl Functions {
    /// Force and torque on each body.
    fn loads(&self, t: f64, bodies: &[BodyMotion]) -> std::result::Result<Vec<(Vector3, Vector3)>, String> {
        called(&self.loads, t, bodies, |given| {
            let pairs = if self.couples.is_some() { given.extract::<List<Pair>>()?.0 } else { vec![given.extract()?] };
            Ok(pairs.into_iter().map(|Pair(force, torque)| (force, torque)).collect())
        })
    }

    /// Potential energy [J].
    fn energy(&self, t: f64, bodies: &[BodyMotion]) -> std::result::Result<f64, String> {
        match &self.energy {
            Some(energy) => called(energy, t, bodies, |given| given.extract()),
            None => Ok(0.0),
        }
    }
}

/// What a user's function returns; an exception is kept, and its text returned. After one that shall end the
/// program, such as `KeyboardInterrupt`, no function is called any more.
pub(crate) fn called<T>(
    function: &Py<PyAny>,
    t: f64,
    bodies: &[BodyMotion],
    read: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>,
) -> std::result::Result<T, String> {
    Python::attach(|py| {
        let call = || {
            let motions = bodies.iter().map(|body| Bound::new(py, PyBodyMotion(*body)));
            let motions = PyTuple::new(py, motions.collect::<PyResult<Vec<_>>>()?)?;
            read(&function.bind(py).call1((t, motions))?)
        };
        let ending = RAISED.with_borrow(|raised| {
            raised.as_ref().filter(|error| !error.is_instance_of::<PyException>(py)).map(ToString::to_string)
        });
        if let Some(text) = ending {
            return Err(text);
        }
        call().map_err(|error| {
            let text = error.to_string();
            RAISED.set(Some(error));
            text
        })
    })
}

/// A force [N] and a torque [N·m], as a user's function returns them.
struct Pair(Vector3, Vector3);

impl<'py> FromPyObject<'_, 'py> for Pair {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let read = || -> PyResult<Vec<Numbers<3>>> { obj.try_iter()?.map(|item| item?.extract()).collect() };
        if let Ok(&[Numbers(force), Numbers(torque)]) = read().as_deref() {
            return Ok(Self(force.into(), torque.into()));
        }
        let message = format!("a pair (force, torque) of 3 numbers each wanted, got {}", obj.repr()?);
        Err(PyTypeError::new_err(message))
    }
}

/// Ends in the exception that a user's function raised, if one did.
pub(crate) fn check_raised() -> Result<()> {
    take_raised().map_or(Ok(()), |error| Err(Failure::Python(error)))
}
