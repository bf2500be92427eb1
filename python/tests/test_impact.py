"""Times of impact: closed forms, what each finder sees, bad input, many at once."""

import copy
import math
import pickle

import bryla
import numpy as np
import pytest

UPRIGHT = (1, 0, 0, 0)
REST = bryla.Motion((0, 0, 0), UPRIGHT, (0, 0, 0), (0, 0, 0))
FLOOR = bryla.HalfSpace((0, 0, 1), 0)
FINDERS = ("guaranteed", "secant", "bisection")


def falling(height, speed, spin=(0, 0, 0)):
    return bryla.Motion((0.3, -0.2, height), UPRIGHT, (0, 0, -speed), spin)


@pytest.mark.parametrize("finder", FINDERS)
def test_a_ball_meets_a_plane_when_it_has_fallen_its_gap(finder):
    h, r, v = 2.5, 0.4, 3.0
    found = bryla.time_of_impact(FLOOR, REST, bryla.Sphere(r), falling(h, v, (5, -7, 9)), 1.0, finder=finder)
    assert found.outcome == "at"
    # t = (h − r)/v, early by ε/v at most: ε is 1e-12 of the ball's radius, 16 roundings of the height or less
    late = found.time - (h - r) / v
    assert -(4e-13 + 16 * np.finfo(float).eps * h) / v <= late <= np.finfo(float).eps
    assert 0 <= found.closest.signed_distance <= 4e-13 + 16 * np.finfo(float).eps * h
    assert found.closest.normal.tolist() == [0, 0, 1]
    assert found.iterations > 0 or finder == "guaranteed"
    assert found.queries > 0


def test_a_spinning_rod_meets_a_ball_where_its_end_reaches_it():
    # the rod's middle rests at the origin and it turns about z; a ball of radius r at the angle φ on the circle of
    # its ends: the thin rod touches where the ball's distance from its line is r, φ − ω t = asin(r/l)
    length, r, angle, w = 1.0, 0.05, 2.0, 40.0
    rod = bryla.ConvexPolyhedron([(-length, 0, 0), (length, 0, 0)])
    spins = bryla.Motion((0, 0, 0), UPRIGHT, (0, 0, 0), (0, 0, w))
    near = 0.9 * length
    ball = bryla.Motion((near * math.cos(angle), near * math.sin(angle), 0), UPRIGHT, (0, 0, 0), (0, 0, 0))
    truth = (angle - math.asin(r / near)) / w
    found = bryla.time_of_impact(rod, spins, bryla.Sphere(r), ball, 1.0)
    assert found.outcome == "at"
    # ε is 1e-12 of both radii at a speed of ω · 0.9 m, and the rounding of an angle of 2 rad
    assert abs(found.time - truth) < 1.1e-12 / (w * near) + 8 * np.finfo(float).eps / w
    assert found.closest.feature_a[0] == "edge"


def test_bisection_misses_a_pass_through_that_the_guaranteed_search_finds():
    plate, bullet = bryla.Cuboid((0.5, 0.5, 0.001)), bryla.Sphere(0.01)
    h, v = 2.0, 1000.0
    for finder in ("bisection", "secant"):
        missed = bryla.time_of_impact(plate, REST, bullet, falling(h, v), 0.1, finder=finder)
        assert (missed.outcome, missed.time) == ("clear", 0.1)
    found = bryla.time_of_impact(plate, REST, bullet, falling(h, v), 0.1)
    assert found.outcome == "at"
    # ε is 1e-12 of both radii, 0.72 m
    assert abs(found.time - (h - 0.011) / v) < 1e-12 / v


def test_the_finders_agree_to_eps_over_the_speed():
    a, b = bryla.Collider(bryla.Cuboid((0.5, 0.3, 0.2))), bryla.Collider(bryla.Cylinder(0.2, 0.4))
    moves = bryla.Motion((2, 0.1, 0.1), (0.9, 0.1, 0.3, -0.2), (-2, 0, 0), (0.3, 0.2, -0.4))
    for eps in (1e-4, 1e-8, 1e-12):
        times = []
        for finder in FINDERS:
            found = bryla.time_of_impact(a, REST, b, moves, 0.9, eps, finder)
            assert found.outcome == "at"
            assert found.closest.upper > 0
            assert found.closest.signed_distance <= eps
            times.append(found.time)
        # the nearest points approach with 2 m/s less what the turning takes, 0.54 rad/s · 0.5 m
        assert max(times) - min(times) <= eps / 1.7


def test_every_way_to_end_has_its_word():
    cube = bryla.Cuboid((0.5, 0.5, 0.5))

    def end(gap, velocity, spin=(0, 0, 0), **more):
        moves = bryla.Motion((0, 0, 1 + gap), UPRIGHT, velocity, spin)
        return bryla.time_of_impact(cube, REST, cube, moves, 1.0, **more).outcome

    assert end(0.5, (0, 0, 1)) == "clear"
    assert end(0.5, (0, 0, -1)) == "at"
    assert end(0.0, (0, 0, -1)) == "already_touching"
    assert end(-0.1, (0, 0, 1)) == "overlap"
    # below what rounding leaves of 1 m: the guaranteed search takes more, bisection has nothing to accept
    assert end(0.4, (0.1, 0, -1), (1, 2, 3), eps=1e-300) == "at"
    assert end(0.4, (0.1, 0, -1), (1, 2, 3), eps=1e-300, finder="bisection") == "stalled"
    # an edge that comes by within ε: it is √½ from the axis, as is the wall but for half an ε
    turns = bryla.Motion((0, 0, 0), UPRIGHT, (0, 0, 0), (0, 0, 1))
    wall = bryla.Motion((1 + math.sqrt(0.5) + 5e-10, 0, 0), UPRIGHT, (0, 0, 0), (0, 0, 0))
    grazes = bryla.time_of_impact(cube, turns, bryla.Cuboid((1, 5, 5)), wall, 1.2, 1e-9)
    assert grazes.outcome == "grazing"


def test_a_motion_is_about_the_point_that_moves_uniformly():
    # the rod's end rests, and its other end comes down on the floor: sin(ω t) = h/l
    rod = bryla.ConvexPolyhedron([(-0.5, 0, 0), (0.5, 0, 0)])
    h, w = 0.3, 2.0
    swings = bryla.Motion((0, 0, h), UPRIGHT, (0, 0, 0), (0, w, 0), center=(-0.5, 0, 0))
    found = bryla.time_of_impact(FLOOR, REST, rod, swings, 1.0)
    assert found.outcome == "at"
    # ε of half a metre over the end's speed ω l cos(ω t), and a few roundings
    assert abs(found.time - math.asin(h) / w) < 1e-12
    assert swings.center.tolist() == [-0.5, 0, 0]
    assert bryla.Motion((0, 0, 0), (2, 0, 0, 0), (0, 0, 0), (0, 0, 0)) == REST


def test_motions_and_impacts_are_shown_compared_and_pickled():
    motion = bryla.Motion((1, 2, 3), (1, 2, 3, 4), (5, 6, 7), (8, 9, 10), (11, 12, 13))
    for again in (pickle.loads(pickle.dumps(motion)), copy.deepcopy(motion)):
        assert again == motion
    # the orientation is divided by its length once more, which rounds
    shown = eval(repr(motion), vars(bryla))
    assert np.allclose(shown.orientation, motion.orientation, rtol=0, atol=np.finfo(float).eps)
    assert motion != REST
    found = bryla.time_of_impact(FLOOR, REST, bryla.Sphere(0.4), falling(2, 1), 3.0)
    assert pickle.loads(pickle.dumps(found)) == found == copy.copy(found)
    assert pickle.loads(pickle.dumps(found.closest)) == found.closest
    assert repr(found).startswith("<Impact at, t = 1.5")


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"t_max": -1.0}, r"time of impact: t_max must be positive and finite, got -1\.0"),
        ({"t_max": math.nan}, "t_max must be positive and finite, got NaN"),
        ({"t_max": math.inf}, "t_max must be positive and finite, got inf"),
        ({"eps": 0.0}, r"eps must be positive and finite, got 0\.0"),
        ({"eps": math.nan}, "eps must be positive and finite, got NaN"),
        ({"finder": "newton"}, 'finder must be one of bisection, secant, guaranteed, got "newton"'),
        ({"motion_b": falling(math.nan, 1)}, "motion_b: position must be finite, got .*NaN"),
        ({"motion_b": falling(1, math.inf)}, "motion_b: velocity must be finite, got .*-inf"),
        ({"motion_b": falling(1, 1, (0, math.nan, 0))}, "motion_b: angular_velocity must be finite"),
        ({"motion_a": bryla.Motion(*[(0, 0, 0), (0, 0, 0, 0), (0, 0, 0), (0, 0, 0)])}, "motion_a: orientation must be"),
        (
            {"motion_a": bryla.Motion(*[(0, 0, 0), UPRIGHT, (0, 0, 0), (0, 0, 0), (0, math.inf, 0)])},
            "motion_a: center must",
        ),
    ],
)
def test_bad_input_is_refused_by_name(more, message):
    given = {"a": FLOOR, "motion_a": REST, "b": bryla.Sphere(0.1), "motion_b": falling(1, 1), "t_max": 2.0}
    for finder in FINDERS:
        with pytest.raises(bryla.Error, match=message):
            bryla.time_of_impact(**({"finder": finder} | given | more))


def test_what_is_no_motion_is_refused():
    with pytest.raises(TypeError):
        bryla.time_of_impact(FLOOR, bryla.Pose(), bryla.Sphere(0.1), falling(1, 1), 2.0)
    with pytest.raises(TypeError, match="3 numbers wanted"):
        bryla.Motion((0, 0), UPRIGHT, (0, 0, 0), (0, 0, 0))


def test_many_motions_agree_with_one_at_a_time():
    rng = np.random.default_rng(3)
    a, b = bryla.Collider(bryla.Cuboid((0.5, 0.3, 0.2))), bryla.Collider(bryla.Cone(0.2, 0.4))
    x, q = rng.normal(size=(3, 20, 3)), rng.normal(size=(3, 20, 4))
    x *= 2 / np.linalg.norm(x, axis=-1, keepdims=True)
    v, w = -3 * x + 0.5 * rng.normal(size=x.shape), rng.normal(size=x.shape)
    center = (0.1, 0, 0.2)
    many = bryla.time_of_impact_many(a, REST, b, (x, q, v, w, center), 1.0)
    assert many["outcome"].shape == many["time"].shape == (3, 20)
    assert many["normal"].shape == (3, 20, 3)
    assert (many["outcome"] == "at").sum() > 30
    for index in np.ndindex(3, 20):
        moves = bryla.Motion(x[index], q[index], v[index], w[index], center)
        one = bryla.time_of_impact(a, REST, b, moves, 1.0)
        # the same search
        assert (many["outcome"][index], many["time"][index]) == (one.outcome, one.time)
        assert (many["iterations"][index], many["queries"][index]) == (one.iterations, one.queries)
        assert many["signed_distance"][index] == one.closest.signed_distance
    # one of each kind, and none at all
    single = bryla.time_of_impact_many(a, REST, b, (x[0, 0], q[0, 0], v[0, 0], w[0, 0]), 1.0)
    assert single["time"].shape == ()
    none = bryla.time_of_impact_many(a, REST, b, (x[:0], q[:0], v[0, 0], w[0, 0]), 1.0)
    assert none["outcome"].shape == (0, 20)
    with pytest.raises(ValueError, match="leading axes"):
        bryla.time_of_impact_many(a, REST, b, (x, q[:2], v, w), 1.0)
    with pytest.raises(ValueError, match="as many motions"):
        bryla.time_of_impact_many(a, (x[0], q[0], v[0], w[0]), b, (x, q, v, w), 1.0)
    with pytest.raises(TypeError, match="a Motion, or a tuple of arrays"):
        bryla.time_of_impact_many(a, REST, b, (x, q), 1.0)
