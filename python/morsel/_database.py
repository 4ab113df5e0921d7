"""Shapes in a file, and those that look alike."""

from __future__ import annotations

import builtins
import os
from dataclasses import dataclass
from types import TracebackType
from typing import Iterable, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _morsel
from ._files import check_sampling, existing
from ._match import Comparable, segmentation, signature_bytes
from ._points import Path, PointsLike, Progress
from ._segment import Segmentation, segment
from ._signature import Signature


class ShapeInfo(NamedTuple):
    """What a person says about a shape."""

    name: str
    class_name: str
    """What it is, such as "chair"; empty: not said."""
    tags: list[str]
    source: str
    """Where the points came from, such as the path of a file; may be empty."""


class LookAlike(NamedTuple):
    """A shape of the database that looks like another."""

    shape: ShapeInfo
    score: float
    """0 to 1."""

    @property
    def name(self) -> str:
        """The shape's name."""
        return self.shape.name


class SimilarityMatrix(NamedTuple):
    """The scores of all pairs."""

    shapes: list[ShapeInfo]
    """The n shapes, by class, then by name."""
    scores: NDArray[np.float64]
    """(n, n) symmetric, ones on the diagonal."""


@dataclass(frozen=True)
class IndexReport:
    """What became of the files."""

    added: int
    replaced: int
    unchanged: int
    without_inside: int
    """Of these, shapes that bound no inside: they are compared by their points alone."""
    failures: list[tuple[str, str]]
    """Files that could not be stored, each with the reason."""


class Database:
    """Shapes under names, in one file or on a server: the same as `morsel index` and `search` use.

    Every change is on disk as a whole when the call returns. Several programs and threads may read
    and write at once.

    Args:
        path: the file, or the address of a PostgreSQL database, postgresql://HOST/NAME.
        mode: "c" to read and write, the file is made if it is not there; "w" to read and write,
            "r" to read one that is there.

    Raises:
        FileNotFoundError: there is no such file, or no such folder.
        morsel.Error: it is no database of morsel, of a newer version, or damaged. So may all
            methods.
        OSError: it cannot be written, another program has kept it locked for a minute, or the server
            cannot be reached.

    >>> with morsel.Database("shapes.db") as database:
    ...     database.add("two balls", shape, class_name="toy")
    ...     database.search(0.5 * points)[0].name
    'added'
    'two balls'
    """

    def __init__(self, path: Path, mode: str = "c") -> None:
        text = os.fspath(path)
        server = text.startswith(("postgresql://", "postgres://"))
        if "://" in text and not server:
            raise ValueError(f"{text}: give the path of a file, or postgresql://HOST/NAME")
        if mode not in ("r", "w", "c"):
            raise ValueError(f"mode is {mode!r}; it must be 'r', 'w' or 'c'")
        if server:
            pass
        elif mode != "c":
            existing(text)
        elif not os.path.exists(text):
            os.stat(os.path.dirname(text) or ".")
        self.path: str = text
        self._file = _morsel.Database(text, mode)

    def close(self) -> None:
        """Closes the file; may be called again."""
        self._file.close()

    def __enter__(self) -> Database:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None,
                 traceback: TracebackType | None) -> None:
        self.close()

    def __len__(self) -> int:
        return self._file.size()

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self._file.find(name) is not None

    def add(self, name: str, shape: Segmentation | PointsLike, *,
            class_name: str | None = None, tags: Iterable[str] | None = None,
            source: str | None = None) -> str:
        """Stores a shape, in place of the one of that name if there is one.

        Args:
            name: 1 to 1024 bytes of UTF-8.
            shape: a segmentation, or points, which are segmented first.
            class_name, tags, source: as in ShapeInfo; what is not given stays as it was.

        Returns:
            "added", "replaced" or "unchanged".

        Raises:
            ValueError: a name that cannot be one, or a flat cloud.
        """
        if not isinstance(shape, Segmentation):
            shape = segment(shape)
        return self._file.put(name, shape._shape, class_name, _list(tags), source)

    def add_files(self, paths: Iterable[Path], *, class_name: str | None = None,
                  tags: Iterable[str] = (), sample: int = 20000, noise: float = 0.0, seed: int = 1,
                  method: str = "default", denoise: int | None = None, ground: str = "auto",
                  threads: int = 0, progress: Progress | None = None) -> IndexReport:
        """Stores files under their paths, several at once, as `morsel index` does.

        A file whose content is stored already is not segmented again. One that fails does not
        stop the others. When cancelled (Ctrl-C), what is stored stays.

        Args:
            paths: files that read_points() reads.
            class_name: of all of them; not given: as it was.
            tags: added to those that they have.
            sample, noise, seed: of meshes, as in read_points().
            method, denoise, ground: as in segment().
            threads: files that are worked on at once; 0: one a core.
            progress: called as progress("index", fraction), the share of the files that are done.
        """
        check_sampling(sample, seed)
        texts = [os.fspath(path) for path in paths]
        files = [(text, os.path.normpath(text)) for text in texts]
        added, replaced, unchanged, without_inside, failures = self._file.put_files(
            files, class_name, list(tags), (sample, noise, seed), (method, denoise, ground, threads),
            progress)
        return IndexReport(added, replaced, unchanged, without_inside,
                           [(os.fspath(path), reason) for path, reason in failures])

    def list(self, class_name: str | None = None,
             tag: str | None = None) -> builtins.list[ShapeInfo]:
        """The shapes, by name; only those of a class or with a tag, if given."""
        return [ShapeInfo(*info) for info in self._file.shapes(class_name, tag)]

    def signature(self, name: str) -> Signature:
        """The signature of a shape. Raises KeyError when there is none of that name."""
        self._require(name)
        return Signature(self._file.signature(name))

    def remove(self, *names: str) -> None:
        """Removes all of these or, with KeyError when one is missing, none."""
        for name in names:
            self._require(name)
        self._file.remove(list(names))

    def rename(self, old: str, new: str) -> None:
        """Raises KeyError when `old` is missing, ValueError when `new` is taken."""
        self._require(old)
        if new != old and new in self:
            raise ValueError(f"{self.path}: there is a shape named {new!r} already")
        self._file.rename(old, new)

    def search(self, query: Comparable, top: int = 10, *, method: str = "default",
               mode: str = "rigid", mirror: bool = True,
               same_scale: bool = False) -> builtins.list[LookAlike]:
        """The shapes most like the query, best first, equal scores by name.

        Args:
            query: a segmentation, a signature, or points, which are segmented first.
            top: how many, at least 1.
            method, mode, mirror, same_scale: as in match(); with mode "partial" the query is a piece.
        """
        if top < 1:
            raise ValueError(f"top is {top}; it must be at least 1")
        if mode == "partial":
            found = self._file.search_partial(segmentation(query)._shape, top, method, mirror,
                                              same_scale)
        else:
            found = self._file.search(signature_bytes(query), top, method, mode, mirror, same_scale)
        return [LookAlike(ShapeInfo(*info), score) for info, score in found]

    def matrix(self, *, method: str = "default", mode: str = "rigid",
               mirror: bool = True, threads: int = 0, progress: Progress | None = None) -> SimilarityMatrix:
        """The scores of all pairs. Arguments as in match() and segment()."""
        shapes, scores = self._file.matrix(method, mode, mirror, threads, progress)
        return SimilarityMatrix([ShapeInfo(*info) for info in shapes], scores)

    def __repr__(self) -> str:
        return f"<morsel.Database: {self.path}>"

    def _require(self, name: str) -> None:
        if name not in self:
            raise KeyError(name)


def _list(values: Iterable[str] | None) -> builtins.list[str] | None:
    return None if values is None else [*values]
