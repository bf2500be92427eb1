//! Answers worked out by hand.

use bryla::closest::{Accuracy, ClosestFeatures, Collider, Feature, State, closest_features};
use bryla::math::{Pose, Vector3};
use bryla::shape::{
    Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Mesh, Piece, Polyhedron, Shape, Sphere,
};

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose { position: Vector3::new(x, y, z), ..Pose::identity() }
}

fn query(a: impl Into<Shape>, pose_a: &Pose, b: impl Into<Shape>, pose_b: &Pose) -> ClosestFeatures {
    let (a, b) = (Collider::new(&a.into()).unwrap(), Collider::new(&b.into()).unwrap());
    closest_features(&a, pose_a, &b, pose_b, None, Accuracy::Exact).unwrap()
}

/// The answer, right to `8 ε` of a size of about 5.
fn expect(found: ClosestFeatures, by_hand: f64) -> ClosestFeatures {
    assert!((found.signed_distance - by_hand).abs() <= 40.0 * f64::EPSILON, "by hand {by_hand:e}: {found:?}");
    assert!(found.lower <= by_hand + 8.0 * f64::EPSILON && by_hand <= found.upper + 8.0 * f64::EPSILON, "{found:?}");
    assert!(found.certified, "{found:?}");
    found
}

#[test]
fn balls_apart_touching_overlapping_and_about_one_centre() {
    let ball = Sphere::new(1.0);
    let found = expect(query(ball, &at(0.0, 0.0, 0.0), ball, &at(0.0, 3.0, 0.0)), 1.0);
    assert_eq!((found.state, found.normal), (State::Separated, Vector3::y()));
    assert_eq!((found.point_a, found.point_b), (Vector3::y(), 2.0 * Vector3::y()));
    assert_eq!((found.feature_a, found.feature_b), (Feature::Surface(0), Feature::Surface(0)));
    let found = expect(query(ball, &at(0.0, 0.0, 0.0), ball, &at(0.0, 2.0, 0.0)), 0.0);
    assert_eq!((found.state, found.normal), (State::Touching, Vector3::y()));
    let found = expect(query(ball, &at(0.0, 0.0, 0.0), ball, &at(0.5, 0.0, 0.0)), -1.5);
    assert_eq!((found.state, found.normal), (State::Overlapping, Vector3::x()));
    let found = expect(query(ball, &at(0.0, 0.0, 0.0), Sphere::new(0.25), &at(0.0, 0.0, 0.0)), -1.25);
    assert_eq!(found.state, State::Overlapping);
    assert!((found.normal.norm() - 1.0).abs() < 1e-15);
}

#[test]
fn a_ball_inside_a_box_leaves_through_the_nearest_face() {
    let cuboid = Cuboid::new([3.0, 2.0, 1.0]);
    let found = expect(query(cuboid, &at(0.0, 0.0, 0.0), Sphere::new(0.5), &at(1.0, 0.5, 0.75)), -0.75);
    assert_eq!((found.normal, found.feature_b), (Vector3::z(), Feature::Surface(0)));
    assert_eq!(found.feature_a.kind(), "face");
    // over an edge: the diagonal of a 3–4 triangle
    let found = expect(query(cuboid, &at(0.0, 0.0, 0.0), Sphere::new(0.5), &at(6.0, 6.0, 0.0)), 4.5);
    assert_eq!(found.feature_a.kind(), "edge");
}

#[test]
fn capsules_by_their_axes() {
    // crossed at a right angle, one over the other
    let capsule = Capsule::new(0.25, 1.0);
    let s = std::f64::consts::FRAC_1_SQRT_2;
    let lying = Pose::new([1.5, 0.25, 0.5], [s, 0.0, s, 0.0]);
    let found = expect(query(capsule, &at(0.0, 0.0, 0.0), capsule, &lying), libm::hypot(0.5, 0.25) - 0.5);
    assert_eq!((found.feature_a, found.feature_b), (Feature::Surface(2), Feature::Surface(0)));
    // axes that cross in their middles: any way across both
    let crossed = Pose::new([0.0; 3], [s, 0.0, s, 0.0]);
    let found = expect(query(capsule, &at(0.0, 0.0, 0.0), capsule, &crossed), -0.5);
    assert!(found.normal.y.abs() > 1.0 - 1e-15, "{found:?}");
    // one above the other: round end to round end
    let found = expect(query(capsule, &at(0.0, 0.0, 0.0), capsule, &at(0.0, 0.0, 3.0)), 0.5);
    assert_eq!((found.feature_a, found.feature_b), (Feature::Surface(1), Feature::Surface(0)));
    // no height: a ball
    expect(query(Capsule::new(1.0, 0.0), &at(0.0, 0.0, 0.0), Sphere::new(1.0), &at(0.0, 3.0, 0.0)), 1.0);
}

#[test]
fn a_cylinder_seen_from_its_side_its_cap_and_its_rim() {
    let cylinder = Cylinder::new(1.0, 2.0);
    for (at_ball, distance, feature) in [
        (at(3.0, 4.0, 1.0), 3.75, Feature::Surface(0)),
        (at(0.25, 0.5, -4.0), 1.75, Feature::Face(0)),
        (at(0.0, 4.0, 6.0), 4.75, Feature::Edge(1)),
        (at(0.5, 0.0, 1.0), -0.75, Feature::Surface(0)),
        (at(0.0, 0.25, 1.5), -0.75, Feature::Face(1)),
    ] {
        let found = expect(query(cylinder, &at(0.0, 0.0, 0.0), Sphere::new(0.25), &at_ball), distance);
        assert_eq!((found.feature_a, found.feature_b), (feature, Feature::Surface(0)), "{found:?}");
    }
}

#[test]
fn cylinders_standing_side_by_side_on_each_other_and_on_a_box() {
    let cylinder = Cylinder::new(1.0, 2.0);
    let found = expect(query(cylinder, &at(0.0, 0.0, 0.0), cylinder, &at(3.0, 4.0, 1.0)), 3.0);
    assert_eq!((found.feature_a, found.feature_b), (Feature::Surface(0), Feature::Surface(0)));
    for gap in [0.5, 1e-9, 0.0, -1e-9, -0.25] {
        let found = expect(query(cylinder, &at(0.0, 0.0, 0.0), cylinder, &at(0.5, 0.25, 4.0 + gap)), (4.0 + gap) - 4.0);
        assert!((found.normal - Vector3::z()).norm() < 1e-7, "{found:?}");
        assert_eq!((found.feature_a, found.feature_b), (Feature::Face(1), Feature::Face(0)), "{gap:e} {found:?}");
        let table = Cuboid::new([5.0, 5.0, 1.0]);
        expect(query(table, &at(0.0, 0.0, 0.0), cylinder, &at(1.5, 0.25, 3.0 + gap)), (3.0 + gap) - 3.0);
        // lying on it
        let s = std::f64::consts::FRAC_1_SQRT_2;
        let lying = Pose::new([0.5, 0.25, 2.0 + gap], [s, 0.0, s, 0.0]);
        let found = query(table, &at(0.0, 0.0, 0.0), cylinder, &lying);
        assert!((found.signed_distance - ((2.0 + gap) - 2.0)).abs() < 8e-15 && found.certified, "{gap:e} {found:?}");
        assert_eq!(found.feature_b, Feature::Surface(0), "{gap:e} {found:?}");
    }
}

#[test]
fn a_cone_by_its_apex_its_side_its_rim_and_its_base() {
    // rise 4 over radius 3: the side's normal is (4, 0, 3)/5
    let cone = Cone::new(3.0, 2.0);
    for (at_ball, distance, feature) in [
        (at(0.0, 0.0, 5.0), 2.5, Feature::Vertex(0)),
        (at(1.5 + 4.0, 0.0, 3.0), 4.5, Feature::Surface(0)),
        (at(1.0, 1.0, -4.0), 1.5, Feature::Face(0)),
        (at(6.0, 0.0, -6.0), 4.5, Feature::Edge(0)),
    ] {
        let found = expect(query(cone, &at(0.0, 0.0, 0.0), Sphere::new(0.5), &at_ball), distance);
        assert_eq!(found.feature_a, feature, "{found:?}");
    }
}

#[test]
fn an_ellipsoid_of_equal_axes_is_a_ball_and_a_long_one_ends_at_its_axis() {
    expect(query(Ellipsoid::new([1.0; 3]), &at(0.0, 0.0, 0.0), Ellipsoid::new([0.5; 3]), &at(0.0, 3.0, 4.0)), 3.5);
    expect(query(Ellipsoid::new([3.0, 2.0, 1.0]), &at(0.0, 0.0, 0.0), Sphere::new(1.0), &at(5.0, 0.0, 0.0)), 1.0);
    // a point inside on the longest axis leaves along the shortest one, if it is near the middle
    expect(query(Ellipsoid::new([3.0, 2.0, 1.0]), &at(0.0, 0.0, 0.0), Sphere::new(0.25), &at(0.0, 0.0, 0.0)), -1.25);
    // the foot of (x₀ + t x₀/a², …) for t = 1 is (x₀, …): normals of the surface
    let (a, b) = (2.0, 1.0);
    let (x0, z0) = (1.2, 0.8); // (1.2/2)² + 0.8² = 1
    let (dx, dz) = (x0 / (a * a), z0 / (b * b));
    let found = query(Ellipsoid::new([a, 3.0, b]), &at(0.0, 0.0, 0.0), Sphere::new(0.25), &at(x0 + dx, 0.0, z0 + dz));
    expect(found, libm::hypot(dx, dz) - 0.25);
}

#[test]
fn everything_over_a_half_space() {
    let s = std::f64::consts::FRAC_1_SQRT_2;
    // a floor of normal (0, 0, 2): its surface at z = 1/2
    let floor = HalfSpace::new([0.0, 0.0, 2.0], 1.0);
    let lying = Pose::new([7.0, -3.0, 2.0], [s, 0.0, s, 0.0]);
    let cases: [(Shape, f64, f64); 7] = [
        (Cuboid::new([1.0, 2.0, 0.5]).into(), 0.5, 1.0),
        (Sphere::new(0.75).into(), 0.75, 0.75),
        (Cylinder::new(0.5, 1.0).into(), 1.0, 0.5),
        (Capsule::new(0.5, 1.0).into(), 1.5, 0.5),
        (Cone::new(0.5, 1.0).into(), 1.0, 0.5),
        (Ellipsoid::new([0.25, 0.5, 0.75]).into(), 0.75, 0.25),
        (
            Compound::new([
                Piece::new(Sphere::new(0.25)).position([0.0, 0.0, -0.5]),
                Piece::new(Sphere::new(0.5)).position([0.0, 0.0, 5.0]),
            ])
            .into(),
            0.75,
            0.25,
        ),
    ];
    for (shape, standing, side) in cases {
        let found = query(floor, &at(0.0, 0.0, 0.0), shape.clone(), &at(7.0, -3.0, 2.0));
        assert!((found.signed_distance - (1.5 - standing)).abs() < 1e-14 && found.certified, "{shape:?} {found:?}");
        assert_eq!((found.normal, found.feature_a), (Vector3::z(), Feature::Face(0)));
        if !matches!(shape, Shape::Cuboid(_) | Shape::Cone(_)) {
            let found = query(floor, &at(0.0, 0.0, 0.0), shape.clone(), &lying);
            let by_hand = if matches!(shape, Shape::Compound(_)) { 1.5 - 0.5 } else { 1.5 - side };
            assert!((found.signed_distance - by_hand).abs() < 1e-14 && found.certified, "{shape:?} {found:?}");
        }
        // a slope, the other way round, buried
        let slope = Pose::new([0.0, 0.0, -0.5], [s, 0.0, s, 0.0]);
        let found = query(shape.clone(), &at(-3.0, 2.0, 9.0), floor, &slope);
        assert_eq!(found.state, State::Overlapping);
        assert!((found.normal + Vector3::x()).norm() < 1e-15, "{shape:?} {found:?}");
    }
}

#[test]
fn a_compound_names_its_piece() {
    let dumbbell = || {
        Compound::new([
            Piece::new(Cylinder::new(0.1, 1.0)),
            Piece::new(Sphere::new(0.5)).position([0.0, 0.0, 1.0]),
            Piece::new(Compound::new([Piece::new(Cuboid::new([0.5; 3])).position([0.0, 0.0, -1.0])])),
        ])
    };
    let found = expect(query(dumbbell(), &at(0.0, 0.0, 0.0), Sphere::new(0.5), &at(3.0, 0.0, 1.0)), 2.0);
    assert_eq!((found.part_a, found.part_b, found.feature_a), (1, 0, Feature::Surface(0)));
    let found = expect(query(Sphere::new(0.5), &at(2.0, 0.0, -1.0), dumbbell(), &at(0.0, 0.0, 0.0)), 1.0);
    assert_eq!((found.part_a, found.part_b, found.feature_b.kind()), (0, 2, "face"));
    let found = expect(query(Sphere::new(0.1), &at(0.3, 0.0, 0.0), dumbbell(), &at(0.0, 0.0, 0.0)), 0.1);
    assert_eq!(found.part_b, 0);
}

#[test]
fn what_cannot_collide_is_refused() {
    let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.2, 0.2]];
    let faces = [vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 4], vec![2, 3, 4], vec![3, 1, 4]];
    let refusal = |shape: Shape| Collider::new(&shape).unwrap_err().to_string();
    let dent = refusal(Polyhedron::new(vertices, faces).into());
    assert!(
        dent.contains("face 3 has vertex 3 in front of it") && dent.contains("compound of convex pieces"),
        "{dent}"
    );
    assert!(refusal(Mesh::new("nowhere.stl", 1.0).into()).contains("loaded"));
    assert!(refusal(Sphere::new(-1.0).into()).contains("radius"));
    assert!(refusal(Sphere::new(1e40).into()).contains("1e30"));
    assert!(refusal(Compound::new([Piece::new(Sphere::new(f64::NAN))]).into()).contains("piece 0"));
    let floor = Collider::new(&HalfSpace::new([0.0, 0.0, 1.0], 0.0).into()).unwrap();
    let error = closest_features(&floor, &Pose::identity(), &floor, &Pose::identity(), None, Accuracy::Exact);
    assert!(error.unwrap_err().to_string().contains("two half spaces"));
}

/// A vertex that no face uses is no part of the solid.
#[test]
fn an_unused_vertex_is_left_out() {
    let vertices = [[9.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let faces = [[1, 3, 2], [1, 2, 4], [2, 3, 4], [1, 4, 3]].map(Vec::from);
    expect(query(Polyhedron::new(vertices, faces), &at(0.0, 0.0, 0.0), Sphere::new(1.0), &at(0.0, 0.0, 4.0)), 2.0);
}

/// Where a whole circle of ways out is equally deep: bodies of revolution about one axis. The sum of two
/// cylinders is a cylinder, that of a cone and a cylinder has the cone's slope.
#[test]
fn bodies_about_one_axis() {
    let (r, h, p, q) = (1.0, 4.0, 0.5, 3.0);
    let (wide, thin) = (Cylinder::new(r, h), Cylinder::new(p, q));
    // side by side, through the caps, on the axis, upside down
    let found = expect(query(wide, &at(0.0, 0.0, 0.0), thin, &at(0.0, 0.0, 0.0)), -1.5);
    assert_eq!((found.feature_a, found.feature_b), (Feature::Surface(0), Feature::Surface(0)));
    expect(query(wide, &at(0.0, 0.0, 0.0), thin, &at(0.25, 0.0, 0.5)), -1.25);
    expect(query(wide, &at(0.0, 0.0, 0.0), thin, &at(1e-9, 0.0, 0.0)), 1e-9 - 1.5);
    let found = expect(query(wide, &at(0.0, 0.0, 0.0), thin, &at(0.25, 0.0, 6.5)), -0.5);
    assert_eq!((found.feature_a, found.feature_b), (Feature::Face(1), Feature::Face(0)));
    let turned = |x: f64, y: f64, z: f64| Pose::new([x, y, z], [0.0, 0.6, 0.8, 0.0]);
    expect(query(wide, &at(0.0, 0.0, 0.0), thin, &turned(0.0, 0.0, 0.0)), -1.5);

    // the same, turned and moved together
    let whole = Pose::new([10.0, -7.0, 3.0], [0.3, -0.5, 0.7, 0.4]);
    let place = |p: Pose| Pose { position: whole.point(&p.position), orientation: whole.orientation * p.orientation };
    for offset in [0.0, 1e-12, 1e-6, 0.01, 0.3] {
        let found = query(wide, &whole, thin, &place(at(offset, 0.0, 0.5)));
        assert!((found.signed_distance - (offset - 1.5)).abs() <= 1e-14 && found.certified, "{offset:e} {found:?}");
    }

    // a ball, a capsule and a spheroid on the axis
    expect(query(wide, &at(0.0, 0.0, 0.0), Sphere::new(0.25), &at(0.0, 0.0, 0.5)), -1.25);
    expect(query(wide, &at(0.0, 0.0, 0.0), Capsule::new(0.25, 0.5), &at(0.0, 0.0, 0.5)), -1.25);
    expect(query(wide, &at(0.0, 0.0, 0.0), Ellipsoid::new([0.25, 0.25, 0.75]), &at(0.0, 0.0, 0.5)), -1.25);
    expect(query(Ellipsoid::new([0.5, 0.5, 2.0]), &at(0.0, 0.0, 0.0), Sphere::new(0.25), &at(0.0, 0.0, 0.0)), -0.75);
    expect(query(Ellipsoid::new([1.0; 3]), &at(0.0, 0.0, 0.0), Ellipsoid::new([0.5; 3]), &at(0.0, 0.0, 0.0)), -1.5);

    // rise 4 over radius 3: the side's normal is (4, 3)/5 across and along, at height 2 · 3/5 of the middle
    let cone = Cone::new(3.0, 2.0);
    expect(query(cone, &at(0.0, 0.0, 0.0), Sphere::new(0.125), &at(0.0, 0.0, 0.0)), -1.325);
    expect(query(cone, &at(0.0, 0.0, 0.0), Cylinder::new(0.25, 0.5), &at(0.0, 0.0, 0.0)), -(1.2 + 0.2 + 0.3));
    // along the side's normal 1.2 + 3.6, along the axis 2 + 2
    expect(query(cone, &at(0.0, 0.0, 0.0), cone, &at(0.0, 0.0, 0.0)), -4.0);
}
