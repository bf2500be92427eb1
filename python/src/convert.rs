//! Conversion between Python's values and plain data; all of it is here.

use bryla::contact::collision::Law;
use bryla::effect::Frame;
use bryla::math::{Matrix3, Vector3};
use bryla::{BreakingLoad, Direction, Finder, Orientation, Record, Response, Schedule};
use numpy::{AllowTypeChange, IxDyn, PyArray1, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList, PyString, PyTuple, PyType};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;

/// `N` numbers, from any iterable of them: a tuple, a list, an array. To Python, a tuple.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers<const N: usize>(pub(crate) [f64; N]);

impl<'py, const N: usize> FromPyObject<'_, 'py> for Numbers<N> {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let read = || -> PyResult<Option<[f64; N]>> {
            let mut numbers = [0.0; N];
            let mut given = obj.try_iter()?;
            for number in &mut numbers {
                let Some(item) = given.next() else { return Ok(None) };
                *number = item?.extract()?;
            }
            Ok(given.next().is_none().then_some(numbers))
        };
        match read() {
            Ok(Some(numbers)) => Ok(Self(numbers)),
            _ => Err(PyTypeError::new_err(format!("{N} numbers wanted, got {}", obj.repr()?))),
        }
    }
}

impl<'py, const N: usize> IntoPyObject<'py> for Numbers<N> {
    type Target = PyTuple;
    type Output = Bound<'py, PyTuple>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        PyTuple::new(py, self.0)
    }
}

/// Several values, from any iterable but a string. To Python, a list.
#[derive(Debug, Clone)]
pub(crate) struct List<T>(pub(crate) Vec<T>);

impl<'py, T: pyo3::conversion::FromPyObjectOwned<'py>> FromPyObject<'_, 'py> for List<T> {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if obj.is_instance_of::<PyString>() {
            return Err(PyTypeError::new_err(format!("a list wanted, got {}", obj.repr()?)));
        }
        obj.try_iter()?.map(|item| item?.extract().map_err(Into::into)).collect::<PyResult<_>>().map(Self)
    }
}

impl<'py, T: IntoPyObject<'py>> IntoPyObject<'py> for List<T> {
    type Target = PyList;
    type Output = Bound<'py, PyList>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let items = self.0.into_iter().map(|item| item.into_bound_py_any(py)).collect::<PyResult<Vec<_>>>()?;
        PyList::new(py, items)
    }
}

/// Plain data of the core, and the Python value that stands for it.
pub(crate) trait Plain: Sized {
    /// The value that Python gives and gets.
    type Value;

    fn to_python(&self) -> Self::Value;

    fn from_python(value: Self::Value) -> Result<Self>;
}

/// Data that Python has as well.
macro_rules! same {
    ($($Type:ty),*) => {
        $(impl Plain for $Type {
            type Value = Self;

            fn to_python(&self) -> Self {
                self.clone()
            }

            fn from_python(value: Self) -> Result<Self> {
                Ok(value)
            }
        })*
    };
}
same!(f64, usize, bool, String, std::path::PathBuf);

impl<const N: usize> Plain for [f64; N] {
    type Value = Numbers<N>;

    fn to_python(&self) -> Numbers<N> {
        Numbers(*self)
    }

    fn from_python(value: Numbers<N>) -> Result<Self> {
        Ok(value.0)
    }
}

impl Plain for [[f64; 3]; 3] {
    type Value = List<Numbers<3>>;

    fn to_python(&self) -> List<Numbers<3>> {
        List(self.map(Numbers).to_vec())
    }

    fn from_python(value: List<Numbers<3>>) -> Result<Self> {
        let rows: Vec<_> = value.0.into_iter().map(|row| row.0).collect();
        let count = rows.len();
        Ok(rows
            .try_into()
            .map_err(|_| PyTypeError::new_err(format!("3 rows of 3 numbers wanted, got {count} rows")))?)
    }
}

impl<T: Plain> Plain for Option<T> {
    type Value = Option<T::Value>;

    fn to_python(&self) -> Self::Value {
        self.as_ref().map(Plain::to_python)
    }

    fn from_python(value: Self::Value) -> Result<Self> {
        value.map(T::from_python).transpose()
    }
}

impl<T: Plain> Plain for Vec<T> {
    type Value = List<T::Value>;

    fn to_python(&self) -> Self::Value {
        List(self.iter().map(Plain::to_python).collect())
    }

    fn from_python(value: Self::Value) -> Result<Self> {
        value.0.into_iter().map(T::from_python).collect()
    }
}

impl Plain for Schedule {
    type Value = List<Numbers<2>>;

    fn to_python(&self) -> List<Numbers<2>> {
        List(self.0.iter().map(|&(time, factor)| Numbers([time, factor])).collect())
    }

    fn from_python(value: List<Numbers<2>>) -> Result<Self> {
        Ok(Self(value.0.into_iter().map(|Numbers([time, factor])| (time, factor)).collect()))
    }
}

impl Plain for BreakingLoad {
    type Value = (Option<f64>, Option<f64>);

    /// None where it bears any.
    fn to_python(&self) -> Self::Value {
        let [force, torque] = [self.force, self.torque].map(|most| (most != f64::INFINITY).then_some(most));
        (force, torque)
    }

    fn from_python((force, torque): Self::Value) -> Result<Self> {
        Ok(Self::new(force.unwrap_or(f64::INFINITY), torque.unwrap_or(f64::INFINITY)))
    }
}

/// The variant that `text` names.
pub(crate) fn named<T: Copy>(
    place: &str,
    field: &'static str,
    all: &[T],
    name: fn(T) -> &'static str,
    text: &str,
) -> Result<T> {
    let found = all.iter().copied().find(|&variant| name(variant) == text);
    Ok(found.ok_or_else(|| {
        let names: Vec<_> = all.iter().map(|&variant| name(variant)).collect();
        bryla::Error::value(place, field, format!("one of {}", names.join(", ")), text)
    })?)
}

/// Enums that Python has as lower-case strings.
macro_rules! names {
    ($($Type:ty: $place:literal, $field:literal;)*) => {
        $(impl Plain for $Type {
            type Value = String;

            fn to_python(&self) -> String {
                self.name().to_owned()
            }

            fn from_python(text: String) -> Result<Self> {
                named($place, $field, Self::ALL, Self::name, &text)
            }
        })*
    };
}
names! {
    Response: "body", "response";
    Frame: "wrench", "frame";
    Record: "run", "record";
    Orientation: "run", "orientation";
    Finder: "run", "finder";
    Law: "run", "restitution_law";
    Direction: "event", "direction";
}

/// A call that would make the object again, such as `Sphere(radius=0.1)`; what is `None` is left out.
pub(crate) fn call_text(py: Python<'_>, name: &str, arguments: Vec<(&str, PyResult<Py<PyAny>>)>) -> PyResult<String> {
    let mut words = Vec::new();
    for (field, value) in arguments {
        let value = value?;
        if !value.is_none(py) {
            words.push(format!("{field}={}", value.bind(py).repr()?));
        }
    }
    Ok(format!("{name}({})", words.join(", ")))
}

/// What pickle keeps: a class method that reads bytes, and the bytes.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyBytes>,));

/// The pickled form of an object of a class that has `_from_bytes`.
pub(crate) fn reduce<'py>(class: &Bound<'py, PyType>, value: &impl Serialize) -> PyResult<Reduced<'py>> {
    let bytes = rmp_serde::to_vec_named(value).map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok((class.getattr("_from_bytes")?, (PyBytes::new(class.py(), &bytes),)))
}

/// The object whose pickled form has these bytes.
pub(crate) fn from_bytes<T: DeserializeOwned>(bytes: &[u8]) -> PyResult<T> {
    rmp_serde::from_slice(bytes).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// A class of plain data: made from its fields, which it shows; compared, printed and pickled by them.
macro_rules! plain_class {
    (
        $(#[$doc:meta])*
        class $name:tt $Class:ident($Core:ident) $signature:tt as $text:tt {
            $($(#[$field_doc:meta])* $field:ident: $Type:ty,)*
        }
        $($methods:tt)*
    ) => {
        $(#[$doc])*
        #[pyclass(name = $name, module = "bryla", frozen, eq)]
        #[derive(Debug, Clone, PartialEq)]
        pub(crate) struct $Class(pub(crate) $Core);

        #[pymethods]
        impl $Class {
            #[new]
            #[pyo3(signature = $signature, text_signature = $text)]
            #[allow(clippy::too_many_arguments, reason = "one for each field")]
            fn new($($field: <$Type as $crate::convert::Plain>::Value,)*) -> $crate::error::Result<Self> {
                Ok(Self($Core { $($field: $crate::convert::Plain::from_python($field)?,)* }))
            }

            $(
                $(#[$field_doc])*
                #[getter]
                fn $field(&self) -> <$Type as $crate::convert::Plain>::Value {
                    $crate::convert::Plain::to_python(&self.0.$field)
                }
            )*

            fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
                use pyo3::IntoPyObjectExt;
                let fields = vec![$((stringify!($field), self.$field().into_py_any(py)),)*];
                $crate::convert::call_text(py, $name, fields)
            }

            fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<$crate::convert::Reduced<'py>> {
                $crate::convert::reduce(&py.get_type::<Self>(), &self.0)
            }

            #[classmethod]
            fn _from_bytes(_class: &Bound<'_, pyo3::types::PyType>, bytes: &[u8]) -> PyResult<Self> {
                $crate::convert::from_bytes(bytes).map(Self)
            }

            $($methods)*
        }
    };
}
pub(crate) use plain_class;

/// An array of any shape.
pub(crate) type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

/// An array of this shape from its numbers, the last axis running fastest.
pub(crate) fn array<'py>(py: Python<'py>, shape: &[usize], numbers: Vec<f64>) -> PyResult<Array<'py>> {
    PyArray1::from_vec(py, numbers).reshape(IxDyn(shape))
}

/// A vector as an array: (3,).
pub(crate) fn vector<'py>(py: Python<'py>, v: &Vector3) -> PyResult<Array<'py>> {
    array(py, &[3], v.as_slice().to_vec())
}

/// The nine numbers of a matrix, row by row.
pub(crate) fn rows(m: &Matrix3) -> [f64; 9] {
    [m[(0, 0)], m[(0, 1)], m[(0, 2)], m[(1, 0)], m[(1, 1)], m[(1, 2)], m[(2, 0)], m[(2, 1)], m[(2, 2)]]
}

/// The matrix of nine numbers, row by row.
pub(crate) fn from_rows(numbers: [f64; 9]) -> Matrix3 {
    Matrix3::from_row_slice(&numbers)
}

/// A matrix as an array: (3, 3).
pub(crate) fn matrix<'py>(py: Python<'py>, m: &Matrix3) -> PyResult<Array<'py>> {
    array(py, &[3, 3], rows(m).to_vec())
}

/// What NumPy makes an array of numbers of.
pub(crate) type ArrayLike<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// Items of `N` numbers in an array, its last axes being those of an item: the axes before them, and
/// the items.
pub(crate) fn items<const N: usize>(given: &ArrayLike<'_>, item: &[usize]) -> PyResult<(Vec<usize>, Vec<[f64; N]>)> {
    let given = given.as_array();
    let Some(leading) = given.shape().strip_suffix(item) else {
        let axes: Vec<_> = item.iter().map(ToString::to_string).collect();
        let wanted = axes.join(", ");
        return Err(PyValueError::new_err(format!("shape (..., {wanted}) wanted, got {:?}", given.shape())));
    };
    let numbers: Vec<f64> = given.iter().copied().collect();
    Ok((leading.to_vec(), numbers.as_chunks().0.to_vec()))
}

/// Applies `f` to every item of an array.
pub(crate) fn map<'py, const I: usize, const O: usize>(
    py: Python<'py>,
    given: &ArrayLike<'_>,
    axes: [&[usize]; 2],
    f: impl Fn([f64; I]) -> [f64; O],
) -> PyResult<Array<'py>> {
    let (mut shape, items) = items::<I>(given, axes[0])?;
    shape.extend(axes[1]);
    array(py, &shape, items.into_iter().flat_map(f).collect())
}

/// Applies `f` to the items of two arrays, pair by pair; of which one may be a single item.
pub(crate) fn map_pairs<'py, const A: usize, const B: usize, const O: usize>(
    py: Python<'py>,
    [a, b]: [&ArrayLike<'_>; 2],
    axes: [&[usize]; 3],
    f: impl Fn([f64; A], [f64; B]) -> [f64; O],
) -> PyResult<Array<'py>> {
    let ((shape_a, a), (shape_b, b)) = (items::<A>(a, axes[0])?, items::<B>(b, axes[1])?);
    let mut shape = match (shape_a.is_empty(), shape_b.is_empty()) {
        (_, true) => shape_a,
        (true, _) => shape_b,
        _ if shape_a == shape_b => shape_a,
        _ => {
            let message = format!("the axes before the last must agree, got {shape_a:?} and {shape_b:?}");
            return Err(PyValueError::new_err(message));
        }
    };
    let count = shape.iter().product();
    shape.extend(axes[2]);
    let pairs = a.iter().cycle().zip(b.iter().cycle()).take(count);
    array(py, &shape, pairs.flat_map(|(a, b)| f(*a, *b)).collect())
}
