"""Closest features: one query, many, the plane, figures."""

import copy
import math
import pickle
import threading

import bryla
import numpy as np
import pytest

HOME = bryla.Pose()


def at(x, y, z):
    return bryla.Pose((x, y, z))


def test_every_shape_answers_by_hand():
    ball = bryla.Sphere(0.5)
    for shape, reach in [
        (bryla.Cuboid((1, 2, 3)), 1.0),
        (bryla.Sphere(0.75), 0.75),
        (bryla.Cylinder(0.75, 2), 0.75),
        (bryla.Capsule(0.75, 2), 0.75),
        (bryla.Ellipsoid((0.75, 1, 2)), 0.75),
        (bryla.Compound([bryla.Piece(bryla.Sphere(0.25), position=(1, 0, 0)), bryla.Cuboid((0.5, 1, 1))]), 1.25),
        (bryla.HalfSpace((1, 0, 0), 0.25), 0.25),
        (bryla.ConvexPolyhedron([(1, 1, 1), (1, -1, -1), (1, 1, -1), (1, -1, 1), (-1, 0, 0)]), 1.0),
    ]:
        found = bryla.closest_features(shape, HOME, bryla.Collider(ball), at(3, 0, 0))
        # 3 m less both reaches, right to a few roundings of the size of the pair
        assert found.signed_distance == pytest.approx(2.5 - reach, abs=1e-14)
        assert found.state == "separated"
        assert found.certified
        assert found.lower <= 2.5 - reach <= found.upper
        assert np.allclose(found.normal, (1, 0, 0), atol=1e-7)
        assert found.feature_b == ("surface", 0)
        # the lecture's promise of one quantity: the same normal carries it through contact
        deep = bryla.closest_features(shape, HOME, ball, at(reach + 0.4, 0, 0))
        assert deep.state == "overlapping"
        assert deep.normal @ (deep.point_b - deep.point_a) == pytest.approx(deep.signed_distance, abs=1e-14)


def test_features_and_pieces_are_named():
    floor = bryla.Cuboid((2, 2, 0.5))
    found = bryla.closest_features(floor, HOME, bryla.Cuboid((0.5, 0.5, 0.5)), at(0.3, 0.2, 1.5))
    collider = bryla.Collider(floor)
    kind, number = found.feature_a
    body = collider.polyhedron()
    assert kind in ("face", "vertex", "edge")
    assert found.feature_b[0] in ("face", "vertex", "edge")
    if kind == "face":
        assert np.array_equal(body.normals[number], (0, 0, 1))
    dumbbell = bryla.Compound([bryla.Cylinder(0.1, 1), bryla.Piece(bryla.Sphere(0.5), position=(0, 0, 1))])
    found = bryla.closest_features(dumbbell, HOME, bryla.Sphere(0.5), at(3, 0, 1))
    assert (found.part_a, found.part_b, bryla.Collider(dumbbell).part_count) == (1, 0, 2)


def test_a_polyhedron_shows_its_parts():
    box = bryla.ConvexPolyhedron([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1e-9)])
    assert (len(box.vertices), len(box.edges), len(box.faces), box.rank) == (8, 12, 6, 3)
    assert {frozenset(edge) for edge in box.edges} == {
        frozenset((face[k - 1], face[k])) for face in box.faces for k in range(4)
    }
    assert tuple(box.vertices[box.support((1, 1, -1))]) == (1, 1, 0)
    for body in (box, bryla.ConvexPolygon([(0, 0), (2, 0), (1, 1), (1, 0.2)])):
        assert pickle.loads(pickle.dumps(body)) == body == copy.copy(body)
    assert bryla.Collider(box) == bryla.Collider(bryla.Collider(box))


def test_a_cache_makes_the_next_query_short():
    a = bryla.Collider(bryla.ConvexPolyhedron(np.random.default_rng(1).normal(size=(200, 3))))
    cache = bryla.PairCache()
    first = bryla.closest_features(a, HOME, a, at(9, 1, 0), cache)
    again = bryla.closest_features(a, HOME, a, at(9, 1.001, 0), cache)
    assert again.rung == "verified"
    assert again.steps == 1 <= first.steps


def test_accuracy_is_an_argument():
    a, b = bryla.Collider(bryla.Ellipsoid((1, 0.5, 0.3))), bryla.Collider(bryla.Cone(0.4, 0.7))
    pose = bryla.Pose((1.2, 0.9, 0.8), (0.9, 0.1, 0.3, -0.2))
    exact = bryla.closest_features(a, HOME, b, pose)
    # 48 roundings of the size: both radii and the distance of the centres
    size = 1 + math.hypot(0.4, 0.7) + float(np.linalg.norm(pose.position))
    assert exact.upper - exact.lower < 48 * np.finfo(float).eps * size
    for accuracy in (1e-3, 1e-9, "yes_no"):
        rough = bryla.closest_features(a, HOME, b, pose, accuracy=accuracy)
        assert rough.steps <= exact.steps
        assert rough.lower <= exact.upper
        assert exact.lower <= rough.upper
    for wrong in ("sharp", 0.0, 2.0):
        with pytest.raises(bryla.Error, match="accuracy must be"):
            bryla.closest_features(a, HOME, b, pose, accuracy=wrong)


def test_many_poses_agree_with_one_at_a_time_and_let_others_run():
    rng = np.random.default_rng(2)
    a, b = bryla.Collider(bryla.Cuboid((1, 0.5, 0.3))), bryla.Collider(bryla.Cylinder(0.4, 0.7))
    x, q = 2 * rng.normal(size=(4, 25, 3)), rng.normal(size=(4, 25, 4))
    many = bryla.closest_features_many(a, HOME, b, (x, q))
    assert many["signed_distance"].shape == (4, 25)
    assert many["normal"].shape == (4, 25, 3)
    assert many["certified"].all()
    for index in np.ndindex(4, 25):
        one = bryla.closest_features(a, HOME, b, bryla.Pose(x[index], q[index]))
        # both intervals hold the truth, so they meet
        assert many["lower"][index] <= one.upper
        assert one.lower <= many["upper"][index]
        assert {1: "separated", 0: "touching", -1: "overlapping"}[int(many["state"][index])] == one.state

    # asked anew, the order of the poses leaves no trace
    anew = bryla.closest_features_many(a, HOME, b, (x, q), warm=False)
    backwards = bryla.closest_features_many(a, HOME, b, (x[::-1, ::-1], q[::-1, ::-1]), warm=False)
    for name, column in anew.items():
        np.testing.assert_array_equal(column, backwards[name][::-1, ::-1])

    # another thread counts while the queries run
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    bryla.closest_features_many(a, HOME, b, (np.tile(x, (50, 1, 1)), np.tile(q, (50, 1, 1))))
    during = counted[0] - before
    stop.set()
    thread.join()
    assert during > 0
    with pytest.raises(ValueError, match="as many positions"):
        bryla.closest_features_many(a, HOME, b, (x, q[:2]))


def test_what_cannot_collide_is_refused():
    vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.2, 0.2, 0.2)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4)]
    with pytest.raises(bryla.Error, match=r"face 3 has vertex 3 in front of it.*compound"):
        bryla.Collider(bryla.Polyhedron(vertices, faces))
    floor = bryla.HalfSpace((0, 0, 1), 0)
    with pytest.raises(bryla.Error, match="two half spaces"):
        bryla.closest_features(floor, HOME, floor, HOME)
    with pytest.raises(TypeError, match="a shape wanted"):
        bryla.Collider("a stone")


def test_the_regions_of_a_polygon():
    polygon = bryla.ConvexPolygon([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, 0)])
    regions = bryla.voronoi_regions(polygon)
    assert [region.feature for region in regions][:3] == [("vertex", 0), ("edge", 0), ("vertex", 1)]
    points = np.array([(0, -3), (2, -3), (1, -3), (0.2, 0.5)])
    holders = np.array([region.contains(points) for region in regions])
    # one region, one region, the border of two, and inside none
    assert holders.sum(axis=0).tolist() == [1, 1, 2, 0]


def test_the_walk_in_the_plane_and_its_figures():
    square = bryla.ConvexPolygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    found = bryla.closest_features_planar(square, (0, 0, 0), square, (4, 0, math.pi / 4))
    assert found.signed_distance == pytest.approx(3 - math.sqrt(2), abs=1e-15)
    assert (found.state, found.feature_a[0], found.feature_b[0], found.certified) == (
        "separated",
        "edge",
        "vertex",
        True,
    )
    assert found.path[-1][:2] == (found.feature_a, found.feature_b)
    again = bryla.closest_features_planar(square, (0, 0, 0), square, (4, 0.1, 0.7), (found.feature_a, found.feature_b))
    assert len(again.path) <= len(found.path)
    with pytest.raises(bryla.Error, match="start"):
        bryla.closest_features_planar(square, (0, 0, 0), square, (4, 0, 0), (("vertex", 9), ("edge", 0)))

    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    figure = square.plot()
    figure.canvas.draw()
    (axes,) = figure.axes
    assert {text.get_text() for text in axes.texts} == {f"V({kind}{k})" for kind in "ve" for k in range(4)}
    (axes,) = found.plot(figure=matplotlib.figure.Figure()).axes
    assert len(axes.lines) == len(found.path)
    assert len(axes.patches) == 2
