"""Figures of variants side by side, on the same axes."""

from collections.abc import Mapping, Sequence
from functools import partial, reduce
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import numpy.typing as npt
import xarray as xr
from matplotlib.figure import Figure
from PIL import Image, ImageDraw, ImageFont, ImageOps

from pipeline.config.results import drawing
from pipeline.config.schema.fields import YamlMapping
from pipeline.config.schema.scene import Picture
from pipeline.declaration import imported
from pipeline.records.files import replacing
from pseudorigid.figures.axes.limits import of_data
from pseudorigid.figures.canvas import render, style

_FONT = f"{matplotlib.get_data_path()}/fonts/ttf/STIXGeneral.ttf"  # of all pictures
_TEXT = 1 / 30  # of the width of the whole: size of texts, 11 pixels of 335
_WIDEST = 4 * style.COLUMN  # pixels
_MOST = 50  # times the width of an axis that the axis of all may have

Pixels = npt.NDArray[np.uint8]


def on_same_axes(
    blocks: Sequence[Picture], data: Sequence[Sequence[xr.Dataset]]
) -> tuple[list[Pixels], str]:
    """Draw a scene of variants on axes that hold all; return the pixels and words on the axes.

    Each keeps its own axes if the kind of picture has none in the config, if one of the pictures
    would shrink to a spot, or if windows have nothing in common.
    """
    draw = imported(blocks[0].drawn_by)
    found: list[dict[str, Any]] = [{} for _ in blocks]
    figures = [
        draw(drawing(block) | {"completed": axes}, *datasets)
        for block, axes, datasets in zip(blocks, found, data, strict=True)
    ]
    shared = {name: reduce(_around, (axes[name] for axes in found)) for name in found[0]}
    widths = {name: [np.ptp(axes[name]["limits"]) for axes in found] for name in shared}
    spots = [n for n in shared if np.ptp(shared[n]["limits"]) > _MOST * min(widths[n])]
    ends = {n: np.transpose([axes[n]["limits"] for axes in found]) for n in shared}
    apart = [n for n, (low, high) in ends.items() if max(low) >= min(high)]
    if spots or apart or not shared:
        why = f": one of them is too wide along {spots[0]}" if spots else ""
        why = f": they have nothing in common along {apart[0]}" if apart else why
        return [render.pixels(figure) for figure in figures], f", each on its own axes{why}"
    for i, axes in enumerate(found):
        if axes != shared:
            figures[i] = draw(drawing(blocks[i]) | {"axes": shared}, *data[i])
    return [render.pixels(figure) for figure in figures], ", on the same axes"


def _around(first: YamlMapping, second: YamlMapping) -> YamlMapping:
    """Return the axis that holds both, the wider one of them if it does."""
    (low, high), (other_low, other_high) = first["limits"], second["limits"]
    low, high = min(low, other_low), max(high, other_high)
    made: YamlMapping = of_data([low, high], room=0.0, margin=0.08, most=6)
    return next((axis for axis in (first, second) if list(axis["limits"]) == [low, high]), made)


def side_by_side(
    drawings: Mapping[str, Pixels | None], path: Path, curves: Figure | None = None
) -> None:
    """Save pictures side by side, each below its name, and perhaps curves below them all.

    None means a missing picture. The whole has at most _WIDEST pixels from side to side.
    """
    images = [None if part is None else Image.fromarray(part) for part in drawings.values()]
    blank = Image.new("RGB", next(filter(None, images)).size, "white")
    row = [image or blank for image in images]
    scale = min(1.0, _WIDEST / sum(image.width for image in row))
    row = [ImageOps.scale(image, scale) if scale < 1.0 else image for image in row]
    wide, high = sum(image.width for image in row), max(image.height for image in row)
    size = round(_TEXT * wide)
    head, below = 2 * size, None
    if curves:
        curves.set_dpi(style.DPI * wide / style.COLUMN)
        below = Image.fromarray(render.pixels(curves))
    whole = Image.new("RGB", (wide, head + high + (below.height if below else 0)), "white")
    write, left = partial(ImageDraw.Draw(whole).text, fill="black", anchor="mm"), 0
    for name, image, known in zip(drawings, row, images, strict=True):
        whole.paste(image, (left, head))
        texts = {head / 2: name} | ({} if known else {head + high / 2: "no figure"})
        for y, text in texts.items():
            font = ImageFont.truetype(_FONT, size)
            fits = min(1.0, 0.95 * image.width / font.getlength(text))
            write((left + image.width / 2, y), text, font=font.font_variant(size=size * fits))
        left += image.width
    if below:
        whole.paste(below, (0, head + high))
    with replacing(path) as part:
        whole.save(part, "PNG")
