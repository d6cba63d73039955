"""docs/data.md, from a small run of each: `.venv/bin/python -m pipeline.checks.datasets`."""

import tempfile
from importlib import import_module
from pathlib import Path

from pseudorigid.dynamics.ball import Ball
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep import blocks

from ..config.declared.stages import STAGES
from ..config.declared.study import FIXED, MEASURED
from ..records import artifacts
from ..records.files import write_whole
from ..records.sources import ROOT

BALL, ENERGY = Ball(0.2, 0.04), 0.01
_SEA = {"between": (0.55, 0.68), "orbits": 4}
_SIX = {"period": 6, "type": "hyperbolic"}
# Stage -> fields of a scene, as small as they can be.
SMALL = {
    "orbits": {"starts": [0.1, {"x": 0.1, "xdot": 0.05}], "impacts": [3, 2]},
    "periodic": {"period": 6},
    "motion": {"period": 1, "type": "elliptic", "duration": 1.0},
    "manifolds": _SIX
    | {"point": 0, "window": {"x": [-0.01, 0.01], "xdot": [-0.01, 0.01]}, "length": 0.05}
    | {"resolution": {"distance": 0.5, "bend": 30}},
    "spread": {"orbits": 4, "length": 2000, "blocks": 4, "regular": [0.1], "regular_impacts": 4}
    | {"cells": 4, "visits": 4},
    "clusters": _SEA | {"impacts": 200, "cuts": [4, 6], "lags": 2, "resamples": 10, "seed": 1},
    "rotation": {
        "energies": [0.001],
        "starts": 10,
        "impacts": 200,
        "detail": (-0.8357, -0.8342),
        "detail_impacts": 200,
    },
    "jumps": {"energies": [0.0018], "sides": 40},
    "flux": _SEA | {"period": 6, "distance": 2e-2, "grid": 20, "impacts": 100},
    "last_curve": {
        "nobles": [[0, 5, 1, 15]],
        "convergents": 2,
        "between": (-0.2, -0.0325639),
        "impacts": 100,
        "drawn": 10,
    },
    "horseshoe": _SIX | {"connection": "outer"},
    "twist": {"energies": [0.01]},
    "lyapunov": {"starts": [0.6], "impacts": 10, "records": 2},
}
_AXIS = {"limits": [-0.5, 0.5], "ticks": [0]}
_MOTION = SMALL["motion"] | {
    "picture": "motion",
    "ball": {"k": 0.2, "g": 0.04},
    "energy": ENERGY,
    "axes": {"t": {"limits": [0, 1], "ticks": [0, 1]}, "displacement": _AXIS},
}
# Attribute -> what it means, and its scale.
ATTRIBUTES = {
    "Conventions": ("the conventions of this file, CF", ""),
    "title": ("what the dataset is", ""),
    "source": ("what made it", ""),
    "references": ("the paper", ""),
    "config": ("the block of config.yaml behind the data, as JSON", ""),
    "stage": ("the stage that made it, or study, or derivations", ""),
    "k": ("Euler inertia", "m R^2"),
    "g": ("gravity", "omega^2 R"),
    "energy": ("total energy", "m omega^2 R^2"),
    "period": ("impacts of the periodic orbits", "1"),
    "resolution": ("cells of each symmetry line in the search", "1"),
    "unsolved": ("orbits seen that do not close to rounding", "1"),
    "window_x": ("the window's edges in x", "R"),
    "window_xdot": ("the window's edges in xdot", "omega R"),
    "point_x": ("x of the point in the window", "R"),
    "point_xdot": ("xdot of that point", "omega R"),
    "start_error": (
        "by how much the image of a branch's first segment misses it",
        "section radius",
    ),
    "ended": ("where a branch is no longer known to rounding; absent if all are", "section radius"),
    "impacts": ("impacts computed, of each orbit or, with a scan, of all", "1"),
    "impacts_missed": ("with a scan, impacts that it flew past", "1"),
    "detail_impacts": ("impacts of each orbit of the detail", "1"),
    "block_impacts": ("impacts of a block", "1"),
    "first_energy": ("energy from which on the map jumps", "m omega^2 R^2"),
    "section": ("area of the section in (x, y)", "omega R^2"),
    "multiplier": ("multiplier of the hyperbolic orbit", "1"),
    "states": ("states of each set", "1"),
    "hard": ("impacts that a scan of step 0.5 misses", "1"),
    "apart": ("distance in x from which on orbits are apart", "R"),
    "orbits": ("orbits of each cell", "1"),
    "impacts_of_the_truth": ("impacts of the orbits that say what is true", "1"),
}
# What the small runs do not have: they follow no scan, and no branch to where it is lost.
_SCAN = ("impacts", "impacts_missed")
OPTIONAL = {
    **dict.fromkeys(("orbits", "motion", "lyapunov"), _SCAN),
    "manifolds": ("ended", *_SCAN),
}
HEAD = """\
# The datasets

Made from a small run of each by `.venv/bin/python -m pipeline.checks.datasets`. Every result is an
uncompressed netCDF-4 file that any netCDF library reads, with attributes as CF has them.

A number in a file is dimensionless, so `units` is "1" everywhere; times its attribute `scale` it is
the quantity. R is the ball's radius, omega the frequency of its stretching (times are in 1/omega),
m its mass; "section radius" is that of the section along y = xdot - k udot = 0; "1" is a pure
number. What a variable means is its `long_name`. NaN is stored as it is; there is no fill value.

Rows of different length are contiguous ragged arrays: the samples of one row after the other along
one dimension, and `row_size`, whose attribute `sample_dimension` names that dimension, counts them.

A file has the variables that apply to it: `start_x` and `start_xdot`, say, only where a start of
its scene is a point.

## Read a file

With xarray, from the project's folder after `./reproduce`:

    import xarray as xr

    orbits = xr.open_dataset("results/paper/orbits_fig2.nc")
    orbits.info()                                    # the header, as ncdump -h prints it
    print(orbits["tau"].attrs["long_name"], orbits["tau"].attrs["scale"])
    counts = orbits["row_size"].values
    ends = counts.cumsum()
    second = orbits.isel(point=slice(ends[0], ends[1]), orbit=1)

With pandas, a row an impact:

    import numpy as np

    table = orbits[["x", "xdot", "udot", "tau"]].to_dataframe()
    table["orbit"] = np.repeat(np.arange(counts.size), counts)
    print(table.groupby("orbit")["tau"].mean())

The orbits go on from where the file ends:

    from pseudorigid import Ball, orbit

    more = orbit(Ball(orbits.attrs["k"], orbits.attrs["g"]), orbits, impacts=100)

On the command line, with Debian's package netcdf-bin, which is not needed for anything else:

    ncdump -h results/paper/orbits_fig2.nc           # the header
    ncdump -v row_size results/paper/orbits_fig2.nc  # and one variable

## Files

VARIANT is `paper`, a variant, `claims` (`./reproduce claims`) or `proofs` (`./reproduce prove
--pictures`); SCENE is the first scene of config.yaml that needs the data, and others share them."""
STUDY = "Measured with the libraries of the study; the machine and versions are attributes too."


def page() -> str:
    """The whole page."""
    found = stages() | others() | study()
    uses = {}
    for name, (_, data) in found.items():
        for attribute in [*data.attrs, *OPTIONAL.get(name, ())]:
            uses.setdefault(attribute, []).append(name)
    lines = ["| attribute | of | meaning | scale |", "|---|---|---|---|"]
    for name, (meaning, scale) in ATTRIBUTES.items():
        of = uses.pop(name)
        of = "all" if len(of) == len(found) else ", ".join(f"`{one}`" for one in dict.fromkeys(of))
        lines.append(f"| `{name}` | {of} | {meaning} | {scale} |")
    if uses:
        raise KeyError(f"attributes without a meaning: {uses}")
    parts = [HEAD, *(section(name, *one) for name, one in found.items())]
    return "\n\n".join([*parts, "## Attributes of files", "\n".join(lines)]) + "\n"


def section(name, file, data) -> str:
    """The dataset's part of the page."""
    lines = [f"### {name}", "", f"`{file}`: {data.attrs['title']}."]
    counted = data.get("row_size")
    if counted is not None:
        sample = counted.attrs["sample_dimension"]
        lines[-1] += f" Ragged: `row_size` on `{counted.dims[0]}` counts `{sample}`."
    lines[-1] += f" {STUDY}" if name.removeprefix("study: ") in MEASURED else ""
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
    needs = {"fig3": _MOTION}, {"fig3": "motion"}
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
