//! Which flight group watches for which event, and which of its loads the state switches.

use super::{Binding, FlightGroup, PlannedBody};
use crate::effect::Switch;
use crate::error::{Error, Result};
use crate::scene::{RunOptions, Scene};

/// An event, and the bodies that it is measured of.
#[derive(Debug, Clone)]
pub(crate) struct Watch {
    /// The event, as a place among those of the run.
    pub(crate) event: usize,
    /// Its bodies, as places in the group.
    pub(crate) members: Vec<usize>,
}

/// A load that the state switches.
#[derive(Debug, Clone)]
pub(crate) struct Toggle {
    /// What events and messages call it.
    pub(crate) name: String,
    /// The effect, as a place in the scene.
    pub(crate) effect: usize,
    /// Its body, as a place in the group.
    pub(crate) member: usize,
    pub(crate) switch: Switch,
}

/// The switched loads among those of a group.
pub(super) fn toggles(bindings: &[Binding], scene: &Scene) -> Vec<Toggle> {
    let toggle = |binding: &Binding| {
        let switch = binding.effect.as_effect().switch()?.clone();
        let name = scene.effect_place(binding.effect_index);
        Some(Toggle { name, effect: binding.effect_index, member: *binding.members.first()?, switch })
    };
    bindings.iter().filter_map(toggle).collect()
}

/// The bodies of every event, as places in the scene.
pub(super) fn watched(scene: &Scene, bodies: &[PlannedBody], options: &RunOptions) -> Result<Vec<Vec<usize>>> {
    let mut all = Vec::new();
    for (index, event) in options.events.iter().enumerate() {
        let place = event.place();
        if options.events[..index].iter().any(|other| other.name == event.name) {
            return Err(Error::value("run", "event name", "one that no other event has", &event.name));
        }
        let named: Vec<usize> =
            event.bodies.iter().map(|name| Ok(scene.find(name, &place, "bodies")?.index())).collect::<Result<_>>()?;
        if let Some(twice) = named.iter().enumerate().find(|(i, m)| named[..*i].contains(m)) {
            return Err(Error::value(place, "bodies", "different from each other", &bodies[*twice.1].name));
        }
        if let Some(&moved) = named.iter().find(|&&i| bodies[i].motion.is_some()) {
            return Err(Error::value(place, "bodies", "without a prescribed motion", &bodies[moved].name));
        }
        if named.iter().all(|&i| bodies[i].fixed) {
            return Err(Error::value(place, "bodies", "at least one that can move", &event.bodies));
        }
        all.push(named);
    }
    Ok(all)
}

/// Gives every event to the group of its bodies; fixed ones among them join it, to be seen.
pub(super) fn bind(watched: &[Vec<usize>], bodies: &[PlannedBody], groups: &mut [FlightGroup]) {
    for (event, named) in watched.iter().enumerate() {
        let moves = |group: &FlightGroup| named.iter().any(|&i| !bodies[i].fixed && group.members.contains(&i));
        let Some(group) = groups.iter_mut().find(|group| moves(group)) else { continue };
        let members = named.iter().map(|body| {
            group.members.iter().position(|member| member == body).unwrap_or_else(|| {
                group.members.push(*body);
                group.members.len() - 1
            })
        });
        let members = members.collect();
        group.watches.push(Watch { event, members });
    }
}
