"""Write a figure as PNG, SVG or PDF, or figures as GIF, with the same bytes on every machine."""

import re
import struct
import zlib
from collections.abc import Iterable
from io import BytesIO

import deflate
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import style

_NO_METADATA = {
    "svg": {"Date": None, "Creator": None, "Format": None, "Type": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}

# In an SVG: a mark of matplotlib, thousands of one kind and colour, and the radius of a dot.
_MARK = rb'<use xlink:href="#%s" x="[\d.]+" y="[\d.]+" style="fill: %s"/>\s*'
_MANY_MARKS = re.compile(
    _MARK % (rb"(m\w+)", rb"(#\w+)") + rb"(?:" + _MARK % (rb"\1", rb"\2") + rb"){2000,}"
)
_PLACE = re.compile(rb'x="([\d.]+)" y="([\d.]+)"')
_DOT = re.compile(rb'<path id="(m\w+)" d="M 0 ([\d.]+) \nC')

_FRAME_TIME, _HOLD, _FADE = 80, 10, 6  # milliseconds, frames, frames
_COLORS, _PALE = 64, 240  # of a GIF: white, and others whose least part is below this


def render(figure: Figure, extension: str) -> bytes:
    """Return the bytes of a figure's file; `extension` is png, svg or pdf.

    The figure's label is the title of an SVG, which screen readers read.
    """
    if extension == "png":
        return png(pixels(figure), figure.dpi)
    stream = BytesIO()
    title = {"Title": str(figure.get_label())} if figure.get_label() else {}
    with style.pinned():
        figure.savefig(stream, format=extension, metadata=_NO_METADATA[extension] | title)
    return _with_merged_dots(stream.getvalue()) if extension == "svg" else stream.getvalue()


def _with_merged_dots(svg: bytes) -> bytes:
    """Write thousands of dots as one path of round points, a quarter as long as a mark for each."""
    radii = dict(_DOT.findall(svg))

    def path(marks: re.Match[bytes]) -> bytes:
        marker, color = marks.groups()
        if marker not in radii:
            return marks[0]
        places = ((float(x), float(y)) for x, y in _PLACE.findall(marks[0]))
        points = b"".join(b"M%.3f %.3fh0" % place for place in places)
        style = b"fill: none; stroke-linecap: round; stroke: %s; stroke-width: %g"
        style %= color, 2 * float(radii[marker])
        return b'<path d="%s" style="%s"/>\n' % (points, style)

    return _MANY_MARKS.sub(path, svg)


def pixels(figure: Figure) -> np.ndarray:
    """Render a figure to an array of uint8, shape (height, width, 3): red, green and blue."""
    with style.pinned():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    return np.ascontiguousarray(np.asarray(canvas.buffer_rgba())[..., :3])


def png(image: np.ndarray, dpi: float) -> bytes:
    """Encode an array of uint8, shape (height, width, 3), as PNG.

    The chunks are written here, so that the bytes depend on the image alone. Pillow would use the
    zlib that it was built with; the compressor here is libdeflate, which its wheel contains.
    """
    height, width, _ = image.shape
    rows = np.zeros((height, 1 + 3 * width), dtype=np.uint8)
    rows[:, 1:] = image.reshape(height, -1)
    per_metre = round(dpi / 0.0254)
    return b"".join(
        [
            b"\x89PNG\r\n\x1a\n",
            _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
            _chunk(b"sRGB", b"\0"),
            _chunk(b"pHYs", struct.pack(">IIB", per_metre, per_metre, 1)),
            _chunk(b"IDAT", bytes(deflate.zlib_compress(rows.tobytes(), 9))),
            _chunk(b"IEND", b""),
        ]
    )


def gif(figures: Iterable[Figure]) -> bytes:
    """Return the bytes of a GIF that shows figures of one size again and again.

    The last one is held and then fades into the first. Colours are mixed and reduced in whole
    numbers, by Pillow, whose version decides the bytes.
    """
    from PIL import Image

    images = [pixels(figure) for figure in figures]
    first, last = images[0].astype(int), images[-1].astype(int)
    mixed = ((last * (_FADE - i) + first * (i + 1)) // (_FADE + 1) for i in range(_FADE))
    images = [*images, *[images[-1]] * _HOLD, *(image.astype(np.uint8) for image in mixed)]
    sample = np.concatenate(images[:: len(images) // 12 or 1])
    inked = Image.fromarray(sample[sample.min(axis=2) < _PALE][np.newaxis])
    colors = inked.quantize(_COLORS - 1, method=Image.Quantize.MEDIANCUT).getpalette() or []
    palette = Image.new("P", (1, 1))
    palette.putpalette([*colors[: 3 * (_COLORS - 1)], 255, 255, 255])
    frames = [
        Image.fromarray(image).quantize(palette=palette, dither=Image.Dither.NONE)
        for image in images
    ]
    stream = BytesIO()
    frames[0].save(
        stream, "GIF", save_all=True, append_images=frames[1:], duration=_FRAME_TIME, loop=0
    )
    return stream.getvalue()


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
