//! Many free bodies at once.

use std::num::NonZero;

use bryla::math::{Matrix3, Vector3, quaternion};
use bryla::{Batch, BodyMotion};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::convert::{self, Array, ArrayLike};
use crate::error::Result;

/// Body-steps between two looks at Python's signals: about a second of one core.
const PIECE: u64 = 20_000_000;

/// Free bodies that fly on their own, advanced together by the classical Runge–Kutta method.
///
/// Nothing acts on them, so they do not know of each other; a body in a batch has the same bits as on its
/// own. Arrays have one row for each body; one item is for all.
///
/// Parameters
/// ----------
/// mass : float or array (bodies,)
///     Masses [kg].
/// inertia : array (3, 3) or (bodies, 3, 3)
///     Inertia about the centre of mass, body axes [kg·m²].
/// position, velocity, angular_velocity : array (3,) or (bodies, 3), optional
///     Where the centre of mass is [m], its velocity [m/s], the angular velocity [rad/s], world axes; 0 if absent.
/// orientation : array (4,) or (bodies, 4), optional
///     Rotation from body to world axes (w, x, y, z), of which q/|q| is taken; none if absent.
#[pyclass(name = "Batch", module = "bryla")]
#[derive(Debug)]
pub(crate) struct PyBatch(Batch);

/// Items of `N` numbers of which there is one for all, or one for each body.
struct Column<const N: usize> {
    name: &'static str,
    items: Vec<[f64; N]>,
}

impl<const N: usize> Column<N> {
    fn new(name: &'static str, given: Option<&ArrayLike<'_>>, axes: &[usize], default: [f64; N]) -> PyResult<Self> {
        let items = match given {
            None => vec![default],
            Some(given) => {
                let (leading, items) = convert::items::<N>(given, axes)
                    .map_err(|error| PyValueError::new_err(format!("{name}: {error}")))?;
                if leading.len() > 1 {
                    return Err(PyValueError::new_err(format!("{name}: one axis of bodies wanted, got {leading:?}")));
                }
                items
            }
        };
        Ok(Self { name, items })
    }

    /// The item of a body.
    fn get(&self, body: usize) -> [f64; N] {
        if self.items.len() == 1 { self.items[0] } else { self.items[body] }
    }

    /// Whether it has one item, or one for each of `n` bodies.
    fn check(&self, n: usize) -> PyResult<()> {
        if self.items.len() == 1 || self.items.len() == n {
            return Ok(());
        }
        let message = format!("{}: one item or one for each of {n} bodies wanted, got {}", self.name, self.items.len());
        Err(PyValueError::new_err(message))
    }
}

#[pymethods]
impl PyBatch {
    #[new]
    #[pyo3(signature = (mass, inertia, *, position=None, orientation=None, velocity=None, angular_velocity=None))]
    fn new(
        mass: ArrayLike<'_>,
        inertia: ArrayLike<'_>,
        position: Option<ArrayLike<'_>>,
        orientation: Option<ArrayLike<'_>>,
        velocity: Option<ArrayLike<'_>>,
        angular_velocity: Option<ArrayLike<'_>>,
    ) -> Result<Self> {
        let mass = Column::<1>::new("mass", Some(&mass), &[], [0.0])?;
        let inertia = Column::<9>::new("inertia", Some(&inertia), &[3, 3], [0.0; 9])?;
        let orientation = Column::new("orientation", orientation.as_ref(), &[4], [1.0, 0.0, 0.0, 0.0])?;
        let vectors = [("position", position), ("velocity", velocity), ("angular_velocity", angular_velocity)];
        let [position, velocity, angular_velocity] =
            vectors.map(|(name, given)| Column::<3>::new(name, given.as_ref(), &[3], [0.0; 3]));
        let (position, velocity, angular_velocity) = (position?, velocity?, angular_velocity?);

        let counts = [
            mass.items.len(),
            inertia.items.len(),
            orientation.items.len(),
            position.items.len(),
            velocity.items.len(),
            angular_velocity.items.len(),
        ];
        let n = if counts.contains(&0) { 0 } else { counts.into_iter().max().unwrap_or(0) };
        mass.check(n)?;
        inertia.check(n)?;
        orientation.check(n)?;
        for column in [&position, &velocity, &angular_velocity] {
            column.check(n)?;
        }
        let motion = |body: usize| {
            let rows: Matrix3 = convert::from_rows(inertia.get(body));
            let mut motion = BodyMotion::at_rest(mass.get(body)[0], rows);
            motion.position = Vector3::from(position.get(body));
            motion.orientation = quaternion::normalized(&quaternion::from_scalar_first(orientation.get(body)));
            motion.rotation = quaternion::to_matrix(&motion.orientation);
            motion.velocity = Vector3::from(velocity.get(body));
            motion.angular_velocity = Vector3::from(angular_velocity.get(body));
            motion
        };
        Ok(Self(Batch::new((0..n).map(motion).collect())?))
    }

    /// Takes steps, on as many threads as are asked for, by default as many as there are processors; the
    /// bits do not depend on them. Other Python threads go on meanwhile, and Ctrl-C ends it between pieces.
    ///
    /// Parameters
    /// ----------
    /// step : float
    ///     Length of a step [s].
    /// steps : int
    ///     How many.
    /// threads : int, optional
    ///     How many threads.
    #[pyo3(signature = (step, steps, *, threads=None))]
    fn advance(&mut self, py: Python<'_>, step: f64, steps: u64, threads: Option<NonZero<usize>>) -> Result<()> {
        let available = || std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        let threads = threads.unwrap_or_else(available);
        let piece = (PIECE / (self.0.len() as u64).max(1)).max(1);
        let mut left = steps;
        while left > 0 {
            let next = left.min(piece);
            py.detach(|| self.0.advance(step, next, threads))?;
            py.check_signals()?;
            left -= next;
        }
        Ok(())
    }

    /// Centres of mass [m]: array (bodies, 3).
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.numbers(py, |motion| motion.position.into())
    }

    /// Rotations from body to world axes (w, x, y, z): array (bodies, 4).
    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.numbers(py, |motion| quaternion::to_scalar_first(&motion.orientation))
    }

    /// Velocities of the centres of mass, world axes [m/s]: array (bodies, 3).
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.numbers(py, |motion| motion.velocity.into())
    }

    /// Angular velocities, world axes [rad/s]: array (bodies, 3).
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.numbers(py, |motion| motion.angular_velocity.into())
    }

    /// Kinetic energies [J]: array (bodies,).
    #[getter]
    fn kinetic_energy<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::array(py, &[self.0.len()], self.0.motions().map(|motion| motion.kinetic_energy()).collect())
    }

    /// Number of bodies.
    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __repr__(&self) -> String {
        format!("<bryla.Batch: {} bodies>", self.0.len())
    }
}

impl PyBatch {
    /// Numbers of every body: (bodies, N).
    fn numbers<'py, const N: usize>(&self, py: Python<'py>, of: fn(&BodyMotion) -> [f64; N]) -> PyResult<Array<'py>> {
        let numbers = self.0.motions().flat_map(|motion| of(&motion)).collect();
        convert::array(py, &[self.0.len(), N], numbers)
    }
}
