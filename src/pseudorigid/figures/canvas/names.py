"""Names of curves, written on them or beside them where the most room is."""

from collections.abc import Sequence
from itertools import product

import numpy as np

from .sheet import POINT, Sheet, width

Frame = tuple[float, float, float, float]

_GAP = 1.8  # points from a curve to its name
_CELL = 4  # pixels: points of curves that share a cell of this size count once
_LEAST = 0.4  # of this gap: least distance to other curves and names
_HIDDEN = 0.3  # largest share of the nearby part of a curve that its name may hide
_SEPARATE = 12  # pixels: parts of a curve that are farther apart are its islands
_TRIED = 60  # points of a curve beside which its name is tried
_HIGH = 0.68  # height of digits and capitals, in sizes of the text


def name_curves(
    sheet: Sheet,
    curves: Sequence[np.ndarray],
    names: Sequence[str],
    colors: Sequence[str],
    frame: Frame,
    size: float,
    ground: np.ndarray | None = None,
) -> None:
    """Write the name of each curve where the other curves are farthest, on a white ground.

    It interrupts its curve, or is beside it if it would hide a large share of the curve.
    Curves are points (2, n) in pixels, so dense that a name does not fit between two of them; one
    beyond the last name has none. A name that would lie on a curve or another name, or beyond the
    frame (left, bottom, right, top), is left out. Names of curves that lie within the islands of
    one another are at the same island, if there is room. Places off the points (2, n) of the
    `ground` are preferred.
    """
    cells = [(np.unique(np.floor(c / _CELL), axis=1) + 0.5) * _CELL for c in curves]
    gap, places = _GAP * POINT, []
    covered = _Cells(frame, np.empty((2, 0)) if ground is None else ground)
    for i, name in enumerate(names):
        half = 0.5 * width(name, size), 0.5 * _HIGH * size * POINT
        others = np.hstack([cell for j, cell in enumerate(cells) if j != i])
        # On the curve or beside it, off the ground, and then the same on the ground.
        found: list[list[tuple[np.ndarray, np.ndarray]]] = [[], []]
        for beside in (False, True):
            centres = _places(cells[i], half, gap, frame, beside)
            own, room = (_room(centres, half, points) for points in (cells[i], others))
            room = room.min(axis=1, initial=np.inf)
            if beside:
                free = own.min(axis=1, initial=np.inf) > _LEAST * gap
            else:
                hidden, near = (np.sum(own < reach, axis=1) for reach in (gap, 5.0 * half[1]))
                free = hidden < _HIDDEN * near
            free &= room > _LEAST * gap
            for kept, chosen in zip(found, (free & covered.free(centres, half), free), strict=True):
                kept.append((centres[:, chosen], room[chosen]))
        offers = [offer for kept in found for offer in kept]
        best = next((offer for offer in offers if offer[1].size), offers[0])
        places.append((i, half, *best))
    taken = np.empty((2, 0))
    named: list[tuple[np.ndarray, np.ndarray]] = []  # place and islands
    for i, half, centres, to_curves in sorted(places, key=lambda place: place[3].size):
        room = np.minimum(to_curves, _room(centres, half, taken).min(axis=1, initial=np.inf))
        if room.max(initial=0.0) <= _LEAST * gap:
            continue
        islands = _islands(cells[i])
        for place, others in named:
            same = _at_same(centres, islands, place, others, 2.0 * half[1] + gap)
            if np.max(room[same], initial=0.0) > _LEAST * gap:
                room = np.where(same, room, 0.0)
        x, y = centres[:, int(np.argmax(room))].tolist()
        named.append((np.array([[x, y]]), islands))
        sheet.draw([x - half[0], x + half[0]], [y, y], color="white", lw=2.0 * half[1] / POINT)
        sheet.text(x, y, names[i], ha="center", va="center_baseline", size=size, color=colors[i])
        across, up = np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0])
        box = np.array([x + half[0] * across.ravel(), y + half[1] * up.ravel()])
        taken = np.hstack([taken, box])


class _Cells:
    """Which cells of a frame have points (2, n)."""

    def __init__(self, frame: Frame, points: np.ndarray) -> None:
        self.corner = np.array(frame[:2])[:, None]
        self.last = ((np.array(frame[2:])[:, None] - self.corner) // _CELL).astype(np.int64)
        covered = np.zeros(self.last.ravel() + 1, dtype=np.int64)
        covered[tuple(self._cell(points))] = 1
        self.sums = np.pad(covered.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))

    def free(self, centres: np.ndarray, half: tuple[float, float]) -> np.ndarray:
        """Return whether no cell that a rectangle around each centre meets has points."""
        reach = np.array(half)[:, None]
        x0, y0 = self._cell(centres - reach)
        x1, y1 = self._cell(centres + reach) + 1
        sums = self.sums
        return sums[x1, y1] - sums[x0, y1] - sums[x1, y0] + sums[x0, y0] == 0

    def _cell(self, points: np.ndarray) -> np.ndarray:
        """Return the cells of points, those at the ends for points beyond the frame."""
        cells = np.floor((points - self.corner) / _CELL).astype(np.int64)
        return np.clip(cells, 0, self.last)


def dense(line: Sequence[np.ndarray], frame: Frame) -> np.ndarray:
    """Return points (2, n) of the part of a line (across, up) in a frame, a pixel apart or less."""
    places = np.array(line)
    steps = np.abs(np.diff(places)).max(axis=0)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.arange(0.0, along[-1] + 1.0)
    x, y = points = np.array([np.interp(at, along, part) for part in places])
    left, bottom, right, top = frame
    return points[:, (left < x) & (x < right) & (bottom < y) & (y < top)]


def _places(
    curve: np.ndarray, half: tuple[float, float], gap: float, frame: Frame, beside: bool
) -> np.ndarray:
    """Return centres of a text, half as wide and high, on a curve or all around its points."""
    steps = np.array([s for s in product((-1.0, 0.0, 1.0), repeat=2) if any(s) == beside]).T
    shifts = steps * (np.array(half)[:, None] + gap)
    tried = curve[:, :: max(curve.shape[1] // _TRIED, 1)]
    x, y = (tried[:, :, None] + shifts[:, None]).reshape(2, -1)
    left, bottom, right, top = frame
    inside = (x > left + half[0] + gap) & (x < right - half[0] - gap)
    inside &= (y > bottom + half[1] + gap) & (y < top - half[1] - gap)
    return np.array([x, y])[:, inside]


def _room(centres: np.ndarray, half: tuple[float, float], points: np.ndarray) -> np.ndarray:
    """Return how far each point is from a text around each centre, (centre, point), in pixels."""
    apart = np.abs(centres[:, :, None] - points[:, None])
    return np.maximum(apart[0] - half[0], apart[1] - half[1])


def _islands(cells: np.ndarray) -> np.ndarray:
    """Return the frame of each separate part of a curve, (part, 4)."""
    rest = {(int(x), int(y)) for x, y in np.floor(cells.T / _SEPARATE)}
    frames = []
    while rest:
        part, new = set(), {rest.pop()}
        while new:
            part |= new
            steps = product((-1, 0, 1), repeat=2)
            new = {(x + i, y + j) for i, j in steps for x, y in new} & rest
            rest -= new
        across, up = zip(*part, strict=True)
        frames.append((min(across), min(up), max(across) + 1, max(up) + 1))
    return _SEPARATE * np.array(frames, dtype=float).reshape(-1, 4)


def _at_same(
    centres: np.ndarray, islands: np.ndarray, place: np.ndarray, others: np.ndarray, reach: float
) -> np.ndarray:
    """Return which centres are at an island nested with one at `place`, all if none are nested."""
    nested = _lies_in(islands, others) | _lies_in(others, islands).T
    if min(nested.shape) < 2 or not (nested.any(axis=0).all() or nested.any(axis=1).all()):
        return np.full(centres.shape[1], True)
    wide = np.array([-reach, -reach, reach, reach])
    there = _lies_in(np.tile(place, 2), others + wide)[0]
    own = islands[nested[:, there].any(axis=1)] + wide
    return np.any(_lies_in(np.tile(centres.T, 2), own), axis=1)


def _lies_in(frames: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return whether each frame (n, 4) lies in each of the others (m, 4)."""
    beyond = (frames[:, None] - others) * [1.0, 1.0, -1.0, -1.0]
    return np.all(beyond >= 0.0, axis=2)
