"""From points to parts."""

from __future__ import annotations

import functools
import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _morsel, _view
from ._parts import Level, Neighbour, Part
from ._points import Path, PointsLike, Progress, as_points
from ._signature import Signature


def segment(points: PointsLike, parts: int | None = None, merge_ratio: float | None = None, *,
            method: str = "default", denoise: int | None = None, ground: str = "auto",
            threads: int = 0, progress: Progress | None = None) -> Segmentation:
    """Cuts the cloud of a solid into its parts.

    Args:
        points: array (n, 3) of float32 or float64 in any unit, or an object that has one as its
            `.points` (Open3D, PyVista) or `.vertices` (trimesh). A float64 array in C order is
            used in place and must not be changed while morsel works on it.
        parts: how many parts, at least 1. Not given: the program decides.
        merge_ratio: instead of `parts`: merge parts below this ratio, at least 1; larger is coarser.
        method: "default", or "paper" for the published rules to the letter.
        denoise: rounds of smoothing, 0 to 20. Not given: the noise is measured and the program
            decides. Unless it is 0, 5,500 evenly spread points stand for a larger cloud, more
            where walls are thin. The paper's method has none of both.
        ground: what becomes of a plane that objects stand on: "auto" sets it apart where it is
            unmistakable, "keep" takes it for part of an object, "remove" sets the plane apart that
            bears most points. The paper's method takes the points as they are.
        threads: at most so many; 0: one a core. The result does not depend on it.
        progress: called as progress(stage, fraction) with the name of the stage that begins and
            the share of all work, 0 to 1, that is done; if it raises, the work is cancelled.

    Returns:
        A Segmentation. A cloud that bounds no solid is a result too: `is_solid` is False then and
        `message` says why.

    Raises:
        ValueError: an array or option that cannot be used; the text says what came and what is
            wanted.
        KeyboardInterrupt: Ctrl-C cancels the work.

    Other Python threads go on meanwhile. Needs about 1 kB a point.

    >>> shape = morsel.segment(points)
    >>> shape.message
    '2 parts.'
    >>> morsel.segment(points[:, :2])
    Traceback (most recent call last):
    ...
    ValueError: points: got an array (4000, 2) of float64; wanted is an array (n, 3) of float32 or \
float64
    """
    return Segmentation(_morsel.segment(as_points(points), _count("parts", parts), merge_ratio,
                                        method, denoise, ground, threads, progress))


class Segmentation:
    """The parts of a cloud, one cut of all that it can be cut into. Made by segment() and cut()."""

    def __init__(self, shape: _morsel.Shape) -> None:
        self._shape = shape

    @property
    def labels(self) -> NDArray[np.int32]:
        """(n,) part of each point in the order of the points, read-only; -1 for the ground and unless
        solid.

        >>> shape.labels.shape, shape.labels.min(), shape.labels.max()
        ((4000,), 0, 1)
        """
        return self._shape.labels

    @functools.cached_property
    def parts(self) -> list[Part]:
        """By decreasing volume; part i has the label i. Empty unless solid."""
        return [Part(number, volume, center, covariance, radius, ball_center, count,
                     object, tuple(Neighbour(*n) for n in neighbours))
                for number, (volume, center, covariance, ball_center, radius, count, object,
                     neighbours)
                in enumerate(self._shape.parts)]

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 3) the points, the caller's own array where that could be used in place."""
        return self._shape.points

    @property
    def is_solid(self) -> bool:
        """Whether an inside was found, and so parts."""
        return self._shape.is_solid

    @property
    def message(self) -> str:
        """One sentence: what was found and, unless solid, what to do.

        >>> morsel.segment(np.zeros((10, 3))).message
        'The cloud has 1 distinct points; a solid needs at least four, a good sample thousands.'
        """
        return self._findings[0]

    @property
    def merge_ratio(self) -> float:
        """At which the merge tree was cut."""
        return self._shape.merge_ratio

    @property
    def levels(self) -> list[Level]:
        """All numbers of parts that some merge ratio gives, coarsest first.

        >>> [level.parts for level in shape.levels][:2]
        [1, 2]
        """
        return [Level(*level) for level in self._shape.levels]

    @property
    def signature(self) -> Signature:
        """To compare the shape with others: match(), Database.search()."""
        return Signature(self._findings[2])

    def cut(self, parts: int | None = None,
            merge_ratio: float | None = None) -> Segmentation:
        """The same cloud cut otherwise, at once: the work is not done again.

        Args:
            parts: how many parts, at least 1; as near as the shape can be cut.
            merge_ratio: instead of `parts`: merge parts below this ratio, at least 1.

        >>> shape.cut(parts=1)
        <morsel.Segmentation: 4000 points, 1 part>
        """
        return Segmentation(self._shape.cut(_count("parts", parts), merge_ratio))

    def report(self, source: str = "") -> dict[str, Any]:
        """Everything that was measured, as `morsel segment --report`; docs/report.md.

        Args:
            source: what the report calls the input, such as a file name.

        >>> shape.report()["counts"]["parts"]
        2
        """
        report: dict[str, Any] = json.loads(self._findings[1])
        report["source"] = source
        return report

    def to_html(self, name: str = "") -> str:
        """A page that shows the parts in 3D in any browser, as `morsel segment --html`.

        It holds all it needs, some 0.7 MB and 20 bytes a point, and loads nothing.

        Args:
            name: what the page calls the shape.

        Raises:
            ValueError: the shape is not solid, or morsel was built without Node.js.
        """
        return _view.page(self._shape, self.message, name)

    def write_html(self, path: Path, name: str = "") -> None:
        """Writes that page; the file appears whole or not at all. Raises OSError as well."""
        _view.write_page(self._shape, self.message, path, name)

    def show(self, name: str = "") -> None:
        """Shows that page: below the cell in Jupyter, else in the web browser."""
        _view.show(self.to_html(name))

    def to_plotly(self) -> Any:
        """A plotly Figure of the points, one trace a part, in the colours of the page.

        Raises ImportError where plotly is not installed.
        """
        return _view.figure(self.points, self.labels)

    def _repr_html_(self) -> str | None:
        if not self.is_solid or not _morsel.has_viewer():
            return None
        return _view.frame(self.to_html())

    def __repr__(self) -> str:
        count = len(self.parts)
        found = f"{count} part{'' if count == 1 else 's'}" if self.is_solid else "no solid"
        return f"<morsel.Segmentation: {len(self.labels)} points, {found}>"

    @functools.cached_property
    def _findings(self) -> tuple[str, str, bytes]:
        return self._shape.findings()


def _count(name: str, value: int | None) -> int | None:
    if value is not None and value < 1:
        raise ValueError(f"{name} is {value}; it must be at least 1")
    return value
