"""Write docs/data.md, which describes the datasets of a small run of every stage.

Run `.venv/bin/python -m pipeline.checks.datasets` to renew it.
"""

import inspect
import tempfile
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import jinja2
import xarray as xr

from pseudorigid.dynamics.ball import Ball

from ..config.schema.sets import STUDY
from ..config.schema.stages import STAGES
from ..declaration import files, imported
from ..records import artifacts
from ..records.files import write_whole
from ..records.sources import ROOT

BALL, ENERGY = Ball(0.2, 0.04), 0.01
# Parts of datasets.toml: small runs, optional attributes, meanings of attributes and the like.
_PARTS: dict[str, dict[str, Any]] = {}
for _file in (Path(__file__).with_suffix(".toml"), *files("datasets.toml")):
    for _part, _entries in tomllib.loads(_file.read_text(encoding="utf-8")).items():
        _PARTS.setdefault(_part, {}).update(_entries)
SMALL = _PARTS["small"]  # stage -> fields of a scene


class File(NamedTuple):
    """A dataset as it is read from its file, and the path that the file has in the project."""

    path: str
    data: xr.Dataset


def page() -> str:
    """Return the text of the page."""
    described = _of_stages() | _of_study()
    owners: dict[str, list[str]] = {}
    for name, file in described.items():
        for attribute in dict.fromkeys([*file.data.attrs, *_PARTS["optional"].get(name, ())]):
            owners.setdefault(attribute, []).append(f"`{name}`")
    if unknown := owners.keys() - _PARTS["attributes"].keys():
        raise KeyError(f"attributes without a meaning: {unknown}")
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, trim_blocks=True, keep_trailing_newline=True
    )
    template = Path(__file__).with_suffix(".md.jinja").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        files=described,
        measured=[name for name, stage in STAGES.items() if stage.measured],
        attributes=_PARTS["attributes"],
        owners={k: "all" if len(v) == len(described) else ", ".join(v) for k, v in owners.items()},
    )


def _of_stages() -> dict[str, File]:
    """Return the file of each stage that is none of the study's, and of a part where it has any."""
    described = {}
    for name, small in SMALL.items():
        stage, path = STAGES[name], f"results/VARIANT/{name}_SCENE"
        block = {key: value for used in stage.inputs for key, value in SMALL[used].items()} | small
        data = _saved(_compute(name, block), name, stage.function)
        described[name] = File(f"{path}.nc", data)
        if stage.parts:
            part = imported(stage.part)(**imported(stage.parts)(block)[0])
            data = _saved(part, "block 0", stage.part)
            described[f"{name}, a block"] = File(f"{path}.0000.nc", data)
    return described


def _compute(name: str, block: Mapping[str, Any]) -> xr.Dataset:
    """Compute the dataset of a stage, and those of its inputs, from a block of a config."""
    stage = STAGES[name]
    if stage.parts:
        inputs = [imported(stage.part)(**part) for part in imported(stage.parts)(block)]
    else:
        inputs = [_compute(used, block) for used in stage.inputs]
    parameters = _parameters(stage.function)
    of_ball = [BALL, ENERGY] if "ball" in parameters else []
    fields = {key: value for key, value in block.items() if key in parameters}
    dataset: xr.Dataset = imported(stage.function)(*of_ball, *inputs, **fields)
    return dataset


def _parameters(function: str) -> Mapping[str, inspect.Parameter]:
    return inspect.signature(imported(function)).parameters


def _of_study() -> dict[str, File]:
    """Return the file of each part of the study."""
    from study import figure_errors, measured, stages
    from study.methods.counted_methods import METHODS

    methods = stages.EDGE_METHODS[:1]
    kinds, inputs = {"fig3": "motion"}, ["periodic/fig3"]
    periodic = _compute("periodic", {"period": 1})
    parts = {
        "work": stages.work(METHODS, 2),
        "edges": stages.edges(methods, 2),
        "drift": stages.drift(1000),
        "needs": figure_errors.figure_errors(
            periodic, scenes=_PARTS["needs"], measures=kinds, inputs=inputs
        ),
        "work_all": measured.timed_work(METHODS[:1], 2, 1),
        "edges_all": stages.edges(methods, 2, "edges_all"),
        "missed_all": measured.missed(methods, 10_000),
    }
    return {
        f"study: {part}": File(f"results/{STUDY}/{part}.nc", _saved(data, "study"))
        for part, data in parts.items()
    }


def _saved(data: xr.Dataset, step: str, function: str = "") -> xr.Dataset:
    """Return a dataset as it is read from its file, with the attributes that a job gives it."""
    attributes: dict[str, Any] = {"stage": step}
    if function:
        attributes |= {"title": artifacts.title_of(imported(function))} | data.attrs
        if "ball" in _parameters(function):
            attributes |= {"k": BALL.k, "g": BALL.g, "energy": ENERGY}
    with tempfile.TemporaryDirectory() as folder:
        artifacts.save(data, f"{folder}/data.nc", {}, **attributes)
        return artifacts.load(f"{folder}/data.nc")


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "data.md", page())
