"""Effects that are Python functions."""

import copy
import pickle

import bryla
import numpy as np
import pytest
from conftest import G, spinning_scene


def gravity(t, bodies):
    (body,) = bodies
    return body.mass * np.array(G), (0, 0, 0)


def potential(t, bodies):
    return -sum(body.mass * np.dot(G, body.position) for body in bodies)


def ball_scene(*effects):
    scene = bryla.Scene()
    for name, x in [("a", 0.0), ("b", 1.0)]:
        ball = bryla.Sphere(0.1)
        body = bryla.Body(
            name, ball, density=1, position=(x, 0, 0), velocity=(0, 1, 2), angular_velocity=(1, 2, 3), collides=False
        )
        scene.add(body)
    for effect in effects:
        scene.add_effect(effect)
    return scene


OPTIONS = {"method": "rk4", "step": 1e-2, "estimate": False}


def test_gravity_in_python_is_gravity():
    run = ball_scene(bryla.UserEffect(gravity, energy=potential)).run((0, 1), **OPTIONS)
    built_in = ball_scene(bryla.UniformGravity(G)).run((0, 1), **OPTIONS)
    # the same products and sums in another order, 100 steps long
    np.testing.assert_allclose(run.position, built_in.position, rtol=0, atol=1e-14)
    np.testing.assert_allclose(run.energy.potential, built_in.energy.potential, rtol=0, atol=1e-14)
    np.testing.assert_allclose(run.energy.balance, run.energy.balance[0], rtol=0, atol=1e-13)


def test_without_an_energy_it_works():
    energy = ball_scene(bryla.UserEffect(gravity)).run((0, 1), **OPTIONS).energy
    assert not energy.potential.any()
    assert np.abs(energy.work).max() > 0.01
    assert energy.drift < 1e-13


def test_it_acts_on_the_bodies_named():
    run = ball_scene(bryla.UserEffect(gravity, bodies=["b"])).run((0, 1), **OPTIONS)
    np.testing.assert_allclose(run["a"].position[-1], (0, 1, 2), rtol=1e-14)
    np.testing.assert_allclose(run["b"].position[-1], (1, 1, 2 - 0.5 * 9.81), rtol=1e-13)


def test_coupled_bodies_come_together_and_get_one_pair_each():
    seen = set()

    def spring(t, bodies):
        a, b = bodies
        seen.add(type(bodies).__name__)
        force = 5.0 * (b.position - a.position)
        return [(force, np.zeros(3)), (-force, np.zeros(3))]

    run = ball_scene(bryla.UserEffect(spring, couples=["a", "b"])).run((0, 1), **OPTIONS)
    built_in = ball_scene(bryla.Spring("a", "b", stiffness=5)).run((0, 1), **OPTIONS)
    np.testing.assert_allclose(run.position, built_in.position, rtol=0, atol=1e-14)
    assert seen == {"tuple"}


def once(error, after):
    """A function that does nothing but raise one exception, at its first call after a time."""
    raised = []

    def function(t, bodies):
        if t > after and not raised:
            raised.append(t)
            raise error
        return (0, 0, 0), (0, 0, 0)

    return bryla.UserEffect(function, bodies=["a"]), raised


def test_under_a_tolerance_a_step_that_it_breaks_is_tried_again():
    effect, raised = once(ValueError("too far"), 0.5)
    run = ball_scene(effect).run((0, 1), tolerance=1e-6)
    assert raised
    assert run.report.met
    # both keep 1e-6 of a path below 3 m
    np.testing.assert_allclose(run.position, ball_scene().run((0, 1), tolerance=1e-6).position, rtol=0, atol=6e-6)


def test_what_ends_the_program_is_not_tried_again():
    effect, raised = once(KeyboardInterrupt(), 0.5)
    with pytest.raises(KeyboardInterrupt) as caught:
        ball_scene(effect).run((0, 1), tolerance=1e-6)
    assert isinstance(caught.value.__cause__, bryla.SimulationError)
    assert raised


@pytest.mark.parametrize("options", [OPTIONS, {"tolerance": 1e-6}, {"method": "rk4", "step": 1e-2}])
def test_what_it_raises_is_the_cause(options):
    calls = []

    def fails(t, bodies):
        calls.append(t)
        if t > 0.5:
            raise ZeroDivisionError("no way on")
        return (0, 0, 0), (0, 0, 0)

    with pytest.raises(bryla.SimulationError, match="a user effect failed: ZeroDivisionError: no way on") as caught:
        ball_scene(bryla.UserEffect(fails, bodies=["a"])).run((0, 1), **options)
    error = caught.value
    assert isinstance(error.__cause__, ZeroDivisionError)
    assert error.__cause__.__traceback__ is not None
    assert error.bodies == ["a"]
    assert 0.3 < error.time <= 0.52
    assert error.trajectory.end == error.time
    # a step that breaks is tried twice more, shorter; no finer run is tried
    assert sum(t > 0.5 for t in calls) <= 4


def test_what_ends_the_program_is_not_wrapped():
    def interrupted(t, bodies):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as caught:
        ball_scene(bryla.UserEffect(interrupted)).run((0, 1))
    assert isinstance(caught.value.__cause__, bryla.SimulationError)


@pytest.mark.parametrize(
    "returned", [None, 1, (1, 2, 3), ((1, 2, 3),), ((1, 2, 3), (1, 2)), [((0, 0, 0), (0, 0, 0))], "ab"]
)
def test_what_is_no_pair_is_refused(returned):
    with pytest.raises(bryla.SimulationError, match=r"a pair \(force, torque\) of 3 numbers each wanted") as caught:
        ball_scene(bryla.UserEffect(lambda t, bodies: returned)).run((0, 1), **OPTIONS)
    assert isinstance(caught.value.__cause__, TypeError)


def test_too_few_pairs_are_refused():
    effect = bryla.UserEffect(lambda t, bodies: [((0, 0, 0), (0, 0, 0))], couples=["a", "b"])
    with pytest.raises(bryla.SimulationError, match="2 wanted, got 1"):
        ball_scene(effect).run((0, 1), **OPTIONS)


def test_a_simulation_raises_too():
    def fails(t, bodies):
        raise LookupError("gone")

    simulation = ball_scene(bryla.UserEffect(fails)).compile(method="heun", step=1e-2).start()
    with pytest.raises(bryla.SimulationError) as caught:
        simulation.advance(1.0)
    assert isinstance(caught.value.__cause__, LookupError)


def test_an_energy_that_raises_raises():
    def fails(t, bodies):
        raise LookupError("gone")

    run = ball_scene(bryla.UserEffect(gravity, energy=fails)).run((0, 0.1), **OPTIONS)
    with pytest.raises(LookupError, match="gone"):
        _ = run.energy


def test_a_simulation_asked_from_within_says_that_it_is_at_work():
    asked = []

    def asks(t, bodies):
        try:
            asked.append(simulation.time)
        except RuntimeError as error:
            asked.append(str(error))
        return (0, 0, 0), (0, 0, 0)

    simulation = ball_scene(bryla.UserEffect(asks)).compile(method="heun", step=1e-2).start()
    simulation.advance(0.1)
    assert set(asked) == {"the simulation is being advanced; ask it when that has ended"}


def test_it_shows_what_it_was_made_of():
    effect = bryla.UserEffect(gravity, couples=["a", "b"], energy=potential)
    assert (effect.function, effect.couples, effect.bodies, effect.energy) == (gravity, ["a", "b"], None, potential)
    assert effect == bryla.UserEffect(gravity, ("a", "b"), None, potential)
    assert effect != bryla.UserEffect(gravity, ("a", "b"))
    assert effect != bryla.UserEffect(gravity, bodies=("a", "b"), energy=potential)
    scene = ball_scene(effect)
    assert scene.effects == [effect]
    assert scene.effects[0].function is gravity
    assert "user_effect" in scene.explain()


def test_it_is_code_and_cannot_be_written(tmp_path):
    effect = bryla.UserEffect(gravity)
    scene = ball_scene(effect)
    run = scene.run((0, 0.1), **OPTIONS)
    simulation = scene.compile(method="heun", step=1e-2).start()
    for refused in [
        lambda: pickle.dumps(effect),
        lambda: pickle.dumps(scene),
        lambda: copy.deepcopy(scene),
        lambda: pickle.dumps(scene.compile()),
        lambda: pickle.dumps(run),
        lambda: pickle.dumps(run["a"]),
        lambda: scene.save(tmp_path / "scene.toml"),
        lambda: simulation.save(tmp_path / "at.bryla"),
    ]:
        with pytest.raises(bryla.Error, match="a user effect is code and cannot be"):
            refused()
    assert spinning_scene() == copy.deepcopy(spinning_scene())


def test_couples_and_bodies_exclude_each_other():
    effect = bryla.UserEffect(gravity, couples=["a"], bodies=["b"])
    with pytest.raises(bryla.Error, match="couples and bodies exclude each other"):
        ball_scene(effect).compile()
