"""The page docs/data.md, written from a small run of every stage, of a sweep and of the study.

Run `.venv/bin/python -m pipeline.checks.datasets` to renew it.
"""

import tempfile
import tomllib
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep import blocks

from ..config.schema.stages import STAGES
from ..config.schema.study import FIXED, MEASURED
from ..config.schema.study import data as study_path
from ..records import artifacts
from ..records.files import write_whole
from ..records.sources import ROOT

BALL, ENERGY = Ball(0.2, 0.04), 0.01
TEXT = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
SMALL = TEXT["small"]  # stage -> fields of a scene

Files = dict[str, tuple[str, xr.Dataset]]  # name on the page -> (path, dataset)


def page() -> str:
    """Return the text of the page."""
    files = _stages() | _sweep_and_derivations() | _study()
    owners: dict[str, list[str]] = {}
    for name, (_, data) in files.items():
        for attribute in dict.fromkeys([*data.attrs, *TEXT["optional"].get(name, ())]):
            owners.setdefault(attribute, []).append(f"`{name}`")
    lines = ["| attribute | of | meaning | scale |", "|---|---|---|---|"]
    for name, (meaning, scale) in TEXT["attributes"].items():
        of = owners.pop(name)
        of_text = "all" if len(of) == len(files) else ", ".join(of)
        lines.append(f"| `{name}` | {of_text} | {meaning} | {scale} |")
    if owners:
        raise KeyError(f"attributes without a meaning: {owners}")
    parts = [TEXT["head"].strip(), *(_section(name, *file) for name, file in files.items())]
    return "\n\n".join([*parts, "## Attributes of files", "\n".join(lines)]) + "\n"


def _section(name: str, path: str, data: xr.Dataset) -> str:
    """Describe one dataset and its variables."""
    sentences = [f"`{path}`: {data.attrs['title']}."]
    if (row_size := data.get("row_size")) is not None:
        sample = row_size.attrs["sample_dimension"]
        sentences += [f"Ragged: `row_size` on `{row_size.dims[0]}` counts `{sample}`."]
    if name.removeprefix("study: ") in MEASURED:
        sentences += [TEXT["study"].strip()]
    lines = [f"### {name}", "", " ".join(sentences), ""]
    lines += ["| variable | dimensions | type | meaning | scale |", "|---|---|---|---|---|"]
    for variable, values in data.variables.items():
        dims = ", ".join(f"`{dim}`" for dim in values.dims)
        dtype = "text" if values.dtype.kind in "OUT" else str(values.dtype)
        texts = values.attrs["long_name"], values.attrs.get("scale", "")
        meaning, scale = (text.replace("|", "\\|") for text in texts)
        lines.append(f"| `{variable}` | {dims} | {dtype} | {meaning} | {scale} |")
    return "\n".join(lines)


def _stages() -> Files:
    files = {}
    for name, stage in STAGES.items():
        fields = SMALL[name]
        inputs = [_computed(used, {"period": fields["period"]}) for used in stage.inputs]
        data = _saved(_computed(name, fields, *inputs), _function(name), stage=name)
        files[name] = f"results/VARIANT/{name}_SCENE.nc", data
    return files


def _sweep_and_derivations() -> Files:
    block = blocks.compute({"cells": [[0.2, 6.25]], "starts": 12, "impacts": 100})
    whole = blocks.join({"k": [0.2], "energy": [6.25]}, [block])
    path = "results/sweep/SWEEP"
    algebra = _saved(derivations(BALL, ENERGY), derivations, stage="derivations")
    return {
        "sweep": (f"{path}.nc", _saved(whole, blocks.join, ball=False)),
        "sweep, a block": (f"{path}_0000.nc", _saved(block, blocks.compute, ball=False)),
        "derivations": ("results/claims/derivations.nc", algebra),
    }


def _study() -> Files:
    from pseudorigid.study import failures, figure_errors, verdicts, work
    from pseudorigid.study.methods.counted_methods import METHODS

    methods = failures.EDGE_METHODS[:1]
    needs = TEXT["needs"], {"fig3": "motion"}
    periodic = {("periodic", "fig3"): _computed("periodic", {"period": 1})}
    compute = {
        "work": lambda: work.counted(2),
        "edges": lambda: failures.edges(methods, 2),
        "orbits": lambda: failures.orbits(1000),
        "needs": lambda: figure_errors.figure_errors(*needs, periodic),
        "verdicts": lambda: verdicts.verdicts(cells=1, orbits=2),
        "work_all": lambda: work.measured(METHODS[:1], 2, 1),
        "edges_all": lambda: failures.edges(methods, 2),
        "missed_all": lambda: failures.missed(methods, 10_000),
    }
    files = {}
    for part in (*FIXED, *MEASURED):
        attributes = {"stage": "study", "title": f"Methods compared: {part}"}
        data = _saved(compute[part](), None, ball=part != "verdicts", **attributes)
        files[f"study: {part}"] = study_path(part), data
    return files


def _function(stage: str) -> Callable[..., xr.Dataset]:
    function: Callable[..., xr.Dataset] = getattr(
        import_module(STAGES[stage].module), STAGES[stage].function
    )
    return function


def _computed(stage: str, fields: dict[str, Any], *inputs: xr.Dataset) -> xr.Dataset:
    return _function(stage)(BALL, ENERGY, *inputs, **fields)


def _saved(
    data: xr.Dataset,
    function: Callable[..., xr.Dataset] | None,
    ball: bool = True,
    **attributes: object,
) -> xr.Dataset:
    """Return a dataset after a round through its file, titled by the function that computed it."""
    attributes |= {"k": BALL.k, "g": BALL.g, "energy": ENERGY} if ball else {}
    if function is not None:
        attributes["title"] = artifacts.title_of(function)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "data.nc"
        artifacts.save(data, path, {}, **attributes)
        return artifacts.load(path)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "data.md", page())
