"""Save pictures."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

from pseudorigid.figures.canvas.render import render

from .files import write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def save_figure(figure: "Figure", path: str | os.PathLike[str]) -> None:
    """Save a figure as .png, .svg or .pdf, whole or not at all.

    Raises
    ------
    ValueError
        If the suffix is another one.
    FileError
        If the file cannot be written.
    """
    write_whole(path, render(figure, Path(path).suffix[1:]))
