"""Kinds of chart of the study, whose states and methods are fixed."""

from typing import Literal

from pipeline.config.schema.scene import Picture

DRAWN_BY = "study.charts.{}"  # the function of each kind that names no other one


class Work(Picture):
    """error and failures of each method against its time"""

    stages = ("work",)

    states: Literal["uniform", "grazing"]
    """Set of states before the flights: over the whole section, or close to grazing."""


class Edges(Picture):
    """the share of failures near grazing and near a touch of the floor"""

    stages = ("edges",)


class Energy(Picture):
    """the drift of the energy, and the impacts missed"""

    stages = ("drift",)


class Separation(Picture):
    """the distance of each method's orbit from the proved one"""

    stages = ("drift",)


class FigureErrors(Picture):
    """the error of each figure by each method"""

    stages = ("needs",)


class Misses(Picture):
    """the impacts missed in long runs, and at the hardest states that a search found"""

    stages = ("misses",)
