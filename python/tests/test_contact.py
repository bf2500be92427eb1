"""Contact in runs, against closed forms."""

import bryla
import numpy as np


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
