"""Draw a picture from its datasets."""

from importlib import import_module

from ..records.artifacts import load
from ..records.build_spec import BuildSpec
from ..records.drawings import save_figure


def make(spec: BuildSpec) -> None:
    """Draw with the module of figures that the specification names."""
    picture = import_module(f"pseudorigid.figures.{spec.given}")
    data = [load(path) for path in spec.inputs]
    save_figure(picture.draw(spec.config, *data), spec.result)
