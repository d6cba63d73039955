"""Pictures behind the verdicts on the paper's statements."""

from typing import Any

from matplotlib.figure import Figure

__all__ = ["Figure", "Frame", "Scene"]  # for the annotations of the modules beside this one
Frame = tuple[float, float, float, float]  # left, bottom, right, top of a panel, in pixels
Scene = dict[str, Any]  # a scene's block of the config
