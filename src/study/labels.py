"""Labels of lines and marks in a panel, beside a point of theirs."""

from collections.abc import Sequence

import numpy as np

from pseudorigid.figures.axes.panel import Panel
from pseudorigid.figures.canvas.sheet import width

# Shifts of a label in pixels, the nearest first; those to the left count as farther away.
_SHIFTS = sorted(
    ((i, 13 * j) for i in range(-600, 601, 10) for j in range(-60, 61) if abs(i) > 15),
    key=lambda shift: ((1.5 if shift[0] > 0 else 2.0) * shift[0]) ** 2 + shift[1] ** 2,
)


def label(
    panel: Panel,
    drawn: Sequence[np.ndarray],
    labels: Sequence[tuple[float, float, str, str]],
    taken: Sequence[tuple[float, ...]] = (),
) -> None:
    """Write each text (x, y, text, colour) near its point, where it hides no line and no text.

    `drawn` has the vertices of lines (n, 2) in pixels, and `taken` frames of other texts.
    """
    steps = np.linspace(0.0, 1.0, 40)[:, None, None]
    lines = [(line[:-1] + steps * np.diff(line, axis=0)).reshape(-1, 2) for line in drawn]
    marks = np.concatenate([*lines, *drawn])
    left, bottom, end, top = panel.frame
    taken = [*taken]
    for across, up, text, color in sorted(labels):
        (own_x,), (own_y,) = (a.tolist() for a in panel.place(across, up))
        wide = width(text, 7.0) + 2
        for right, high in _SHIFTS:
            at, middle = own_x + (right if right > 0 else right - wide), own_y + high
            box = at - 4, middle - 14, at + wide, middle + (22 if "^" in text else 14)
            hides = (marks > box[:2]).all(axis=1) & (marks < box[2:]).all(axis=1)
            over = any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3]
                       for b in taken)  # fmt: skip
            inside = left < box[0] and box[2] < end and bottom < box[1] and box[3] < top
            if inside and not over and not hides.any():
                break
        taken.append(box)
        near = at - 4 if at > own_x else at + wide + 2
        panel.sheet.draw([own_x, near], [own_y, middle], color=color, lw=0.4, zorder=3)
        panel.sheet.text(at, middle, text, size=7.0, color=color)
