"""What must hold for the text of every picture."""

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.transforms import Bbox

from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels


def frames_of(figure):
    """The outlines of a figure's panels, in pixels."""
    lines = [line for line in figure.artists if len(line.get_xdata()) == 5]
    lines = [line for line in lines if line.get_color() == style.FRAME and line.get_zorder() == 3]
    return [Bbox(line.get_xydata()[[0, 2]] * figure.dpi) for line in lines]


def assert_text_is_whole_and_apart(figure, margin=4, slack=0):
    with style.pinned():
        renderer = FigureCanvasAgg(figure).get_renderer()
        boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in figure.texts]
    wide, high = figure.bbox.size
    for text, extent in boxes:
        assert min(extent.x0, extent.y0) >= margin, text
        assert extent.x1 <= wide - margin, text
        assert extent.y1 <= high - margin, text
    for place, (text, extent) in enumerate(boxes):
        for other, second in boxes[:place]:
            assert not extent.overlaps(second.padded(-slack)), (text, other)
        for frame in frames_of(figure):
            inside = frame.x0 <= extent.x0 and extent.x1 <= frame.x1
            inside = inside and frame.y0 <= extent.y0 and extent.y1 <= frame.y1
            assert inside or not frame.overlaps(extent), f"{text} lies across a frame"
    image = pixels(figure)
    rim = max(margin - 1, 1)
    for side in (image[:rim], image[-rim:], image[:, :rim], image[:, -rim:]):
        assert (side == 255).all()
