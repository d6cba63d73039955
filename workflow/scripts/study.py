"""One part of the study: data that are the same everywhere, or measurements with their machine."""

from importlib import import_module

from pipeline.records import artifacts
from pipeline.records.job import one_line_errors, recorded
from pseudorigid.study import failures, figure_errors, states, work
from pseudorigid.study.machine import machine


def libraries():
    """The rivals whose packages only the study has."""
    names = ("scipy_events", "taylor")
    return [m for n in names for m in import_module(f"pseudorigid.study.methods.{n}").METHODS]


def edge_rivals():
    """Of the libraries, the settings that are compared near grazing."""
    names = ("certified march", "brentq 0.1, 1e-12", "RK45, 1e-06", "DOP853, 1e-09")
    names += ("DOP853, steps <= 0.1, 1e-12", "LSODA, 1e-09")
    names += ("heyoka any, 1e-15", "heyoka positive, 1e-15")
    return [m for m in (failures.OURS, *libraries()) if m.name in names]


def errors_of_figures():
    """Of the scenes that the block has, with the figures' own artifacts that they take."""
    block, taken = snakemake.params.block, snakemake.params.given
    loaded = {(stage, scene): artifacts.load(path) for stage, scene, path in taken}
    return figure_errors.figure_errors(block["scenes"], block["measures"], loaded)


PARTS = {
    "work": work.counted,
    "edges": lambda: failures.edges(failures.EDGE_METHODS),
    "orbits": failures.orbits,
    "needs": errors_of_figures,
    "verdicts": lambda: import_module("pseudorigid.study.verdicts").verdicts(),
    "work_all": lambda: work.measured([*work.METHODS, *libraries()]),
    "edges_all": lambda: failures.edges(edge_rivals(), 40),
    "missed_all": lambda: failures.missed(edge_rivals()),
}

with one_line_errors(snakemake), recorded(snakemake):
    part = snakemake.wildcards.scene
    dataset = PARTS[part]()
    if part.endswith("_all"):
        dataset.attrs |= machine()
    ball = {"k": states.BALL.k, "g": states.BALL.g, "energy": states.ENERGY}
    about = {} if part == "verdicts" else ball  # verdicts are on cells of many
    about |= {"stage": "study", "title": f"Methods compared: {part}"}
    artifacts.save(dataset, snakemake.output[0], {"part": part}, **about)
