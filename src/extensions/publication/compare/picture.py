"""Two figures side by side, on the same axes."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import xarray as xr
from PIL import Image, ImageDraw, ImageFont, ImageOps

from pipeline.config.results import drawing
from pipeline.config.schema.fields import YamlMapping
from pipeline.config.schema.scene import Picture
from pipeline.declaration import imported
from pipeline.records.files import replacing
from pseudorigid.figures.axes.limits import of_data
from pseudorigid.figures.canvas import render

_HEAD = 75  # pixels
_SIZE = 42  # pixels
_MOST = 50  # times the width of an axis that the axis of both may have

Pixels = npt.NDArray[np.uint8]


def on_same_axes(
    blocks: Sequence[Picture], data: Sequence[Sequence[xr.Dataset]]
) -> tuple[list[Pixels], str]:
    """Draw a scene of two variants on axes that hold both; return the pixels and words on the axes.

    Each keeps its own axes if the kind of picture has none in the config, or if one of the pictures
    would shrink to a spot.
    """
    draw = imported(blocks[0].drawn_by)
    found: list[dict[str, Any]] = [{}, {}]
    figures = [
        draw(drawing(block) | {"completed": axes}, *datasets)
        for block, axes, datasets in zip(blocks, found, data, strict=True)
    ]
    both = {name: _around(*(axes[name] for axes in found)) for name in found[0]}
    spots = [
        name for name in both for axes in found if _width(both[name]) > _MOST * _width(axes[name])
    ]
    if spots or not both:
        why = f": one of both is too wide along {spots[0]}" if spots else ""
        return [render.pixels(figure) for figure in figures], f", each on its own axes{why}"
    for i, axes in enumerate(found):
        if axes != both:
            figures[i] = draw(drawing(blocks[i]) | {"axes": both}, *data[i])
    return [render.pixels(figure) for figure in figures], ", on the same axes"


def _around(first: YamlMapping, second: YamlMapping) -> YamlMapping:
    """Return the axis that holds both, the wider one of them if it does."""
    (low, high), (other_low, other_high) = first["limits"], second["limits"]
    low, high = min(low, other_low), max(high, other_high)
    made: YamlMapping = of_data([low, high], room=0.0, margin=0.08, most=6)
    return next((axis for axis in (first, second) if list(axis["limits"]) == [low, high]), made)


def _width(axis: YamlMapping) -> float:
    """Return the distance of the limits of an axis."""
    low, high = axis["limits"]
    return float(high - low)


def side_by_side(drawings: Mapping[str, Pixels | None], path: Path) -> None:
    """Save two pictures side by side, each below its name. None means a missing picture."""
    images = [None if part is None else Image.fromarray(part) for part in drawings.values()]
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
