//! Bodies that become one in the course of a run: what the plan says of them.
//!
//! ```text
//! m = Σ mᵢ        I = Σ [R_i I_i R_iᵀ + m_i (|d_i|² 1 − d_i d_iᵀ)]        lecture §7, parallel axes
//! ```
//!
//! A compound is one flight group: itself, which moves freely, and its parts, which follow it and take the loads.
//! Under uniform gravity that pulls at all parts alike its motion has a closed form.

use std::ops::Range;
use std::sync::Arc;

use super::{Binding, FlightGroup, Plan, PlannedBody, Toggle, watch};
use crate::effect::AnyEffect;
use crate::error::{Error, Result};
use crate::freedom::{Chart, Freedom, Riding};
use crate::integrator::Method;
use crate::mass::MassProperties;
use crate::math::{Matrix3, Pose, Vector3};
use crate::scene::Orientation;
use crate::state::BodyMotion;

/// Several bodies that move as one.
#[derive(Debug, Clone)]
pub(crate) struct Compound {
    /// It as a body, with a place behind those of the scene. Its axes are those of its first part at the time of
    /// the merge; it has no shape but those of its parts.
    pub(crate) body: PlannedBody,
    pub(crate) parts: Vec<Part>,
    /// Whether it rides on a moved body: its centre is a point of that, and no load moves it.
    pub(crate) rides: bool,
    /// What flies: the compound, then the members of its parts' groups.
    pub(crate) spec: Arc<FlightGroup>,
}

/// A body of the scene that is part of a compound.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    /// Its place in the scene.
    pub(crate) body: usize,
    /// Its centre of mass and axes, in the axes of the compound, from the compound's centre of mass.
    pub(crate) pose: Pose,
    /// The group that it is the moving body of, and where this group's members stand among the compound's.
    pub(crate) group: usize,
    pub(crate) members: Range<usize>,
}

impl Plan {
    /// These bodies as one, which is the body `place` behind those of the scene.
    ///
    /// # Errors
    /// A body that an effect joins to others in flight, or whose loads the state switches.
    pub(crate) fn compound(&self, place: usize, bodies: &[(usize, Pose)], rides: bool) -> Result<Compound> {
        let name = bodies.iter().map(|&(i, _)| self.bodies[i].name.as_str()).collect::<Vec<_>>().join(" + ");
        let solids: Vec<MassProperties> = bodies
            .iter()
            .map(|(i, pose)| {
                let own = MassProperties { center_of_mass: Vector3::zeros(), ..self.bodies[*i].properties };
                own.turned(&pose.orientation).moved(pose.position)
            })
            .collect();
        let whole = MassProperties::combined(&solids);
        // what is moved turns as its driver does, whatever its moments
        let inertia = if rides { Matrix3::identity() } else { whole.inertia };
        let properties = MassProperties { center_of_mass: Vector3::zeros(), inertia, ..whole };
        let radius = bodies.iter().map(|(i, pose)| pose.position.norm() + self.bodies[*i].radius).fold(0.0, f64::max);

        // the groups of the parts, one behind the other
        let (mut members, mut parts) = (vec![place], Vec::new());
        let (mut bindings, mut watches, mut switches): (Vec<Binding>, Vec<watch::Watch>, Vec<f64>) = Default::default();
        for &(body, pose) in bodies {
            let flies = |group: &Arc<FlightGroup>| group.members.contains(&body);
            let Some(group) = self.groups.iter().position(flies) else { continue };
            let spec = &self.groups[group];
            let place = self.scene.bodies[body].place();
            if spec.members.iter().filter(|&&i| !self.bodies[i].fixed).count() > 1 {
                let why = "it shares its flight with other bodies, to which an effect or an event joins it, and cannot \
                           become part of another";
                return Err(Error::refused(place, why));
            }
            if let Some(Toggle { name, .. }) = spec.toggles.first() {
                let why = format!("{name} is switched by its state, and it cannot become part of another");
                return Err(Error::refused(place, why));
            }
            let at = members.len();
            members.extend(&spec.members);
            bindings.extend(spec.bindings.iter().map(|binding| Binding {
                members: binding.members.iter().map(|member| at + member).collect(),
                ..binding.clone()
            }));
            watches.extend(spec.watches.iter().map(|watch| watch::Watch {
                event: watch.event,
                members: watch.members.iter().map(|member| at + member).collect(),
            }));
            switches.extend(&spec.switches);
            parts.push(Part { body, pose, group, members: at..members.len() });
        }
        switches.sort_by(f64::total_cmp);
        switches.dedup();
        let groups = parts.iter().map(|part| &self.groups[part.group]);
        let has_kinks = groups.clone().any(|group| group.has_kinks);
        let flown = groups.map(|group| group.method).find(|&method| method != Method::Exact);
        let (method, why, toggles) = (Method::Exact, String::new(), Vec::new());
        let mut spec =
            FlightGroup { members, bindings, has_kinks, method, why, switches, watches, toggles, meets: true };
        let first = self.options.method.or(flown);
        spec.method = match (rides || spec.pulls_alike(&parts), self.options.method) {
            _ if rides => Method::Exact,
            (true, None) => Method::Exact,
            (false, Some(Method::Exact)) => {
                let reason = format!("exact: what acts on {name} has no closed form; leave the method out");
                return Err(Error::refused("run: method", reason));
            }
            _ => first.unwrap_or(Method::Dop853),
        };
        let start = BodyMotion::at_rest(properties.mass, properties.inertia);
        let (freedom, fixed, motion, collider) = (Freedom::Free, false, None, None);
        let body = PlannedBody { name, properties, freedom, fixed, motion, start, radius, collider };
        Ok(Compound { body, parts, rides, spec: Arc::new(spec) })
    }

    /// The coordinates of a compound and its parts, of which `rests` tells that nothing moves.
    pub(crate) fn compound_charts(&self, compound: &Compound, rests: bool) -> Result<Vec<Chart>> {
        let form = compound.spec.method.form(self.options.orientation == Orientation::Matrix);
        let free = Chart::new(&Freedom::Free, form, &compound.body.start, &compound.body.name)?;
        let mut charts = vec![if rests { Chart::Fixed } else { free }];
        for part in &compound.parts {
            let members = &compound.spec.members[part.members.clone()];
            let riding = Chart::Riding(Riding { pose: part.pose });
            charts.extend(members.iter().map(|&i| if i == part.body { riding.clone() } else { Chart::Fixed }));
        }
        Ok(charts)
    }
}

impl Compound {
    /// What flies of it: a rider does not feel its loads.
    pub(crate) fn flown(&self) -> Arc<FlightGroup> {
        if !self.rides {
            return self.spec.clone();
        }
        Arc::new(FlightGroup { bindings: Vec::new(), has_kinks: false, ..(*self.spec).clone() })
    }
}

impl FlightGroup {
    /// Whether nothing but uniform gravity acts on a compound, on all of its parts alike.
    fn pulls_alike(&self, parts: &[Part]) -> bool {
        let gravity_only = self.bindings.iter().all(|b| matches!(*b.effect, AnyEffect::UniformGravity(_)));
        let pulls: Vec<Vector3> = parts.iter().map(|part| self.pull(part.members.start, 1.0).acceleration).collect();
        gravity_only && pulls.windows(2).all(|pair| pair[0] == pair[1])
    }
}
