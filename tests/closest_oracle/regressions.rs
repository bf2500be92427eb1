//! Cases that made public libraries fail, with answers worked out by hand.

use bryla::closest::{Accuracy, ClosestFeatures, Feature, PairCache, State, closest_features};
use bryla::math::{Pose, Vector3};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;

use crate::families::cuboid;
use crate::{assert_is_right, oracle, size};

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose { position: Vector3::new(x, y, z), ..Pose::identity() }
}

/// The answer, after the oracle has agreed with it and with the value by hand.
fn answer(a: &ConvexPolyhedron, pose_a: &Pose, b: &ConvexPolyhedron, pose_b: &Pose, by_hand: f64) -> ClosestFeatures {
    let found = closest_features(a, pose_a, b, pose_b, None, Accuracy::Exact).unwrap();
    let (truth, size) = (oracle::signed_distance(a, pose_a, b, pose_b), size(a, pose_a, b, pose_b));
    assert!(
        (truth.signed_distance - by_hand).abs() <= 8.0 * f64::EPSILON * size,
        "by hand {by_hand:e}, oracle {truth:?}"
    );
    assert_is_right(&found, &truth, size, "regression");
    found
}

/// libccd#25: depth 0 and a direction of NaN.
#[test]
fn cubes_that_overlap_by_a_tenth() {
    let cube = cuboid([1.0; 3]);
    let found = answer(&cube, &at(0.0, 0.0, 0.0), &cube, &at(0.0, 0.0, 1.9), 1.9 - 2.0);
    assert_eq!((found.state, found.normal), (State::Overlapping, Vector3::z()));
}

/// coal#144: corner to corner.
#[test]
fn cubes_that_touch_in_a_corner() {
    let cube = cuboid([1.0; 3]);
    let found = answer(&cube, &at(0.0, 0.0, 0.0), &cube, &at(2.0, 2.0, 2.0), 0.0);
    assert_eq!(found.state, State::Touching);
    assert!((found.point_a - Vector3::new(1.0, 1.0, 1.0)).norm() < 1e-14, "{found:?}");
    // any supporting direction is valid; it must not point into A
    assert!(found.normal.iter().all(|&x| x >= -1e-15), "{found:?}");
}

/// openGJK#52: tall prisms whose own coordinates are near 9e4, tops in one plane.
#[test]
fn tall_prisms_far_from_their_origin() {
    let prism = |x: f64| {
        let corner = |k: usize| {
            [
                x + if k & 1 == 0 { 0.0 } else { 10.0 },
                9.0e4 + if k & 2 == 0 { 0.0 } else { 7.0 },
                if k & 4 == 0 { 0.0 } else { 300.0 },
            ]
        };
        ConvexPolyhedron::from_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    };
    let (a, b) = (prism(8.9e4), prism(8.9e4 + 12.5));
    let found = answer(&a, &Pose::identity(), &b, &Pose::identity(), 2.5);
    assert_eq!(found.normal, Vector3::x());
    answer(&a, &Pose::identity(), &prism(8.9e4 + 9.75), &Pose::identity(), -0.25);
}

/// openGJK#3: polygons without thickness that cross, in one plane and through each other.
#[test]
fn flat_polygons_that_cross() {
    let square =
        ConvexPolyhedron::from_points(&[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
            .unwrap();
    let found = answer(&square, &Pose::identity(), &square, &at(0.5, 0.25, 0.0), 0.0);
    assert_eq!(found.state, State::Touching);
    assert!(found.normal.z.abs() > 1.0 - 1e-15, "{found:?}");
    // one stands across the other: a quarter of its height is the way out
    let across = Pose::new([0.0, 0.0, 0.75], [0.5f64.sqrt(), 0.5f64.sqrt(), 0.0, 0.0]);
    answer(&square, &Pose::identity(), &square, &across, -0.25);
}

/// `mujoco_warp#1430`: a small box resting on a box a thousand times larger.
#[test]
fn a_small_box_on_a_huge_one() {
    let (ground, small) = (cuboid([50.0, 50.0, 50.0]), cuboid([0.05; 3]));
    let found =
        answer(&ground, &Pose::identity(), &small, &at(17.0, -23.0, 50.05 - 1e-6), (50.05 - 1e-6) - 50.0 - 0.05);
    assert_eq!((found.state, found.normal), (State::Overlapping, Vector3::z()));
    let found =
        answer(&ground, &Pose::identity(), &small, &at(17.0, -23.0, 50.05 + 1e-6), (50.05 + 1e-6) - 50.0 - 0.05);
    assert_eq!((found.state, found.normal), (State::Separated, Vector3::z()));
}

/// bullet3#1703 and Jolt#2065: faces of 84 m a millimetre thick.
#[test]
fn a_wide_thin_floor() {
    let (floor, cube) = (cuboid([84.0, 0.001, 84.0]), cuboid([0.5; 3]));
    for gap in [0.25, 1e-9, 0.0, -1e-4] {
        let height = 0.501 + gap;
        let found = answer(&floor, &Pose::identity(), &cube, &at(61.0, height, -70.0), height - 0.501);
        assert!((found.normal - Vector3::y()).norm() < 1e-15, "{found:?}");
    }
}

/// Boxes about one centre, where peers report depth 0: the way out is through the thin side.
#[test]
fn boxes_about_one_centre() {
    let (long, slab) = (cuboid([2.0, 0.25, 0.25]), cuboid([1.0, 1.0, 0.25]));
    let found = answer(&long, &Pose::identity(), &slab, &Pose::identity(), -0.5);
    assert_eq!(found.state, State::Overlapping);
    assert!(found.normal.z.abs() > 1.0 - 1e-15, "{found:?}");
}

/// The face and the vertex that carry the answer are named, with the lower dimension first.
#[test]
fn features_are_named() {
    let cube = cuboid([1.0; 3]);
    let corner_down = Pose::new([0.0, 0.0, 3.0], [0.880476235, 0.279848142, -0.364705199, 0.115916896]);
    let found = closest_features(&cube, &Pose::identity(), &cube, &corner_down, None, Accuracy::Exact).unwrap();
    let Feature::Face(top) = found.feature_a else { panic!("{found:?}") };
    assert_eq!(cube.faces()[top as usize].normal, [0.0, 0.0, 1.0]);
    let Feature::Vertex(tip) = found.feature_b else { panic!("{found:?}") };
    let lowest = corner_down.point(&cube.vertices()[tip as usize].into());
    assert!((lowest - found.point_b).norm() < 1e-14);
}

/// Stale, foreign and senseless caches cost steps, never truth.
#[test]
fn any_cache_is_legal() {
    let (cube, tetrahedron) = (
        cuboid([1.0; 3]),
        ConvexPolyhedron::from_points(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap(),
    );
    let mut cache = PairCache::new();
    for k in 0..200 {
        let x = 0.03 * f64::from(k) - 3.0;
        let (a, b) = if k % 3 == 0 { (&tetrahedron, &cube) } else { (&cube, &cube) };
        let warm =
            closest_features(a, &Pose::identity(), b, &at(x, 0.2, 0.1), Some(&mut cache), Accuracy::Exact).unwrap();
        let cold = closest_features(a, &Pose::identity(), b, &at(x, 0.2, 0.1), None, Accuracy::Exact).unwrap();
        assert!((warm.signed_distance - cold.signed_distance).abs() <= 8e-15, "{k}: {warm:?} {cold:?}");
        assert!(warm.certified && warm.state == cold.state);
    }
}

/// A pose that places nothing is refused.
#[test]
fn bad_poses_are_refused() {
    let cube = cuboid([1.0; 3]);
    let query = |pose: Pose| closest_features(&cube, &Pose::identity(), &cube, &pose, None, Accuracy::Exact);
    assert!(query(at(f64::NAN, 0.0, 0.0)).unwrap_err().to_string().contains("pose_b"));
    let mut no_direction = Pose::identity();
    no_direction.orientation.w = 0.0;
    assert!(query(no_direction).unwrap_err().to_string().contains("quaternion"));
}
