"""Scenes that several tests look at."""

import sys
from pathlib import Path

import bryla
import pytest

# the tests read the script that keeps the stubs; behind the installed package, which must be found first
sys.path.append(str(Path(__file__).parents[1]))

G = (0.0, 0.0, -9.81)


def die_scene() -> bryla.Scene:
    """A die thrown on a table, on which it bounces twice within half a second."""
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity(G))
    floor = bryla.HalfSpace(normal=(0, 0, 1), offset=0.0)
    scene.add(bryla.Body("floor", floor, fixed=True, friction=0.4, restitution=0.5))
    scene.add(
        bryla.Body(
            "die",
            bryla.Cuboid(half_extents=(0.01, 0.01, 0.01)),
            density=1200.0,
            position=(0, 0, 0.5),
            velocity=(1, 0, 0),
            angular_velocity=(20, 30, 10),
            restitution=0.5,
        )
    )
    return scene


def spinning_scene() -> bryla.Scene:
    """A free body that tumbles for ever, so that a run is as long as its span."""
    scene = bryla.Scene()
    scene.add(bryla.Body("book", bryla.Cuboid((0.1, 0.07, 0.015)), density=600, angular_velocity=(0.1, 6, 0.1)))
    return scene


@pytest.fixture
def die() -> bryla.Scene:
    return die_scene()


@pytest.fixture(scope="session")
def run() -> bryla.Trajectory:
    return die_scene().run((0.0, 0.5), tolerance=1e-7)
