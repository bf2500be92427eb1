//! Bodies, and their motion at an instant.

use bryla::math::quaternion;
use bryla::{Body, BodyMotion, BreakingLoad, Freedom, Prescribed, Response, Shape};
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::convert::{self, Array, Numbers, Plain, Reduced, plain_class};
use crate::error::Result;
use crate::freedom::AnyFreedom;
use crate::mass::PyMassProperties;

plain_class! {
    /// One body: shape, mass, start and material. SI units, angles in radians.
    ///
    /// What is wrong with a body is told when it is added to a scene.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     A name that no other body of the scene has.
    /// shape : a shape, optional
    ///     The solid; without one, mass and inertia are given. Body axes are the shape's axes.
    /// density : float, optional
    ///     Uniform density [kg/m³].
    /// mass : float, optional
    ///     Mass [kg]; instead of the density, or beside inertia.
    /// inertia : 3 rows of 3 numbers, optional
    ///     Inertia about the centre of mass, body axes [kg·m²]; instead of that of a uniform solid.
    /// position : 3 numbers, optional
    ///     Where the centre of mass starts, world axes [m]; of a fixed body, the shape's origin.
    /// origin : 3 numbers, optional
    ///     Where the origin of the shape's coordinates starts, world axes [m]; instead of position.
    /// orientation : 4 numbers
    ///     Rotation from body to world axes, a unit quaternion (w, x, y, z).
    /// velocity : 3 numbers, optional
    ///     Velocity of the centre of mass, world axes [m/s]; 0, or what the freedom asks, if absent.
    /// angular_velocity : 3 numbers, optional
    ///     Angular velocity, world axes [rad/s].
    /// angular_velocity_body : 3 numbers, optional
    ///     Angular velocity, body axes [rad/s]; instead of angular_velocity.
    /// friction : float
    ///     Coefficient of friction [-]; a pair has the geometric mean of both.
    /// restitution : float
    ///     Coefficient of restitution, 0 to 1 [-]; a pair has the larger of both.
    /// response : {"bounce", "stick"}
    ///     What happens when it touches another body.
    /// breaking_load : (float or None, float or None), optional
    ///     Force [N] and torque about the point of contact [N·m] under which what it sticks to, or what sticks to it,
    ///     comes off; of a pair the weaker counts. None bears any.
    /// fixed : bool
    ///     Whether it stays where it is.
    /// motion : Prescribed, optional
    ///     The motion that it is moved along, whatever it meets.
    /// freedom : "free", Planar, Pivot or Axle
    ///     How it may move.
    /// collides : bool
    ///     Whether its shape meets other bodies; if not, it serves for the mass alone.
    class "Body" PyBody(Body)
    (name, shape=None, *, density=None, mass=None, inertia=None, position=None, origin=None,
     orientation=Numbers([1.0, 0.0, 0.0, 0.0]), velocity=None, angular_velocity=None, angular_velocity_body=None,
     friction=0.0, restitution=0.0, response=Response::Bounce.to_python(), breaking_load=None, fixed=false, motion=None,
     freedom=AnyFreedom(Freedom::Free), collides=true)
    as "(name, shape=None, *, density=None, mass=None, inertia=None, position=None, origin=None, orientation=(1.0, 0.0, 0.0, 0.0), velocity=None, angular_velocity=None, angular_velocity_body=None, friction=0.0, restitution=0.0, response='bounce', breaking_load=None, fixed=False, motion=None, freedom='free', collides=True)"
    {
        /// A name that no other body of the scene has.
        name: String,
        /// The solid, or None.
        shape: Option<Shape>,
        /// Uniform density [kg/m³], or None.
        density: Option<f64>,
        /// Mass [kg], or None.
        mass: Option<f64>,
        /// Inertia about the centre of mass, body axes [kg·m²], or None.
        inertia: Option<[[f64; 3]; 3]>,
        /// Where the centre of mass starts, world axes [m], or None.
        position: Option<[f64; 3]>,
        /// Where the origin of the shape's coordinates starts, world axes [m], or None.
        origin: Option<[f64; 3]>,
        /// Rotation from body to world axes, (w, x, y, z).
        orientation: [f64; 4],
        /// Velocity of the centre of mass, world axes [m/s], or None.
        velocity: Option<[f64; 3]>,
        /// Angular velocity, world axes [rad/s], or None.
        angular_velocity: Option<[f64; 3]>,
        /// Angular velocity, body axes [rad/s], or None.
        angular_velocity_body: Option<[f64; 3]>,
        /// Coefficient of friction [-].
        friction: f64,
        /// Coefficient of restitution [-].
        restitution: f64,
        /// What happens when it touches another body: "bounce" or "stick".
        response: Response,
        /// Force [N] and torque [N·m] under which what has stuck comes off, or None.
        breaking_load: Option<BreakingLoad>,
        /// Whether it stays where it is.
        fixed: bool,
        /// The motion that it is moved along, or None.
        motion: Option<Prescribed>,
        /// How it may move: "free", Planar, Pivot or Axle.
        freedom: Freedom,
        /// Whether its shape meets other bodies.
        collides: bool,
    }

    /// Mass, centre of mass (shape axes) and inertia of a body that moves.
    #[pyo3(signature = ())]
    fn mass_properties(&self) -> Result<PyMassProperties> {
        Ok(PyMassProperties(self.0.mass_properties()?))
    }
}

/// Motion of one body at an instant, as effects and simulations see it.
///
/// World axes unless a name ends in _body; arrays are copies.
#[pyclass(name = "BodyMotion", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyBodyMotion(pub(crate) BodyMotion);

#[pymethods]
impl PyBodyMotion {
    /// Mass [kg].
    #[getter]
    fn mass(&self) -> f64 {
        self.0.mass
    }

    /// Inertia about the centre of mass, body axes [kg·m²]: array (3, 3).
    #[getter]
    fn inertia_body<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::matrix(py, &self.0.inertia_body)
    }

    /// Centre of mass [m]: array (3,).
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.position)
    }

    /// Rotation from body to world axes, (w, x, y, z): array (4,).
    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::array(py, &[4], quaternion::to_scalar_first(&self.0.orientation).to_vec())
    }

    /// The same rotation as a matrix: array (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::matrix(py, &self.0.rotation)
    }

    /// Velocity of the centre of mass [m/s]: array (3,).
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.velocity)
    }

    /// Angular velocity [rad/s]: array (3,).
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.angular_velocity)
    }

    /// Angular velocity, body axes [rad/s]: array (3,).
    #[getter]
    fn angular_velocity_body<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.angular_velocity_body())
    }

    /// Linear momentum m v [kg·m/s]: array (3,).
    #[getter]
    fn linear_momentum<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &(self.0.mass * self.0.velocity))
    }

    /// Angular momentum about the centre of mass [kg·m²/s]: array (3,).
    #[getter]
    fn angular_momentum<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.angular_momentum())
    }

    /// Kinetic energy [J].
    #[getter]
    fn kinetic_energy(&self) -> f64 {
        self.0.kinetic_energy()
    }

    /// A body point (body axes, from the centre of mass) in the world [m]: array (3,).
    #[pyo3(signature = (p_body))]
    fn point<'py>(&self, py: Python<'py>, p_body: Numbers<3>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.point(&p_body.0.into()))
    }

    /// Velocity of the body at a world point [m/s]: array (3,).
    #[pyo3(signature = (p))]
    fn velocity_at<'py>(&self, py: Python<'py>, p: Numbers<3>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.velocity_at(&p.0.into()))
    }

    fn __repr__(&self) -> String {
        let BodyMotion { mass, position: x, velocity: v, angular_velocity: w, .. } = &self.0;
        let [x, v, w] = [x, v, w].map(|a| format!("({:.6}, {:.6}, {:.6})", a.x, a.y, a.z));
        format!("<bryla.BodyMotion: {mass} kg at {x} m, velocity {v} m/s, angular velocity {w} rad/s>")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}
