"""Contact in runs, against closed forms."""

import math
from pathlib import Path

import bryla
import numpy as np
import pytest

SCENES = Path(__file__).parents[2] / "examples/scenes"


def ball(name, radius, mass, **rest):
    return bryla.Body(name, bryla.Sphere(radius), mass=mass, **rest)


def test_two_balls_that_meet_off_centre_turn_about_their_common_centre():
    # V = m1 v/M, I = 2/5 (m1 r1² + m2 r2²) + mu d², Omega = mu d × v/I
    m1, r1, m2, r2, v, b = 0.3, 0.05, 0.5, 0.08, 2.0, 0.1
    scene = bryla.Scene()
    scene.add(ball("thrown", r1, m1, position=(-1, b, 0), velocity=(v, 0, 0), response="stick"))
    scene.add(ball("target", r2, m2))
    run = scene.run((0, 1.5), tolerance=1e-9)
    (event,) = run.events
    assert (event.kind, event.bodies) == ("stick", ("thrown", "target"))

    d = np.array([-np.sqrt((r1 + r2) ** 2 - b**2), b, 0])
    mu = m1 * m2 / (m1 + m2)
    inertia = 0.4 * (m1 * r1**2 + m2 * r2**2) + mu * d @ d
    spin = mu * np.cross(d, (v, 0, 0)) / inertia
    mean = np.array([m1 * v / (m1 + m2), 0, 0])
    np.testing.assert_allclose(event.angular_velocity[1], spin, rtol=0, atol=1e-12 * v / r1)
    np.testing.assert_allclose(event.velocity[1], mean - m1 / (m1 + m2) * np.cross(spin, d), rtol=0, atol=1e-12)
    lost = 0.5 * mu * v**2 - 0.5 * inertia * spin @ spin
    np.testing.assert_allclose(event.energy_lost, lost, rtol=0, atol=1e-12)

    # from there on their distance stays, and so do the momenta
    after = run.t > event.time
    apart = run["target"].position - run["thrown"].position
    np.testing.assert_allclose(np.linalg.norm(apart[after], axis=1), r1 + r2, rtol=0, atol=1e-12)
    momentum = run.linear_momentum.sum(axis=1)
    np.testing.assert_allclose(momentum, np.broadcast_to([m1 * v, 0, 0], momentum.shape), rtol=0, atol=1e-12)
    np.testing.assert_allclose(run["thrown"].angular_velocity[after], run["target"].angular_velocity[after], atol=0)


def test_a_box_is_carried_along_by_a_conveyor_that_starts_to_run():
    # slides with a = mu g up to the belt's speed u, after u/a, and is carried from there on; the belt's work is m u²
    mu, g, u, m = 0.25, 10.0, 1.0, 3.0
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity((0, 0, -g)))
    belt = bryla.Prescribed(velocity=(u, 0, 0), schedule=[(0.2, 1.0)])
    scene.add(bryla.Body("belt", bryla.Cuboid((20, 0.5, 0.1)), position=(0, 0, -0.1), friction=mu, motion=belt))
    scene.add(bryla.Body("box", bryla.Cuboid((0.1, 0.1, 0.1)), mass=m, position=(0, 0, 0.1), friction=mu))
    assert (
        "moved      belt: velocity (1, 0, 0) m/s, angular velocity (0, 0, 0) rad/s, times 1 from t = 0.2 s"
        in scene.explain()
    )
    run = scene.run((0, 1), tolerance=1e-6)
    slide = u / (mu * g)
    np.testing.assert_allclose(run["box"].position[-1], (0.5 * u * slide + u * (0.8 - slide), 0, 0.1), atol=1e-6)
    np.testing.assert_allclose(run["belt"].velocity[-1], (u, 0, 0), atol=0)
    np.testing.assert_allclose(run["belt"].position[-1], (0.8 * u, 0, -0.1), atol=1e-15)
    np.testing.assert_allclose(run.energy.work[-1], m * u**2, atol=1e-6)


def test_a_body_that_hangs_on_a_ceiling_falls_when_it_is_pulled_too_hard():
    # it sticks before t = 0.1; m g + F sin(w (t - 0.1)) = f_max from there on
    m, g, f, w, most = 2.0, 10.0, 30.0, 0.8, 45.0
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity((0, 0, -g)))
    pull = bryla.Wrench("cube", force=(0, 0, -f), angular_frequency=w, phase=-0.1 * w, schedule=[(0.1, 1.0)])
    scene.add_effect(pull)
    ceiling = bryla.HalfSpace(normal=(0, 0, -1), offset=-1.0)
    scene.add(bryla.Body("ceiling", ceiling, fixed=True, breaking_load=(most, None)))
    cube = bryla.Cuboid((0.1, 0.1, 0.1))
    start = {"position": (0.3, 0.2, 0.8), "velocity": (0, 0, 2.0)}
    scene.add(bryla.Body("cube", cube, mass=m, response="stick", breaking_load=(50.0, 9.0), **start))
    assert "cube–ceiling: stick, up to 45 N and 9 N·m; time of contact by guaranteed" in scene.explain()
    run = scene.run((0, 1.8), tolerance=1e-9)
    stick, event = run.events
    assert (stick.kind, event.kind, event.bodies) == ("stick", "break", ("ceiling", "cube"))
    np.testing.assert_allclose(event.time, 0.1 + math.asin((most - m * g) / f) / w, rtol=0, atol=1e-11)
    np.testing.assert_allclose(event.force, (0, 0, most), rtol=0, atol=1e-9)
    np.testing.assert_allclose(event.torque, 0, atol=1e-9)
    np.testing.assert_allclose(event.point, (0.3, 0.2, 1), rtol=0, atol=1e-11)
    assert run["cube"].velocity[-1, 2] < -1


def test_a_breaking_load_is_a_force_and_a_torque():
    body = ball("ball", 0.1, 1.0, breaking_load=(3, math.inf))
    assert body.breaking_load == (3.0, None)
    assert ball("ball", 0.1, 1.0).breaking_load is None
    scene = bryla.Scene()
    with pytest.raises(bryla.Error, match=r"body ball: breaking_load.force must be a number > 0, or left out, got -1"):
        scene.add(ball("ball", 0.1, 1.0, breaking_load=(-1, 2)))
    with pytest.raises(TypeError, match="breaking_load"):
        ball("ball", 0.1, 1.0, breaking_load=3)


def test_a_ball_pushes_a_door_open_and_a_hovercraft_bounces_off_a_wall():
    # j = (1 + e) v/(1/m + d²/I), I = M ((2a)² + (2b)²)/12 + M a² about the hinge
    (a, b, c), mass, m, r, v, d, e = (0.4, 0.02, 1.0), 20.0, 0.5, 0.1, 4.0, 0.7, 0.5
    scene = bryla.Scene()
    hinge = bryla.Axle((-a, 0, 0), (0, 0, 1))
    scene.add(bryla.Body("door", bryla.Cuboid((a, b, c)), mass=mass, position=(a, 0, 0), freedom=hinge))
    scene.add(ball("ball", r, m, position=(d, 1, 0.3), velocity=(0, -v, 0), restitution=e))
    run = scene.run((0, 0.5), tolerance=1e-9)
    (event,) = run.events
    inertia = mass * (a**2 + b**2) / 3 + mass * a**2
    j = (1 + e) * v / (1 / m + d**2 / inertia)
    np.testing.assert_allclose(event.impulse, (0, j, 0), rtol=0, atol=1e-12 * j)
    np.testing.assert_allclose(run["door"].angular_velocity[-1], (0, 0, -j * d / inertia), rtol=0, atol=1e-12)

    # in the plane j = −(1 + e) u/(1/m + (r × n)²/I) at the corner that hits
    arena = bryla.load(SCENES / "hovercraft_walls.toml")
    assert "hovercraft–east: bounce, restitution 0.6, friction 0.2" in arena.explain()
    assert "hovercraft: planar, 6 numbers" in arena.explain()
    run = arena.run((0, 20), tolerance=1e-6)
    assert run.report.met
    assert {event.bodies[0] for event in run.events} > {"east", "north"}
    # what stays in its plane stays there, and the walls take what the balance says
    assert (run["hovercraft"].position[:, 2] == 0.4).all()
    assert run.energy.drift < 1e-4


def test_a_body_of_fewer_freedoms_that_would_stick_is_refused():
    scene = bryla.Scene()
    scene.add(bryla.Body("door", bryla.Cuboid((1, 0.1, 1)), mass=20, freedom=bryla.Axle((-1, 0, 0), (0, 0, 1))))
    scene.add(ball("mud", 0.1, 0.5, position=(0.5, 1, 0), response="stick"))
    with pytest.raises(bryla.Error, match="body door: with freedom axle it cannot stick, as it would to mud"):
        scene.compile()
