"""Comparison of two variants, figure by figure: ./reproduce compare A B.

Nothing is computed here: both variants must have their results.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont, ImageOps

from ..config import paths
from ..config.build_specs import of_variants
from ..config.schema.fields import YamlMapping
from ..records.artifacts import load
from ..records.differences import brief, columns, differing_keys
from ..records.files import replacing
from ..records.pictures import pixels
from .freshness import CURRENT, Freshness
from .quantities import measured

_HEAD = 75  # pixels
_SIZE = 42  # pixels


def compare(
    root: Path, variants: paths.Variants, names: Sequence[str], scenes: Sequence[str]
) -> None:
    """Print what differs between two variants and save their figures side by side."""
    freshness = Freshness(root, of_variants(variants, names))
    print(" | ".join(names))
    for scene in scenes:
        drawings = {name: paths.drawn(scene, "png", name) for name in names}
        states = {name: freshness.state(path) for name, path in drawings.items()}
        present = {n: root / path for n, path in drawings.items() if states[n] == CURRENT}
        lines = [*_config_differences(*(variants[name][scene] for name in names))]
        lines += [f"{name}: {states[name]}" for name in names if name not in present]
        if len(present) == len(names):
            lines += _data_differences(root, variants, names, scene)
        image = root / f"results/compare/{'..'.join(names)}/{scene}.png"
        if present:
            _side_by_side({name: present.get(name) for name in names}, image)
            lines.append(f"side by side: {image.relative_to(root)}")
        else:
            with suppress(OSError):
                image.unlink()  # left by an earlier comparison
        print(f"\n{scene}", *(f"  {line}" for line in lines), sep="\n")


def _config_differences(first: YamlMapping, second: YamlMapping) -> Iterator[str]:
    """Yield a line for each key of the config that differs, except derived axes."""
    before, after = (paths.drawing(block) | {"axes": None} for block in (first, second))
    keys = differing_keys(before, after)
    yield from [f"{key}: {brief(a)} | {brief(b)}" for key, a, b in keys] or ["the same config"]


def _data_differences(
    root: Path, variants: paths.Variants, names: Sequence[str], scene: str
) -> Iterator[str]:
    """Yield which datasets differ, and a line for each reported quantity in both variants."""
    files, differing = paths.artifact_paths(variants), []
    for stage in paths.stages(variants[names[0]][scene]):
        first, second = (load(root / files[name, scene, stage]) for name in names)
        differing += [] if first.equals(second) else [stage]
    yield f"other numbers in {', '.join(differing)}" if differing else "the same numbers"
    ours, theirs = (measured(root, variants, name, scene) for name in names)
    rows = [(key, ours.get(key, ""), theirs.get(key, "")) for key in ours | theirs]
    yield from columns([("", *names), *rows])


def _side_by_side(drawings: Mapping[str, Path | None], path: Path) -> None:
    """Save two PNG side by side, each below its name. None is a figure that is not there."""
    images = [Image.fromarray(pixels(file)) if file else None for file in drawings.values()]
    blank = Image.new("RGB", next(filter(None, images)).size, "white")
    framed = [ImageOps.expand(image or blank, (0, _HEAD, 0, 0), "white") for image in images]
    size = sum(image.width for image in framed), max(image.height for image in framed)
    both, left = Image.new("RGB", size, "white"), 0
    for name, image, column in zip(drawings, images, framed, strict=True):
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
