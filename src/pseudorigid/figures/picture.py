"""A picture with one pair of axes, for scripts and notebooks."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal, SupportsFloat

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D

from ..dynamics.inputs import Reals, coordinates, doubles, not_allowed, number, one_of
from .axes.limits import of_data, ticks
from .axes.plane import Plane
from .canvas import style
from .canvas.render import render
from .canvas.sheet import POINT, width

_FORMATS = ("png", "svg", "pdf")


class Picture:
    """A picture with one pair of axes, whose files have the same bytes on every machine.

    Coordinates are read by the rule in `help(pseudorigid)`. Colours are matplotlib's, and other
    keywords are properties of its Line2D. A refused argument raises ValueError with one line.

    Parameters
    ----------
    x, y : array_like
        Data that the axes show. Their limits are round numbers around these; what lies beyond is
        cut off.
    names : (str, str)
        Names of the axes, with formulas between dollar signs.
    title : str
        A line above the picture.

    Examples
    --------
    >>> from pseudorigid import Picture
    >>> picture = Picture([0, 4], [0, 1], ("$n$", "$E$"), title="A line")
    >>> picture.line([0, 4], [0.2, 0.8], color="#0072b2", label="rising")
    >>> picture.dots([1, 3], [0.5, 0.5], "black", 3)
    >>> picture.render("png")[1:4]
    b'PNG'
    """

    @style.pinned()
    def __init__(
        self, x: Reals, y: Reals, names: tuple[str, str] = ("$x$", "$y$"), title: str = ""
    ) -> None:
        self._labelled: dict[str, dict[str, Any]] = {}
        scene = {"axes": {"x": _axis("x", x), "y": _axis("y", y)}, "ball": {}}
        names = _pair("names", names, _text)
        self._plane = Plane(scene, ("x", "y"), names, energy=False)
        self.figure, sheet = self._plane.figure, self._plane.sheet
        self.figure.set_label(title)
        at = self._plane.frame[0], sheet.high - 4 * POINT
        sheet.text(*at, _text("title", title), va="top", size=9.0)

    @style.pinned()
    def line(self, x: Reals, y: Reals, label: str = "", **line_style: Any) -> None:
        """Draw a line, broken where a coordinate is not finite.

        Parameters
        ----------
        x, y : array_like, numbers along one dimension
        label : str, written once above the frame, beside the style that it was given first
        **line_style : properties of matplotlib's Line2D
        """
        _text("label", label)
        x, y = coordinates(x=x, y=y)
        if x.ndim > 1:
            raise not_allowed("x", x, "numbers along one dimension")
        with _checked(line_style):
            self._plane.line(x, y, **line_style)
        self._labelled.setdefault(label, line_style)

    @style.pinned()
    def dots(
        self, x: Reals, y: Reals, color: Any, size: SupportsFloat = 1.0, label: str = "",
        **line_style: Any,
    ) -> None:  # fmt: skip
        """Draw dots.

        Parameters
        ----------
        x, y : array_like
        color : a colour of matplotlib
        size : float, from 0 to 1000 points
        label, **line_style : as for `line`
        """
        _text("label", label)
        size = number("size", size, "0 to 1000 points", lambda v: 0.0 <= v <= 1000.0)
        x, y = _columns(x=x, y=y)
        with _checked(line_style | {"color": color}):
            self._plane.dots(x, y, color, size, **line_style)
        self._labelled.setdefault(label, {"color": color, "dots": max(size, 2.0)})

    def bars(self, x: Reals, low: Reals, high: Reals, **line_style: Any) -> None:
        """Draw an upright line from low to high at each x.

        Parameters
        ----------
        x, low, high : array_like
        **line_style : as for `line`
        """
        for at, *span in zip(*_columns(x=x, low=low, high=high), strict=True):
            self.line([at, at], span, **line_style)

    @style.pinned()
    def estimates(self, x: Reals, values: Reals, low: Reals, high: Reals, color: Any) -> None:
        """Draw a dot for each value, joined by a line, with its bar from low to high.

        Parameters
        ----------
        x, values, low, high : array_like
        color : a colour of matplotlib
        """
        x, values, low, high = _columns(x=x, values=values, low=low, high=high)
        with _checked({"color": color}):
            self._plane.estimates(x, values, low, high, to_hex(color))

    @style.pinned()
    def note(
        self, x: SupportsFloat, y: SupportsFloat, text: str,
        shift: tuple[SupportsFloat, SupportsFloat] = (0, 0),
        ha: Literal["left", "center", "right"] = "left",
        va: Literal["bottom", "center", "top"] = "center",
    ) -> None:  # fmt: skip
        """Write a text beside a point, on the other side if only that fits.

        Beside a point beyond the axes nothing is written.

        Parameters
        ----------
        x, y : float
        text : str
        shift : (float, float), in points to the right and up
        ha, va : {"left", "center", "right"}, {"bottom", "center", "top"}
        """
        one_of("ha", ha, ("left", "center", "right"))
        one_of("va", va, ("bottom", "center", "top"))
        x, y, away = number("x", x), number("y", y), _pair("shift", shift, number)
        _text("text", text)
        if self._plane.shows(x, y):
            self._plane.note(x, y, text, away, ha, va)

    @style.pinned()
    def colorbar(
        self, colors: Any, low: SupportsFloat, high: SupportsFloat, name: str = ""
    ) -> None:
        """Draw a scale of colours at the right inside; the limits of x should leave room for it.

        Parameters
        ----------
        colors : list of two colours of matplotlib or more
        low, high : float, the values of the first and the last colour
        name : str, written above the scale
        """
        low = number("low", low)
        high = number("high", high, "a number above low", lambda value: value > low)
        _text("name", name)
        try:
            first, *rest = [to_hex(color) for color in colors]
        except (TypeError, ValueError):
            rest = []
        if not rest:
            raise not_allowed("colors", colors, "two of matplotlib's colours or more")
        left, bottom, right, top = self._plane.frame
        texts = {mark: style.number(mark) for mark in ticks(low, high, 4)}
        edge, right = right, right - max(width(t, style.PLAIN) for t in texts.values()) - 8 * POINT
        left = right - 8 * POINT
        bottom, top = bottom + 0.15 * (top - bottom), top - 0.15 * (top - bottom)
        step, sheet = (top - bottom) / (1 + len(rest)), self._plane.sheet
        for i, hue in enumerate([first, *rest]):  # a pixel of overlap hides the seams
            up = bottom + (i + 0.5) * step
            sheet.draw([left, right], [up, up], color=hue, lw=(step + 1.0) / POINT)
        for mark, text in texts.items():
            up = bottom + (mark - low) / (high - low) * (top - bottom)
            sheet.draw([right, right + 2 * POINT], [up, up], color=style.FRAME, lw=0.6)
            sheet.text(right + 4 * POINT, up, text, style.PLAIN)
        sheet.text(edge - 4 * POINT, top + 5 * POINT, name, style.PLAIN, "right", "bottom")

    @style.pinned()
    def render(self, extension: Literal["png", "svg", "pdf"]) -> bytes:
        """Return the bytes of a file.

        Parameters
        ----------
        extension : {"png", "svg", "pdf"}
        """
        one_of("extension", extension, _FORMATS)
        labels, self._labelled = self._labelled, {}
        entries = [(text, width(text, style.PLAIN) / POINT, labels[text]) for text in labels]
        self._plane.legend(*(entry for entry in entries if entry[0]))
        return render(self.figure, extension)

    def save(self, file: str | os.PathLike[str]) -> "Picture":
        """Write a file, and return the picture, which a notebook shows.

        Parameters
        ----------
        file : str or path, which ends with .png, .svg or .pdf
        """
        extension: Any = Path(str(file)).suffix[1:]
        if extension not in _FORMATS:
            raise not_allowed("file", file, "a path that ends with .png, .svg or .pdf")
        Path(file).write_bytes(self.render(extension))
        return self

    def _repr_png_(self) -> bytes:
        return self.render("png")


def _axis(name: str, values: Any) -> dict[str, list[float]]:
    """Return the axis around the values of an argument."""
    array = doubles(name, values)
    if np.isnan(array).all() or np.any(np.abs(array) > 1e300):
        raise not_allowed(name, values, "finite numbers up to 1e300, or NaN; at least one number")
    return of_data(array, room=0.02)


def _columns(**values: Any) -> list[np.ndarray]:
    """Return the coordinates of marks as arrays (n,)."""
    return [array.ravel() for array in coordinates(**values)]


def _text(name: str, value: Any) -> str:
    """Return a text; raise ValueError if matplotlib cannot write it."""
    try:
        width(value, style.PLAIN)
    except (AttributeError, TypeError, ValueError):
        allowed = "text, with matplotlib's formulas between dollar signs"
        raise not_allowed(name, value, allowed) from None
    return str(value)


def _pair(name: str, value: Any, read: Callable[[str, Any], Any]) -> tuple[Any, Any]:
    """Return the two parts of an argument, as a function of its name and a part reads them."""
    if not (isinstance(value, (tuple, list)) and len(value) == 2):
        raise not_allowed(name, value, "two values")
    return read(name, value[0]), read(name, value[1])


@contextmanager
def _checked(line_style: dict[str, Any]) -> Iterator[None]:
    """Turn what matplotlib says about properties of a line into a ValueError of one line."""
    try:
        mark = Line2D([0.0], [0.0], **{"marker": "o"} | line_style)
        mark.draw(RendererAgg(1, 1, 72.0))  # it looks at some properties only now
        sizes = mark.get_linewidth(), mark.get_markersize(), mark.get_markeredgewidth()
        if not all(-np.inf < size < np.inf for size in (*sizes, mark.zorder)):
            raise ValueError
        yield
    except Exception:
        allowed = "properties of matplotlib's Line2D"
        raise not_allowed("line_style", line_style, allowed) from None
