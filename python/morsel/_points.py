"""Points from whatever carries them."""

from __future__ import annotations

import os
from typing import Any, Callable, Protocol

import numpy as np
from numpy.typing import NDArray

Path = str | os.PathLike[str]
Progress = Callable[[str, float], object]


class HasPoints(Protocol):
    """As open3d.geometry.PointCloud and pyvista.PolyData."""

    @property
    def points(self) -> Any: ...


class HasVertices(Protocol):
    """As trimesh.PointCloud; of a mesh, its corners are taken."""

    @property
    def vertices(self) -> Any: ...


PointsLike = NDArray[np.float32] | NDArray[np.float64] | HasPoints | HasVertices


def as_points(source: object) -> object:
    """The array of `source`: itself, its `.points` or `.vertices`, or what NumPy makes of it.

    Whether it is (n, 3) of float32 or float64 is looked at later.
    """
    if isinstance(source, np.ma.MaskedArray):
        raise ValueError("points: got a masked array; leave the masked points out first")
    if isinstance(source, np.ndarray):
        return source
    for name in ("points", "vertices"):
        inner = getattr(source, name, None)
        if inner is not None and not callable(inner):
            return inner if isinstance(inner, np.ndarray) else np.asarray(inner)
    return np.asarray(source) if hasattr(source, "__array__") else source
