"""Runs, their trajectories and what can be asked of them."""

import itertools
import pickle
import subprocess
import sys
import threading
import time

import bryla
import numpy as np
import pytest
from bryla import quaternion
from conftest import G, die_scene, spinning_scene

EPS = np.finfo(float).eps


def test_arrays_have_the_shapes_that_they_promise(run):
    n, bodies = 201, 2
    assert run.names == ["floor", "die"]
    assert (len(run), run.t.shape, run.t[0], run.t[-1], run.end) == (n, (n,), 0.0, 0.5, 0.5)
    for name in [
        "position",
        "velocity",
        "angular_velocity",
        "angular_velocity_body",
        "linear_momentum",
        "spin_angular_momentum",
        "angular_momentum_body",
        "reaction_force",
        "reaction_torque",
    ]:
        whole = getattr(run, name)
        assert (whole.shape, whole.dtype) == ((n, bodies, 3), np.float64)
        np.testing.assert_array_equal(getattr(run["die"], name), whole[:, 1])
        np.testing.assert_array_equal(getattr(run.at(run.t[7]), name), whole[7])
        np.testing.assert_array_equal(getattr(run.at(run.t[7:9])["die"], name), whole[7:9, 1])
    assert run.orientation.shape == (n, bodies, 4)
    assert run["die"].orientation.shape == (n, 4)
    assert run.at(0.1).orientation.shape == (bodies, 4)
    assert run.at(0.1)["die"].orientation.shape == (4,)
    assert run.at([0.1, 0.2]).orientation.shape == (2, bodies, 4)
    assert run.at(0.1).t == 0.1
    np.testing.assert_array_equal(run.at([0.1, 0.2]).t, [0.1, 0.2])
    assert run.at(0.1)["die"].names == ["die"]


def test_quantities_fit_each_other(run):
    die = run["die"]
    m = run.plan.bodies[1].mass_properties()
    r = quaternion.to_matrix(die.orientation)
    rounding = 64 * EPS
    spin = 40 * m.inertia.max()
    np.testing.assert_allclose(die.linear_momentum, m.mass * die.velocity, rtol=rounding)
    np.testing.assert_allclose(
        die.angular_velocity, np.einsum("nij,nj->ni", r, die.angular_velocity_body), atol=rounding * 40
    )
    np.testing.assert_allclose(die.angular_momentum_body, die.angular_velocity_body @ m.inertia, atol=rounding * spin)
    np.testing.assert_allclose(
        die.spin_angular_momentum, np.einsum("nij,nj->ni", r, die.angular_momentum_body), atol=rounding * spin
    )
    total = run.total(about=(1, 0, 0))
    assert total.linear_momentum.shape == total.angular_momentum.shape == (201, 3)
    np.testing.assert_allclose(
        total.angular_momentum,
        die.spin_angular_momentum + np.cross(die.position - (1, 0, 0), die.linear_momentum),
        atol=rounding * 0.1,
    )


def test_a_thrown_body_flies_on_its_parabola(run):
    # until it hits the table, t < 0.31
    t = run.t[run.t < 0.3]
    parabola = np.array([0, 0, 0.5]) + np.outer(t, (1, 0, 0)) + 0.5 * np.outer(t**2, G)
    np.testing.assert_allclose(run["die"].position[: len(t)], parabola, atol=64 * EPS)


def test_energy_is_balanced(run):
    energy = run.energy
    for name in ["kinetic", "potential", "dissipated", "work", "balance"]:
        assert getattr(energy, name).shape == (201,)
    np.testing.assert_allclose(
        energy.balance, energy.kinetic + energy.potential + energy.dissipated - energy.work, rtol=4 * EPS
    )
    assert energy.drift == pytest.approx(np.abs(energy.balance - energy.balance[0]).max())
    assert energy.drift < 1e-12 * energy.kinetic.max()
    lost = sum(event.energy_lost for event in run.events)
    assert energy.dissipated[-1] == pytest.approx(lost, rel=4 * EPS)
    assert lost > 0.01 * energy.kinetic.max()


def test_events_tell_the_bounce(run):
    assert len(run.events) == run.report.impacts == 2
    event = run.events[0]
    assert (event.kind, event.bodies) == ("bounce", ("floor", "die"))
    assert event.features.startswith("face 0, vertex ")
    # the finder takes rounds where the impact lies within a step; here steps of 1 ms, which do not end on it
    located = die_scene().run((0, 0.5), method="rk4", step=1e-3, estimate=False).events[0]
    assert 0 < located.iterations < 60
    np.testing.assert_array_equal(event.normal, (0, 0, 1))
    assert abs(event.point[2]) < 1e-9
    m = run.plan.bodies[1].mass_properties().mass
    before, after = event.velocity
    np.testing.assert_allclose(m * (after - before), event.impulse, atol=64 * EPS * m)
    # the point that touches leaves with e = 0.5 of the speed that it came with
    arm = event.point - run.at(event.time)["die"].position
    before, after = event.velocity + np.cross(event.angular_velocity, arm)
    assert after[2] == pytest.approx(-0.5 * before[2], rel=1e-9)
    assert event.energy_lost > 0


def test_the_report_tells_what_ran(run):
    report = run.report
    assert report.method in bryla.METHODS
    assert report.tolerance == 1e-7
    assert report.met is True
    assert 0 < report.error_estimate <= 1e-7
    assert (report.horizon, report.length_scale > 0.5) == (0.5, True)
    assert report.estimated_by == "against runs with steps twice and four times as long"
    # the closed form takes steps only so that samples are read and contacts looked for, and evaluates nothing
    assert report.method == "exact"
    assert report.counts.evaluations == 0 < report.counts.steps
    assert report.counts.rejected >= 0
    assert report.counts.orientation_drift < 1e-6
    assert report.seconds.run > 0
    assert report.seconds.compile >= 0
    assert report.seconds.estimate > 0
    assert str(report).startswith("Report: ")


def test_a_pose_is_that_of_the_shapes_axes():
    scene = bryla.Scene()
    scene.add(bryla.Body("cone", bryla.Cone(0.1, 0.2), mass=1, origin=(1, 2, 3), velocity=(1, 0, 0)))
    run = scene.run((0, 1), method="rk4", step=0.1)
    pose = run.pose("cone", 0.5)
    np.testing.assert_allclose(pose.position, (1.5, 2, 3), rtol=8 * EPS)
    np.testing.assert_allclose(run.at(0.5)["cone"].position, (1.5, 2, 2.9), rtol=8 * EPS)


@pytest.mark.parametrize("method", bryla.METHODS[1:])
def test_every_method_runs(method, die):
    run = die.run((0, 0.2), method=method, step=1e-3)
    assert (run.report.method, run.report.counts.steps) == (method, 200)
    assert run.report.error_estimate < 0.1


def test_results_read_back_equal_from_a_pickle(run):
    states = [run["die"], run.at(0.1), run.at([0.1, 0.2])["die"]]
    motion = die_scene().compile(method="rk4", step=1e-3).start().state("die")
    table = spinning_scene().compare((0, 0.1), methods=["heun"], steps=[1e-2, 5e-3], repeats=1)
    results = [run, *states, *run.events, run.energy, run.total(), run.report, run.report.counts]
    results += [run.report.seconds, run.plan, motion, table, *table.rows]
    for result in results:
        back = pickle.loads(pickle.dumps(result))
        assert back == result, result
        assert type(back) is type(result)
        assert repr(back) == repr(result)
    back = pickle.loads(pickle.dumps(run))
    np.testing.assert_array_equal(back.at(0.123).orientation, run.at(0.123).orientation)
    assert run != die_scene().run((0, 0.5), tolerance=1e-6)
    assert run["die"] != run["floor"]
    assert run.at(0.1) != run.at(0.2)
    assert run.energy != die_scene().run((0, 0.4), tolerance=1e-7).energy


def test_what_is_not_there_is_refused(run):
    with pytest.raises(bryla.Error, match='names "dice", which is not in the scene; there are floor, die'):
        run["dice"]
    with pytest.raises(bryla.Error, match='names "floor", which is not in the scene; there is die'):
        run["die"]["floor"]
    with pytest.raises(bryla.Error, match=r"trajectory: time must be within 0 to 0\.5, got 0\.6"):
        run.at(0.6)
    with pytest.raises(bryla.Error, match=r"got 0\.7"):
        run.at([0.1, 0.7])
    thin = die_scene().run((0, 0.1), method="heun", step=1e-2, record="samples")
    with pytest.raises(bryla.Error, match="run with record = dense"):
        thin.at(0.0123)
    assert len(die_scene().run((0, 0.1), method="heun", step=1e-2, record="end")) == 2


def test_samples_are_at_the_times_asked_for(die):
    times = np.geomspace(1e-3, 0.3, 7)
    run = die.run((0, 0.3), tolerance=1e-6, t_eval=times)
    np.testing.assert_array_equal(run.t, times)
    with pytest.raises(bryla.Error, match="sorted by rising time"):
        die.run((0, 1), t_eval=[0.2, 0.1])


def test_a_simulation_is_advanced_saved_and_resumed_with_the_same_bits(die, tmp_path):
    plan = die.compile(method="rk4", step=1e-3)
    straight, pieces = plan.start(), plan.start(t=0.0)
    straight.advance(to=0.45)
    for to in [0.1, 0.1, 0.333, 0.34]:
        pieces.advance(to=to)
    assert pieces.time == 0.34
    assert len(pieces.events) == 1
    pieces.save(tmp_path / "at.bryla")
    resumed = bryla.resume(tmp_path / "at.bryla")
    pieces.advance(to=0.45)
    resumed.advance(to=0.45)
    assert straight.state("die") == pieces.state("die") == resumed.state("die")
    assert straight.events == resumed.events
    assert straight.counts.steps == resumed.counts.steps > 450
    run = plan.run((0.0, 0.5))
    np.testing.assert_array_equal(run.at(0.45)["die"].orientation, straight.state("die").orientation)
    with pytest.raises(bryla.Error, match=r"to must be a time not before 0\.45, got 0\.4"):
        straight.advance(0.4)
    with pytest.raises(bryla.Error, match="got inf"):
        straight.advance(float("inf"))
    with pytest.raises(bryla.Error, match='names "dice"'):
        straight.state("dice")


def test_a_motion_tells_its_quantities(die):
    motion = die.compile(method="rk4", step=1e-3).start().state("die")
    np.testing.assert_array_equal(motion.position, (0, 0, 0.5))
    np.testing.assert_array_equal(motion.velocity, (1, 0, 0))
    np.testing.assert_array_equal(motion.orientation, (1, 0, 0, 0))
    np.testing.assert_array_equal(motion.rotation, np.eye(3))
    w = motion.angular_velocity
    np.testing.assert_allclose(w, (20, 30, 10), rtol=8 * EPS)
    np.testing.assert_allclose(motion.angular_velocity_body, w, rtol=8 * EPS)
    np.testing.assert_allclose(motion.angular_momentum, motion.inertia_body @ w, rtol=8 * EPS)
    np.testing.assert_array_equal(motion.linear_momentum, motion.mass * motion.velocity)
    expected = 0.5 * motion.mass + 0.5 * w @ motion.inertia_body @ w
    assert motion.kinetic_energy == pytest.approx(expected, rel=8 * EPS)
    np.testing.assert_array_equal(motion.point((1, 2, 3)), (1, 2, 3.5))
    np.testing.assert_allclose(motion.velocity_at((1, 0, 0.5)), np.add((1, 0, 0), np.cross(w, (1, 0, 0))), rtol=8 * EPS)


def test_a_block_that_falls_flat_rests_where_it_fell():
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity(G))
    scene.add(bryla.Body("floor", bryla.HalfSpace((0, 0, 1), 0), fixed=True))
    scene.add(bryla.Body("block", bryla.Cuboid((0.1, 0.1, 0.1)), density=1, position=(0, 0, 0.2)))
    run = scene.run((0, 1), method="rk4", step=1e-3)
    assert [event.kind for event in run.events] == ["bounce", "rest"]
    # it falls by 0.1 m
    assert run.events[-1].time == pytest.approx(np.sqrt(0.2 / 9.81), abs=1e-9)
    np.testing.assert_array_equal(run["block"].velocity[-1], 0)
    np.testing.assert_allclose(run["block"].position[-1], (0, 0, 0.1), atol=1e-12)


def test_friction_brings_a_box_to_a_stop():
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity((0, 0, -10)))
    scene.add(bryla.Body("floor", bryla.HalfSpace((0, 0, 1), 0), fixed=True, friction=0.3))
    box = bryla.Cuboid((0.1, 0.1, 0.1))
    scene.add(bryla.Body("box", box, mass=1, position=(0, 0, 0.1), velocity=(2, 0, 0), friction=0.3))
    run = scene.run((0, 1), tolerance=1e-9, restitution_law="poisson")
    assert [event.kind for event in run.events] == ["contact", "rest"]
    # v / (mu g) and v**2 / (2 mu g)
    assert run.events[-1].time == pytest.approx(2 / 3, abs=1e-9)
    assert run["box"].position[-1][0] == pytest.approx(2 / 3, abs=1e-9)
    assert run.report.met


def test_a_run_that_breaks_off_keeps_what_it_computed():
    # an egg that spins on an egg, which no formula follows
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity(G))
    egg = bryla.Ellipsoid((0.1, 0.1, 0.15))
    scene.add(bryla.Body("floor", egg, position=(0, 0, -0.15), fixed=True))
    scene.add(bryla.Body("egg", egg, density=1, position=(0, 0, 0.2), angular_velocity=(0, 0, 1)))
    with pytest.raises(bryla.SimulationError, match="LastingContact") as caught:
        scene.run((0, 1), method="rk4", step=1e-3)
    error = caught.value
    assert isinstance(error, RuntimeError)
    assert error.bodies == ["floor", "egg"]
    # it falls by 0.05 m; found to 1e-12 of its size, at 1 m/s
    assert error.time == pytest.approx(np.sqrt(2 * 0.05 / 9.81), abs=1e-12)
    assert error.trajectory.end == error.time
    assert error.trajectory.t[-1] <= error.time
    back = pickle.loads(pickle.dumps(error))
    assert (str(back), back.time, back.trajectory) == (str(error), error.time, error.trajectory)
    simulation = scene.compile(method="rk4", step=1e-3).start()
    with pytest.raises(bryla.SimulationError) as caught:
        simulation.advance(1.0)
    assert caught.value.trajectory is None


def test_impacts_beyond_those_allowed_end_the_run():
    # an elastic ball meets the floor at 0.3, 0.9 and 1.5 s
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity((0, 0, -10)))
    scene.add(bryla.Body("floor", bryla.HalfSpace((0, 0, 1), 0), fixed=True))
    scene.add(bryla.Body("ball", bryla.Sphere(0.1), mass=1, position=(0, 0, 0.55), restitution=1))
    assert len(scene.run((0, 2), tolerance=1e-9, max_impacts=3).events) == 3
    with pytest.raises(bryla.SimulationError, match="max_impacts = 2 of ball are used up") as caught:
        scene.run((0, 2), tolerance=1e-9, max_impacts=2)
    assert caught.value.time == pytest.approx(1.5, abs=1e-9)
    assert caught.value.trajectory.end == caught.value.time
    with pytest.raises(TypeError, match="max_impacts"):
        scene.run((0, 2), max_impacts=-1)


def test_a_tolerance_that_is_not_met_is_a_warning_in_the_callers_line():
    # Euler's method would need 1e9 steps
    scene = spinning_scene()
    with pytest.warns(bryla.AccuracyWarning, match=r"is met up to t = .* s only, of a run to t = 1 s") as caught:
        run = scene.run((0, 1), method="euler", tolerance=1e-9)
    assert caught[0].filename == __file__
    assert run.report.met is False
    assert run.report.horizon < 1
    # as an error, as this suite takes warnings, it ends the call
    with pytest.raises(bryla.AccuracyWarning):
        scene.run((0, 1), method="euler", tolerance=1e-9)


def test_other_threads_go_on_while_a_run_runs():
    scene, count, done = spinning_scene(), [0], threading.Event()

    def other():
        while not done.is_set():
            count[0] += 1
            time.sleep(1e-3)

    thread = threading.Thread(target=other)
    thread.start()
    began = time.perf_counter()
    scene.run((0, 500), method="rk4", step=2e-4, estimate=False, record="end")
    seconds = time.perf_counter() - began
    done.set()
    thread.join()
    assert seconds > 0.1, "too short to tell"
    # with the lock held, the other thread would not run at all
    assert count[0] > 10


INTERRUPTED = """
import os, signal, sys, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs are born deaf to it
sys.path.insert(0, {folder!r})
from conftest import spinning_scene
import bryla
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    {call}
except KeyboardInterrupt as error:
    cause = error.__cause__
    print(type(cause).__name__, cause.trajectory is not None and 0 < cause.trajectory.end < 1e7)
"""


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("spinning_scene().run((0, 1e7), method='rk4', step=1e-3, record='samples')", "SimulationError True"),
        ("spinning_scene().compile(method='rk4', step=1e-3).run((0, 1e7))", "SimulationError True"),
        ("spinning_scene().compare((0, 1e4), methods=['rk4'], steps=[1e-3])", "SimulationError True"),
    ],
)
def test_ctrl_c_stops_a_run(call, expected):
    from pathlib import Path

    program = INTERRUPTED.format(folder=str(Path(__file__).parent), call=call)
    began = time.perf_counter()
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert (result.stdout.strip(), result.returncode) == (expected, 0), result.stderr
    assert time.perf_counter() - began < 30


def test_ctrl_c_stops_a_simulation():
    program = """
import os, signal, sys, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs are born deaf to it
sys.path.insert(0, {folder!r})
from conftest import spinning_scene
simulation = spinning_scene().compile(method="rk4", step=1e-3).start()
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    simulation.advance(1e7)
except KeyboardInterrupt:
    print(0 < simulation.time < 1e7)
"""
    from pathlib import Path

    program = program.format(folder=str(Path(__file__).parent))
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert result.stdout.strip() == "True", result.stderr


def test_progress_is_shown_on_a_terminal_only(monkeypatch, capsys):
    class Terminal:
        text = ""

        def isatty(self):
            return True

        def write(self, text):
            self.text += text

        def flush(self):
            pass

    def long_run():
        spinning_scene().run((0, 1000), method="rk4", step=1e-4, estimate=False, record="end", progress=True)

    long_run()
    assert capsys.readouterr().err == ""
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    long_run()
    assert "\rbryla: pass 1," in terminal.text
    assert terminal.text.split("\r")[-1].strip() == ""


def test_a_comparison_by_tolerance():
    scene = spinning_scene()
    scene.add_effect(bryla.Wrench("book", (0, 0, 0), (1e-4, 0, 0)))
    table = scene.compare((0, 1), methods=["tsit5", "dop853"], steps=[1e-3], tolerances=[1e-6, 1e-9], repeats=1)
    assert [row.tolerance for row in table.rows] == [None, 1e-6, 1e-9] * 2
    # the tolerance is kept, though no estimate says so
    assert all(row.error < row.tolerance for row in table.rows if row.tolerance)
    assert table.rows[2].evaluations > table.rows[1].evaluations
    assert len(table.plot().axes[0].get_lines()) == 4
    with pytest.raises(bryla.Error, match="compare: tolerances must be steps for rk4"):
        scene.compare((0, 1), methods=["rk4"], tolerances=[1e-6])


def test_the_order_of_power_series_and_of_the_discrete_rotation_can_be_asked_for():
    scene = spinning_scene()
    truth = scene.run((0, 1), method="exact").orientation[-1, 0]

    def error(**options) -> float:
        end = scene.run((0, 1), estimate=False, record="end", **options).orientation[-1, 0]
        return quaternion.angle_between(end, truth)

    # a step of 0.04 s turns the book by 0.24 rad: each order takes an order of magnitude
    for method in ["taylor", "dmv"]:
        errors = [error(method=method, order=order, step=0.04) for order in (4, 6, 8, 10)]
        assert all(b < 0.2 * a for a, b in itertools.pairwise(errors)), errors
    assert error(method="taylor", tolerance=1e-10) < 1e-10
    with pytest.raises(bryla.Error, match="an order needs the method taylor or dmv"):
        error(method="rk4", order=4, step=0.04)
    scene.add_effect(bryla.Drag(quadratic=0.1))
    with pytest.raises(bryla.Error, match="taylor: the load of drag on book is no power series"):
        scene.run((0, 1), method="taylor")


def test_a_comparison_tells_order_and_cost():
    table = spinning_scene().compare((0, 1), methods=["euler", "heun"], steps=[1e-2, 5e-3, 2.5e-3], repeats=1)
    assert len(table) == len(table.rows) == 6
    assert [row.method for row in table.rows] == ["euler"] * 3 + ["heun"] * 3
    for method, order in [("euler", 1), ("heun", 2)]:
        errors = [row.error for row in table.rows if row.method == method]
        # towards the order as the step goes to 0
        assert np.log2(errors[1] / errors[2]) == pytest.approx(order, abs=0.2)
    assert all(row.seconds_median >= row.seconds_min > 0 for row in table.rows)
    assert [row.steps for row in table.rows[:3]] == [100, 200, 400]
    assert table.rows[0].evaluations >= 100
    assert table.reference_error < 1e-9
    assert table.reference == "the closed form"
    assert str(table).startswith("Error of the end state against ")
    assert table.to_csv().splitlines()[0].startswith("method,step_s,tolerance,error")
    with pytest.raises(bryla.Error, match="method must be one of"):
        spinning_scene().compare((0, 1), methods=["rk5"])


def test_samples_are_written_to_files(run, tmp_path):
    run.write(tmp_path / "run.npz")
    with np.load(tmp_path / "run.npz") as arrays:
        for name in ["t", "position", "orientation", "velocity", "angular_velocity", "spin_angular_momentum"]:
            np.testing.assert_array_equal(arrays[name], getattr(run, name))
    with pytest.raises(bryla.Error, match=r"run.xyz: a trajectory is written as one of"):
        run.write(tmp_path / "run.xyz")
