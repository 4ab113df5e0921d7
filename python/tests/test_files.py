"""Points from files and to files."""

import os

import numpy as np
import pytest

import morsel

TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


def put(name, text):
    with open(name, "w", encoding="ascii") as file:
        file.write(text)


@pytest.mark.parametrize("ending", ["ply", "xyz", "pcd"])
def test_points_come_back_as_they_were(tmp_path, points, shape, ending):
    path = tmp_path / f"scan.{ending}"
    morsel.write_points(path, points, shape.labels)
    assert np.array_equal(morsel.read_points(path), points)
    assert np.array_equal(morsel.read_points(str(path)), points)


def test_npy_and_npz_are_numpys(points, shape):
    np.save("scan.npy", points)
    assert np.array_equal(morsel.read_points("scan.npy"), points)
    morsel.write_points("parts.npz", points, shape.labels)
    with np.load("parts.npz") as parts:
        assert any(np.array_equal(parts[name], shape.labels) for name in parts)


def test_the_array_is_the_callers_own(points):
    np.save("scan.npy", points)
    array = morsel.read_points("scan.npy")
    assert array.flags.c_contiguous and array.flags.writeable
    array[0] = 0


def test_meshes_are_sampled():
    put("mesh.off", TETRAHEDRON)
    points = morsel.read_points("mesh.off", sample=1000)
    assert points.shape == (1000, 3)
    x, y, z = points.T
    assert np.allclose(np.minimum.reduce([x, y, z, (1 - x - y - z) / 3**0.5]), 0, atol=1e-12)
    assert np.array_equal(points, morsel.read_points("mesh.off", sample=1000, seed=1))
    assert not np.array_equal(points, morsel.read_points("mesh.off", sample=1000, seed=2))
    noisy = morsel.read_points("mesh.off", sample=1000, noise=0.01)
    assert np.isclose(np.std(noisy - points), 0.01 * 3**0.5, rtol=0.1)


def test_files_that_cannot_be_opened(tmp_path):
    with pytest.raises(FileNotFoundError, match="none.ply"):
        morsel.read_points("none.ply")
    with pytest.raises(FileNotFoundError):
        morsel.read_points("-")
    with pytest.raises(IsADirectoryError):
        morsel.read_points(tmp_path)
    with pytest.raises(TypeError):
        morsel.read_points(3)


def test_files_that_cannot_be_read():
    put("bad.off", TETRAHEDRON.replace("3 1 2 3", "3 1 2 9"))
    with pytest.raises(morsel.Error, match="bad.off:10"):
        morsel.read_points("bad.off")


def test_a_name_that_is_not_unicode():
    name = os.fsdecode(b"\xff.off")
    put(name, "OFF\nno\n")
    with pytest.raises(morsel.Error):
        morsel.read_points(name)


@pytest.mark.parametrize("options", [
    {"sample": 0}, {"sample": 2**40}, {"noise": -1.0}, {"noise": 2.0}, {"seed": -1}])
def test_options_out_of_range(options):
    put("mesh.off", TETRAHEDRON)
    with pytest.raises(ValueError, match=next(iter(options))):
        morsel.read_points("mesh.off", **options)


def test_points_that_cannot_be_written(points, shape):
    with pytest.raises(OSError, match="no/parts.ply"):
        morsel.write_points("no/parts.ply", points, shape.labels)
    with pytest.raises(ValueError, match="parts.doc"):
        morsel.write_points("parts.doc", points, shape.labels)
    with pytest.raises(ValueError, match="got 3 for 4000 points"):
        morsel.write_points("parts.ply", points, shape.labels[:3])
    with pytest.raises(ValueError, match=r"labels: got an array \(4000,\) of float64"):
        morsel.write_points("parts.ply", points, points[:, 0])
    with pytest.raises(ValueError, match="labels: got an object of type list"):
        morsel.write_points("parts.ply", points, [0])
    assert os.listdir() == []


def test_labels_of_any_integer(points, shape):
    morsel.write_points("a.ply", points, shape.labels)
    morsel.write_points("b.ply", points, shape.labels.astype(np.uint8))
    with open("a.ply", "rb") as a, open("b.ply", "rb") as b:
        assert a.read() == b.read()
