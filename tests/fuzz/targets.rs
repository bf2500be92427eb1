//! What the fuzzers call: bytes in, a broken promise panics.

use bryla::closest::{Accuracy, ClosestFeatures, Collider, PairCache, State, closest_features};
use bryla::math::{Pose, Quaternion, Vector3, quaternion};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use bryla::shape::{Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Piece, Shape, Sphere};

/// Numbers from bytes; zeros when they have run out.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// Any `f64` at all, a grid point, or an ordinary number, as the first byte says.
    fn number(&mut self) -> f64 {
        match self.byte() {
            0..16 => f64::from_le_bytes(std::array::from_fn(|_| self.byte())),
            16..128 => f64::from(i16::from(self.byte()) - 128) / 16.0,
            128..160 => f64::from(i16::from(self.byte()) - 128) * f64::EPSILON,
            _ => {
                let low = u16::from_le_bytes([self.byte(), self.byte()]);
                (f64::from(low) - 32768.0) / 16384.0
            }
        }
    }

    fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }

    /// A length, mostly of ordinary size.
    fn length(&mut self) -> f64 {
        if self.byte() < 8 { self.number() } else { (1.0 + f64::from(self.byte())) / 64.0 }
    }

    fn points(&mut self) -> Vec<[f64; 3]> {
        let count = 1 + usize::from(self.byte() % 48);
        (0..count).map(|_| self.numbers()).collect()
    }

    fn pose(&mut self) -> Pose {
        let (position, q) = (Vector3::from(self.numbers::<3>()), self.numbers());
        Pose { position, orientation: quaternion::from_scalar_first(q) }
    }

    fn shape(&mut self, depth: u32) -> Shape {
        match self.byte() % 8 {
            0 => Sphere::new(self.length()).into(),
            1 => Capsule::new(self.length(), self.length()).into(),
            2 => Cylinder::new(self.length(), self.length()).into(),
            3 => Cone::new(self.length(), self.length()).into(),
            4 => Ellipsoid::new([self.length(), self.length(), self.length()]).into(),
            5 => HalfSpace::new(self.numbers::<3>(), self.number()).into(),
            6 if depth == 0 => {
                let count = 1 + self.byte() % 3;
                let piece = |b: &mut Self| {
                    let (shape, pose) = (b.shape(1), b.pose());
                    let q = quaternion::normalized(&pose.orientation);
                    let q = if q.norm() > 0.5 { q } else { Quaternion::identity() };
                    Piece::new(shape).position(pose.position).orientation([q.w, q.i, q.j, q.k])
                };
                Compound::new((0..count).map(|_| piece(self)).collect::<Vec<_>>()).into()
            }
            _ => Cuboid::new([self.length(), self.length(), self.length()]).into(),
        }
    }

    /// A hull or a shape; none where it is refused.
    fn body(&mut self) -> Option<Collider> {
        if self.byte() < 128 {
            return ConvexPolyhedron::from_points(&self.points()).ok().map(Into::into);
        }
        Collider::new(&self.shape(0)).ok()
    }
}

/// A hull holds its points, closes up, and knows where its vertices came from.
pub(crate) fn hull(data: &[u8]) {
    let points = Bytes(data).points();
    let Ok(body) = ConvexPolyhedron::from_points(&points) else { return };
    let (v, e, f) = (body.vertices().len(), body.edges().len(), body.faces().len());
    if body.rank() >= 2 {
        assert_eq!(v + f, e + 2, "Euler's formula: {v} vertices, {e} edges, {f} faces of {points:?}");
    }
    for (k, &source) in body.sources().iter().enumerate() {
        let (kept, given) = (body.vertices()[k], points[source as usize]);
        assert!((0..3).all(|i| kept[i] == given[i] || given[i].abs() < 1e-39 * body.radius()), "{points:?}");
    }
    let c = Vector3::from(body.center());
    for face in body.faces() {
        let normal = Vector3::from(face.normal);
        assert!((normal.norm() - 1.0).abs() < 1e-14, "{points:?}");
        for p in &points {
            let over = normal.dot(&(Vector3::from(*p) - c)) - face.offset;
            assert!(over <= 8.0 * f64::EPSILON * body.radius(), "a point is {over:e} outside of {points:?}");
        }
    }
}

/// An answer is finite and certified, and every other way to ask agrees with it.
pub(crate) fn query(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (Some(a), Some(b)) = (bytes.body(), bytes.body()) else { return };
    let (pose_a, pose_b, next) = (bytes.pose(), bytes.pose(), bytes.pose());
    let mut cache = PairCache::new();
    let Ok(cold) = closest_features(&a, &pose_a, &b, &pose_b, Some(&mut cache), Accuracy::Exact) else { return };
    check(&cold, &a, &b);
    let ask = |accuracy| closest_features(&b, &pose_b, &a, &pose_a, None, accuracy).expect("it was asked before");
    for accuracy in [Accuracy::Exact, Accuracy::Relative(1e-6), Accuracy::YesNo] {
        let other = ask(accuracy);
        assert!(other.lower <= cold.upper && cold.lower <= other.upper, "{cold:?} {other:?} {a:?} {b:?}");
    }

    // elsewhere, from the cache of here
    let Ok(warm) = closest_features(&a, &pose_a, &b, &next, Some(&mut cache), Accuracy::Exact) else { return };
    check(&warm, &a, &b);
    let fresh = closest_features(&a, &pose_a, &b, &next, None, Accuracy::Exact).expect("it was asked before");
    assert!(fresh.lower <= warm.upper && warm.lower <= fresh.upper, "{warm:?} {fresh:?} {a:?} {b:?}");
}

fn check(found: &ClosestFeatures, a: &Collider, b: &Collider) {
    let numbers = [found.signed_distance, found.point_a.norm(), found.point_b.norm(), found.normal.norm()];
    assert!(numbers.iter().all(|x| x.is_finite()), "{found:?} {a:?} {b:?}");
    assert!((found.normal.norm() - 1.0).abs() < 1e-14, "{found:?} {a:?} {b:?}");
    assert!(found.lower <= found.signed_distance && found.signed_distance <= found.upper, "{found:?} {a:?} {b:?}");
    // what a curved body overlaps may have a circle of ways out
    let all_flat = |c: &Collider| (0..c.part_count()).all(|k| c.polyhedron(k).is_some());
    let may_be_open = found.state == State::Overlapping && !(all_flat(a) && all_flat(b));
    assert!(found.certified || may_be_open, "{found:?} {a:?} {b:?}");
}
