"""The recipes of CONTRIBUTING in a copy: an extension with a kind and a stage, in one folder."""

import json

import numpy as np
import pytest
from project import APART, fresh_tree
from runs import rows

from pipeline.declaration import SCHEMA
from pipeline.records.artifacts import load

FILES = {
    "__init__.py": '"""Returns of orbits."""',
    "part.py": '''
"""What returns add to the pipeline."""

from pipeline.declaration import Part, SceneSet, SnakemakeCommand, Stage

PART = Part(
    stages={"flights": Stage("extensions.returns.flights.mean_flights", inputs=("orbits",))},
    sets={
        "returns": SceneSet(
            "more_figures/returns", "./reproduce returns", "Returns", key="returns"
        )
    },
    commands={
        "returns": SnakemakeCommand("draw returns, in more_figures/returns/", scenes="returns"),
    },
)
''',
    "flights.py": '''
"""Mean time of flight of orbits."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import variables


def mean_flights(ball, energy, orbits):
    """Compute the mean time of flight of each orbit."""
    ends = np.cumsum(orbits["row_size"].values)[:-1]
    means = [part.mean() for part in np.split(orbits["tau"].values, ends)]
    return xr.Dataset(variables("orbit", [np.array(means)], {"mean": "mean time of flight"}))
''',
    "kinds.py": '''
"""Next position against the present one."""

from typing import Literal

from paper.groups import OfOrbits
from pipeline.config.schema.fields import Axis


class Returns(OfOrbits):
    """the next position against the present one"""

    stages = ("orbits", "flights")
    headline = "orbits"

    axes: dict[Literal["x", "next"], Axis] = None
    """Limits and ticks."""
''',
    "figures/__init__.py": '"""Pictures of returns."""',
    "figures/returns.py": '''
"""Next position against the present one."""

from pseudorigid.figures.axes.limits import complete, of_data
from pseudorigid.figures.axes.plane import Plane
from pseudorigid.figures.canvas import style


@style.pinned()
def draw(scene, orbits, flights):
    """Return the Figure of x' against x."""
    x = orbits["x"].values
    scene = complete(scene, x=lambda: of_data(x), next=lambda: of_data(x))
    picture = Plane(scene, ("x", "next"), ("$x$", "$x'$"))
    picture.dots(x[:-1], x[1:], style.BLUE, 1.5)
    return picture.figure
''',
    "figures/reports.py": '''
"""What they report."""


def returns(block, orbits, flights):
    """Give how many orbits there are."""
    return {"orbits": f"{orbits.sizes['orbit']}"}
''',
    "scenes.yaml": """
returns:
  twice: {picture: returns, energy: 0.01, starts: [0.1, 0.6], impacts: 50}
""",
    "presets.js": """
"use strict";
Object.assign(PRESETS, { returns: (scene) => ({ orbits: orbitsOf(scene) }) });
""",
    "captions.toml": """
[kinds.returns]
title = "the next position against the present one"
shows = "Positions of {{ s.starts|length }} orbits: the next one, x', against the present one, x."
see = "Regular orbits are closed lines."
""",
    "examples.yaml": """
returns:
  picture: returns
  energy: 0.001
  starts: [0.1]
  impacts: 50
""",
}
PUBLISHED = "more_figures/returns/twice.png"


@pytest.fixture
def tree(tmp_path):
    """A copy with one small scene of the paper and with the extension."""
    portrait = {"picture": "portrait", "energy": 0.01, "starts": [0.1, 0.6], "impacts": 50}
    parts = {part: {} for part in APART}
    document = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"map": portrait}} | parts
    tree = fresh_tree(tmp_path / "one more", document)
    for name, text in FILES.items():
        file = tree.path / "src/extensions/returns" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text.lstrip())
    return tree


@pytest.mark.slow
def test_an_extension_is_one_folder(tree):
    """It has a stage, a kind, a command and a published picture, in each list and each check."""
    assert "\n  returns " in tree.succeed("help")
    assert rows(tree.succeed()) == {"paper_figures/map.png": "recomputed"}
    assert rows(tree.succeed("returns")) == {PUBLISHED: "recomputed"}
    assert rows(tree.succeed("returns")) == {PUBLISHED: "current"}
    orbits, flights = (
        load(tree.path / f"results/returns/{name}_twice.nc") for name in ("orbits", "flights")
    )
    means = [np.mean(part) for part in np.split(orbits["tau"].values, 2)]
    assert flights["mean"].values.tolist() == means
    tree.succeed("accept")
    result = tree.run("verify")
    assert (result.returncode, "note" in result.stdout) == (0, False), result.stdout
    assert "twice  png  identical\n" in result.stdout
    (tree.path / PUBLISHED).write_bytes(b"damaged")
    assert tree.run("verify").returncode == 1
    result = tree.python("-P", "-m", "pipeline.renew")
    assert result.returncode == 0, result.stderr
    tree.succeed("report")
    report = (tree.path / "results/report/report.html").read_text()
    assert "Positions of 2 orbits: the next one" in report
    assert '<th scope="row">orbits</th><td>not printed</td><td>2</td>' in report
    page = (tree.path / "src/extensions/returns/README.md").read_text()
    assert "### picture: returns\n\nThe next position against the present one." in page
    assert "### returns/twice: the next" in (tree.path / "docs/figures.md").read_text()
    names = json.loads((tree.path / SCHEMA).read_text())["$defs"]["AnyScene"]["properties"]
    assert "returns" in names["picture"]["enum"]
    document = tree.document()
    mine = {"picture": "returns", "energy": 0.01, "starts": [0.1], "impacts": 50, "axes": {"y": {}}}
    tree.write(document | {"returns": {"mine": mine}})
    line = "returns.mine.axes.y: unknown key: allowed here: x, next"
    (said,) = tree.run("returns").stdout.splitlines()
    assert said.endswith(f": {line} (this concerns ./reproduce returns alone)")
    tree.write(document)
    tree.append("extensions/returns/flights.py")
    edited = "made by other code than this tree's: src/extensions/returns/flights.py differs"
    assert f"twice: {edited}: flights; perhaps drawing\n" in tree.succeed("returns", "-n")
    (tree.path / "src/extensions/returns/part.py").unlink()
    assert "returns" not in tree.succeed("help")
