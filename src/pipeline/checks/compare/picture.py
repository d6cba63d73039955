"""Two figures side by side."""

from collections.abc import Mapping
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from ...records.files import replacing
from ...records.pictures import pixels

_HEAD = 75  # pixels
_SIZE = 42  # pixels


def side_by_side(drawings: Mapping[str, Path | None], path: Path) -> None:
    """Save two PNG side by side, each below its name. None is a figure that cannot exist."""
    images = {name: Image.fromarray(pixels(file)) for name, file in drawings.items() if file}
    for name in drawings.keys() - images.keys():
        images[name] = Image.new("RGB", next(iter(images.values())).size, "white")
        _write(images[name], "cannot exist", images[name].height / 2)
    width = sum(image.width for image in images.values())
    height = max(image.height for image in images.values())
    both, left = Image.new("RGB", (width, _HEAD + height), "white"), 0
    for name in drawings:
        head = Image.new("RGB", (images[name].width, _HEAD), "white")
        _write(head, name, _HEAD / 2)
        both.paste(head, (left, 0))
        both.paste(images[name], (left, _HEAD))
        left += images[name].width
    with replacing(path) as part:
        both.save(part, "PNG")


def _write(image: Image.Image, text: str, y: float) -> None:
    """Write a text in the middle of a line of an image."""
    font = ImageFont.load_default(_SIZE)
    ImageDraw.Draw(image).text((image.width / 2, y), text, "black", font, anchor="mm")
