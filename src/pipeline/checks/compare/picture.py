"""Two figures side by side."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels, png
from pseudorigid.figures.canvas.sheet import POINT, Sheet

from ...records.files import write_whole
from ...records.pictures import pixels as read

_HEAD = 75  # pixels


def side_by_side(drawings: Sequence[Path | None], names: Sequence[str], path: Path) -> None:
    """Save two PNG side by side, each below its name. None is a figure that cannot exist."""
    height, width, _ = next(read(drawing).shape for drawing in drawings if drawing)
    images = [
        read(drawing) if drawing else _label("cannot exist", width, height) for drawing in drawings
    ]
    high = max(image.shape[0] for image in images)
    parts = []
    for image, name in zip(images, names, strict=True):
        below = np.full((high - image.shape[0], image.shape[1], 3), 255, dtype=np.uint8)
        head = _label(name, image.shape[1], _HEAD, 5 * POINT, "bottom")
        parts.append(np.concatenate([head, image, below]))
    write_whole(path, png(np.concatenate(parts, axis=1), style.DPI))


@style.pinned()
def _label(
    text: str, width: int, height: int, y: float | None = None, va: str = "center"
) -> np.ndarray:
    """Draw a text on a white image of this size, by default in its middle."""
    sheet = Sheet(width, height)
    sheet.text(width / 2, height / 2 if y is None else y, text, ha="center", va=va, size=10.0)
    return np.asarray(pixels(sheet.figure))
