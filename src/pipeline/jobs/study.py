"""Compute a part of the study: data that are the same everywhere, or measurements."""

from functools import partial
from importlib import import_module

from pseudorigid.study import failures, figure_errors, states, work
from pseudorigid.study.machine import machine

from ..records import artifacts


def _libraries():
    """The rivals whose packages only the study has."""
    names = ("scipy_events", "taylor")
    return [m for n in names for m in import_module(f"pseudorigid.study.methods.{n}").METHODS]


def _edge_rivals():
    """Of the libraries, the settings that are compared near grazing."""
    names = ("certified march", "brentq 0.1, 1e-12", "RK45, 1e-06", "DOP853, 1e-09")
    names += ("DOP853, steps <= 0.1, 1e-12", "LSODA, 1e-09")
    names += ("heyoka any, 1e-15", "heyoka positive, 1e-15")
    return [m for m in (failures.OURS, *_libraries()) if m.name in names]


def _errors_of_figures(spec):
    """Compare the scenes of the block with the figures' own datasets."""
    loaded = {(stage, scene): artifacts.load(path) for stage, scene, path in spec.given}
    return figure_errors.figure_errors(spec.config["scenes"], spec.config["measures"], loaded)


def make(spec):
    """Compute the result of a BuildSpec; measurements say on which machine."""
    part = spec.config["part"]
    compute = {
        "work": work.counted,
        "edges": lambda: failures.edges(failures.EDGE_METHODS),
        "orbits": failures.orbits,
        "needs": partial(_errors_of_figures, spec),
        "verdicts": lambda: import_module("pseudorigid.study.verdicts").verdicts(),
        "work_all": lambda: work.measured([*work.METHODS, *_libraries()]),
        "edges_all": lambda: failures.edges(_edge_rivals(), 40),
        "missed_all": lambda: failures.missed(_edge_rivals()),
    }[part]
    dataset = compute()
    if part.endswith("_all"):
        dataset.attrs |= machine()
    ball = {"k": states.BALL.k, "g": states.BALL.g, "energy": states.ENERGY}
    about = {} if part == "verdicts" else ball  # verdicts are on cells of many
    about |= {"stage": "study", "title": f"Methods compared: {part}"}
    artifacts.save(dataset, spec.result, {"part": part}, **about)
