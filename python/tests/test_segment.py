"""Parts, measured again with NumPy and SciPy."""

import math

import numpy as np
import pytest
from scipy.spatial import ConvexHull, Delaunay, cKDTree

import morsel
import shapes


def moments_of_hull(points):
    """Volume, center and covariance of the convex hull: exact sums over its tetrahedra."""
    corners = points[Delaunay(points).simplices]  # (c, 4, 3)
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    volume = volumes.sum()
    center = volumes @ corners.mean(axis=1) / volume
    around = corners - center
    total = around.sum(axis=1)
    second = np.einsum("cki,ckj->cij", around, around) + np.einsum("ci,cj->cij", total, total)
    return volume, center, np.einsum("c,cij->ij", volumes, second) / 20 / volume


def test_a_convex_shape_is_its_hull():
    points = shapes.ball(3000) * [3, 2, 1] + [5, 6, 7]
    (part,) = morsel.segment(points, parts=1, denoise=0).parts
    volume, center, covariance = moments_of_hull(points)
    assert math.isclose(volume, ConvexHull(points).volume, rel_tol=1e-9)
    assert math.isclose(part.volume, volume, rel_tol=1e-3)
    assert np.allclose(part.center, center, atol=2e-3)
    assert np.allclose(part.covariance, covariance, atol=3e-3)
    assert np.array_equal(part.covariance, part.covariance.T)


def test_a_dumbbell_is_cut_at_its_waist(points, shape):
    assert shape.is_solid and len(shape.parts) == 2
    right = points[:, 0] > 0
    right_part = np.bincount(shape.labels[right]).argmax()
    assert np.mean((shape.labels == right_part) == right) > 0.98
    assert shape.parts[right_part].center[0] > 0.7
    ((other, neck),) = shape.parts[0].neighbours
    assert other == 1 and shape.parts[1].neighbours == ((0, neck),)
    assert 0.5 < neck < shape.parts[0].radius


def test_the_largest_balls_are_empty_and_touch_the_points(points):
    tree = cKDTree(points)
    for part in morsel.segment(points, denoise=0).parts:
        distance, _ = tree.query(part.ball_center)
        assert math.isclose(distance, part.radius, rel_tol=1e-6)


def test_the_ground_is_set_apart():
    around = np.random.default_rng(2).uniform(-4, 4, (8000, 3)) * [1, 1, 0] - [0, 0, 0.8]
    around = around[np.hypot(around[:, 0], around[:, 1]) > 0.9]
    ball = shapes.ball(6000)
    points = np.concatenate([ball[ball[:, 2] > -0.8], around])
    shape = morsel.segment(points)
    ground = shape.report()["ground"]
    assert ground["points"] == np.sum(shape.labels == -1) > 0.9 * len(around)
    assert np.allclose(ground["normal"], [0, 0, 1], atol=1e-3)
    assert [part.object for part in shape.parts] == [0] * len(shape.parts)
    volume = sum(part.volume for part in shape.parts)
    assert math.isclose(volume, math.pi * (1.8**2 * 1.2 / 3), rel_tol=0.03)  # a ball without its cap
    assert morsel.segment(points, ground="keep").report()["ground"] is None


def test_three_balls():
    points = shapes.snowman()
    shape = morsel.segment(points, parts=3)
    heights = sorted(part.center[2] for part in shape.parts)
    assert np.allclose(heights, [-0.05, 1.4, 2.4], atol=0.15)
    by_height = np.array([part.center[2] for part in shape.parts])[shape.labels]
    assert np.corrcoef(by_height, points[:, 2])[0, 1] > 0.9


def test_volumes_and_counts_add_up(shape):
    assert math.isclose(sum(part.volume for part in shape.parts), shape.report()["volume"])
    counts = np.bincount(shape.labels)
    assert [part.point_count for part in shape.parts] == counts.tolist()
    assert [part.number for part in shape.parts] == list(range(len(counts)))


def test_labels_follow_their_points(points, shape):
    order = np.random.default_rng(1).permutation(len(points))
    assert np.array_equal(morsel.segment(points[order]).labels, shape.labels[order])


def test_threads_change_nothing(points, shape):
    alone = morsel.segment(points, threads=1)
    assert np.array_equal(alone.labels, shape.labels)
    assert alone.signature == shape.signature


@pytest.mark.parametrize("parts", [1, 2, 3])
def test_cut_again_is_as_cut_at_first(points, shape, parts):
    first, again = morsel.segment(points, parts=parts), shape.cut(parts=parts)
    assert len(again.parts) == parts
    assert np.array_equal(again.labels, first.labels)
    assert again.signature == first.signature
    assert again.message == first.message
    assert {**again.report(), "stages": 0} == {**first.report(), "stages": 0}
    assert again.points is shape.points


def test_levels_are_the_cuts_at_their_ratios(shape):
    for level in shape.levels:
        between = math.sqrt(level.from_ratio * min(level.to_ratio, 100))
        assert len(shape.cut(merge_ratio=between).parts) == level.parts
    assert shape.levels[0].to_ratio == math.inf


def test_the_report(shape):
    report = shape.report("scan.ply")
    assert report["source"] == "scan.ply"
    assert report["morsel"] == morsel.__version__
    assert report["parts"][1]["volume"] == shape.parts[1].volume


def test_the_paper(points):
    shape = morsel.segment(points, method="paper")
    assert shape.report()["options"]["method"] == "paper"


def test_a_flat_cloud_is_a_result():
    flat = morsel.segment(np.random.default_rng(1).random((500, 3)) * [1, 1, 0])
    assert not flat.is_solid and flat.parts == [] and flat.levels == []
    assert "on one plane" in flat.message
    assert set(flat.labels) == {-1}
    assert flat.cut(parts=2).message == flat.message
    assert flat.signature.size == 0 and flat.report()["verdict"] == "flat"
    assert repr(flat) == "<morsel.Segmentation: 500 points, no solid>"


@pytest.mark.parametrize("options, text", [
    ({"parts": 0}, "parts is 0"),
    ({"parts": -1}, "parts is -1"),
    ({"merge_ratio": 0.5}, "merge_ratio"),
    ({"parts": 2, "merge_ratio": 2.0}, "merge_ratio"),
    ({"method": "best"}, "method is 'best'; it must be 'default' or 'paper'"),
    ({"denoise": 21}, "rounds"),
    ({"denoise": 1, "method": "paper"}, "takes the points as they are"),
    ({"ground": "flat"}, "ground is 'flat'; it must be 'auto', 'keep' or 'remove'"),
    ({"ground": "keep", "method": "paper"}, "takes the points as they are"),
    ({"threads": -1}, "threads is -1; it must be 0 to 1024"),
])
def test_options_out_of_range(points, options, text):
    with pytest.raises(ValueError, match=text):
        morsel.segment(points, **options)


@pytest.mark.parametrize("options", [
    {"parts": 0}, {"merge_ratio": 0.0}, {"parts": 1, "merge_ratio": 2.0}])
def test_cuts_out_of_range(shape, options):
    with pytest.raises(ValueError):
        shape.cut(**options)
