"""The modules bryla.rotation and bryla.quaternion, against the formulas they are made of."""

import bryla
import numpy as np
import pytest
from bryla import quaternion, rotation

RNG = np.random.default_rng(1)
Q = RNG.normal(size=(4, 5, 4))
Q /= np.linalg.norm(Q, axis=-1, keepdims=True)
# rounding of a dozen operations on numbers of size 1
ROUNDING = 16 * np.finfo(float).eps


def close(a, b, tolerance=ROUNDING):
    assert np.shape(a) == np.shape(b)
    assert np.max(np.abs(a - b)) <= tolerance


def test_elementary_rotations():
    c, s = np.cos(0.3), np.sin(0.3)
    close(rotation.elementary_x(0.3), np.array([[1, 0, 0], [0, c, -s], [0, s, c]]))
    close(rotation.elementary_y(0.3), np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]))
    close(rotation.elementary_z(0.3), np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))
    assert rotation.elementary_z([0.1, 0.2]).shape == (2, 3, 3)


def test_the_cross_matrix_is_the_cross_product():
    w, r = RNG.normal(size=(2, 7, 3))
    close(np.einsum("nij,nj->ni", rotation.cross_matrix(w), r), np.cross(w, r), 64 * ROUNDING)


def test_the_polar_factor_is_the_rotation_nearest():
    r = quaternion.to_matrix(Q[0])
    bent = r + 1e-3 * RNG.normal(size=r.shape)
    u, _, v = np.linalg.svd(bent)
    close(rotation.polar_factor(bent), u @ v)
    assert np.all(rotation.orthogonality_error(rotation.polar_factor(bent)) < ROUNDING)
    assert np.all(rotation.orthogonality_error(bent) > 1e-4)
    assert np.all(np.isnan(rotation.polar_factor(np.diag([1.0, 1, -1]))))


def test_matrix_and_back():
    r = quaternion.to_matrix(Q)
    assert r.shape == (4, 5, 3, 3)
    assert quaternion.angle_between(quaternion.from_matrix(r), Q).max() < ROUNDING


def test_product_conjugate_and_rotation_fit_the_matrices():
    a, b = Q[0], Q[1]
    close(quaternion.to_matrix(quaternion.product(a, b)), quaternion.to_matrix(a) @ quaternion.to_matrix(b))
    close(quaternion.to_matrix(quaternion.conjugate(a)), np.swapaxes(quaternion.to_matrix(a), -1, -2))
    v = np.array([1.0, -2, 3])
    close(quaternion.rotate(a, v), quaternion.to_matrix(a) @ v, 4 * ROUNDING)
    pair = np.stack([v, 2 * v])
    close(quaternion.rotate(a[0], pair), pair @ quaternion.to_matrix(a[0]).T, 8 * ROUNDING)


def test_exp_and_log_undo_each_other():
    # within a half turn
    phi = RNG.uniform(-1.8, 1.8, size=(20, 3))
    close(quaternion.log(quaternion.exp(phi)), phi, 4 * ROUNDING)
    angle, axis = 0.7, np.array([0, 0.6, 0.8])
    close(quaternion.exp(angle * axis), quaternion.from_axis_angle(axis, angle))
    assert quaternion.from_axis_angle(axis, [0.1, 0.2, 0.3]).shape == (3, 4)
    assert quaternion.angle_between(quaternion.exp(angle * axis), (1, 0, 0, 0)) == pytest.approx(angle, rel=ROUNDING)


def test_axes_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="the axes before the last must agree, got \\[4, 5\\] and \\[5\\]"):
        quaternion.product(Q, Q[0])
    with pytest.raises(ValueError, match=r"shape \(\.\.\., 3, 3\) wanted, got \[3\]"):
        quaternion.from_matrix([1, 2, 3])


def test_they_are_modules():
    import bryla.quaternion as module

    assert module is bryla.quaternion
    assert module.__name__ == "bryla.quaternion"
    assert bryla.rotation.__name__ == "bryla.rotation"
