"""A check of an SVG: sizes, contrasts, keys, overlaps.

Usage: .venv/bin/python tests/helpers/readable.py FILE.svg ...
"""

import re
import sys
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from itertools import combinations, product
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from helpers.colours import WIDER, apart, contrast
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import render
from pseudorigid.figures.canvas.sheet import POINT

COLUMN = 89 / 25.4 * 72  # points: the width of a journal's column
TEXT, INDEX = 6.0, 4.9  # points: least sizes of texts, and of their exponents and indices
OF_TEXT, OF_LINES = 4.5, 3.0  # least contrasts with what is behind
BAND, SAMPLE = 3.0, 4.9  # points: a wider line is a band or a halo, a wider mark its sample
_TOUCH = 0.25  # points that a text may lie on a line or on another text
_SVG, _LINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
_MARK_TO_TEXT, _LINE_TO_TEXT = 7 - 6 / POINT, 7 - 20 / POINT  # points, in `panel.key`


@dataclass(eq=False)
class Text:
    """A text: its colour, its sizes, its place, and the frame of its ink (left, top, ...)."""

    text: str
    color: str
    size: float
    least: float  # size of its smallest character
    at: np.ndarray
    frame: np.ndarray
    glyphs: np.ndarray  # frames of its characters, (n, 4)

    def over(self, other):
        """Return whether a character lies over one of another text."""
        low = np.maximum(self.glyphs[:, None, :2], other.glyphs[:, :2])
        high = np.minimum(self.glyphs[:, None, 2:], other.glyphs[:, 2:])
        return bool((high - low > _TOUCH).all(axis=2).any())


@dataclass(eq=False)
class Line:
    """A line or the marks of one kind, which are lines without sides."""

    color: str
    points: np.ndarray
    width: float
    dashes: str = ""
    shape: str = ""  # of a mark
    hollow: bool = False
    clip: tuple = (-np.inf, -np.inf, np.inf, np.inf)

    @property
    def quiet(self):
        """Whether it carries no data: a grid, a pane, a backdrop, a band or a halo."""
        return self.color in {*style.QUIET, "#ffffff"} or self.is_band

    @property
    def is_band(self):
        return self.width > (SAMPLE if self.shape else BAND)

    def meets(self, frame):
        """Return whether a side or a mark reaches a frame (left, top, right, bottom)."""
        low, high = np.maximum(frame[:2], self.clip[:2]), np.minimum(frame[2:], self.clip[2:])
        if (low >= high).any():
            return False
        low, high = low - self.width / 2, high + self.width / 2
        start = self.points if self.shape else self.points[:-1]
        step = np.zeros_like(start) if self.shape else np.diff(self.points, axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.sort([(low - start) / step, (high - start) / step], axis=0)
        outside = (step == 0) & ((start <= low) | (start >= high))
        enter = np.where(step == 0, -np.inf, ends[0]).max(axis=1)
        leave = np.where(step == 0, np.inf, ends[1]).min(axis=1)
        return bool((~outside.any(axis=1) & (np.maximum(enter, 0) < np.minimum(leave, 1))).any())


def _matrix(transform):
    """Return the matrix of `translate(...) rotate(...) scale(...)`."""
    found = np.eye(3)
    for name, values in re.findall(r"(\w+)\(([^)]*)\)", transform or ""):
        a, b = ([float(value) for value in re.split(r"[ ,]+", values)] * 2)[:2]
        turn = np.exp(1j * np.radians(a))
        found = (
            found
            @ {
                "translate": np.array([[1, 0, a], [0, 1, b], [0, 0, 1.0]]),
                "scale": np.diag([a, b, 1.0]),
                "rotate": np.array(
                    [[turn.real, -turn.imag, 0], [turn.imag, turn.real, 0], [0, 0, 1]]
                ),
            }[name]
        )
    return found


def _vertices(path):
    """Return the vertices, and of curves the ends of their tangents, of absolute commands."""
    values = [
        float(value) for value in re.findall(r"-?[\d.]+(?:e-?\d+)?", (path or "").replace("h0", ""))
    ]
    return np.array(values).reshape(-1, 2)


def _style(element):
    return dict(re.findall(r"([\w-]+): ([^;]+)", element.get("style", "")))


class Drawing:
    """The texts and lines of an SVG of this project, in the order in which they are drawn."""

    def __init__(self, svg):
        builder = ET.TreeBuilder(insert_comments=True)
        self.root = ET.fromstring(svg, ET.XMLParser(target=builder))
        self.wide, self.high = map(float, self.root.get("viewBox").split()[2:])
        self.by_id = {e.get("id"): e for e in self.root.iter() if e.get("id")}
        self.items: list[Text | Line] = []
        self._walk(self.root)
        self.texts = [item for item in self.items if isinstance(item, Text)]
        self.lines = [item for item in self.items if isinstance(item, Line)]
        boxes = [[*line.points.min(axis=0), *line.points.max(axis=0)] for line in self.lines]
        reach = [[-line.width, -line.width, line.width, line.width] for line in self.lines]
        self.boxes = np.reshape(boxes, (-1, 4)) + np.reshape(reach, (-1, 4)) / 2
        self.data = [line for line in self.lines if not line.quiet]

    def _walk(self, element):
        name = ""
        if uses := element.findall(f"{_SVG}use"):
            self.items.append(self._marks(uses))
        for child in element:
            if child.tag is ET.Comment:
                name = child.text.strip()
            elif child.tag == f"{_SVG}g" and name:
                self._text(child, name)
            elif child.tag in (f"{_SVG}g", f"{_SVG}svg"):
                self._walk(child)
            elif child.tag == f"{_SVG}path":
                self._line(child)

    def _text(self, group, name):
        outer, sizes, frames = _matrix(group.get("transform")), [], []
        for part in group.iter():
            if part.tag not in (f"{_SVG}use", f"{_SVG}path") or part.get("id"):
                continue
            inner = outer @ _matrix(part.get("transform"))
            if part.tag == f"{_SVG}use":
                sizes.append(100 * abs(np.linalg.det(inner)) ** 0.5)
                glyph = self.by_id[part.get(_LINK)[1:]]
                inner = inner @ _matrix(glyph.get("transform"))
            else:
                glyph = part
            if len(ink := _vertices(glyph.get("d"))):
                ink = ink @ inner[:2, :2].T + inner[:2, 2]
                frames.append([*ink.min(axis=0), *ink.max(axis=0)])
        if frames:
            glyphs = np.array(frames)
            frame = np.concatenate([glyphs[:, :2].min(axis=0), glyphs[:, 2:].max(axis=0)])
            color = _style(group).get("fill", "#000000")
            size = 100 * abs(np.linalg.det(outer)) ** 0.5
            self.items.append(Text(name, color, size, min(sizes), outer[:2, 2], frame, glyphs))

    def _clip(self, element):
        if not (name := re.findall(r"#(\w+)", element.get("clip-path", ""))):
            return Line.clip
        (shape,) = self.by_id[name[0]]
        x, y, wide, high = (float(shape.get(key)) for key in ("x", "y", "width", "height"))
        return x, y, x + wide, y + high

    def _line(self, path):
        look, points = _style(path), _vertices(path.get("d"))
        if look.get("stroke", "none") == "none" or not len(points):
            return  # the sheet, or an empty line
        width, round_dots = float(look.get("stroke-width", 1)), "stroke-linecap" in look
        dashes = look.get("stroke-dasharray", "")
        shape = "o" if round_dots and look["stroke-linecap"] == "round" else ""
        self.items.append(Line(look["stroke"], points, width, dashes, shape, clip=self._clip(path)))

    def _marks(self, uses):
        """Return the marks of one artist, which look the same, as one line."""
        look, path = _style(uses[0]), self.by_id[uses[0].get(_LINK)[1:]].get("d")
        at = np.array([[float(use.get("x")), float(use.get("y"))] for use in uses])
        hollow = look.get("fill") in ("#ffffff", "none")
        fill = look.get("fill", "#000000")
        color = look.get("stroke", fill) if hollow else fill
        return Line(color, at, 2 * float(np.abs(_vertices(path)).max()), "", path, hollow)

    def key(self):
        """Return the entries of the picture's keys, as `panel.key` draws them: (text, line)."""
        found = []
        for text, line in product(self.texts, self.lines):
            start, end = line.points[0], line.points[-1]
            if len(line.points) == (1 if line.shape else 2):
                gap = _MARK_TO_TEXT if line.shape else _LINE_TO_TEXT
                sample = line.shape or abs(end[0] - start[0] - 28 / POINT) < 0.1
                beside = abs(text.at[0] - end[0] - gap) < 0.6
                if sample and beside and text.frame[1] < end[1] < text.frame[3]:
                    found.append((text.text, line))
        return found

    def _at(self, frame):
        """Return the lines and marks that reach a frame, in the order in which they are drawn."""
        near = (self.boxes[:, :2] < frame[2:]) & (self.boxes[:, 2:] > frame[:2])
        lines = [self.lines[i] for i in np.flatnonzero(near.all(axis=1))]
        return [line for line in lines if line.meets(frame)]

    def _behind(self, text):
        """Return the colour of the band behind a text, white without one."""
        middle = (text.frame[:2] + text.frame[2:]) / 2
        bands = [line for line in self._at(np.append(middle - 0.01, middle + 0.01)) if line.is_band]
        return bands[-1].color if bands else "#ffffff"

    def faults(self):
        """Yield (kind, words) for each fault: "size", "contrast", "key" or "over"."""
        shrink = min(COLUMN / self.wide, 1.0)
        for text in self.texts:
            if text.size * shrink < TEXT - 0.01 or text.least * shrink < INDEX - 0.01:
                yield "size", f"{text.text}: {text.size * shrink:.1f}, {text.least * shrink:.1f} pt"
            if contrast(text.color, self._behind(text)) < OF_TEXT:
                yield "contrast", f"{text.text}: {text.color} on {self._behind(text)}"
        entries = self.key()
        named = [line for _, line in entries if not line.shape]  # also in a colour of the ground
        for color in sorted({line.color for line in self.data + named}):
            if contrast(color, "#ffffff") < OF_LINES:
                yield "contrast", f"lines or marks of {color}: {contrast(color, '#ffffff'):.2f}"
        for (name, one), (other_name, other) in combinations(entries, 2):
            if words := _confused(_look(one), _look(other)):
                yield "key", f"{name}, {other_name}: {words}"
        for one, other in combinations(self.texts, 2):
            if one.over(other):
                yield "over", f"{one.text} over {other.text}"
        for text in self.texts:
            lines = self._at(text.frame + _TOUCH * np.array([1, 1, -1, -1]))
            halo = [i for i, line in enumerate(lines) if line.color == "#ffffff"]
            for i, line in enumerate(lines):
                own = text.color in (line.color, style.ink(line.color))
                own &= i < max(halo, default=-1)
                if not line.quiet and not own:
                    yield "over", f"{text.text} over a line or mark of {line.color}"
                    break


def _confused(one, other):
    """Return why two looks of one key may be confused, or nothing."""
    if one[1] == other[1] == "" and one[2] != other[2]:
        return ""  # dashes
    if one[0] != other[0]:
        return apart(one, other)
    sizes = sorted((one[3], other[3]))
    same = one[1:3] == other[1:3] and sizes[1] < WIDER * sizes[0]
    return f"both {one[0]} and of one shape" if same else ""


def _look(line):
    """Return the look of a line as `colours.looks` does: colour, mark, hollow or dashes, size."""
    return line.color, line.shape, line.hollow if line.shape else line.dashes, line.width


def faults(svg):
    """Return the faults of an SVG (bytes or text), each (kind, words)."""
    return [*Drawing(svg).faults()]


def assert_readable(svg):
    """Assert that a picture has no fault.

    `svg` is its text, or the figure object of a picture that is not published as SVG.
    """
    assert not (found := faults(render(svg, "svg") if isinstance(svg, Figure) else svg)), found


if __name__ == "__main__":
    for file in sys.argv[1:]:
        for kind, words in faults(Path(file).read_text(encoding="utf-8")):
            print(f"{file}: {kind}: {words}")
