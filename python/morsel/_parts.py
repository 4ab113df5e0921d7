"""Parts and how they touch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Neighbour(NamedTuple):
    """A part that touches another."""

    part: int
    """Its number."""
    neck_radius: float
    """Of the largest ball that passes from the one to the other, in the unit of the points."""


@dataclass(frozen=True, eq=False)
class Part:
    """One part of one cut. Parts are numbered by decreasing volume.

    >>> part = shape.parts[0]
    >>> part.number, part.point_count, round(part.volume, 1)
    (0, 1989, 4.1)
    >>> [neighbour.part for neighbour in part.neighbours]
    [1]
    """

    number: int
    """Its label."""
    volume: float
    """In cubed units; the paper's weight."""
    center: NDArray[np.float64]
    """(3,) mean of the volume; the paper's representative point."""
    covariance: NDArray[np.float64]
    """(3, 3) of the volume about the center, in squared units."""
    radius: float
    """Of the largest ball inside: half the thickness."""
    ball_center: NDArray[np.float64]
    """(3,) of that ball."""
    point_count: int
    """Points that carry its label, outliers not counted."""
    object: int
    """The object that it is of: objects do not touch, the one of most volume is 0."""
    neighbours: tuple[Neighbour, ...]
    """Parts that touch it, ascending."""


class Level(NamedTuple):
    """A number of parts that the shape can be cut into, and the merge ratios that give it.

    A number that lasts over a wide range of ratios is the shape's own.
    """

    parts: int
    from_ratio: float
    to_ratio: float
    """Infinite for the coarsest."""
