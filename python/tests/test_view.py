"""Pages, notebooks, plotly."""

import html
import re
import sys
import types
import webbrowser

import numpy as np
import pytest

import morsel
from morsel import _morsel, _view

needs_viewer = pytest.mark.skipif(not _morsel.has_viewer(), reason="built without the viewer")


@needs_viewer
def test_the_page_is_one_file(shape):
    page = shape.to_html("<toy>")
    assert page.lower().startswith("<!doctype html>") and "Content-Security-Policy" in page
    assert "<toy>" not in page
    assert not re.search(r'(src|href)="http', page)
    shape.write_html("page.html", "<toy>")
    with open("page.html", encoding="utf-8") as file:
        assert file.read() == page


@needs_viewer
def test_the_page_opens_with_the_cut(shape):
    assert shape.to_html() != shape.cut(parts=1).to_html()


@needs_viewer
def test_a_notebook_shows_the_page_in_a_frame(shape):
    frame = shape._repr_html_()
    source = re.fullmatch(r'<iframe srcdoc="([^"]*)".* sandbox="allow-scripts .*</iframe>', frame)[1]
    assert html.unescape(source) == shape.to_html()


@needs_viewer
def test_show_in_a_notebook(shape, monkeypatch):
    shown = []
    display = types.ModuleType("IPython.display")
    display.HTML, display.display = lambda text: text, shown.append
    notebook = types.ModuleType("IPython")
    notebook.get_ipython = lambda: types.SimpleNamespace(kernel=1)
    monkeypatch.setitem(sys.modules, "IPython", notebook)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    shape.show()
    assert shown == [shape._repr_html_()]


@needs_viewer
def test_show_elsewhere_opens_the_browser(shape, monkeypatch, tmp_path, capsys):
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: None))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or len(opened) < 2)
    shape.show("toy")
    with open(opened[0].removeprefix("file://"), encoding="utf-8") as file:
        assert file.read() == shape.to_html("toy")
    assert capsys.readouterr().out == ""
    shape.show()
    assert opened[1].removeprefix("file://") in capsys.readouterr().out


def test_without_a_viewer_a_notebook_shows_text(shape, monkeypatch):
    monkeypatch.setattr(_morsel, "has_viewer", lambda: False)
    assert shape._repr_html_() is None


def test_without_parts_there_is_nothing_to_show():
    nothing = morsel.segment(np.zeros((3, 3)))
    assert nothing._repr_html_() is None
    for show in (nothing.to_html, nothing.show, lambda: nothing.write_html("page.html")):
        with pytest.raises(ValueError, match="no parts to show: The cloud has 1 distinct"):
            show()


def test_the_plotly_figure(points, shape):
    traces = _view.figure_values(points, shape.labels)["data"]
    assert [trace["name"] for trace in traces] == ["part 0", "part 1"]
    for part, trace in enumerate(traces):
        assert np.array_equal(np.column_stack([trace["x"], trace["y"], trace["z"]]),
                              points[shape.labels == part])
        assert re.fullmatch(r"rgb\(\d+, \d+, \d+\)", trace["marker"]["color"])


def test_plotly_takes_it(shape):
    pytest.importorskip("plotly")
    assert len(shape.to_plotly().data) == 2


def test_without_plotly_it_says_so(shape, monkeypatch):
    monkeypatch.setitem(sys.modules, "plotly", None)
    with pytest.raises(ImportError, match="needs plotly"):
        shape.to_plotly()
