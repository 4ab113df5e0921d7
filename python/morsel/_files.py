"""Points from files and to files."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _morsel
from ._points import Path, PointsLike, as_points


def existing(path: Path) -> str:
    """The path as text; raises FileNotFoundError, IsADirectoryError or PermissionError."""
    text = os.fspath(path)
    with open(text, "rb"):
        return text


def check_sampling(sample: int, seed: int) -> None:
    if not 1 <= sample <= 2**31:
        raise ValueError(f"sample is {sample}; it must be 1 to {2**31}")
    if not 0 <= seed < 2**64:
        raise ValueError(f"seed is {seed}; it must be 0 to {2**64 - 1}")


def read_points(path: Path, sample: int = 20000, noise: float = 0.0,
                seed: int = 1) -> NDArray[np.float64]:
    """Reads the points of a file.

    Args:
        path: PLY, PCD, XYZ/TXT/PTS/CSV, OFF, OBJ, NPY, LAS, STL, glTF or GLB; the content decides.
        sample: a mesh, a file with faces, is sampled with this many points, 1 to 2^31.
        noise: standard deviation of Gaussian noise that is added to samples of a mesh, as a
            fraction of the diagonal of its bounding box, 0 to 1.
        seed: of the random numbers; the same gives the same points on every machine.

    Returns:
        float64 array (n, 3), in the unit and order of the file.

    Raises:
        FileNotFoundError, IsADirectoryError, PermissionError: the file cannot be opened.
        morsel.Error: the text names the line, byte or point, and what would be right.
        ValueError: an option outside its range.

    >>> morsel.write_points("scan.ply", points, shape.labels)
    >>> bool((morsel.read_points("scan.ply") == points).all())
    True
    """
    check_sampling(sample, seed)
    return _morsel.read_points(existing(path), sample, noise, seed)


def write_points(path: Path, points: PointsLike, labels: NDArray[np.integer[Any]]) -> None:
    """Writes points with their parts as a number and a colour; the file appears whole or not at all.

    Args:
        path: a name that ends in .ply, .pcd, .xyz or .npz.
        points: (n, 3), in any unit.
        labels: (n,) part of each point; -1 stands for none.

    Raises:
        ValueError: for another ending, or when the numbers of points and labels differ.
        OSError: the file cannot be written.

    >>> morsel.write_points("parts.ply", points, shape.labels)
    """
    _morsel.write_points(os.fspath(path), as_points(points), labels)
