"""What steps cost, and what runs are predicted to take."""

import bryla
import pytest
from conftest import spinning_scene


def top():
    scene = bryla.Scene()
    scene.add_effect(bryla.UniformGravity((0, 0, -9.81)))
    inertia = [[0.01, 0, 0], [0, 0.013, 0], [0, 0, 0.004]]
    pivot = bryla.Pivot((0, 0, -0.1))
    body = bryla.Body(
        "top", mass=1, inertia=inertia, position=(0, 0, 0.1), angular_velocity=(0, 0.3, 40), freedom=pivot
    )
    scene.add(body)
    scene.run_options = {"t_span": [0, 2], "tolerance": 1e-8}
    return scene


def test_calibration_writes_the_table_that_predictions_use(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    shipped = top().compile().predict()
    path = bryla.calibrate()
    assert path == tmp_path / "bryla" / "costs.toml"
    steps, run, estimate = top().compile().predict()
    assert steps == shipped[0]
    assert run != shipped[1]
    assert estimate == pytest.approx(0.75 * run)
    report = top().run().report
    assert 0.5 < steps / report.counts.steps < 2
    assert "predicted" in top().explain()
    assert bryla.calibrate(tmp_path / "other.toml").exists()

    path.write_text("machine = 3")
    with pytest.raises(bryla.Error, match=r"costs\.toml"):
        top().explain()


def test_no_steps_are_told_and_functions_are_timed():
    assert spinning_scene().compile().predict((0, 1)) == (0.0, 0.0, 0.0)
    scene, calls = top(), []
    scene.add_effect(bryla.UserEffect(lambda t, bodies: calls.append(t) or ((0, 0, 0), (0, 0, 0))))
    steps, run, estimate = scene.compile().predict()
    assert len(calls) >= 16
    assert min(steps, run, estimate) > 0
    assert " steps, " in scene.explain()

    scene.add_effect(bryla.UserEffect(lambda t, bodies: None))
    assert scene.compile().predict() is None
    assert "nothing: a step breaks off" in scene.explain()
