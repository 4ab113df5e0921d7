"""The examples run as a user would run them."""

import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import morsel
import shapes

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"


def run(name, *arguments, status=0):
    done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)],
                          capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == status, done.stderr
    return done.stdout


@pytest.fixture
def scan(points):
    np.save("scan.npy", points)
    return "scan.npy"


def test_parts_of_a_scan(scan):
    viewer = morsel._morsel.has_viewer()
    text = run("parts_of_a_scan.py", scan, *["page.html"][:viewer])
    assert text.startswith("2 parts.\npart 0: ") and "beside 1\n" in text and "cut in 1," in text
    assert pathlib.Path("page.html").exists() == viewer
    np.save("flat.npy", np.zeros((9, 3)))
    assert "distinct points" in run("parts_of_a_scan.py", "flat.npy", status=1)


def test_look_alikes(scan):
    folder = pathlib.Path("folder")
    folder.mkdir()
    for name, cloud in (("ring", shapes.torus(3000)), ("toy", shapes.dumbbell(3000, seed=5))):
        np.savetxt(folder / f"{name}.xyz", cloud)
    (folder / "bad.ply").write_text("ply\n")
    for found in ("2 shapes are new, 0 were known", "0 shapes are new, 2 were known"):
        lines = run("look_alikes.py", folder, scan).splitlines()
        assert lines[0] == found and lines[1].startswith("left out folder/bad.ply: ")
        assert re.fullmatch(r"[01]\.\d\d folder/toy\.xyz", lines[2])


def test_batch(scan, shape):
    np.save("ring.npy", shapes.torus(3000))
    text = run("batch.py", scan, "none.ply", "ring.npy")
    assert "scan.npy: 2 parts." in text
    assert np.array_equal(np.load("scan.npy.labels.npy"), shape.labels)
    assert np.load("ring.npy.labels.npy").shape == (3000,)


def test_compare_scans(scan, points):
    np.save("half.npy", 0.5 * points)
    text = run("compare_scans.py", scan, "half.npy")
    assert text.startswith("score 1.00\n") and "scaled by 2\n" in text and "lies on part" in text


def test_compare_scans_in_a_picture(scan):
    pytest.importorskip("matplotlib")
    run("compare_scans.py", scan, scan, "picture.png")
    assert pathlib.Path("picture.png").read_bytes().startswith(b"\x89PNG")
