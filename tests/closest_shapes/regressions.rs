//! Cases of curved bodies that made public libraries fail, and what the fuzzer found here.

use bryla::closest::{Accuracy, ClosestFeatures, Collider, Feature, State, closest_features};
use bryla::math::Pose;
use bryla::shape::{Cuboid, Cylinder, Ellipsoid, Shape, Sphere};

use crate::proof;
use crate::random::Random;

/// The answer, after its own proof.
fn proved(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> ClosestFeatures {
    let (ca, cb) = (Collider::new(a).unwrap(), Collider::new(b).unwrap());
    let found = closest_features(&ca, pose_a, &cb, pose_b, None, Accuracy::Exact).unwrap();
    proof::check(&found, [(a, pose_a), (b, pose_b)], &mut Random(1), "regression");
    assert!(found.certified, "{found:?}");
    found
}

/// fcl#319: "this should not happen" between a board and a cylinder.
#[test]
fn a_board_and_a_cylinder() {
    let board = Cuboid::new([0.025, 0.195, 0.735]).into();
    let cylinder = Cylinder::new(0.18, 0.09).into();
    let (pose_a, pose_b) = (
        Pose::new([0.8, -0.385, 0.735], [1.0, 0.0, 0.0, 1.0]),
        Pose::new([0.4, -0.4, 0.93], [0.991445, 0.0, 0.0, -0.130526]),
    );
    // turned by a right angle, the board reaches 0.195 m along x and 0.025 m along y
    let found = proved(&board, &pose_a, &cylinder, &pose_b);
    assert!((found.signed_distance - (0.4 - 0.195 - 0.18)).abs() < 1e-6, "{found:?}");
    assert_eq!(found.feature_b, Feature::Surface(0));
}

/// fcl#391: the same between a thin pole and a ball beside it.
#[test]
fn a_pole_and_a_ball() {
    let (pole, ball) = (Cylinder::new(0.03, 0.325).into(), Sphere::new(0.055).into());
    let (x, y, z) = (0.5419794018f64, -0.0621175025f64, 0.6016236576);
    let (pose_a, pose_b) =
        (Pose::new([0.6, 0.0, 0.325], [1.0, 0.0, 0.0, 0.0]), Pose::new([x, y, z], [1.0, 0.0, 0.0, 0.0]));
    let found = proved(&pole, &pose_a, &ball, &pose_b);
    // beside the pole, below its top at 0.65 m
    assert!((found.signed_distance - (libm::hypot(x - 0.6, y) - 0.085)).abs() < 1e-15, "{found:?}");
}

/// fcl#408: a ball that touches the edge of a face, to rounding; "the origin is outside of the polytope".
#[test]
fn a_ball_that_touches_a_box() {
    let (ball, cube) = (Sphere::new(0.06).into(), Cuboid::new([0.05; 3]).into());
    let ball_pose =
        Pose::new([1.7855056639081962376e-10, 0.039999999999999993894, 0.33000000000000012657], [1.0, 0.0, 0.0, 0.0]);
    let cube_pose = Pose::new([0.05, 0.15, 0.35], [1.0, 0.0, 0.0, 0.0]);
    // the face's plane is at y = 0.1, and the ball's centre over the face by 2e-10 m
    let found = proved(&ball, &ball_pose, &cube, &cube_pose);
    assert!(found.signed_distance.abs() < 1e-16 * 4.0, "{found:?}");
}

/// parry#79: a cylinder whose cap touches a triangle's plane, its rim over the triangle's side.
#[test]
fn a_cylinder_on_a_triangle() {
    use bryla::shape::convex_polyhedron::ConvexPolyhedron;
    let triangle = ConvexPolyhedron::from_points(&[[1.0, -1.0, 0.0], [-1.0, -1.0, 0.0], [0.0, -1.0, 1.0]]).unwrap();
    // the cylinder of that report stands along y; half as high as the plane is deep
    let s = std::f64::consts::FRAC_1_SQRT_2;
    let cylinder = Collider::new(&Cylinder::new(1.0, 0.5).into()).unwrap();
    let upright = Pose::new([0.0; 3], [s, s, 0.0, 0.0]);
    let found = closest_features(&cylinder, &upright, &triangle, &Pose::identity(), None, Accuracy::Exact).unwrap();
    assert!((found.signed_distance - 0.5).abs() < 4.0 * f64::EPSILON && found.certified, "{found:?}");
    assert_eq!(found.state, State::Separated);
}

/// Found by the fuzzer: with both centres on one spot the search began with a point inside, and a triangle on one line
/// through the origin was taken for a proof.
#[test]
fn a_ball_at_the_centre_of_an_ellipsoid() {
    let (ball, ellipsoid) = (Sphere::new(0.59375).into(), Ellipsoid::new([0.171875, 2.03125, 1.171875]).into());
    let mut random = Random(3);
    let turned = [[-3.375, 1.99993896484375, -3.375, -3.375]];
    for q in turned.into_iter().chain((0..50).map(|_| [0; 4].map(|_| random.within(-1.0, 1.0)))) {
        let found = proved(&ball, &Pose::identity(), &ellipsoid, &Pose::new([0.0; 3], q));
        // the shortest way out is along the shortest axis
        assert!((found.signed_distance + 0.59375 + 0.171875).abs() < 16.0 * f64::EPSILON, "{q:?}: {found:?}");
    }
}
