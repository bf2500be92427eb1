"""Many free bodies at once."""

import bryla
import numpy as np
import pytest

INERTIA = np.diag([0.8, 1.5, 2.1])
SPIN = np.random.default_rng(3).normal(size=(50, 3))


def test_a_body_in_a_batch_has_the_bits_it_has_alone():
    batch = bryla.Batch(2.0, INERTIA, velocity=(0.3, 0.0, -0.1), angular_velocity=SPIN)
    batch.advance(0.01, 100)
    for index in (0, 17, 49):
        scene = bryla.Scene()
        body = bryla.Body("b", mass=2, inertia=INERTIA, velocity=(0.3, 0, -0.1), angular_velocity=SPIN[index])
        scene.add(body)
        simulation = scene.compile(method="rk4", step=0.01).start()
        # a hair less than 100 steps, of which the last then ends where the batch does
        simulation.advance(0.995)
        simulation.advance(simulation.time + 0.005)
        alone = simulation.state("b")
        np.testing.assert_array_equal(batch.position[index], alone.position)
        np.testing.assert_array_equal(batch.orientation[index], alone.orientation)
        np.testing.assert_array_equal(batch.angular_velocity[index], alone.angular_velocity)


def test_threads_and_pieces_change_no_bits():
    def after(threads, pieces):
        batch = bryla.Batch(1.0, INERTIA, angular_velocity=SPIN)
        for _ in range(pieces):
            batch.advance(0.01, 60 // pieces, threads=threads)
        return batch.orientation

    np.testing.assert_array_equal(after(1, 1), after(3, 4))


def test_arrays_fit_or_are_refused():
    batch = bryla.Batch(np.ones(50), np.tile(INERTIA, (50, 1, 1)), angular_velocity=SPIN)
    assert len(batch) == 50
    assert batch.position.shape == (50, 3)
    assert batch.orientation.shape == (50, 4)
    energy = batch.kinetic_energy
    np.testing.assert_allclose(energy, 0.5 * np.einsum("ni,ij,nj->n", SPIN, INERTIA, SPIN), rtol=1e-14)
    assert repr(batch) == "<bryla.Batch: 50 bodies>"
    with pytest.raises(ValueError, match="velocity: one item or one for each of 50 bodies wanted, got 7"):
        bryla.Batch(1.0, INERTIA, velocity=np.zeros((7, 3)), angular_velocity=SPIN)
    with pytest.raises(ValueError, match=r"inertia: .*shape \(..., 3, 3\) wanted"):
        bryla.Batch(1.0, np.ones(3))
    with pytest.raises(bryla.Error, match="body 0: mass must be"):
        bryla.Batch(-1.0, INERTIA)
