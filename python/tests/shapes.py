"""Point clouds with known parts, from fixed seeds."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]


def ball(count: int, seed: int = 1) -> Points:
    """Points on the unit sphere."""
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def dumbbell(count: int = 4000, seed: int = 1) -> Points:
    """Surface of two overlapping unit balls around (-0.85, 0, 0) and (0.85, 0, 0)."""
    points = ball(2 * count, seed)
    side = np.where(np.arange(2 * count) % 2 == 0, -0.85, 0.85)
    points[:, 0] += side
    other = points + np.outer(side, [1, 0, 0])
    return points[np.linalg.norm(other, axis=1) >= 1][:count].copy()


def torus(count: int, seed: int = 1) -> Points:
    """Around the z axis, radii 1 and 0.4."""
    u, v = np.random.default_rng(seed).uniform(0, 2 * np.pi, size=(2, count))
    r = 1 + 0.4 * np.cos(v)
    return np.column_stack([r * np.cos(u), r * np.sin(u), 0.4 * np.sin(v)])


def snowman(count: int = 6000, seed: int = 1) -> Points:
    """Three balls of radii 1, 0.7 and 0.5 on one another along z."""
    centers = np.array([[0, 0, 0], [0, 0, 1.4], [0, 0, 2.35]])
    radii = np.array([1, 0.7, 0.5])
    which = np.random.default_rng(seed).choice(3, 2 * count, p=radii**2 / np.sum(radii**2))
    points = centers[which] + radii[which, None] * ball(2 * count, seed)
    distances = np.linalg.norm(points[:, None] - centers, axis=2)
    outside = np.all(distances >= radii - 1e-9, axis=1)
    return points[outside][:count].copy()
