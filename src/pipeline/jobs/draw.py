"""Draw a picture from its datasets."""

from pathlib import Path
from typing import Any

from pseudorigid.figures.canvas.render import gif, render

from ..declaration import hidden_by, imported
from ..records.artifacts import load
from ..records.files import write_whole
from ..records.provenance import BuildSpec


def make(spec: BuildSpec) -> dict[str, Any]:
    """Draw with the function that the specification names; return what the axes hide.

    The frames of a GIF are drawn by the function `moving` beside it.
    """
    datasets = [*map(load, spec.inputs)]
    suffix = Path(spec.result).suffix[1:]
    if suffix == "gif":
        module = spec.function.rpartition(".")[0]
        content = gif(imported(f"{module}.moving")(spec.config, *datasets))
    else:
        figure = imported(spec.function)(spec.config, *datasets)
        figure.set_label(f"{Path(spec.result).stem}: {spec.config['picture'].replace('_', ' ')}")
        content = render(figure, suffix)
    write_whole(spec.result, content)
    return {"hidden": hidden_by(spec.function, spec.config, *datasets)}
