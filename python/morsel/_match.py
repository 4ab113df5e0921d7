"""How alike two shapes are, and how to lay one onto the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _morsel
from ._points import PointsLike
from ._segment import Segmentation, segment
from ._signature import Signature

Comparable = Signature | Segmentation | PointsLike


class Correspondence(NamedTuple):
    """Two parts that lie on each other."""

    target: int
    """Part of the target."""
    source: int
    """Part of the source."""
    contribution: float
    """Share of the overlap of both volumes that the two make up, 0 to 1."""


@dataclass(frozen=True, eq=False)
class Match:
    """How the source lies on the target."""

    score: float
    """0 to 1; 1 for equal signatures. The same when the two are exchanged."""
    target_from_source: NDArray[np.float64]
    """(4, 4) takes points of the source, in its unit, to where they lie on the target, in the
    target's: rotation, with a reflection when `mirrored`, scale and translation."""
    mirrored: bool
    """Whether the source was reflected."""
    correspondences: list[Correspondence]
    """By decreasing contribution; each part at most once."""
    unmatched_target: list[int]
    """Parts of the target without a counterpart, ascending."""
    unmatched_source: list[int]
    """Parts of the source without a counterpart, ascending."""

    def apply(self, points: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """Points (n, 3) of the source as they lie on the target."""
        matrix = self.target_from_source
        return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3], np.float64)


def match(target: Comparable, source: Comparable, *, method: str = "default",
          mode: str = "rigid", mirror: bool = True, same_scale: bool = False) -> Match:
    """Scores two shapes and aligns them.

    Args:
        target, source: segmentations, signatures, or points, which are segmented first.
        method: which score, "default" or the "paper"'s over weighted points.
        mode: what counts as one shape: "rigid", what can be turned onto each other; "articulated",
            also what was bent at its joints; "partial", also a piece of it: the source, of the target.
            Pieces are found by points: no signatures. The paper's method is "rigid" alone.
        mirror: a shape and its mirror image count as the same.
        same_scale: a piece has the target's unit; otherwise its scale is found along.

    >>> half = morsel.segment(0.5 * points)
    >>> found = morsel.match(shape, half)
    >>> round(found.score, 2), len(found.correspondences)
    (1.0, 2)
    >>> bool(np.allclose(found.target_from_source[:3, :3] @ found.target_from_source[:3, :3].T,
    ...                  4 * np.eye(3), atol=0.02))
    True
    """
    if mode == "partial":
        found = _morsel.match_partial(segmentation(target)._shape, segmentation(source)._shape,
                                      method, mirror, same_scale)
    else:
        found = _morsel.match(signature_bytes(target), signature_bytes(source), method, mode, mirror,
                              same_scale)
    score, matrix, mirrored, pairs, unmatched_target, unmatched_source = found
    return Match(score, matrix, mirrored, [Correspondence(*pair) for pair in pairs],
                 unmatched_target, unmatched_source)


def segmentation(shape: Comparable) -> Segmentation:
    if isinstance(shape, Signature):
        raise ValueError("a signature is of a whole shape; the mode 'partial' needs a segmentation or points")
    return shape if isinstance(shape, Segmentation) else segment(shape)


def signature_bytes(shape: Comparable) -> bytes:
    if isinstance(shape, Signature):
        return shape.to_bytes()
    if not isinstance(shape, Segmentation):
        shape = segment(shape)
    return shape.signature.to_bytes()
