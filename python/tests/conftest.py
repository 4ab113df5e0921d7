"""What the tests share; each runs in a folder of its own."""

import pytest

import morsel
import shapes


@pytest.fixture(scope="session")
def points():
    array = shapes.dumbbell()
    array.setflags(write=False)
    return array


@pytest.fixture(scope="session")
def shape(points):
    return morsel.segment(points)


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
