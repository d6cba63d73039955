"""Draw a picture from its datasets, by the module of figures that the specification names."""

from importlib import import_module

from ..records.artifacts import load
from ..records.drawings import save_figure


def make(spec):
    """Draw the result of a BuildSpec."""
    picture = import_module(f"pseudorigid.figures.{spec.given}")
    data = [load(path) for path in spec.inputs]
    save_figure(picture.draw(spec.config, *data), spec.result)
