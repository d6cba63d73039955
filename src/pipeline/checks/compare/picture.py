"""Two figures side by side."""

import numpy as np

from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels, png
from pseudorigid.figures.canvas.sheet import POINT, Sheet

from ...records.files import write_whole
from ...records.pictures import pixels as read

_HEAD = 75  # pixels


def side_by_side(drawings, names, path):
    """Save to `path` two PNG, each under its name; None stands for a figure that cannot exist."""
    images = [drawing and read(drawing) for drawing in drawings]
    size = next(image.shape for image in images if image is not None)
    images = [image if image is not None else _nothing(size) for image in images]
    high = max(image.shape[0] for image in images)
    parts = []
    for image, name in zip(images, names, strict=True):
        below = np.full((high - image.shape[0], image.shape[1], 3), 255, dtype=np.uint8)
        parts.append(np.concatenate([_head(name, image.shape[1]), image, below]))
    write_whole(path, png(np.concatenate(parts, axis=1), style.DPI))


@style.pinned()
def _head(name, wide):
    sheet = Sheet(wide, _HEAD)
    sheet.text(wide / 2, 5 * POINT, name, ha="center", va="bottom", size=10.0)
    return pixels(sheet.figure)


@style.pinned()
def _nothing(shape):
    high, wide, _ = shape
    sheet = Sheet(wide, high)
    sheet.text(wide / 2, high / 2, "cannot exist", ha="center", va="center", size=10.0)
    return pixels(sheet.figure)
