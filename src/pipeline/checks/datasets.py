"""The page docs/data.md, written from a small run of every stage.

Run `.venv/bin/python -m pipeline.checks.datasets` to renew it.
"""

import inspect
import tempfile
import tomllib
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
TEXT: dict[str, dict[str, Any]] = {}
for _file in (Path(__file__).with_suffix(".toml"), *files("datasets.toml")):
    for _part, _texts in tomllib.loads(_file.read_text(encoding="utf-8")).items():
        TEXT.setdefault(_part, {}).update(_texts)
SMALL = TEXT["small"]  # stage -> fields of a scene
_OF_STUDY = [name for name, stage in STAGES.items() if stage.function.startswith(f"{STUDY}.")]


class File(NamedTuple):
    """A dataset after a round through its file, and the path where the project has it."""

    path: str
    data: xr.Dataset


def page() -> str:
    """Return the text of the page."""
    files = _stages() | _study()
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
        measured=[name for name, stage in STAGES.items() if stage.measured],
        attributes=TEXT["attributes"],
        owners={k: "all" if len(v) == len(files) else ", ".join(v) for k, v in owners.items()},
    )


def _stages() -> dict[str, File]:
    found = {}
    for name in (name for name in STAGES if name not in _OF_STUDY):
        stage = STAGES[name]
        block = {key: value for used in (*stage.inputs, name) for key, value in SMALL[used].items()}
        path = f"results/VARIANT/{name}_SCENE.nc"
        found[name] = _saved(path, name, _compute(name, block), stage.function)
        if stage.parts:
            part = imported(stage.part)(**imported(stage.parts)(block)[0])
            path = f"results/VARIANT/{name}_SCENE.0000.nc"
            found[f"{name}, a block"] = _saved(path, "block 0", part, stage.part)
    return found


def _compute(name: str, block: dict[str, Any]) -> xr.Dataset:
    """Compute the dataset of a stage, and those of its inputs, from a block of a config."""
    stage, function = STAGES[name], imported(STAGES[name].function)
    inputs = [_compute(used, block) for used in stage.inputs]
    if stage.parts:
        inputs = [imported(stage.part)(**part) for part in imported(stage.parts)(block)]
    fields = {key: block[key] for key in (*stage.names, *SMALL[name]) if key in block}
    fields = {key: value for key, value in fields.items() if not stage.parts or key in stage.names}
    of_ball = [BALL, ENERGY] if next(iter(inspect.signature(function).parameters)) == "ball" else []
    dataset: xr.Dataset = function(*of_ball, *inputs, **fields)
    return dataset


def _study() -> dict[str, File]:
    from study import failures, figure_errors, stages, work
    from study.methods.counted_methods import METHODS

    methods = failures.EDGE_METHODS[:1]
    needs = TEXT["needs"], {"fig3": "motion"}
    periodic = {("periodic", "fig3"): _compute("periodic", {"period": 1})}
    parts = {
        "work": work.counted(2),
        "edges": failures.edges(methods, 2),
        "drift": failures.orbits(1000),
        "needs": figure_errors.figure_errors(*needs, periodic),
        "work_all": work.measured(METHODS[:1], 2, 1),
        "edges_all": failures.edges(methods, 2),
        "missed_all": failures.missed(methods, 10_000),
    }
    path = "results/study/{}.nc".format
    return {
        f"study: {part}": _saved(path(part), "study", stages.described(part, data))
        for part, data in parts.items()
    }


def _saved(path: str, step: str, data: xr.Dataset, function: str = "") -> File:
    """Return a dataset after a round through its file, with the attributes that a job gives it."""
    more: dict[str, Any] = {"stage": step}
    if function:
        more |= {"title": artifacts.title_of(imported(function))} | data.attrs
    if function and next(iter(inspect.signature(imported(function)).parameters)) == "ball":
        more |= {"k": BALL.k, "g": BALL.g, "energy": ENERGY}
    with tempfile.TemporaryDirectory() as folder:
        artifacts.save(data, f"{folder}/data.nc", {}, **more)
        return File(path, artifacts.load(f"{folder}/data.nc"))


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "data.md", page())
