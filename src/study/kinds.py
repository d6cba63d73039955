"""Kinds of chart of the study, whose states and methods are fixed."""

from typing import Literal

from pipeline.config.schema.fields import NoFormats
from pipeline.config.schema.scene import Picture

DRAWN_BY = "study.charts.{}"  # the function of each kind that names no other one


class Work(Picture):
    """error and failures of each method against its cost"""

    stages = ("work",)

    states: Literal["uniform", "grazing"]
    """Set of states before the flights: over the whole section, or close to grazing."""
    cost: Literal["evaluations", "seconds"] = "evaluations"
    """What is drawn across: evaluations of the gap a flight, or its seconds on this machine."""


class MeasuredWork(Work):
    """error and failures of each method, with external solvers, against its cost"""

    stages = ("work_all",)
    drawn_by = "study.charts.work"


class Edges(Picture):
    """the share of failures near grazing and near a touch of the floor"""

    stages = ("edges",)


class MeasuredEdges(Picture):
    """the share of failures near grazing and near a touch of the floor, with external solvers"""

    stages = ("edges_all",)
    drawn_by = "study.charts.edges"


class Energy(Picture):
    """the drift of the energy, and the impacts missed"""

    stages = ("drift",)


class Separation(Picture):
    """the distance of each method's orbit from the proved one"""

    stages = ("drift",)


class FigureErrors(Picture):
    """the error of each figure by each method"""

    stages = ("needs",)


class MissedImpacts(Picture):
    """data of the impacts that each method misses, without a picture"""

    stages = ("missed_all",)

    formats: NoFormats = []
