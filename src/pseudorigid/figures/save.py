"""The one door through which a picture is saved: PNG, SVG or PDF, the same bytes everywhere."""

import struct
import zlib
from io import BytesIO
from pathlib import Path

import deflate
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from ..files import replacing
from . import style

FORMATS = ("png", "svg", "pdf")
_NOTHING = {
    "svg": {"Date": None, "Creator": None, "Format": None, "Type": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def save(figure, path):
    """Save `figure` to `path` in the format of its suffix, whole or not at all; return the path.

    Raises ValueError for a suffix other than .png, .svg or .pdf.
    """
    path = Path(path)
    kind = path.suffix[1:]
    if kind not in FORMATS:
        raise ValueError(f"{path}: a picture is one of {', '.join(FORMATS)}")
    if kind == "png":
        data = png(pixels(figure), figure.dpi)
    else:
        stream = BytesIO()
        with style.pinned():
            figure.savefig(stream, format=kind, metadata=_NOTHING[kind])
        data = stream.getvalue()
    with replacing(path) as part:
        part.write_bytes(data)
    return path


def pixels(figure):
    """Return the rendered figure as (height, width, 3) bytes, red, green and blue."""
    with style.pinned():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    return np.ascontiguousarray(np.asarray(canvas.buffer_rgba())[..., :3])


def png(image, dpi):
    """Encode (height, width, 3) bytes as PNG.

    The bytes depend on the image alone: rows are left unfiltered (smallest for drawings, whose
    colours are few) and the compressor is libdeflate, from its own wheel, not the system's zlib.
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


def _chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
