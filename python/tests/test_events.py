"""Events: measures of the motion that meet a value."""

import copy
import pickle
from pathlib import Path

import bryla
import numpy as np
import pytest
from conftest import G

SCENES = Path(__file__).parents[2] / "examples/scenes"
SPEED = 6.0


def throw():
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity(G))
    ball = bryla.Sphere(0.1)
    scene.add(bryla.Body("ball", ball, mass=1, velocity=(1, 0, SPEED), angular_velocity=(1, 2, 3)))
    return scene


def vertical(t, bodies):
    (ball,) = bodies
    return ball.velocity[2]


UP = (0, 0, 1)


@pytest.mark.parametrize("how", [{"tolerance": 1e-9}, {"method": "rk4", "step": 0.01}])
@pytest.mark.parametrize("measure", [vertical, {"velocity": UP}])
def test_events_are_found_at_the_times_of_the_formula(measure, how):
    top = bryla.UserEvent("top", measure, ["ball"])
    land = bryla.UserEvent("land", {"position": UP}, ["ball"], direction="falling", terminal=True)
    run = throw().run((0, 10), events=[top, land], **how)
    assert [(event.kind, event.name, event.passage) for event in run.events] == [
        ("user", "top", "falling"),
        ("user", "land", "falling"),
    ]
    # a parabola is integrated exactly: what is left is rounding of positions, over the speed
    times = np.array([event.time for event in run.events])
    np.testing.assert_allclose(times, [SPEED / 9.81, 2 * SPEED / 9.81], rtol=0, atol=64 * np.finfo(float).eps)
    assert run.ended_by == "land"
    assert run.t[-1] == run.end == times[1]
    assert run.events[1].bodies == ("ball", "ball")
    assert "land falling at t = 1.22" in repr(run.events[1])


def test_a_touch_is_seen_that_signs_at_the_ends_of_steps_do_not_show():
    height = SPEED**2 / (2 * 9.81)
    touch = bryla.UserEvent("touch", lambda t, bodies: bodies[0].position[2] - height, ["ball"])
    (event,) = throw().run((0, 1.1), method="rk4", step=0.3, events=[touch]).events
    assert event.passage == "touching"
    np.testing.assert_allclose(event.time, SPEED / 9.81, atol=1e-7)


def test_what_a_function_raises_is_the_cause():
    def fails(t, bodies):
        if t > 0.5:
            raise RuntimeError("no more")
        return 1.0

    with pytest.raises(bryla.SimulationError, match="event broken: RuntimeError: no more") as caught:
        throw().run((0, 1), method="rk4", step=0.1, events=[bryla.UserEvent("broken", fails, ["ball"])])
    assert isinstance(caught.value.__cause__, RuntimeError)
    assert caught.value.trajectory.end == pytest.approx(0.5)


def test_mistakes_are_told():
    with pytest.raises(TypeError, match="a callable, a name or a dict"):
        bryla.UserEvent("e", "sped", ["ball"])
    with pytest.raises(TypeError, match="a callable, a name or a dict"):
        bryla.UserEvent("e", {"altitude": UP}, ["ball"])
    with pytest.raises(bryla.Error, match='direction must be one of rising, falling, both, got "up"'):
        bryla.UserEvent("e", "speed", ["ball"], direction="up")
    with pytest.raises(bryla.Error, match="there is ball"):
        throw().run((0, 1), events=[bryla.UserEvent("e", "speed", ["bal"])])


@pytest.mark.parametrize(
    "measure",
    ["speed", "angular_speed", "distance", {"position": UP}, {"tilt": {"axis_body": (1, 0, 0), "axis": UP}}],
)
def test_events_that_are_data_are_shown_pickled_and_saved(measure):
    event = bryla.UserEvent("e", measure, ["a", "b"], value=2, direction="rising", terminal=True)
    assert event.measure == measure
    assert (event.bodies, event.value, event.direction, event.terminal) == (["a", "b"], 2.0, "rising", True)
    for again in (pickle.loads(pickle.dumps(event)), copy.deepcopy(event), eval(repr(event), vars(bryla))):
        assert again == event


def test_a_function_is_given_back_but_not_pickled():
    event = bryla.UserEvent("e", vertical, ["ball"])
    assert event.measure is vertical
    with pytest.raises(ValueError, match="cannot be serialized"):
        pickle.dumps(event)
    run = throw().run((0, 1), tolerance=1e-6, events=[event])
    with pytest.raises(bryla.Error, match="event e: a function is code"):
        pickle.dumps(run)


def test_events_of_a_scene_file():
    scene = bryla.load(SCENES / "thrown_ball.toml")
    run = scene.run()
    assert [event.name for event in run.events] == ["top", "landing"]
    assert run.ended_by == "landing"
    assert run["ball"].position[-1][2] == pytest.approx(0.1095, abs=1e-12)
    again = pickle.loads(pickle.dumps(run))
    assert again.ended_by == "landing"
    assert again.events == run.events
