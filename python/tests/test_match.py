"""Scores and alignments."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

import morsel
import shapes


def scale_of(matrix):
    """The scale of a similarity transform, negative with a reflection; fails for any other."""
    linear = matrix[:3, :3]
    scale = np.cbrt(np.linalg.det(linear))
    assert np.allclose(linear.T @ linear, scale**2 * np.eye(3), atol=1e-9 * scale**2)
    assert np.array_equal(matrix[3], [0, 0, 0, 1])
    return scale


@pytest.fixture(scope="module")
def target():
    return morsel.segment(shapes.snowman() * [1, 1.3, 1], parts=3)


@pytest.mark.parametrize("scale", [0.4, -0.4])
def test_a_moved_copy_is_laid_back(target, scale):
    turn = scale * Rotation.from_rotvec([0.3, -0.8, 1.1]).as_matrix()
    moved = morsel.segment(target.points @ turn.T + [7, -3, 2], parts=3)
    found = morsel.match(target, moved)
    assert found.score > 0.97
    assert np.isclose(abs(scale_of(found.target_from_source)), 1 / 0.4, rtol=0.02)
    assert (scale_of(found.target_from_source) < 0) == found.mirrored
    distances, _ = cKDTree(target.points).query(found.apply(moved.points))
    assert np.median(distances) < 0.05
    partner = {pair.source: pair.target for pair in found.correspondences}
    there = np.array([partner[label] for label in moved.labels])
    assert np.mean(there == target.labels) > 0.95
    assert found.unmatched_source == [] and found.unmatched_target == []
    shares = [pair.contribution for pair in found.correspondences]
    assert shares == sorted(shares, reverse=True)


def test_scores_are_symmetric_and_tell_shapes_apart(target):
    torus = morsel.segment(shapes.torus(4000))
    for method in ("default", "paper"):
        score = morsel.match(target, torus, method=method).score
        assert score == morsel.match(torus, target, method=method).score
        assert score < 0.8 < morsel.match(target, target, method=method).score


def test_signatures_and_points_stand_for_the_shape(points, shape):
    other = shape.cut(parts=1)
    score = morsel.match(shape, other).score
    assert morsel.match(shape.signature, other.signature).score == score
    assert morsel.match(points, other).score == score


def test_bad_arguments(shape):
    with pytest.raises(ValueError, match="method is 'x'"):
        morsel.match(shape, shape, method="x")
    with pytest.raises(ValueError, match="got an object of type str"):
        morsel.match(shape, "scan.ply")


def test_articulated(target):
    other = morsel.segment(target.points, parts=2)
    found = morsel.match(target, other, mode="articulated")
    assert found.score > 0.97
    assert {pair.target for pair in found.correspondences} == {0, 1, 2}
    assert {pair.source for pair in found.correspondences} == {0, 1}
    assert found.unmatched_source == [] and found.unmatched_target == []
    with pytest.raises(ValueError, match="'rigid', 'articulated' or 'partial'"):
        morsel.match(target, other, mode="bent")
    with pytest.raises(ValueError, match="no articulated mode"):
        morsel.match(target, other, mode="articulated", method="paper")


def test_partial(target):
    points = target.points
    piece = 3 * points[points[:, 2] > 0.5][:, [1, 0, 2]]
    found = morsel.match(target, piece, mode="partial")
    assert found.score > 0.85
    assert np.cbrt(abs(np.linalg.det(found.target_from_source[:3, :3]))) == pytest.approx(1 / 3, rel=0.05)
    assert found.score > morsel.match(target, piece, mode="partial", same_scale=True).score + 0.1
    with pytest.raises(ValueError, match="of a whole shape"):
        morsel.match(target.signature, piece, mode="partial")
    with pytest.raises(ValueError, match="only the mode 'partial'"):
        morsel.match(target, piece, same_scale=True)
    with pytest.raises(ValueError, match="no partial mode"):
        morsel.match(target, piece, mode="partial", method="paper")
