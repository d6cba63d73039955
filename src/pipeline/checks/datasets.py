"""docs/data.md, from a small run of each: `.venv/bin/python -m pipeline.checks.datasets`."""

import tempfile
import tomllib
from importlib import import_module
from pathlib import Path

from pseudorigid.dynamics.ball import Ball
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep import blocks

from ..config.schema.stages import STAGES
from ..config.schema.study import FIXED, MEASURED
from ..records import artifacts
from ..records.files import write_whole
from ..records.sources import ROOT

BALL, ENERGY = Ball(0.2, 0.04), 0.01
TEXT = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
SMALL = TEXT["small"]  # stage -> fields of a scene


def page() -> str:
    """The whole page."""
    found = stages() | others() | study()
    uses = {}
    for name, (_, data) in found.items():
        for attribute in [*data.attrs, *TEXT["optional"].get(name, ())]:
            uses.setdefault(attribute, []).append(name)
    lines = ["| attribute | of | meaning | scale |", "|---|---|---|---|"]
    for name, (meaning, scale) in TEXT["attributes"].items():
        of = uses.pop(name)
        of = "all" if len(of) == len(found) else ", ".join(f"`{one}`" for one in dict.fromkeys(of))
        lines.append(f"| `{name}` | {of} | {meaning} | {scale} |")
    if uses:
        raise KeyError(f"attributes without a meaning: {uses}")
    parts = [TEXT["head"], *(section(name, *one) for name, one in found.items())]
    return "\n\n".join([*parts, "## Attributes of files", "\n".join(lines)]) + "\n"


def section(name, file, data) -> str:
    """The dataset's part of the page."""
    lines = [f"### {name}", "", f"`{file}`: {data.attrs['title']}."]
    counted = data.get("row_size")
    if counted is not None:
        sample = counted.attrs["sample_dimension"]
        lines[-1] += f" Ragged: `row_size` on `{counted.dims[0]}` counts `{sample}`."
    lines[-1] += f" {TEXT['study']}" if name.removeprefix("study: ") in MEASURED else ""
    lines += ["", "| variable | dimensions | type | meaning | scale |", "|---|---|---|---|---|"]
    for variable, values in data.variables.items():
        dims = ", ".join(f"`{dim}`" for dim in values.dims)
        kind = "text" if values.dtype.kind in "OUT" else str(values.dtype)
        about = values.attrs["long_name"], values.attrs.get("scale", "")
        meaning, scale = (text.replace("|", "\\|") for text in about)
        lines.append(f"| `{variable}` | {dims} | {kind} | {meaning} | {scale} |")
    return "\n".join(lines)


def stages():
    """Name -> (file, dataset) of every stage."""
    made = {}
    for name, stage in STAGES.items():
        compute = getattr(import_module(stage.module), stage.function)
        fields = SMALL[name]
        inputs = [_stage(given, {"period": fields["period"]}) for given in stage.inputs]
        data = compute(BALL, ENERGY, *inputs, **fields)
        made[name] = f"results/VARIANT/{name}_SCENE.nc", _saved(data, compute, stage=name)
    return made


def others():
    """Name -> (file, dataset) of a sweep, its blocks and the derivations."""
    one = blocks.compute({"cells": [[0.2, 6.25]], "starts": 12, "impacts": 100})
    whole = blocks.join({"k": [0.2], "energy": [6.25]}, [one])
    sweep = "results/sweep/SWEEP"
    algebra = _saved(derivations(BALL, ENERGY), derivations, stage="derivations")
    return {
        "sweep": (f"{sweep}.nc", _saved(whole, blocks.join, ball=False)),
        "sweep, a block": (f"{sweep}_0000.nc", _saved(one, blocks.compute, ball=False)),
        "derivations": ("results/claims/derivations.nc", algebra),
    }


def study():
    """Name -> (file, dataset) of every part of the study."""
    from pseudorigid.study import failures, figure_errors, verdicts, work

    few = failures.EDGE_METHODS[:1]
    needs = TEXT["needs"], {"fig3": "motion"}
    periodic = {("periodic", "fig3"): _stage("periodic", {"period": 1})}
    makers = {
        "work": lambda: work.counted(2),
        "edges": lambda: failures.edges(few, 2),
        "orbits": lambda: failures.orbits(1000),
        "needs": lambda: figure_errors.figure_errors(*needs, periodic),
        "verdicts": lambda: verdicts.verdicts(cells=1, orbits=2),
        "work_all": lambda: work.measured(work.METHODS[:1], 2, 1),
        "edges_all": lambda: failures.edges(few, 2),
        "missed_all": lambda: failures.missed(few, 10_000),
    }
    made = {}
    for part in (*FIXED, *MEASURED):
        own = {"stage": "study", "title": f"Methods compared: {part}"}
        data = _saved(makers[part](), None, ball=part != "verdicts", **own)
        made[f"study: {part}"] = f"results/study/{part}.nc", data
    return made


def _stage(name, fields):
    stage = STAGES[name]
    return getattr(import_module(stage.module), stage.function)(BALL, ENERGY, **fields)


def _saved(data, maker, ball=True, **about):
    """The dataset as its file has it."""
    about |= {"k": BALL.k, "g": BALL.g, "energy": ENERGY} if ball else {}
    if maker is not None:
        about["title"] = artifacts.title_of(maker)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "data.nc"
        artifacts.save(data, path, {}, **about)
        return artifacts.load(path)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "data.md", page())
