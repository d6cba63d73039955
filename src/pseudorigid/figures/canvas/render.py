"""The one way from a picture to a file's bytes: PNG, SVG or PDF, the same everywhere."""

import struct
import zlib
from io import BytesIO

import deflate
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from . import style

FORMATS = ("png", "svg", "pdf")
_NOTHING = {
    "svg": {"Date": None, "Creator": None, "Format": None, "Type": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def render(figure, extension):
    """A figure as the bytes of a file.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    extension : {"png", "svg", "pdf"}

    Returns
    -------
    bytes

    Raises
    ------
    ValueError
        Another extension.
    """
    if extension not in FORMATS:
        raise ValueError(f"{extension}: a picture is one of {', '.join(FORMATS)}")
    if extension == "png":
        return png(pixels(figure), figure.dpi)
    stream = BytesIO()
    with style.pinned():
        figure.savefig(stream, format=extension, metadata=_NOTHING[extension])
    return stream.getvalue()


def pixels(figure):
    """The rendered figure.

    Parameters
    ----------
    figure : matplotlib.figure.Figure

    Returns
    -------
    ndarray of uint8, shape (height, width, 3)
        Red, green and blue.
    """
    with style.pinned():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    return np.ascontiguousarray(np.asarray(canvas.buffer_rgba())[..., :3])


def png(image, dpi):
    """An image as PNG, written here chunk by chunk so that the bytes depend on the image alone.

    Rows are left unfiltered (smallest for drawings, whose colours are few) and the compressor is
    libdeflate, from its own wheel, where Pillow takes the zlib that it was built with.

    Parameters
    ----------
    image : ndarray of uint8, shape (height, width, 3)
    dpi : float

    Returns
    -------
    bytes
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
