"""The smallest program that uses an installed Python package: a ball's points, its part and its like.

Usage: consumer.py FOLDER    where the package must be
"""

import importlib.metadata
import pathlib
import sys
import tempfile

import numpy as np

import morsel

assert morsel.__file__.startswith(sys.argv[1]), morsel.__file__
assert importlib.metadata.version("morsel") == morsel.__version__
directions = np.random.default_rng(1).normal(size=(2000, 3))
ball = directions / np.linalg.norm(directions, axis=1, keepdims=True)
shape = morsel.segment(ball)
assert len(shape.parts) == 1 and len(shape.labels) == len(ball)
with tempfile.TemporaryDirectory() as folder:
    np.savetxt(pathlib.Path(folder, "ball.xyz"), ball)
    with morsel.Database(pathlib.Path(folder, "shapes.db")) as database:
        database.add_files([pathlib.Path(folder, "ball.xyz")])
        assert [hit.name for hit in database.search(shape, top=1)] == [database.list()[0].name]
print(f"consumer: morsel {morsel.__version__} for Python: {shape.message}")
