"""Compare what finished figures show: pixels of a PNG or GIF, or elements of an SVG."""

import hashlib
import io
import os
from itertools import zip_longest
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from .files import FileError, read_bytes, read_text, write_whole

_Path = str | os.PathLike[str]


def pixels(path: _Path) -> npt.NDArray[np.uint8]:
    """Return the pixels of a PNG, shape (height, width, 3), or of a GIF, whose frames are stacked.

    Raises FileError for other files.
    """
    from PIL import Image, ImageSequence

    try:
        with Image.open(io.BytesIO(read_bytes(path))) as image:
            frames = [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(image)]
            return np.concatenate(frames)
    except Exception as error:  # Pillow raises many types, among them SyntaxError
        raise FileError(f"{path}: damaged, or not a picture") from error


def _elements(path: _Path) -> list[str]:
    """Return the lines of an SVG, of which each begins with a tag; attributes are sorted.

    An element is two of them, its start tag and its end tag. The first line is empty.
    """
    try:
        text = ElementTree.canonicalize(read_text(path), strip_text=True)
    except (ElementTree.ParseError, ValueError, LookupError, RecursionError) as error:
        raise FileError(f"{path}: damaged, or not SVG ({error})") from error
    return text.replace("<", "\n<").split("\n")


def drawing_hash(path: _Path) -> str:
    """Return a hash of a PNG's or GIF's pixels or an SVG's elements; raises FileError."""
    if Path(path).suffix == ".svg":
        return hashlib.sha256("\n".join(_elements(path)).encode()).hexdigest()
    image = pixels(path)
    return hashlib.sha256(str(image.shape).encode() + image.tobytes()).hexdigest()


def picture_difference(path: _Path, reference: _Path, image_path: _Path) -> str:
    """Describe how a drawing differs from its reference.

    For two PNGs or GIFs of one size, `image_path` gets the reference in pale grey, with the
    differing pixels in red, and the words name it. Raises FileError if a file is no picture.
    """
    if Path(path).suffix == ".svg":
        return _differing_elements(_elements(path), _elements(reference))
    ours, theirs = pixels(path), pixels(reference)
    if ours.shape != theirs.shape:
        (height, width, _), (old_height, old_width, _) = ours.shape, theirs.shape
        return f"{width} x {height} pixels instead of {old_width} x {old_height}"
    differs = np.any(ours != theirs, axis=2)
    shown = np.repeat(170 + theirs.mean(axis=2, keepdims=True) / 3, 3, axis=2).astype(np.uint8)
    shown[differs] = (220, 0, 0)
    from pseudorigid.figures.canvas.render import png

    write_whole(image_path, png(shown, 300))
    count = int(differs.sum())
    verb = "differs" if count == 1 else "differ"
    return f"{count:,} of {differs.size:,} pixels {verb}: see {image_path}"


def _differing_elements(ours: list[str], theirs: list[str]) -> str:
    """Say how many lines of `_elements` differ in two SVGs, and which is the first.

    Lines are compared place by place: after one that is inserted, most others differ too.
    """
    different = [a or b for a, b in zip_longest(ours, theirs) if a != b]
    first = different[0] if len(different[0]) <= 60 else different[0][:57] + "..."
    return f"{len(different):,} of {len(theirs):,} elements differ, the first: {first}"
