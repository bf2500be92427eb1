"""The package: names, stubs, figures, the command line."""

import ast
import inspect
import subprocess
import sys
import typing
from pathlib import Path

import bryla
import pytest
import stub_docs

PACKAGE = Path(bryla.__file__).parent


def test_the_public_names_are_those_listed():
    public = {name for name in vars(bryla) if not name.startswith("_")}
    assert public | {"__version__"} == set(bryla.__all__)


def test_everything_public_is_documented():
    for name in bryla.__all__:
        item = getattr(bryla, name)
        if name in ("__version__", "METHODS"):
            continue
        assert inspect.getdoc(item), name
        assert item.__module__ == "bryla" if inspect.isclass(item) else True, name
        if inspect.isclass(item):
            for member, value in vars(item).items():
                if not member.startswith("_"):
                    assert isinstance(value, str) or inspect.getdoc(value), f"{name}.{member}"


def test_arrays_tell_their_shapes():
    for cls in (bryla.Trajectory, bryla.States):
        for name in ("position", "orientation", "velocity", "angular_velocity", "reaction_force"):
            doc = inspect.getdoc(getattr(cls, name))
            assert ": array (" in doc
            assert "[" in doc or name == "orientation"


def literals(alias):
    """The strings of an alias in the stubs."""
    tree = ast.parse((PACKAGE / "_bryla.pyi").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.AnnAssign) and node.target.id == alias:
            return [constant.value for constant in ast.walk(node.value) if isinstance(constant, ast.Constant)]
    raise AssertionError(alias)


def test_the_stubs_know_every_method():
    assert tuple(literals("_Method")) == bryla.METHODS


def test_the_stubs_fit_the_module():
    command = [sys.executable, "-m", "mypy.stubtest", "bryla"]
    result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=PACKAGE.parent.parent)
    assert result.returncode == 0, result.stdout + result.stderr


def test_runs_and_comparisons_are_drawn(run):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    figure = run.plot()
    above, middle, below = figure.axes
    assert [line.get_label() for line in above.lines[:3]] == ["die x", "die y", "die z"]
    # every impact is marked, beside three components or the energies
    assert len(above.lines) == len(middle.lines) == 3 + len(run.events)
    assert "balance" in below.get_legend_handles_labels()[1][-1]
    figure.canvas.draw()
    assert run.plot(["floor"], figure=matplotlib.figure.Figure()).axes[0].lines

    scene = bryla.Scene()
    scene.add(bryla.Body("book", bryla.Cuboid((0.1, 0.07, 0.015)), density=600, angular_velocity=(0.1, 6, 0.1)))
    table = scene.compare((0, 0.5), methods=["euler", "rk4"], steps=[1e-2, 5e-3], repeats=1)
    (axes,) = table.plot().axes
    assert [line.get_label() for line in axes.lines[:2]] == ["euler", "rk4"]
    assert axes.get_xscale() == axes.get_yscale() == "log"


def bryla_command(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "bryla", *arguments], capture_output=True, text=True, check=False, **options
    )


def test_the_command_line_runs(die, tmp_path):
    die.run_options = {"t_span": [0, 0.2], "tolerance": 1e-6}
    die.save(tmp_path / "die.toml")
    done = bryla_command("run", "die.toml", "--out", "die.csv", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "die.csv").read_text().count("\n") > 200
    assert bryla_command("schema").stdout.strip() == bryla.schema().strip()
    assert bryla_command("check", "nowhere.toml", cwd=tmp_path).returncode == 2
    assert bryla.__version__ in bryla_command("--version").stdout


def test_the_summary_shows_the_first_events(tmp_path):
    scene = bryla.Scene()
    scene.add(bryla.Body("floor", bryla.HalfSpace((0, 0, 1), 0), fixed=True))
    scene.add(bryla.Body("ball", bryla.Sphere(0.1), density=500, position=(0, 0, 0.5), restitution=0.95))
    scene.add_effect(bryla.UniformGravity((0, 0, -9.81)))
    scene.run_options = {"t_span": [0, 10], "estimate": False}
    scene.save(tmp_path / "ball.toml")
    events = len(scene.run((0, 10), estimate=False).events)
    assert events > 24
    done = bryla_command("run", "ball.toml", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    shown = [line for line in done.stdout.splitlines() if line.startswith("  bounce")]
    assert len(shown) == 24
    assert f"{events - 24} more events: --out to .json keeps all" in done.stdout


def test_the_front_page_example():
    import doctest

    results = doctest.testmod(bryla)
    assert (results.failed, results.attempted > 4) == (0, True)


def test_hints_of_the_exceptions_resolve():
    assert typing.get_type_hints(bryla.SimulationError, vars(bryla))["time"] is float


@pytest.mark.parametrize("name", stub_docs.MODULES)
def test_the_stubs_carry_the_documentation(name):
    tree = ast.parse((PACKAGE / f"{name}.pyi").read_text(encoding="utf-8"))
    module = sys.modules[f"bryla.{name}"]
    for node, doc in stub_docs.documented(tree, module):
        assert ast.get_docstring(node) == doc, f"{node.name}: run python python/stub_docs.py"
