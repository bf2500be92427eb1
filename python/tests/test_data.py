"""Plain data: shapes, bodies, effects, freedoms, poses, scenes."""

import inspect
import json
import math
import pickle
import sys
from pathlib import Path

import bryla
import numpy as np
import pytest
from conftest import die_scene

TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])

SHAPES = [
    bryla.Cuboid((0.1, 0.2, 0.3)),
    bryla.Sphere(0.1),
    bryla.Cylinder(0.1, 0.2),
    bryla.Capsule(0.1, 0.2),
    bryla.Cone(0.1, half_height=0.2),
    bryla.Ellipsoid([0.1, 0.2, 0.3]),
    bryla.HalfSpace(np.array([0, 0, 1]), 0.25),
    bryla.Polyhedron(*TETRAHEDRON),
    bryla.Mesh("wrench.stl", 0.001),
    bryla.Compound([bryla.Sphere(0.1), bryla.Piece(bryla.Cuboid((1, 1, 1)), (0, 0, 3), (0.6, 0.8, 0, 0))]),
]
FREEDOMS = [bryla.Planar((0, 0, 2)), bryla.Pivot((0, 0, -0.1)), bryla.Axle((0, 0.5, 0), (1, 0, 0))]
EFFECTS = [
    bryla.UniformGravity((0, 0, -9.81), ["a"]),
    bryla.PointGravity(3.986e14, (0, 0, 1), gradient_torque=False),
    bryla.Drag(0.1, 0.2, 0.3, 0.4, wind=(1, 2, 3), bodies=("a", "b")),
    bryla.Thruster("a", (0, 0, 1), (5, 0, 0), schedule=[(0, 1), (2.5, -0.5)]),
    bryla.Wrench("a", (1, 0, 0), (0, 1, 0), "body", point=(0, 0, 1), angular_frequency=3, phase=0.1),
    bryla.Spring("a", "b", (0, 0, 1), (0, 1, 0), stiffness=100, damping=0.5, rest_length=0.1),
]
BODIES = [
    bryla.Body("plain", bryla.Sphere(0.1), density=1000),
    bryla.Body("given", mass=2, inertia=np.diag([1, 2, 2.5]), position=(1, 2, 3), velocity=(0, 0, 1)),
    bryla.Body(
        "all",
        bryla.Cuboid((1, 2, 3)),
        mass=3,
        inertia=[(1, 0, 0), (0, 1, 0), (0, 0, 1)],
        origin=(1, 2, 3),
        orientation=(0, 1, 0, 0),
        angular_velocity_body=(1, 2, 3),
        friction=0.5,
        restitution=0.25,
        response="stick",
        breaking_load=(2.0, None),
        freedom=bryla.Planar((0, 0, 1)),
        collides=False,
    ),
]
MOVED = bryla.Prescribed(velocity=(1, 0, 0), angular_velocity=(0, 0, 2), center=(0, 1, 0), schedule=[(0, 1), (2, -0.5)])
OTHERS = [
    MOVED,
    bryla.Body("moved", bryla.Sphere(1), motion=MOVED),
    bryla.Piece(bryla.Sphere(0.1), position=(1, 2, 3)),
    bryla.Pose((1, 2, 3), (0.5, 0.5, 0.5, 0.5)),
    bryla.MassProperties(2, (0, 0, 1), np.diag([1, 2, 2.5])),
]
PLAIN = [*SHAPES, *FREEDOMS, *EFFECTS, *BODIES, *OTHERS]


def named(items):
    return pytest.mark.parametrize("item", items, ids=lambda item: type(item).__name__)


@named(PLAIN)
def test_reads_back_equal_from_a_pickle(item):
    assert pickle.loads(pickle.dumps(item)) == item


@named(PLAIN)
def test_is_made_again_by_what_it_prints(item):
    text = repr(item)
    known = {**vars(bryla), "PosixPath": Path, "WindowsPath": Path}
    assert eval(text, known) == item
    assert text.startswith(type(item).__name__ + "(")


@named(PLAIN)
def test_differs_from_every_other(item):
    assert [other is item for other in PLAIN] == [other == item for other in PLAIN]
    assert item != 1


@named(PLAIN)
def test_cannot_be_changed(item):
    field = next(name for name in dir(item) if not name.startswith("_"))
    with pytest.raises(AttributeError):
        setattr(item, field, 1)


def test_every_shape_and_effect_of_the_core_is_here():
    """The JSON Schema of scene files comes from the Rust types: same names, same fields."""
    kinds = json.loads(bryla.schema())["$defs"]
    classes = {"Shape": SHAPES, "AnyEffect": EFFECTS, "Freedom": FREEDOMS}
    for kind, items in classes.items():
        variants = [next(iter(v["properties"])) for v in kinds[kind]["oneOf"] if "properties" in v]
        assert sorted(variants) == sorted(snake(type(item).__name__) for item in items)


@named([*SHAPES, *FREEDOMS, *EFFECTS, *BODIES, bryla.Piece(bryla.Sphere(1))])
def test_takes_the_fields_of_the_core_and_shows_them(item):
    fields = json.loads(bryla.schema())["$defs"][type(item).__name__]["properties"]
    assert list(inspect.signature(type(item)).parameters) == in_order(item, fields)
    for field in fields:
        getattr(item, field)


def in_order(item, fields):
    """The order that the documentation promises: that of the Rust fields."""
    return sorted(fields, key=list(inspect.signature(type(item)).parameters).index)


def snake(name):
    return "".join("_" + c.lower() if c.isupper() else c for c in name).lstrip("_")


def test_options_of_a_run_are_those_of_the_core():
    options = set(json.loads(bryla.schema())["$defs"]["RunOptions"]["properties"])
    run, compile_ = (set(inspect.signature(f).parameters) for f in (bryla.Scene.run, bryla.Scene.compile))
    assert run == options | {"self", "progress"}
    assert compile_ == run - {"t_span", "progress"}


def note(argument):
    """How the argument is told: Python has notes from 3.11 on."""
    return f", while processing '{argument}'" if sys.version_info >= (3, 11) else ""


def test_arguments_may_be_tuples_lists_and_arrays():
    for half_extents in [(1, 2, 3), [1.0, 2, 3], np.array([1, 2, 3]), np.float32([1, 2, 3]), range(1, 4)]:
        assert bryla.Cuboid(half_extents).half_extents == (1.0, 2.0, 3.0)
    vertices, faces = TETRAHEDRON
    assert bryla.Polyhedron(np.array(vertices), np.array(faces)) == bryla.Polyhedron(vertices, faces)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: bryla.Cuboid((1, 2)), "3 numbers wanted, got (1, 2)" + note("half_extents")),
        (lambda: bryla.Cuboid((1, 2, 3, 4)), "3 numbers wanted, got (1, 2, 3, 4)"),
        (lambda: bryla.Cuboid("abc"), "3 numbers wanted, got 'abc'"),
        (lambda: bryla.Cuboid(1.0), "3 numbers wanted, got 1.0"),
        (lambda: bryla.Drag(bodies="die"), "a list wanted, got 'die'" + note("bodies")),
        (lambda: bryla.Body("a", "sphere"), "a shape wanted, got 'sphere'" + note("shape")),
        (lambda: bryla.Body("a", mass=1, inertia=[(1, 0, 0)]), "3 rows of 3 numbers wanted, got 1 rows"),
        (lambda: bryla.Scene().add_effect(bryla.Sphere(1)), "an effect wanted, got Sphere(radius=1.0)"),
        (lambda: bryla.UserEffect(1), "function must be callable, got 1"),
        (lambda: die_scene().run((0, 1), speed=1), "run() got an unexpected keyword argument 'speed'"),
        (lambda: die_scene().compile(progress=True), "compile() got an unexpected keyword argument 'progress'"),
        (lambda: die_scene().compare((0, 1), tolerance=1), "compare() got an unexpected keyword argument 'tolerance'"),
        (lambda: die_scene().run((0, 1), step="x"), "argument 'step': must be real number, not str"),
    ],
)
def test_wrong_types_are_type_errors_that_name_the_argument(make, message):
    with pytest.raises(TypeError) as caught:
        make()
    notes = getattr(caught.value, "__notes__", [])
    assert message in ", ".join([str(caught.value), *notes])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: bryla.Scene().add(bryla.Body("die", bryla.Sphere(-1), density=1)),
            "body die: radius must be positive and finite, got -1.0",
        ),
        (
            lambda: bryla.Scene().add(bryla.Body("die", bryla.Sphere(1))),
            "body die: density or mass must be given",
        ),
        (
            lambda: bryla.Body("die", response="break"),
            'body: response must be one of bounce, stick, got "break"',
        ),
        (
            lambda: bryla.Body("die", freedom="fixed"),
            "body: freedom must be \"free\", Planar, Pivot or Axle, got 'fixed'",
        ),
        (
            lambda: bryla.Wrench("die", frame="shape"),
            'wrench: frame must be one of world, body, got "shape"',
        ),
        (
            lambda: bryla.HalfSpace((0, 0, 1), 0).mass_properties(1),
            "half_space: is infinite and has no mass; its body must be fixed",
        ),
        (lambda: die_scene().add(bryla.Body("die", bryla.Sphere(1), mass=1)), "one that no other body has"),
        (lambda: die_scene().run(), "run: t_span must be given, since the scene names none"),
        (lambda: die_scene().run((1, 0)), "run: t_span must be two finite times"),
        (lambda: die_scene().run((0, 1), step=1e-3), "run: a step needs a method beside it"),
        (lambda: die_scene().run((0, 1), tolerance=1e-9, step=1), "run: tolerance and step exclude each other"),
        (lambda: die_scene().run((0, 1), method="rk5"), "run: method must be one of"),
        (lambda: die_scene().run((0, 1), record="all"), 'run: record must be one of dense, samples, end, got "all"'),
        (lambda: die_scene().run((0, 1), finder="newton"), "run: finder must be one of bisection, secant, guaranteed"),
        (lambda: die_scene().run((0, 1), orientation="angles"), "run: orientation must be one of quaternion, matrix"),
        (lambda: die_scene().run((0, 1), tolerance=1e-20), "what rounding leaves of this scene"),
        (lambda: die_scene().compile().start(), "a simulation that is advanced by hand needs method and step"),
        (lambda: die_scene().save("scene.yaml"), "scene.yaml: a scene file ends in .toml or .json"),
        (lambda: bryla.load("nowhere.toml"), "nowhere.toml: No such file"),
        (lambda: bryla.resume("nowhere.bryla"), "nowhere.bryla: No such file"),
        (lambda: bryla.Scene.from_text("[run]\nstop = 1\n"), "unknown field `stop`"),
        (lambda: bryla.Scene.from_text("", "yaml"), 'scene: format must be one of toml, json, got "yaml"'),
        (lambda: bryla.MassProperties(-1, (0, 0, 0), np.eye(3)), "mass must be positive and finite, got -1.0"),
        (lambda: bryla.Scene().explain(), "scene: there is no body in it"),
    ],
)
def test_bad_input_is_an_error_with_the_message_of_the_core(make, message):
    with pytest.raises(bryla.Error) as caught:
        make()
    assert message in str(caught.value)
    assert isinstance(caught.value, ValueError)
    assert type(caught.value).__module__ == "bryla"


def test_mass_properties_of_a_cuboid():
    # m = 8 ρ a b c, I = m/3 (b² + c², …): textbook; rounding of a few operations
    a, b, c = half = np.array([0.1, 0.2, 0.3])
    found = bryla.Cuboid(half).mass_properties(500.0)
    m = 8 * 500 * a * b * c
    assert found.mass == pytest.approx(m, rel=1e-15)
    expected = m / 3 * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
    np.testing.assert_allclose(found.inertia, np.diag(expected), rtol=1e-15)
    np.testing.assert_allclose(found.principal_moments, np.sort(expected), rtol=1e-15)
    assert found.center_of_mass.shape == (3,)
    assert found.principal_axes.shape == (3, 3)
    np.testing.assert_array_equal(
        found.principal_axes @ np.diag(found.principal_moments) @ found.principal_axes.T, found.inertia
    )
    np.testing.assert_allclose(found.about((1, 0, 0)), found.inertia + m * np.diag([0, 1, 1]), rtol=1e-15)
    np.testing.assert_array_equal(found.moved((1, 2, 3)).center_of_mass, (1, 2, 3))
    half_turned = found.turned((math.sqrt(0.5), 0, 0, math.sqrt(0.5)))
    np.testing.assert_allclose(np.diag(half_turned.inertia), expected[[1, 0, 2]], rtol=1e-14)
    twice = bryla.MassProperties.combined([found, found])
    np.testing.assert_allclose(twice.inertia, 2 * found.inertia, rtol=1e-15)
    assert bryla.Body("c", bryla.Cuboid(half), density=500).mass_properties() == found
    assert bryla.Cuboid(half).bounding_radius() == pytest.approx(np.linalg.norm(half), rel=1e-15)


def test_a_pose_takes_points_there_and_back():
    pose = bryla.Pose((1, 2, 3), (0, 0, 0, 2))
    np.testing.assert_array_equal(pose.orientation, (0, 0, 0, 1))
    np.testing.assert_array_equal(pose.position, (1, 2, 3))
    np.testing.assert_array_equal(pose.rotation, np.diag([-1, -1, 1]))
    points = np.arange(24.0).reshape(2, 4, 3)
    there = pose.point(points)
    assert there.shape == (2, 4, 3)
    np.testing.assert_allclose(there, points @ pose.rotation.T + pose.position, rtol=1e-15)
    np.testing.assert_allclose(pose.inverse_point(there), points, rtol=1e-15)
    np.testing.assert_allclose(pose.inverse_vector(pose.vector(points)), points, rtol=1e-15)
    with pytest.raises(ValueError, match=r"shape \(\.\.\., 3\) wanted, got \[2\]"):
        pose.point((1, 2))


def test_a_scene_says_what_it_holds(die):
    assert [body.name for body in die.bodies] == ["floor", "die"]
    assert die.effects == [bryla.UniformGravity((0, 0, -9.81))]
    assert die.add(bryla.Body("ball", bryla.Sphere(0.1), mass=1, collides=False)) == "ball"
    assert "pairs      die–floor: bounce, restitution 0.5" in die.explain()
    assert repr(die) == "<bryla.Scene: 3 bodies, 1 effects>"


def test_a_scene_in_files_and_pickles_is_the_same_scene(die, tmp_path):
    for effect in EFFECTS:
        die.add_effect(effect)
    die.run_options = {"t_span": [0, 0.5], "method": "heun", "step": 1e-3}
    for name in ("scene.toml", "scene.json"):
        die.save(tmp_path / name)
        assert bryla.load(tmp_path / name) == die
        assert bryla.load(str(tmp_path / name)) == die
    for format in ("toml", "json"):
        assert bryla.Scene.from_text(die.to_text(format), format) == die
    assert pickle.loads(pickle.dumps(die)) == die
    other = die_scene()
    assert other != die
    assert other == die_scene()


def test_a_scene_is_run_as_it_says_where_the_call_does_not(die):
    die.run_options = {"t_span": [0.0, 0.25], "method": "heun", "step": 1e-3, "estimate": False}
    assert die.run_options["method"] == "heun"
    run = die.run()
    assert (run.end, run.report.method, run.report.step, run.report.error_estimate) == (0.25, "heun", 1e-3, None)
    assert die.run(method="euler", estimate=True).report.error_estimate is not None
    assert die.run((0, 0.1), step=5e-4).report.step == 5e-4
    # a tolerance takes the place of the step
    assert die.run((0, 0.1), tolerance=1e-3, estimate=True).report.tolerance == 1e-3
    with pytest.raises(bryla.Error, match="unknown field `speed`"):
        die.run_options = {"speed": 1}


def test_a_mesh_runs_as_the_solid_in_its_file(tmp_path):
    vertices, faces = TETRAHEDRON
    lines = ["v {} {} {}".format(*v) for v in vertices] + ["f {} {} {}".format(*(i + 1 for i in f)) for f in faces]
    path = tmp_path / "corner.obj"
    path.write_text("\n".join(lines))

    def thrown(shape):
        scene = bryla.Scene()
        scene.add(bryla.Body("a", shape, density=1, angular_velocity=(1, 2, 3)))
        return scene.run((0, 1), method="rk4", step=1e-2)

    mesh, solid = thrown(bryla.Mesh(path)), thrown(bryla.Polyhedron(*TETRAHEDRON))
    np.testing.assert_array_equal(mesh.orientation, solid.orientation)
    assert mesh.report.length_scale == solid.report.length_scale
    path.unlink()
    assert pickle.loads(pickle.dumps(mesh)) == mesh
