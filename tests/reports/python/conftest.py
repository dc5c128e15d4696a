"""Meshes and steps that several tests use."""

import numpy as np
import pytest

TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], np.int32)


class Step:
    def __init__(self, triangles, x_t0, x_t1):
        self.triangles, self.x_t0, self.x_t1 = triangles, x_t0, x_t1


def tetrahedra(count, seed=1):
    """Returns tetrahedra at random places that move at random, so that many of them meet."""
    random = np.random.default_rng(seed)
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    places = random.uniform(0, count ** (1 / 3) * 3, (count, 1, 3))
    x_t0 = (corners + places).reshape(-1, 3)
    x_t1 = x_t0 + np.repeat(random.uniform(-2, 2, (count, 3)), 4, axis=0)
    triangles = np.concatenate([TETRAHEDRON + 4 * k for k in range(count)])
    return Step(triangles.astype(np.int32), x_t0, x_t1)


@pytest.fixture
def pair():
    """Returns a step in which a tetrahedron flies into a resting one."""
    x_t0 = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    x_t0 = np.vstack([x_t0, x_t0 + 2])
    x_t1 = x_t0.copy()
    x_t1[4:] -= 1.9
    return Step(np.concatenate([TETRAHEDRON, TETRAHEDRON + 4]), x_t0, x_t1)


@pytest.fixture
def cloud():
    return tetrahedra(40)


@pytest.fixture
def long_step():
    """Returns a step that, with culling "none", takes long enough for other threads to act meanwhile."""
    return tetrahedra(1500)


@pytest.fixture
def endless_step():
    """Returns a step that, with culling "none", does not end before it is stopped."""
    return tetrahedra(50000)
