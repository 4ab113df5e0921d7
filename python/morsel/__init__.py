"""Parts of solid shapes from noisy point clouds, and shapes that look alike.

    >>> import morsel
    >>> shape = morsel.segment(points)          # points: (n, 3), any unit
    >>> shape                                   # in Jupyter: the parts in 3D
    <morsel.Segmentation: 4000 points, 2 parts>
    >>> shape.labels[:3]                        # part of each point
    array([0, 1, 0], dtype=int32)

Everything here is the same library as the program `morsel` and gives the same results.
Lengths are in the unit of the points, volumes in its cube.
"""

from ._database import Database, IndexReport, LookAlike, ShapeInfo, SimilarityMatrix
from ._files import read_points, write_points
from ._match import Correspondence, Match, match
from ._morsel import Error
from ._morsel import version as _version
from ._parts import Level, Neighbour, Part
from ._segment import Segmentation, segment
from ._signature import Signature, SignaturePart

__version__: str = _version()
__all__ = [
    "Correspondence", "Database", "Error", "IndexReport", "Level", "LookAlike", "Match", "Neighbour",
    "Part", "Segmentation", "ShapeInfo", "Signature", "SignaturePart", "SimilarityMatrix", "match",
    "read_points", "segment", "write_points",
]

# Where users find them, whatever file they are written in.
for _name in __all__:
    globals()[_name].__module__ = __name__
