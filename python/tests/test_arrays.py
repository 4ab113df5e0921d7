"""Arrays in and out: what is taken as it is, what is copied, what is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

import morsel


def test_float64_in_c_order_is_used_in_place(points, shape):
    assert shape.points is points


def test_labels_are_a_view_that_cannot_be_written(shape):
    assert shape.labels.dtype == np.int32
    assert np.shares_memory(shape.labels, shape.labels)
    with pytest.raises(ValueError, match="read-only"):
        shape.labels[0] = 1


def test_labels_outlive_the_segmentation(points, shape):
    labels = morsel.segment(points).labels
    assert np.array_equal(labels, shape.labels)


@pytest.mark.parametrize("change", [
    np.asfortranarray,
    lambda points: np.column_stack([points, points])[:, :3],
    lambda points: np.repeat(points, 2, axis=0)[::2],
    lambda points: np.frombuffer(b"x" + points.tobytes(), np.uint8)[1:].view(float).reshape(-1, 3),
    lambda points: points.view(type("Tracked", (np.ndarray,), {})),
], ids=["fortran", "columns", "rows", "unaligned", "subclass"])
def test_any_layout_gives_the_same(points, shape, change):
    changed = change(points)
    assert np.array_equal(changed, points)
    assert np.array_equal(morsel.segment(changed).labels, shape.labels)


@pytest.mark.parametrize("order", ["C", "F"])
def test_float32_is_as_the_same_numbers_in_float64(points, order):
    single = morsel.segment(np.asarray(points, np.float32, order=order))
    double = morsel.segment(points.astype(np.float32).astype(np.float64))
    assert np.array_equal(single.labels, double.labels)
    assert single.signature == double.signature


class Carrier:
    def __init__(self, points):
        self._points = points

    def __array__(self, dtype=None):
        return self._points


@pytest.mark.parametrize("carrier", [
    lambda points: SimpleNamespace(points=points),
    lambda points: SimpleNamespace(points=memoryview(points)),
    lambda points: SimpleNamespace(vertices=points, points=None),
    Carrier,
], ids=["pyvista", "open3d", "trimesh", "array"])
def test_objects_that_carry_points(points, shape, carrier):
    assert np.array_equal(morsel.segment(carrier(points)).labels, shape.labels)


@pytest.mark.parametrize("bad, came", [
    (np.zeros((5, 2)), "got an array (5, 2) of float64"),
    (np.zeros(3), "got an array (3,) of float64"),
    (np.zeros((4, 3, 1)), "got an array (4, 3, 1) of float64"),
    (np.zeros((5, 3), int), "got an array (5, 3) of int64"),
    (np.zeros((5, 3), np.float16), "got an array (5, 3) of float16"),
    (np.zeros((5, 3), complex), "got an array (5, 3) of complex128"),
    (np.zeros((5, 3), ">f8"), "got an array (5, 3) of >f8"),
    ([[0.0, 0.0, 0.0]], "got an object of type list"),
    ("scan.ply", "got an object of type str"),
    (None, "got an object of type NoneType"),
    (SimpleNamespace(points=np.zeros((2, 4))), "got an array (2, 4) of float64"),
])
def test_anything_else_is_refused_with_what_came_and_what_is_wanted(bad, came):
    with pytest.raises(ValueError) as refused:
        morsel.segment(bad)
    assert str(refused.value) == (
        f"points: {came}; wanted is an array (n, 3) of float32 or float64")


@pytest.mark.parametrize("method", ["default", "paper"])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_point_that_is_not_finite_is_named(points, value, method):
    bad = points.copy()
    bad[17, 1] = value
    with pytest.raises(ValueError, match="point 17 is not finite"):
        morsel.segment(bad, method=method)


def test_masked_points_are_refused(points):
    with pytest.raises(ValueError, match="masked"):
        morsel.segment(np.ma.masked_array(points, points > 1))


def test_no_points():
    nothing = morsel.segment(np.zeros((0, 3)))
    assert not nothing.is_solid and nothing.labels.shape == (0,)
