"""The one door through which pictures are saved."""

from pathlib import Path

from pseudorigid.figures.canvas.render import render

from .files import replacing


def save_figure(figure, path):
    """Save a picture in the format of its suffix, whole or not at all.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    path : path

    Raises
    ------
    ValueError
        Another suffix than .png, .svg and .pdf.
    FileError
        A file that cannot be written.
    """
    data = render(figure, Path(path).suffix[1:])
    with replacing(path) as part:
        part.write_bytes(data)
