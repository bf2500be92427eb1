//! Who may meet whom, and when: the asynchronous search for impacts.
//!
//! ```text
//! window of a body     the time ahead over which a box holds all that it sweeps
//! pair                 searched when either's window begins, to where the first of the two ends
//! queue                windows that end and touches to come, by time
//! ```
//!
//! Nothing is stepped together: a body that meets nobody only renews its window, and an impact renews
//! those of its cluster. Windows are as long as the body takes for some of its own radii, so that boxes
//! stay small and the cost goes with the number of events. A touch is dropped when a body of its pair has
//! begun another flight since; what it stood for is found again from the new one.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::contact::broad_phase::{Aabb, Tree};
use crate::math::sum::Time;

/// What is due.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum What {
    /// Two bodies touch, if both still fly the flights of these numbers; `iterations` located it.
    Touch { bodies: [usize; 2], flights: [u64; 2], iterations: u32 },
    /// The window of this number ends.
    Window { body: usize, number: u64 },
    /// The step of this number ends, of bodies that are led together.
    Step { slot: usize, number: u64 },
    /// The joint of two bodies breaks, if they still fly the flight of this number.
    Break { bodies: [usize; 2], flight: u64 },
    /// The load of a body that rests jumps, if it still rests in the flight of this number.
    Wake { body: usize, number: u64 },
}

/// Something that is due at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Due {
    pub(super) time: Time,
    pub(super) what: What,
}

impl Due {
    /// Touches before steps before breaks before windows, then by body: the order is the same in every run.
    fn order(&self) -> (u8, usize, usize) {
        match self.what {
            What::Touch { bodies: [a, b], .. } => (0, a, b),
            What::Step { slot, .. } => (1, slot, 0),
            What::Wake { body, .. } => (2, body, 0),
            What::Break { bodies: [a, b], .. } => (3, a, b),
            What::Window { body, .. } => (4, body, 0),
        }
    }
}

impl Eq for Due {}

impl PartialOrd for Due {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Due {
    /// The earlier is the greater, so that a heap gives it first.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_time = other.time.value.total_cmp(&self.time.value).then(other.time.rest.total_cmp(&self.time.rest));
        by_time.then_with(|| other.order().cmp(&self.order()))
    }
}

/// The time ahead of a body over which its box holds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Window {
    /// Where it ends [s]; never, of a body that rests.
    pub(super) to: f64,
    /// Its number: an end of another is no longer due.
    pub(super) number: u64,
    /// The box; none of a half space.
    pub(super) aabb: Option<Aabb>,
    /// The body's impacts so far.
    pub(super) hits: Hits,
}

/// Impacts of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Hits {
    /// When the last one was [s].
    pub(super) last: f64,
    /// How many there were at that instant.
    pub(super) at_once: u32,
    /// How many there were in all.
    pub(super) in_all: u64,
}

impl Hits {
    /// Of a body that has hit nothing yet.
    const NONE: Self = Self { last: f64::MIN, at_once: 0, in_all: 0 };
}

/// Who may meet whom, and what is due.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    pub(super) tree: Tree,
    /// Half spaces: they have no box, and every moving body may meet them.
    pub(super) planes: Vec<usize>,
    /// Body by body; none of those that meet nobody.
    pub(super) windows: Vec<Option<Window>>,
    pub(super) due: BinaryHeap<Due>,
}

impl Near {
    /// Opens a window, or replaces the one that was open.
    pub(super) fn open(&mut self, body: usize, to: f64, aabb: Option<Aabb>) -> u64 {
        let before = self.windows[body];
        let number = before.map_or(0, |window| window.number + 1);
        let hits = before.map_or(Hits::NONE, |window| window.hits);
        let to = to.min(f64::MAX); // a file has no infinity
        self.windows[body] = Some(Window { to, number, aabb, hits });
        match aabb {
            Some(aabb) => self.tree.put(body, aabb),
            None => self.planes.push(body),
        }
        number
    }

    /// Goes on from what was saved.
    #[cfg(feature = "serde")]
    pub(super) fn restore(&mut self, windows: Vec<Option<Window>>, due: Vec<Due>) {
        for (body, window) in windows.iter().enumerate() {
            match window.map(|window| window.aabb) {
                Some(Some(aabb)) => self.tree.put(body, aabb),
                Some(None) => self.planes.push(body),
                None => {}
            }
        }
        (self.windows, self.due) = (windows, due.into());
    }

    /// The bodies whose boxes meet this one, and all half spaces, in rising order.
    pub(super) fn around(&self, aabb: &Aabb, into: &mut Vec<usize>) {
        self.tree.meeting(aabb, into);
        into.extend(&self.planes);
        into.sort_unstable();
    }

    /// Counts an impact of the body at this time [s].
    pub(super) fn count_hit(&mut self, body: usize, time: f64) -> Hits {
        let Some(window) = &mut self.windows[body] else { return Hits::NONE };
        let Hits { last, at_once, in_all } = window.hits;
        window.hits = Hits { last: time, at_once: if last == time { at_once + 1 } else { 1 }, in_all: in_all + 1 };
        window.hits
    }
}
