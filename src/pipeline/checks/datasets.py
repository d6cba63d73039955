"""The page docs/data.md, written from a small run of every stage, of a sweep and of the study.

Run `.venv/bin/python -m pipeline.checks.datasets` to renew it.
"""

import tempfile
import tomllib
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import jinja2
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep import blocks
from pseudorigid.sweep.chains import chains

from ..config.paths import DERIVATIONS
from ..config.schema.stages import STAGES
from ..config.schema.study import MEASURED
from ..config.schema.study import data as study_path
from ..records import artifacts
from ..records.files import write_whole
from ..records.sources import ROOT

BALL, ENERGY = Ball(0.2, 0.04), 0.01
TEXT = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
SMALL = TEXT["small"]  # stage -> fields of a scene


class File(NamedTuple):
    """A dataset after a round through its file, and the path where the project has it."""

    path: str
    data: xr.Dataset


def page() -> str:
    """Return the text of the page."""
    files = _stages() | _sweep_and_derivations() | _study()
    owners: dict[str, list[str]] = {}
    for name, (_, data) in files.items():
        for attribute in dict.fromkeys([*data.attrs, *TEXT["optional"].get(name, ())]):
            owners.setdefault(attribute, []).append(f"`{name}`")
    if unknown := owners.keys() - TEXT["attributes"].keys():
        raise KeyError(f"attributes without a meaning: {unknown}")
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, trim_blocks=True, keep_trailing_newline=True
    )
    template = Path(__file__).with_suffix(".md.jinja").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        files=files,
        measured=MEASURED,
        attributes=TEXT["attributes"],
        owners={k: "all" if len(v) == len(files) else ", ".join(v) for k, v in owners.items()},
    )


def _stages() -> dict[str, File]:
    files = {}
    for name, stage in STAGES.items():
        function = getattr(import_module(stage.module), stage.function)
        block = {key: value for used in (*stage.inputs, name) for key, value in SMALL[used].items()}
        data = _compute(name, block)
        path = f"results/VARIANT/{name}_SCENE.nc"
        files[name] = _saved(path, data, artifacts.title_of(function), stage=name)
    return files


def _compute(name: str, block: dict[str, Any]) -> xr.Dataset:
    """Compute the dataset of a stage, and those of its inputs, from a block of a config."""
    stage = STAGES[name]
    inputs = [_compute(used, block) for used in stage.inputs]
    fields = {key: block[key] for key in stage.fields if key in block}
    dataset: xr.Dataset = getattr(import_module(stage.module), stage.function)(
        BALL, ENERGY, *inputs, **fields
    )
    return dataset


def _sweep_and_derivations() -> dict[str, File]:
    block = blocks.compute({"cells": [[0.2, 6.25]], "starts": 12, "impacts": 100})
    whole = blocks.join({"k": [0.2], "energy": [6.25]}, [block])
    curves = chains({"k": [0.19, 0.21], "energy": [10.0, 11.0], "chains": [5]})
    swept: dict[str, tuple[str, Callable[..., xr.Dataset], xr.Dataset]] = {
        "sweep": ("SWEEP", blocks.join, whole),
        "sweep, a block": ("SWEEP_0000", blocks.compute, block),
        "sweep, chains": ("SWEEP_chains", chains, curves),
    }
    files = {
        name: _saved(f"results/sweep/{file}.nc", data, artifacts.title_of(function), ball=False)
        for name, (file, function, data) in swept.items()
    }
    title, algebra = artifacts.title_of(derivations), derivations(BALL, ENERGY)
    files["derivations"] = _saved(DERIVATIONS, algebra, title, stage="derivations")
    return files


def _study() -> dict[str, File]:
    from pseudorigid.study import failures, figure_errors, verdicts, work
    from pseudorigid.study.methods.counted_methods import METHODS

    methods = failures.EDGE_METHODS[:1]
    needs = TEXT["needs"], {"fig3": "motion"}
    periodic = {("periodic", "fig3"): _compute("periodic", {"period": 1})}
    parts = {
        "work": work.counted(2),
        "edges": failures.edges(methods, 2),
        "orbits": failures.orbits(1000),
        "needs": figure_errors.figure_errors(*needs, periodic),
        "verdicts": verdicts.verdicts(cells=1, orbits=2),
        "work_all": work.measured(METHODS[:1], 2, 1),
        "edges_all": failures.edges(methods, 2),
        "missed_all": failures.missed(methods, 10_000),
    }
    return {
        f"study: {part}": _saved(
            study_path(part), data, f"Methods compared: {part}", part != "verdicts", stage="study"
        )
        for part, data in parts.items()
    }


def _saved(path: str, data: xr.Dataset, title: str, ball: bool = True, **more: object) -> File:
    """Return a dataset after a round through its file, with more attributes."""
    more |= {"k": BALL.k, "g": BALL.g, "energy": ENERGY} if ball else {}
    with tempfile.TemporaryDirectory() as folder:
        artifacts.save(data, f"{folder}/data.nc", {}, title=title, **more)
        return File(path, artifacts.load(f"{folder}/data.nc"))


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "data.md", page())
