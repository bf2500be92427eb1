//! An effect that the user writes.

use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use super::{BodyMotion, Effect, Load, Moment, Target};
use crate::error::{Error, Result};
use crate::math::Vector3;

/// What a user's function returns: force [N] and torque about the centre of mass [N·m] for each
/// body it was given, world axes; or a message that ends the run.
pub type UserLoads = Result<Vec<(Vector3, Vector3)>, String>;

type LoadFunction = dyn Fn(f64, &[BodyMotion]) -> UserLoads + Send + Sync;
type EnergyFunction = dyn Fn(f64, &[BodyMotion]) -> Result<f64, String> + Send + Sync;

/// A function of the user as an effect.
///
/// ```text
/// (F_i, M_i) = function(t, bodies)
/// ```
///
/// It acts on each body alone, or, with `couples`, on the named bodies together. With an `energy`
/// its forces are taken to be conservative with that potential; without, what they do is booked as
/// work. It is called several times a step, at any time within it, and must depend on nothing but
/// its arguments. It cannot be written to a file.
#[derive(Clone)]
pub struct UserEffect {
    function: Arc<LoadFunction>,
    couples: Option<Vec<String>>,
    bodies: Option<Vec<String>>,
    energy: Option<Arc<EnergyFunction>>,
    failure: Arc<Mutex<Option<String>>>,
    attached: Option<Arc<dyn Any + Send + Sync>>,
}

impl UserEffect {
    /// An effect that acts on every body alone.
    pub fn new(function: impl Fn(f64, &[BodyMotion]) -> UserLoads + Send + Sync + 'static) -> Self {
        Self {
            function: Arc::new(function),
            couples: None,
            bodies: None,
            energy: None,
            failure: Arc::default(),
            attached: None,
        }
    }

    /// On these bodies together, in this order.
    #[must_use]
    pub fn couples<S: Into<String>>(mut self, bodies: impl IntoIterator<Item = S>) -> Self {
        self.couples = Some(bodies.into_iter().map(Into::into).collect());
        self
    }

    /// On each of these bodies alone.
    #[must_use]
    pub fn on<S: Into<String>>(mut self, bodies: impl IntoIterator<Item = S>) -> Self {
        self.bodies = Some(bodies.into_iter().map(Into::into).collect());
        self
    }

    /// Potential energy [J] of the bodies the function is given, at a time [s].
    #[must_use]
    pub fn energy(
        mut self,
        energy: impl Fn(f64, &[BodyMotion]) -> Result<f64, String> + Send + Sync + 'static,
    ) -> Self {
        self.energy = Some(Arc::new(energy));
        self
    }

    /// Keeps something of the caller's with the effect, such as what the function was made from.
    #[must_use]
    pub fn attach(mut self, object: Arc<dyn Any + Send + Sync>) -> Self {
        self.attached = Some(object);
        self
    }

    /// What the caller attached.
    pub fn attached(&self) -> Option<Arc<dyn Any + Send + Sync>> {
        self.attached.clone()
    }

    /// The loads of the function; where it fails, the message is kept and the loads are not finite,
    /// so that the step is refused. It is not shown motions that are not finite, as those after a failure.
    fn loads(&self, at: Moment, bodies: &[BodyMotion]) -> Vec<(Vector3, Vector3)> {
        let nothing = || vec![(Vector3::repeat(f64::NAN), Vector3::zeros()); bodies.len()];
        if !bodies.iter().all(BodyMotion::is_finite) {
            return nothing();
        }
        match (self.function)(at.time, bodies) {
            Ok(loads) if loads.len() == bodies.len() => loads,
            Ok(loads) => {
                self.fail(format!(
                    "must return one (force, torque) per body: {} wanted, got {}",
                    bodies.len(),
                    loads.len()
                ));
                nothing()
            }
            Err(message) => {
                self.fail(message);
                nothing()
            }
        }
    }

    fn fail(&self, message: String) {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
    }
}

impl Effect for UserEffect {
    fn validate(&self, place: &str) -> Result<()> {
        if self.couples.is_some() && self.bodies.is_some() {
            return Err(Error::refused(place, "couples and bodies exclude each other: together, or each alone"));
        }
        if self.couples.as_ref().is_some_and(Vec::is_empty) {
            return Err(Error::value(place, "couples", "at least one body", &self.couples));
        }
        Ok(())
    }

    fn target(&self) -> Target {
        self.couples.clone().map_or_else(|| Target::each(self.bodies.as_ref()), Target::Together)
    }

    fn conservative(&self) -> bool {
        self.energy.is_some()
    }

    fn add_to(&self, at: Moment, bodies: &[BodyMotion], loads: &mut [Load]) {
        if self.couples.is_some() {
            for ((force, torque), load) in self.loads(at, bodies).into_iter().zip(loads) {
                load.force += force;
                load.torque += torque;
            }
        } else {
            for (body, load) in bodies.iter().zip(loads) {
                for (force, torque) in self.loads(at, std::slice::from_ref(body)) {
                    load.force += force;
                    load.torque += torque;
                }
            }
        }
    }

    fn potential_energy(&self, at: Moment, bodies: &[BodyMotion]) -> f64 {
        let Some(energy) = &self.energy else { return 0.0 };
        let mut total = 0.0;
        for chunk in bodies.chunks(if self.couples.is_some() { bodies.len().max(1) } else { 1 }) {
            match energy(at.time, chunk) {
                Ok(u) => total += u,
                Err(message) => {
                    self.fail(message);
                    return f64::NAN;
                }
            }
        }
        total
    }

    fn work_rate(&self, at: Moment, bodies: &[BodyMotion]) -> f64 {
        if self.energy.is_some() {
            return 0.0;
        }
        let mut loads = vec![Load::zero(); bodies.len()];
        self.add_to(at, bodies, &mut loads);
        bodies.iter().zip(&loads).map(|(body, load)| load.power(body)).sum()
    }

    fn take_failure(&self) -> Option<String> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl fmt::Debug for UserEffect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("UserEffect")
            .field("couples", &self.couples)
            .field("bodies", &self.bodies)
            .field("energy", &self.energy.is_some())
            .finish_non_exhaustive()
    }
}

/// Two are equal when they are the same function on the same bodies.
impl PartialEq for UserEffect {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function) && self.couples == other.couples && self.bodies == other.bodies
    }
}
