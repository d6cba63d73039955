"""Draw a picture from its datasets."""

from importlib import import_module
from pathlib import Path

from pseudorigid.figures.canvas.render import render

from ..records.artifacts import load
from ..records.build_spec import BuildSpec
from ..records.files import write_whole


def make(spec: BuildSpec) -> None:
    """Draw with the module of figures that the specification names."""
    picture = import_module(f"pseudorigid.figures.{spec.given}")
    figure = picture.draw(spec.config, *map(load, spec.inputs))
    write_whole(spec.result, render(figure, Path(spec.result).suffix[1:]))
