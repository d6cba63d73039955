"""The one door through which pictures are saved."""

from pathlib import Path

from pseudorigid.figures.canvas.render import render

from .files import write_whole


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
    write_whole(path, render(figure, Path(path).suffix[1:]))
