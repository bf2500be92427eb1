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

/// The answer, after the oracle has agreed with it.
fn proved(a: &ConvexPolyhedron, b: &ConvexPolyhedron) -> ClosestFeatures {
    let home = Pose::identity();
    let found = closest_features(a, &home, b, &home, None, Accuracy::Exact).unwrap();
    assert_is_right(&found, &oracle::signed_distance(a, &home, b, &home), size(a, &home, b, &home), "regression");
    found
}

/// A box of these sides, its corners placed by the matrix that the report prints.
fn printed_box(sides: [f64; 3], rows: [[f64; 4]; 3]) -> ConvexPolyhedron {
    let corner = |k: usize| {
        let v: [f64; 3] = std::array::from_fn(|i| if k >> i & 1 == 0 { -0.5 } else { 0.5 } * sides[i]);
        rows.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3])
    };
    ConvexPolyhedron::from_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
}

/// parry#253: a panic in the depth of two triangles, one with a corner in the other's plane.
#[test]
fn triangles_with_a_corner_in_a_plane() {
    let triangle = |points: [[f64; 3]; 3]| ConvexPolyhedron::from_points(&points).unwrap();
    let lying = triangle([[-13.174434, 1.0, 8.736801], [3.5251038, 1.0, 12.1], [3.2048466, 1.0, 12.218325]]);
    let standing = triangle([[-1.63, 0.0, 11.19], [-2.349647, 0.0, 11.037681], [-2.349647, 1.0, 11.037681]]);
    proved(&lying, &standing);
    proved(&standing, &lying);
}

/// fcl#293: nearest points of NaN between a thin plate and a turned box.
#[test]
fn a_plate_and_a_turned_box() {
    let (plate, block) = (cuboid([1.375, 3.0, 0.025]), cuboid([0.212, 0.075, 0.0843]));
    let home = at(1.625, 0.0, 0.5);
    let turned = Pose::new([0.192074, -0.277870, 0.273546], [0.672811, 0.340674, 0.155066, 0.638138]);
    let found = closest_features(&plate, &home, &block, &turned, None, Accuracy::Exact).unwrap();
    let truth = oracle::signed_distance(&plate, &home, &block, &turned);
    assert_is_right(&found, &truth, size(&plate, &home, &block, &turned), "fcl#293");
    assert!(found.state == State::Separated && found.point_a.iter().all(|x| x.is_finite()));
}

/// fcl#493: equal boxes in one orientation whose edges all but touch; "the origin is outside".
#[test]
fn equal_boxes_that_kiss() {
    let (x, y) = (
        [0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667],
        [-0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586],
    );
    let z = [-0.2429801799032638987, 0.23569836841299884878, 0.94096063217417758029];
    let row = |r: [f64; 3], t: f64| [r[0], r[1], r[2], t];
    let a = printed_box(
        [0.25; 3],
        [row(x, 0.073242100093223821977), row(y, 0.2316538089896212349), row(z, 1.3089245921032497399)],
    );
    let b = printed_box([0.25; 3], [row(x, 0.0), row(y, 0.0), row(z, 1.25)]);
    // one edge length apart along y: touching, to the rounding of the printed numbers
    let found = proved(&a, &b);
    assert!(found.signed_distance.abs() < 1e-15, "{found:?}");
}

/// fcl#399: a block whose side all but lies in a board's; "the origin is outside of the polytope".
#[test]
fn a_block_along_a_board() {
    let (c, s) = (0.099432387353076273628, 0.99504432079443971837);
    let block = printed_box(
        [0.23768037557601928711, 0.15702305734157562256, 0.25],
        [[-c, s, 0.0, 0.29526406526565551758], [-s, -c, 0.0, -0.013230856508016586304], [0.0, 0.0, 1.0, 0.0]],
    );
    let (c, s) = (0.99506598442099225554, 0.099215354901756730444);
    let board = printed_box(
        [0.010000000000000000208, 0.78165709972381591797, 0.25],
        [[c, s, 0.0, 0.22759585694545214629], [-s, c, 0.0, 0.14974093549228112421], [0.0, 0.0, 1.0, 0.0]],
    );
    // along the thin side of the board: the distance of the centres less ½ 0.01 + ½ 0.157 + ½ 0.238 · 2.2e-4
    let found = proved(&block, &board);
    assert_eq!(found.state, State::Overlapping);
    assert!((found.signed_distance + 3.38106439992e-5).abs() < 1e-15, "{found:?}");
}

/// fcl#508: boxes apart along y alone, where a distance of 3 came out as 3.16.
#[test]
fn boxes_apart_along_one_axis() {
    let cube = cuboid([0.5; 3]);
    for (k, axis) in [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().enumerate() {
        let mut position = [0.0; 3];
        position[k] = 4.0;
        let found = answer(&cube, &Pose::identity(), &cube, &at(position[0], position[1], position[2]), 3.0);
        assert_eq!((found.signed_distance, found.normal), (3.0, axis));
    }
}

/// dolfinx#3653: a point and a small hull, where the search never ended.
#[test]
fn a_point_near_a_small_hull() {
    let point = ConvexPolyhedron::from_points(&[[44.2919, 39.7508, 18.8208]]).unwrap();
    let hull = ConvexPolyhedron::from_points(&[
        [46.0659, 38.6251, 16.3637],
        [44.2764, 42.3867, 18.239],
        [50.0397, 38.4649, 19.9843],
        [47.1963, 40.4563, 19.1057],
        [48.0266, 38.5593, 18.2475],
        [45.1735, 40.495, 17.3336],
        [48.0415, 40.4456, 18.1963],
    ])
    .unwrap();
    assert_eq!(proved(&point, &hull).state, State::Separated);
}

/// A corner over the long side of a needle: in double-double, four points of that side's plane seemed to
/// hold the origin, although the bodies had been proved apart. Found by the soak after 2e7 steps.
#[test]
fn a_corner_over_a_needle() {
    let plate = ConvexPolyhedron::from_points(&[
        [-0.7354550716020816, 0.5363698679625235, -0.0003251532352719171],
        [-0.7997613220633828, 0.4367914441541281, 6.062874954903075e-5],
        [0.20441202513446366, 0.7210178406221424, 0.0006789566060836312],
        [-0.5149339987922097, 0.7849664977639388, -0.00010600279811161539],
        [-0.27173810606252036, -0.4262594567388147, 0.0006700737293086599],
        [0.8143829719767748, -0.47887168488480936, 0.000666402832569734],
        [0.7218637822091494, -0.6734392368589728, 0.0001327004066916224],
        [0.17513989866019775, -0.9829509719108791, 0.0005584150451920301],
        [-0.6019850420651149, 0.6951890287826048, 0.0009760971897690816],
        [-0.9342862833165464, 0.10933560888423122, 0.0005481379662881922],
        [-0.8756538666726452, -0.2524417018569587, -0.0009080654910613766],
        [0.2426021326240586, -0.16462360655210295, -0.0007504943880819355],
        [0.17403362965647262, 0.14552972718742163, 0.0008896512715514681],
    ])
    .unwrap();
    let needle = ConvexPolyhedron::from_points(&[
        [-0.001, 0.5, 0.001],
        [0.001, -0.5, -0.001],
        [0.001, 1.0, -0.0005],
        [-0.001, -0.5, -0.001],
        [-0.0005, 1.0, -0.001],
        [-0.001, 1.0, 0.0005],
        [-0.001, 0.5, -0.001],
        [-0.001, -0.5, 0.0005],
        [0.001, 0.0, 0.0005],
        [-0.0005, -1.0, -0.0005],
        [0.0, 0.5, 0.001],
        [0.0005, 0.0, 0.001],
        [0.001, 0.5, -0.001],
        [0.0005, -1.0, -0.001],
        [-0.001, 0.0, 0.001],
        [0.001, -1.0, 0.0005],
        [0.001, -1.0, -0.0005],
    ])
    .unwrap();
    let turned = |position: [f64; 3], q: [f64; 4]| Pose {
        position: position.into(),
        orientation: bryla::math::quaternion::from_scalar_first(q),
    };
    let pose_a =
        turned([0.0; 3], [-0.9080247783429339, -0.16494505467151502, 0.37095965918714946, -0.10331051306827763]);
    let pose_b = turned(
        [-1.0001807966064298, 0.687894201956019, -0.9075695414849324],
        [-0.8769975631131166, 0.31508912777497183, 0.23730930248874602, 0.2743691141582222],
    );
    let found = closest_features(&plate, &pose_a, &needle, &pose_b, None, Accuracy::Exact).unwrap();
    let truth = oracle::signed_distance(&plate, &pose_a, &needle, &pose_b);
    assert_is_right(&found, &truth, size(&plate, &pose_a, &needle, &pose_b), "a needle");
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
