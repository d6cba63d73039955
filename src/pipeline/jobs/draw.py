"""Draw a picture from its datasets."""

from pathlib import Path
from typing import Any

from pseudorigid.figures.canvas.render import render

from ..declaration import hidden_by, imported
from ..records.artifacts import load
from ..records.build_spec import BuildSpec
from ..records.files import write_whole


def make(spec: BuildSpec) -> dict[str, Any]:
    """Draw with the function that the specification names; return what the axes hide."""
    datasets = [*map(load, spec.inputs)]
    figure = imported(spec.function)(spec.config, *datasets)
    name, kind = Path(spec.result).stem, spec.config["picture"]
    figure.set_label(f"{name}: {kind.replace('_', ' ')}")
    write_whole(spec.result, render(figure, Path(spec.result).suffix[1:]))
    return {"hidden": hidden_by(spec.function, spec.config, *datasets)}
