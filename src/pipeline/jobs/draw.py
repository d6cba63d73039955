"""Draw a picture from its datasets."""

from pathlib import Path

from pseudorigid.figures.canvas.render import render

from ..declaration import imported
from ..records.artifacts import load
from ..records.build_spec import BuildSpec
from ..records.files import write_whole


def make(spec: BuildSpec) -> None:
    """Draw with the function that the specification names."""
    figure = imported(spec.function)(spec.config, *map(load, spec.inputs))
    write_whole(spec.result, render(figure, Path(spec.result).suffix[1:]))
