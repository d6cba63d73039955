"""What a finished figure shows, apart from how it is encoded: pixels, or the elements of an SVG."""

import hashlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .files import open_regular, write_whole


class PictureError(ValueError):
    """A file that is no picture; the message names it."""


def pixels(path):
    """A PNG's pixels.

    Parameters
    ----------
    path : path

    Returns
    -------
    ndarray of uint8, shape (height, width, 3)

    Raises
    ------
    PictureError
        A file that is no picture.
    """
    from PIL import Image

    try:
        with open_regular(path) as file, Image.open(file) as image:
            return np.asarray(image.convert("RGB"))
    except Exception as error:  # of many kinds, among them SyntaxError
        raise PictureError(f"{path}: damaged, or not a picture") from error


def elements(path):
    """An SVG's tags and texts in order, attributes sorted.

    Parameters
    ----------
    path : path

    Returns
    -------
    list of str

    Raises
    ------
    PictureError
        A file that is no SVG.
    """
    try:
        with open_regular(path) as file:
            text = ElementTree.canonicalize(from_file=file, strip_text=True)
    except (ElementTree.ParseError, ValueError, LookupError, RecursionError) as error:
        raise PictureError(f"{path}: damaged, or not SVG ({error})") from error
    return text.replace("<", "\n<").split("\n")


def describe(path):
    """What the manifest says of a drawing.

    Parameters
    ----------
    path : path

    Returns
    -------
    dict
        Size and hash of its pixels or elements.

    Raises
    ------
    PictureError
        A file that is no picture.
    """
    if Path(path).suffix == ".png":
        image = pixels(path)
        size = {"height": image.shape[0], "width": image.shape[1]}
        return size | {"pixels": hashlib.sha256(image.tobytes()).hexdigest()}
    text = elements(path)
    digest = hashlib.sha256("\n".join(text).encode()).hexdigest()
    return {"elements": len(text), "text": digest}


def difference(path, reference, image_path):
    """How a drawing differs from the reference of its kind, in words and as an image.

    Parameters
    ----------
    path, reference : path
    image_path : path
        Of PNGs of one size an image is saved there: the reference in pale grey, what differs in
        red.

    Returns
    -------
    words : str
    saved : bool
        Whether there is an image.

    Raises
    ------
    PictureError
        A file that is no picture.
    """
    if Path(path).suffix != ".png":
        ours, theirs = elements(path), elements(reference)
        both = min(len(ours), len(theirs))
        different = [i for i in range(both) if ours[i] != theirs[i]]
        count = len(different) + abs(len(ours) - len(theirs))
        first = ours[different[0]] if different else (ours + theirs)[both]
        first = first if len(first) <= 60 else first[:57] + "..."
        return f"{count:,} of {len(theirs):,} elements differ, the first: {first}", False
    ours, theirs = pixels(path), pixels(reference)
    if ours.shape != theirs.shape:
        (high, wide, _), (old_high, old_wide, _) = ours.shape, theirs.shape
        return f"{wide} x {high} pixels instead of {old_wide} x {old_high}", False
    where = np.any(ours != theirs, axis=2)
    shown = np.repeat(170 + theirs.mean(axis=2, keepdims=True) / 3, 3, axis=2).astype(np.uint8)
    shown[where] = (220, 0, 0)
    from pseudorigid.figures.canvas.render import png

    write_whole(image_path, png(shown, 300))
    count = int(where.sum())
    verb = "differs" if count == 1 else "differ"
    return f"{count:,} of {where.size:,} pixels {verb}", True
