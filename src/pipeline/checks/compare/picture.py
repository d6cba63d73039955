"""Two figures side by side."""

from collections.abc import Mapping
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont, ImageOps

from ...records.files import replacing
from ...records.pictures import pixels

_HEAD = 75  # pixels
_SIZE = 42  # pixels


def side_by_side(drawings: Mapping[str, Path | None], path: Path) -> None:
    """Save two PNG side by side, each below its name. None is a figure that is not there."""
    images = [Image.fromarray(pixels(file)) if file else None for file in drawings.values()]
    blank = Image.new("RGB", next(filter(None, images)).size, "white")
    columns = [ImageOps.expand(image or blank, (0, _HEAD, 0, 0), "white") for image in images]
    size = sum(column.width for column in columns), max(column.height for column in columns)
    both, left = Image.new("RGB", size, "white"), 0
    for name, image, column in zip(drawings, images, columns, strict=True):
        _write(column, name, _HEAD / 2)
        if image is None:
            _write(column, "no figure", (_HEAD + column.height) / 2)
        both.paste(column, (left, 0))
        left += column.width
    with replacing(path) as part:
        both.save(part, "PNG")


def _write(image: Image.Image, text: str, y: float) -> None:
    """Write a text in the middle of a line of an image."""
    font = ImageFont.load_default(_SIZE)
    ImageDraw.Draw(image).text((image.width / 2, y), text, "black", font, anchor="mm")
