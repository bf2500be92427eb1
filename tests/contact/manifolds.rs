//! Where bodies touch: all points, in order, with their features.

use bryla::closest::{Accuracy, Feature, closest_features};
use bryla::contact::manifold::{Manifold, ManifoldPoint, Surface, Touch, manifold};
use bryla::math::{Pose, Vector3, quaternion};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use bryla::shape::{Capsule, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Sphere};

use super::{close, vector};

const EPS: f64 = 1e-9;

fn cuboid(half: [f64; 3]) -> ConvexPolyhedron {
    let points: Vec<[f64; 3]> = Cuboid::new(half).vertices().unwrap_or_default().iter().map(|v| (*v).into()).collect();
    ConvexPolyhedron::from_points(&points).expect("a box")
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::new([x, y, z], [1.0, 0.0, 0.0, 0.0])
}

fn turned(x: [f64; 3], axis: Vector3, angle: f64) -> Pose {
    Pose { position: x.into(), orientation: quaternion::from_axis_angle(&axis, angle) }
}

fn between(a: &ConvexPolyhedron, pose_a: &Pose, b: &ConvexPolyhedron, pose_b: &Pose) -> Manifold {
    let closest = closest_features(a, pose_a, b, pose_b, None, Accuracy::Exact).expect("poses");
    manifold(&Surface::Polyhedron(a), pose_a, &Surface::Polyhedron(b), pose_b, &Touch::from(&closest), EPS)
}

/// The points of b, as a set.
fn assert_points(found: &Manifold, expected: &[Vector3]) {
    assert_eq!(found.points.len(), expected.len(), "{found:?}");
    for e in expected {
        assert!(found.points.iter().any(|p| (p.point_b - e).norm() < 1e-12), "{e:?} is missing: {found:?}");
    }
}

#[test]
fn a_box_on_a_box_touches_in_the_rectangle_that_they_share() {
    let (a, b) = (cuboid([1.0, 1.0, 0.5]), cuboid([0.5, 2.0, 0.25]));
    // shifted: x from 0.2 to 1, y over all of a; a gap of 1e-12
    let gap = 1e-12;
    for far in [0.0, 1e4] {
        let found = between(&a, &at(far, 0.0, 0.0), &b, &at(far + 0.7, 0.0, 0.75 + gap));
        assert_eq!(found.normals.len(), 1);
        close(&found.normals[0], &Vector3::z(), 1e-15);
        assert_eq!(found.points.len(), 4);
        for (x, y) in [(0.2, -1.0), (1.0, -1.0), (1.0, 1.0), (0.2, 1.0)] {
            let expected = vector(far + x, y, 0.5);
            // coordinates of 1e4 round to 1e-12
            let near = |p: &Vector3| (p - expected).norm() < 2e-12 + 2.0 * far * f64::EPSILON;
            let p = found.points.iter().find(|p| near(&p.point_a)).expect("a corner");
            assert!((p.gap - gap).abs() < 1e-15 + far * f64::EPSILON, "{}", p.gap);
            // x = 0.2: an edge of b over one of a; x = 1: an edge of a over one of b
            assert!(matches!((p.feature_a, p.feature_b), (Some(Feature::Edge(_)), Some(Feature::Edge(_)))) || x > 0.9);
        }
        // counterclockwise about the normal
        for k in 0..4 {
            let [p, q, r] = [k, (k + 1) % 4, (k + 2) % 4].map(|k| found.points[k].point_a);
            assert!((q - p).cross(&(r - q)).z > 0.0);
        }
    }
}

#[test]
fn a_box_turned_on_a_box_touches_in_an_octagon() {
    // two unit squares turned by 45° meet in a regular octagon of inradius ½ (sides between the vertices)
    let a = cuboid([0.5; 3]);
    let found =
        between(&a, &at(0.0, 0.0, 0.0), &a, &turned([0.0, 0.0, 1.0], Vector3::z(), std::f64::consts::FRAC_PI_4));
    let t = 0.5 * (2f64.sqrt() - 1.0);
    let mut expected = Vec::new();
    for (x, y) in [(0.5, t), (t, 0.5), (-t, 0.5), (-0.5, t), (-0.5, -t), (-t, -0.5), (t, -0.5), (0.5, -t)] {
        expected.push(vector(x, y, 0.5));
    }
    assert_points(&found, &expected);
    for p in &found.points {
        assert!(matches!((p.feature_a, p.feature_b), (Some(Feature::Edge(_)), Some(Feature::Edge(_)))));
    }
}

#[test]
fn cubes_stacked_flush_touch_in_four_corners() {
    let a = cuboid([0.5; 3]);
    let found = between(&a, &at(0.0, 0.0, 0.0), &a, &at(0.0, 0.0, 1.0));
    assert_points(
        &found,
        &[vector(0.5, 0.5, 0.5), vector(-0.5, 0.5, 0.5), vector(-0.5, -0.5, 0.5), vector(0.5, -0.5, 0.5)],
    );
    close(&found.normals[0], &Vector3::z(), 1e-15);
    assert_eq!(found.normals.len(), 1);
    // the same pose gives the same list
    assert_eq!(found, between(&a, &at(0.0, 0.0, 0.0), &a, &at(0.0, 0.0, 1.0)));
}

#[test]
fn an_edge_on_a_face_touches_in_a_segment_and_a_corner_in_a_point() {
    let a = cuboid([1.0, 1.0, 0.5]);
    let b = cuboid([0.25; 3]);
    // turned by 45° about y: an edge of length ½ along y lies on the face
    let up = 0.5 + 0.25 * 2f64.sqrt();
    let found = between(&a, &at(0.0, 0.0, 0.0), &b, &turned([0.1, 0.9, up], Vector3::y(), std::f64::consts::FRAC_PI_4));
    assert_points(&found, &[vector(0.1, 0.65, 0.5), vector(0.1, 1.0, 0.5)]);
    close(&found.normals[0], &Vector3::z(), 1e-15);

    // stood on a corner: rotate (1,1,1) to −z
    let axis = vector(1.0, 1.0, 1.0).cross(&-Vector3::z()).normalize();
    let angle = libm::acos(-1.0 / 3f64.sqrt());
    let found = between(&a, &at(0.0, 0.0, 0.0), &b, &turned([0.3, 0.2, 0.5 + 0.25 * 3f64.sqrt()], axis, angle));
    assert_points(&found, &[vector(0.3, 0.2, 0.5)]);
    assert!(matches!(found.points[0].feature_b, Some(Feature::Vertex(_))));
    assert!(matches!(found.points[0].feature_a, Some(Feature::Face(_))));
}

#[test]
fn edges_that_cross_touch_in_one_point_along_their_product() {
    // an edge of a along y, an edge of b along x, both at 45°
    let a = cuboid([0.5; 3]);
    let below = turned([0.0; 3], Vector3::y(), std::f64::consts::FRAC_PI_4);
    let above = turned([0.1, 0.2, 2f64.sqrt()], Vector3::x(), std::f64::consts::FRAC_PI_4);
    let found = between(&a, &below, &a, &above);
    assert_points(&found, &[vector(0.0, 0.2, 0.5 * 2f64.sqrt())]);
    assert_eq!(found.normals.len(), 1);
    close(&found.normals[0], &Vector3::z(), 1e-14);
    assert!(matches!(found.points[0].feature_a, Some(Feature::Edge(_))));
    assert!(matches!(found.points[0].feature_b, Some(Feature::Edge(_))));
}

#[test]
fn parallel_edges_and_tips_have_a_cone_of_normals() {
    // two square bars edge on edge along y: normals up to 45° to both sides of z; two points
    let a = cuboid([0.5, 1.0, 0.5]);
    let quarter = std::f64::consts::FRAC_PI_4;
    let found = between(
        &a,
        &turned([0.0; 3], Vector3::y(), quarter),
        &a,
        &turned([0.0, 0.4, 2f64.sqrt()], Vector3::y(), quarter),
    );
    assert_points(&found, &[vector(0.0, -0.6, 0.5 * 2f64.sqrt()), vector(0.0, 1.0, 0.5 * 2f64.sqrt())]);
    assert_eq!(found.normals.len(), 2, "{:?}", found.normals);
    for n in &found.normals {
        assert!((n.z - 0.5f64.sqrt()).abs() < 1e-14 && n.y.abs() < 1e-14, "{n:?}");
    }

    // octahedra tip on tip: the cone of each is spanned by four face normals
    let tips: Vec<[f64; 3]> = [0, 1, 2]
        .iter()
        .flat_map(|&k| {
            [1.0, -1.0].map(|s| {
                let mut p = [0.0; 3];
                p[k] = s;
                p
            })
        })
        .collect();
    let octahedron = ConvexPolyhedron::from_points(&tips).expect("an octahedron");
    let found = between(&octahedron, &at(0.0, 0.0, 0.0), &octahedron, &at(0.0, 0.0, 2.0));
    assert_points(&found, &[vector(0.0, 0.0, 1.0)]);
    assert_eq!(found.normals.len(), 4, "{:?}", found.normals);
    assert!(found.normals.iter().all(|n| (n.z - 1.0 / 3f64.sqrt()).abs() < 1e-14));
}

/// A body above the plane z = ½, both ways round.
fn on_floor(surface: &Surface<'_>, pose: &Pose) -> Manifold {
    let plane = HalfSpace::new([0.0, 0.0, 2.0], 1.0);
    let floor = Surface::HalfSpace(&plane);
    let touch = Touch { point_a: pose.position, point_b: pose.position, normal: Vector3::z(), signed_distance: 0.0 };
    let above = manifold(&floor, &Pose::identity(), surface, pose, &touch, EPS);
    let touch = Touch { normal: -Vector3::z(), ..touch };
    let below = manifold(surface, pose, &floor, &Pose::identity(), &touch, EPS);
    assert_eq!(above.points.len(), below.points.len());
    for p in &above.points {
        // the order is counterclockwise about the normal, so the other way round
        let same = |q: &&ManifoldPoint| (p.point_b - q.point_a).norm() < 1e-15;
        let q = below.points.iter().find(same).expect("the same point");
        close(&p.point_a, &q.point_b, 1e-15);
        assert!((p.gap - q.gap).abs() < 1e-15);
    }
    close(&above.normals[0], &-below.normals[0], 1e-15);
    above
}

#[test]
fn round_bodies_touch_the_floor_in_a_point_a_line_or_a_disc() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let lying = |z: f64| turned([0.0, 0.0, z], Vector3::y(), quarter);
    let (sphere, capsule, cylinder) = (Sphere::new(0.2), Capsule::new(0.1, 0.3), Cylinder::new(0.1, 0.3));
    let (cone, ellipsoid) = (Cone::new(0.3, 0.4), Ellipsoid::new([0.1, 0.2, 0.3]));

    assert_points(&on_floor(&Surface::Sphere(&sphere), &at(1.0, 2.0, 0.7)), &[vector(1.0, 2.0, 0.5)]);
    assert_points(&on_floor(&Surface::Ellipsoid(&ellipsoid), &at(1.0, 2.0, 0.8)), &[vector(1.0, 2.0, 0.5)]);
    assert_points(&on_floor(&Surface::Ellipsoid(&ellipsoid), &lying(0.6)), &[vector(0.0, 0.0, 0.5)]);
    assert_points(&on_floor(&Surface::Capsule(&capsule), &at(0.0, 0.0, 0.9)), &[vector(0.0, 0.0, 0.5)]);
    let line = [vector(0.3, 0.0, 0.5), vector(-0.3, 0.0, 0.5)];
    assert_points(&on_floor(&Surface::Capsule(&capsule), &lying(0.6)), &line);
    assert_points(&on_floor(&Surface::Cylinder(&cylinder), &lying(0.6)), &line);

    // standing: the rim, round about; all at the gap of the cap
    let standing = on_floor(&Surface::Cylinder(&cylinder), &at(0.0, 0.0, 0.8));
    assert!(standing.points.len() >= 8);
    for p in &standing.points {
        assert!((libm::hypot(p.point_b.x, p.point_b.y) - 0.1).abs() < 1e-15 && p.gap.abs() < 1e-15);
    }
    let center: Vector3 = standing.points.iter().map(|p| p.point_b).sum();
    assert!(libm::hypot(center.x, center.y) < 1e-15 * 16.0);
    assert_eq!(on_floor(&Surface::Cone(&cone), &at(0.0, 0.0, 0.9)).points.len(), standing.points.len());
    let on_tip = turned([0.0, 0.0, 0.9], Vector3::x(), std::f64::consts::PI);
    assert_points(&on_floor(&Surface::Cone(&cone), &on_tip), &[vector(0.0, 0.0, 0.5)]);
    // tilted by 30°: one point of the rim, radius cos 30° − half height … below the centre
    let tilt = std::f64::consts::FRAC_PI_6;
    let (sin, cos) = libm::sincos(tilt);
    let drop = 0.1 * sin + 0.3 * cos;
    let tilted = on_floor(&Surface::Cylinder(&cylinder), &turned([0.0, 0.0, 0.5 + drop], Vector3::y(), tilt));
    assert_points(&tilted, &[vector(0.1 * cos - 0.3 * sin, 0.0, 0.5)]);
}

#[test]
fn a_polyhedron_on_the_floor_touches_with_what_is_foremost() {
    let b = cuboid([0.1, 0.2, 0.3]);
    let flat = on_floor(&Surface::Polyhedron(&b), &at(0.0, 0.0, 0.8));
    assert_points(
        &flat,
        &[vector(0.1, 0.2, 0.5), vector(-0.1, 0.2, 0.5), vector(-0.1, -0.2, 0.5), vector(0.1, -0.2, 0.5)],
    );
    assert!(flat.points.iter().all(|p| p.feature_a.is_none() && matches!(p.feature_b, Some(Feature::Vertex(_)))));
    // a tilt of 1e-10 over 0.2 m is within ε = 1e-9, one of 1e-8 is not
    for (tilt, count) in [(1e-10, 4), (1e-8, 2)] {
        let touching = on_floor(&Surface::Polyhedron(&b), &turned([0.0, 0.0, 0.8], Vector3::y(), tilt));
        assert_eq!(touching.points.len(), count, "{tilt}");
    }
}

#[test]
fn a_capsule_and_a_board_lie_across_the_rim_of_a_round_table() {
    // along the radius half way between two corners of the polygon that stands for the disc elsewhere
    let azimuth = std::f64::consts::PI / 16.0;
    let (sin, cos) = libm::sincos(azimuth);
    let outward = |r: f64| vector(r * cos, r * sin, 0.0);
    let table = Cylinder::new(0.5, 0.05);
    let lying = |r: f64, z: f64| {
        let down = quaternion::from_axis_angle(&Vector3::y(), std::f64::consts::FRAC_PI_2);
        let orientation = quaternion::from_axis_angle(&Vector3::z(), azimuth) * down;
        Pose { position: outward(r) + vector(0.0, 0.0, z), orientation }
    };
    let on_table = |surface: &Surface<'_>, pose: &Pose, from: f64| {
        let p = outward(from);
        let touch = Touch { point_a: p, point_b: p, normal: Vector3::z(), signed_distance: 0.0 };
        manifold(&Surface::Cylinder(&table), &at(0.0, 0.0, -0.05), surface, pose, &touch, EPS)
    };
    // from 0.35 to 0.55, of which the table ends at 0.5; and from 0.3 to 0.496, all on it
    let capsule = Capsule::new(0.03, 0.1);
    assert_points(&on_table(&Surface::Capsule(&capsule), &lying(0.45, 0.03), 0.4), &[outward(0.35), outward(0.5)]);
    let short = Capsule::new(0.03, 0.098);
    assert_points(&on_table(&Surface::Capsule(&short), &lying(0.398, 0.03), 0.4), &[outward(0.3), outward(0.496)]);
    // a board of ±0.1 across it, whose long sides the rim cuts where |outward(r) ± 0.1 across| = 0.5
    let board = cuboid([0.02, 0.1, 0.1]);
    let reach = (0.25_f64 - 0.01).sqrt();
    let corner = |r: f64, side: f64| outward(r) + side * vector(-sin, cos, 0.0);
    let found = on_table(&Surface::Polyhedron(&board), &lying(0.45, 0.02), 0.4);
    for p in [corner(0.35, 0.1), corner(0.35, -0.1), corner(reach, 0.1), corner(reach, -0.1)] {
        assert!(found.points.iter().any(|q| (q.point_a - p).norm() < 1e-15), "{p:?} {found:?}");
    }
}

#[test]
fn a_ball_on_a_box_and_a_can_on_a_box() {
    let a = cuboid([1.0, 1.0, 0.5]);
    let (sphere, can) = (Sphere::new(0.2), Cylinder::new(0.1, 0.3));
    let touch = |p: Vector3, n: Vector3| Touch { point_a: p, point_b: p, normal: n, signed_distance: 0.0 };
    let flat = at(0.0, 0.0, 0.0);
    // a normal off by 1e-4, as a gap of 1e-12 may leave it: the face's takes its place
    let crooked = vector(1e-4, 0.0, 1.0).normalize();
    let on_top = manifold(
        &Surface::Polyhedron(&a),
        &flat,
        &Surface::Sphere(&sphere),
        &at(0.3, 0.0, 0.7),
        &touch(vector(0.3, 0.0, 0.5), crooked),
        EPS,
    );
    assert_points(&on_top, &[vector(0.3, 0.0, 0.5)]);
    close(&on_top.normals[0], &Vector3::z(), 1e-15);

    // on the edge the normal is that of the closest points
    let n = vector(0.6, 0.0, 0.8);
    let center = vector(1.0, 0.2, 0.5) + 0.2 * n;
    let on_edge = manifold(
        &Surface::Polyhedron(&a),
        &flat,
        &Surface::Sphere(&sphere),
        &at(center.x, center.y, center.z),
        &touch(vector(1.0, 0.2, 0.5), n),
        EPS,
    );
    assert_points(&on_edge, &[vector(1.0, 0.2, 0.5)]);
    close(&on_edge.normals[0], &n, 1e-15);

    // a can that lies half over the edge x = 1: from x = 0.8 to 1
    let lying = turned([1.1, 0.0, 0.6], Vector3::y(), std::f64::consts::FRAC_PI_2);
    let found = manifold(
        &Surface::Polyhedron(&a),
        &flat,
        &Surface::Cylinder(&can),
        &lying,
        &touch(vector(0.9, 0.0, 0.5), crooked),
        EPS,
    );
    assert_points(&found, &[vector(0.8, 0.0, 0.5), vector(1.0, 0.0, 0.5)]);
    let contacts = found.contacts(3, 5, 0.2, 0.9);
    assert!(
        contacts
            .iter()
            .all(|c| (c.a, c.b, c.friction, c.restitution) == (3, 5, 0.2, 0.9) && c.normals[..] == found.normals)
    );
}
