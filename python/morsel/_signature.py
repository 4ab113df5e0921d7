"""What is kept of a shape to find its like."""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import _morsel
from ._parts import Neighbour


@dataclass(frozen=True, eq=False)
class SignaturePart:
    """A part as a signature keeps it. Lengths are in RMS radii of the shape (Signature.size)."""

    weight: float
    """Share of the shape's volume, 0 to 1."""
    center: NDArray[np.float64]
    """(3,) representative point, relative to the shape's centroid."""
    covariance: NDArray[np.float64]
    """(3, 3) of the volume."""
    radius: float
    """Of the largest ball inside."""
    neighbours: tuple[Neighbour, ...]
    """Parts that touch it, ascending."""


class Signature:
    """At most one kilobyte that tells shapes apart, whatever their pose, size and sampling.

    A value: it can be compared with ==, be the key of a dict, pickled and stored.

    >>> signature = shape.signature
    >>> morsel.Signature.from_bytes(signature.to_bytes()) == signature
    True
    >>> [round(part.weight, 1) for part in signature.parts]
    [0.5, 0.5]
    """

    size: float
    """RMS radius about the centroid, in the unit of the points; 0: nothing to compare."""
    centroid: NDArray[np.float64]
    """(3,) of the volume, in the unit of the points."""
    parts: tuple[SignaturePart, ...]
    """The heaviest, at most 12; the number of a part is that of the segmentation."""
    tables: NDArray[np.uint8]
    """Statistics that no rotation, mirroring or scaling changes; docs/signature.md."""

    def __init__(self, data: bytes) -> None:
        self._bytes = bytes(data)
        values = json.loads(_morsel.signature_to_json(self._bytes))
        self.size = values["size"]
        self.centroid = np.array(values["centroid"])
        self.parts = tuple(map(_part, values["parts"]))
        self.tables = np.array(values["tables"], np.uint8)

    @classmethod
    def from_bytes(cls, data: bytes) -> Signature:
        """Reads what to_bytes() gave; raises ValueError that says what is wrong with the bytes."""
        return cls(data)

    @classmethod
    def from_json(cls, text: str) -> Signature:
        """Reads what to_json() gave; raises ValueError that names the field."""
        return cls(_morsel.signature_from_json(text))

    def to_bytes(self) -> bytes:
        """At most 1024 bytes, with version and checksum; the same on every machine."""
        return self._bytes

    def to_json(self) -> str:
        """The same content as text; docs/signature.md."""
        return _morsel.signature_to_json(self._bytes)

    def __reduce__(self) -> tuple[type[Signature], tuple[bytes]]:
        return Signature, (self._bytes,)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Signature) and self._bytes == other._bytes

    def __hash__(self) -> int:
        return hash(self._bytes)

    def __repr__(self) -> str:
        return f"<morsel.Signature: {len(self.parts)} parts, {len(self._bytes)} bytes>"


def _part(values: dict) -> SignaturePart:  # type: ignore[type-arg]
    xx, xy, xz, yy, yz, zz = values["covariance"]
    return SignaturePart(
        values["weight"], np.array(values["representative_point"]),
        np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), values["ball_radius"],
        tuple(Neighbour(n["part"], n["neck_radius"]) for n in values["neighbors"]))
