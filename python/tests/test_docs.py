"""Documentation and types: what is said is so."""

import doctest
import inspect
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import morsel

PYTHON = pathlib.Path(__file__).resolve().parents[1]
PROJECT = PYTHON.parent
PACKAGES = pathlib.Path(morsel.__file__).parents[1]  # those that are compiled


def everything_public():
    for name in morsel.__all__:
        thing = getattr(morsel, name)
        yield pytest.param(thing, id=name)
        for member, value in vars(thing).items() if inspect.isclass(thing) else ():
            if not member.startswith("_") and (inspect.isroutine(value) or hasattr(value, "fget")):
                yield pytest.param(value, id=f"{name}.{member}")


@pytest.mark.parametrize("thing", everything_public())
def test_everything_public_is_documented(thing):
    assert (thing.__doc__ or "").strip()


def test_examples_in_the_docstrings(points, shape):
    names = {"morsel": morsel, "np": np, "points": points, "shape": shape}
    runner = doctest.DocTestRunner()
    # module=False: all that is found there, in whatever file it is written.
    for test in doctest.DocTestFinder().find(morsel, "morsel", module=False, globs=names):
        runner.run(test)
    result = runner.summarize()
    assert result.attempted >= 20 and result.failed == 0


@pytest.mark.parametrize("file", ["README.md", "docs/python.md"])
def test_examples_in_the_documents(file, points, shape, monkeypatch):
    monkeypatch.setattr(morsel.Segmentation, "show", lambda self: None)
    for name in ("scan.ply", "other.ply"):
        morsel.write_points(name, points, shape.labels)
    blocks = re.findall(r"^```python\n(.*?)^```", (PROJECT / file).read_text(encoding="utf-8"),
                        re.DOTALL | re.MULTILINE)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, file, "exec"), names)


def test_the_version_is_that_of_the_project():
    text = (PROJECT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert f"project(morsel VERSION {morsel.__version__} " in text


def run(*command):
    done = subprocess.run([sys.executable, "-m", *command], cwd=PACKAGES, capture_output=True,
                          text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_types_are_complete(tmp_path):
    pytest.importorskip("mypy")
    run("mypy", "--config-file", PROJECT / "pyproject.toml", "--cache-dir", tmp_path, "morsel",
        *sorted((PYTHON / "examples").glob("*.py")))


def test_stubs_are_what_is_compiled(tmp_path):
    pytest.importorskip("mypy")
    allowed = tmp_path / "allowed"
    allowed.write_text(r"morsel\._morsel\.(Database|Shape|Shape\.__init__)")  # pybind11's metaclass
    run("mypy.stubtest", "--mypy-config-file", PROJECT / "pyproject.toml", "--allowlist", allowed,
        "morsel._morsel")
