"""A picture with one pair of axes, for scripts and notebooks."""

from pathlib import Path
from typing import Any

from .axes.limits import of_data
from .axes.plane import Plane
from .canvas import style
from .canvas.render import render
from .canvas.sheet import POINT, width


class Picture(Plane):
    """A picture with one pair of axes, whose files have the same bytes on every machine.

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
    >>> picture = Picture([0, 4], [0, 1], ("$n$", "$E$"), title="A line")
    >>> picture.line([0, 4], [0.2, 0.8], color="#0072b2", label="rising")
    >>> picture.dots([1, 3], [0.5, 0.5], "black", 3)
    >>> picture.render("png")[1:4]
    b'PNG'
    """

    @style.pinned()
    def __init__(
        self, x: Any, y: Any, names: tuple[str, str] = ("$x$", "$y$"), title: str = ""
    ) -> None:
        self._labelled: dict[str, dict[str, Any]] = {}
        scene = {"axes": {"x": of_data(x, room=0.02), "y": of_data(y, room=0.02)}, "ball": {}}
        super().__init__(scene, ("x", "y"), names, energy=False)
        self.sheet.text(self.frame[0], self.sheet.high - 4 * POINT, title, va="top", size=9.0)

    @style.pinned()
    def line(self, x: Any, y: Any, label: str = "", **line_style: Any) -> None:
        """Draw a line, broken where a coordinate is NaN; keywords are those of Line2D.

        Above the frame each label stands once, beside the style that it was given first.
        """
        self._labelled.setdefault(label, line_style)
        super().line(x, y, **line_style)

    @style.pinned()
    def dots(
        self, x: Any, y: Any, color: Any, size: float = 1.0, label: str = "", **line_style: Any
    ) -> None:
        """Draw dots of `size` points."""
        self._labelled.setdefault(label, {"color": color, "dots": max(size, 2.0)})
        super().dots(x, y, color, size, **line_style)

    note = style.pinned()(Plane.note)

    @style.pinned()
    def render(self, extension: str) -> bytes:
        """Return the bytes of a file; `extension` is png, svg or pdf."""
        labels, self._labelled = self._labelled, {}
        entries = [(text, width(text, style.PLAIN) / POINT, labels[text]) for text in labels]
        self.legend(*(entry for entry in entries if entry[0]))
        return render(self.figure, extension)

    def save(self, file: str | Path) -> "Picture":
        """Write a PNG, SVG or PDF file, and return the picture, which a notebook shows."""
        Path(file).write_bytes(self.render(Path(file).suffix[1:]))
        return self

    def _repr_png_(self) -> bytes:
        return self.render("png")
