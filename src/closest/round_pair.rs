//! Two posed convex bodies of which one at least is curved, and their difference.
//!
//! The searches ask for points of the difference by number. A polyhedron's points are its vertices; a
//! curved body has no list, so the points that supports have given are kept here, each under the number
//! of its finding. A point found again keeps its number: that is how a search sees that it has arrived.

use std::cell::RefCell;

use super::answer::Feature;
use super::collider::{Core, Revolution};
use super::meridian::{Axis, unit};
use super::pair::{Difference, Heights, Ids, Measure, OFF_CENTER_UNITS, Stand, error_of_distance, from_to};
use super::rotation::{rotate, rotate_back};
use super::simplex::Simplex;
use super::vector::Vec3;
use crate::math::double_double::{DoubleDouble, Real};
use crate::tolerance::CERTIFICATE_WIDTH_CURVED;

/// What a curved body's height and point cost beyond a polyhedron's, in units `u` times the radii [-]: its
/// height is right to 5 in place of 3, its point to 4 in place of 0.
pub(super) const ROUND_UNITS: f64 = 4.0;
/// Points of an inner polytope [-]: an overlap with one way out needs 30 to 400. Where ways out on a whole
/// curve are equally deep no number suffices, and the depth is given with the bounds that are proved.
const POINTS: usize = 640;
/// Axes at a smaller angle than this [rad] count as parallel; what the angle may move is added to the upper
/// bound. Larger: wider intervals where the search in space would have found narrower ones.
const NEARLY_PARALLEL: f64 = 1e-9;
/// Points that are kept without asking for memory [-]: a search for the distance finds 4 to 30.
const AT_HAND: usize = 32;

/// A posed body.
#[derive(Debug)]
struct Body<'a, R> {
    core: Core<'a>,
    rotation: [Vec3<R>; 3],
}

/// A point of each body about its own centre, world axes; of a polyhedron with the vertex's number.
#[derive(Debug, Clone, Copy)]
struct Found<R> {
    on_a: Vec3<R>,
    on_b: Vec3<R>,
    vertices: Ids,
}

/// The points found so far.
#[derive(Debug)]
struct List<R> {
    first: [Found<R>; AT_HAND],
    count: usize,
    more: Vec<Found<R>>,
}

/// The two bodies.
#[derive(Debug)]
pub(super) struct RoundPair<'a, R> {
    a: Body<'a, R>,
    b: Body<'a, R>,
    between: Vec3<R>,
    size: f64,
    error: f64,
    axis: Option<Axis<R>>,
    found: RefCell<List<R>>,
}

impl<R: Real> List<R> {
    fn new() -> Self {
        let nothing = Found { on_a: Vec3::zero(), on_b: Vec3::zero(), vertices: [0; 2] };
        Self { first: [nothing; AT_HAND], count: 0, more: Vec::new() }
    }

    fn get(&self, k: u32) -> &Found<R> {
        let k = k as usize;
        if k < AT_HAND { &self.first[k] } else { &self.more[k - AT_HAND] }
    }

    /// The number of a point, new or found before.
    fn number(&mut self, found: Found<R>) -> u32 {
        let is_same = |old: &Found<R>| old.on_a == found.on_a && old.on_b == found.on_b;
        let count = self.count.min(AT_HAND);
        let before = self.first[..count].iter().position(is_same);
        let k = before.or_else(|| self.more.iter().position(is_same).map(|k| AT_HAND + k)).unwrap_or_else(|| {
            if self.count < AT_HAND {
                self.first[self.count] = found;
            } else {
                self.more.push(found);
            }
            self.count += 1;
            self.count - 1
        });
        u32::try_from(k).unwrap_or(u32::MAX)
    }
}

impl<'a> RoundPair<'a, f64> {
    pub(super) fn new(a: Core<'a>, at_a: &Stand<'_>, b: Core<'a>, at_b: &Stand<'_>) -> Self {
        let (between, remote) = from_to(at_a, a.center(), at_b, b.center());
        Self::assemble(a, at_a, b, at_b, Vec3(between.to_f64()), remote)
    }
}

impl<'a> RoundPair<'a, DoubleDouble> {
    pub(super) fn precise(a: Core<'a>, at_a: &Stand<'_>, b: Core<'a>, at_b: &Stand<'_>) -> Self {
        let (between, remote) = from_to(at_a, a.center(), at_b, b.center());
        Self::assemble(a, at_a, b, at_b, between, remote)
    }
}

impl<'a, R: Heights> RoundPair<'a, R> {
    fn assemble(a: Core<'a>, at_a: &Stand<'_>, b: Core<'a>, at_b: &Stand<'_>, between: Vec3<R>, remote: f64) -> Self {
        let (radii, centers) = (a.reach() + b.reach(), Vec3::<f64>(between.to_f64()).norm());
        let Measure { size, error } =
            Measure::new(R::COST, radii, centers, [at_a, at_b], ROUND_UNITS + OFF_CENTER_UNITS);
        let axis = common_axis((&a, at_a), (&b, at_b));
        let (a, b) = (Body { core: a, rotation: at_a.rows() }, Body { core: b, rotation: at_b.rows() });
        Self { a, b, between, size, error: error + remote, axis, found: RefCell::new(List::new()) }
    }
}

/// The common axis of two bodies of revolution, if their axes are parallel: what is left of an angle is
/// worked out in double-double.
fn common_axis<R: Heights>((a, at_a): (&Core<'_>, &Stand<'_>), (b, at_b): (&Core<'_>, &Stand<'_>)) -> Option<Axis<R>> {
    use Revolution::{About, AboutAnything, No};
    let turned = |at: &Stand<'_>, axis| unit(&rotate(&at.rows::<R>(), &Vec3::new(axis)));
    match (a.revolution(), b.revolution()) {
        (About(z), About(other)) => {
            let along = turned(at_a, z);
            if turned(at_b, other).cross(&along).norm().to_f64() > NEARLY_PARALLEL {
                return None;
            }
            let precisely = |at: &Stand<'_>, axis| unit(&rotate(&at.rows::<DoubleDouble>(), &Vec3::new(axis)));
            let tilt = precisely(at_b, other).cross(&precisely(at_a, z)).norm().to_f64();
            // the tilt itself is right to a few units of double-double
            let off = (tilt * (1.0 + 4.0 * f64::EPSILON) + 32.0 * DoubleDouble::UNIT) * b.reach();
            Some(Axis { along, off, is_any: false })
        }
        (About(z), AboutAnything) => Some(Axis { along: turned(at_a, z), off: 0.0, is_any: true }),
        (AboutAnything, About(z)) => Some(Axis { along: turned(at_b, z), off: 0.0, is_any: true }),
        (No, _) | (_, No) | (AboutAnything, AboutAnything) => None,
    }
}

impl<R: Heights> Body<'_, R> {
    /// A farthest point along `d`, world axes about the centre, a bound of the height of all points, and
    /// a polyhedron's vertex.
    fn farthest(&self, d: &Vec3<R>, from: Option<u32>) -> (Vec3<R>, R, u32) {
        let local = rotate_back(&self.rotation, d);
        let (point, height, vertex) = self.core.farthest(&local, from);
        (rotate(&self.rotation, &point), height, vertex)
    }

    /// The feature that carries a simplex, for the outward normal `d`, world axes.
    fn feature(&self, vertices: &[Ids], side: usize, d: &Vec3<R>) -> Feature {
        let outward = || rotate_back(&self.rotation, d).to_f64();
        self.core.feature(vertices, side, outward)
    }
}

impl<R: Heights> Difference<R> for RoundPair<'_, R> {
    fn between(&self) -> Vec3<R> {
        self.between
    }

    fn size(&self) -> f64 {
        self.size
    }

    fn error(&self, distance: f64) -> f64 {
        self.error + error_of_distance::<R>(distance)
    }

    fn promise(&self) -> f64 {
        CERTIFICATE_WIDTH_CURVED * self.size
    }

    fn most_points(&self) -> usize {
        POINTS
    }

    fn axis(&self) -> Option<Axis<R>> {
        self.axis
    }

    fn lowest(&self, n: &Vec3<R>, from: Option<Ids>) -> (Ids, R) {
        let start = from.map(|[k, _]| self.found.borrow().get(k).vertices);
        let (on_a, high_a, i) = self.a.farthest(n, start.map(|v| v[0]));
        let (on_b, high_b, j) = self.b.farthest(&-*n, start.map(|v| v[1]));
        let k = self.found.borrow_mut().number(Found { on_a, on_b, vertices: [i, j] });
        ([k, k], n.dot(&self.between) - high_a - high_b)
    }

    fn difference(&self, [k, _]: Ids) -> Vec3<R> {
        let list = self.found.borrow();
        let found = list.get(k);
        (found.on_b + self.between) - found.on_a
    }

    fn point_a(&self, k: u32) -> Vec3<R> {
        self.found.borrow().get(k).on_a
    }

    fn simplex(&self, ids: &[Ids]) -> Simplex<R> {
        let mut simplex = Simplex::empty();
        for &ids in ids.iter().take(4) {
            simplex.push(ids, self.difference(ids));
        }
        simplex
    }

    fn features(&self, simplex: &Simplex<R>, normal: &Vec3<R>) -> [Feature; 2] {
        let mut vertices = [[0; 2]; 4];
        for (pair, [k, _]) in vertices.iter_mut().zip(&simplex.ids[..simplex.count]) {
            *pair = self.found.borrow().get(*k).vertices;
        }
        let vertices = &vertices[..simplex.count];
        [self.a.feature(vertices, 0, normal), self.b.feature(vertices, 1, &-*normal)]
    }
}
