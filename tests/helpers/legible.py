"""A check of a picture's text."""

from itertools import combinations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.transforms import Bbox

from helpers.colours import assert_colours_apart
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels


def frames_of(figure):
    """Return the outlines of a figure's panels in pixels."""
    lines = [line for line in figure.artists if len(line.get_xdata()) == 5]
    lines = [line for line in lines if line.get_color() == style.FRAME and line.get_zorder() == 3]
    return [Bbox(line.get_xydata()[[0, 2]] * figure.dpi) for line in lines]


def pixels_in_frames(figure, color):
    """Return how many pixels of a colour #rrggbb each panel of a figure has, in or on its frame."""
    image, high = pixels(figure).astype(int), int(figure.bbox.height)
    near = np.abs(image - [*bytes.fromhex(color[1:])]).max(axis=2) < 3
    boxes = [(int(value) for value in frame.padded(10).extents) for frame in frames_of(figure)]
    return [int(near[high - y1 : high - y0, x0:x1].sum()) for x0, y0, x1, y1 in boxes]


def assert_legible(figure, slack=0):
    """Fail if colours are too near, or a text crosses a frame, covers another by `slack`,

    or a text or a mark comes nearer than a millimetre to the edge of a picture of a column's width.
    """
    assert_colours_apart(figure)
    margin = 12 * max(figure.bbox.width / style.COLUMN, 1)  # pixels
    with style.pinned():
        renderer = FigureCanvasAgg(figure).get_renderer()
        boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in figure.texts]
        boxes = [box for box in boxes if box[0]]
    wide, high = figure.bbox.size
    for text, extent in boxes:
        assert min(extent.x0, extent.y0) >= margin, text
        assert extent.x1 <= wide - margin and extent.y1 <= high - margin, text
        for frame in frames_of(figure):
            inside = frame.x0 <= extent.x0 and extent.x1 <= frame.x1
            inside = inside and frame.y0 <= extent.y0 and extent.y1 <= frame.y1
            assert inside or not frame.overlaps(extent), f"{text} lies across a frame"
    for (text, extent), (other_text, other) in combinations(boxes, 2):
        assert not other.overlaps(extent.padded(-slack)), (text, other_text)
    image, rim = pixels(figure), int(margin) - 1
    for side in (image[:rim], image[-rim:], image[:, :rim], image[:, -rim:]):
        assert (side == 255).all()
