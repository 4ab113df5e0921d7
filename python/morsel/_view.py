"""Shapes on the screen."""

from __future__ import annotations

import html
import os
import sys
import tempfile
import webbrowser
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _morsel
from ._points import Path

HEIGHT = 640  # pixels of a frame in a notebook


def page(shape: _morsel.Shape, message: str, name: str) -> str:
    _check(shape, message)
    return _morsel.html_page(shape, name)


def write_page(shape: _morsel.Shape, message: str, path: Path, name: str) -> None:
    _check(shape, message)
    _morsel.write_html(shape, os.fspath(path), name)


def frame(text: str) -> str:
    """The page within a page. The sandbox keeps it from the notebook around it."""
    return (f'<iframe srcdoc="{html.escape(text)}" title="Parts of the shape" '
            f'sandbox="allow-scripts allow-downloads" width="100%" height="{HEIGHT}" '
            'style="border: 0"></iframe>')


def show(text: str) -> None:
    if _in_notebook():
        from IPython.display import HTML, display

        display(HTML(frame(text)))
        return
    # The browser reads it after we return, so it is left to the system to clean up.
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="morsel-", suffix=".html",
                                     delete=False) as file:
        file.write(text)
    if not webbrowser.open("file://" + file.name):
        print(f"No browser was found; the page is {file.name}")


def figure(points: NDArray[np.float64], labels: NDArray[np.int32]) -> Any:
    try:
        from plotly import graph_objects
    except ImportError:
        raise ImportError("to_plotly() needs plotly (Debian: python3-plotly); show() and "
                          "to_html() need nothing") from None
    return graph_objects.Figure(figure_values(points, labels))


def figure_values(points: NDArray[np.float64], labels: NDArray[np.int32]) -> dict[str, Any]:
    """The figure as plotly's own plain values."""
    traces = []
    for part in np.unique(labels):
        x, y, z = points[labels == part].T
        red, green, blue = _morsel.part_color(int(part))
        traces.append({"type": "scatter3d", "mode": "markers", "name": f"part {part}",
                       "x": x, "y": y, "z": z,
                       "marker": {"size": 2, "color": f"rgb({red}, {green}, {blue})"}})
    return {"data": traces, "layout": {"scene": {"aspectmode": "data"}}}


def _check(shape: _morsel.Shape, message: str) -> None:
    if not shape.is_solid:
        raise ValueError(f"there are no parts to show: {message}")


def _in_notebook() -> bool:
    if "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return shell is not None and hasattr(shell, "kernel")
