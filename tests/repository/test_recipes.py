"""CONTRIBUTING's recipes, followed to the letter in a copy: three files for a kind or a stage."""

import shutil
import subprocess
import sys

import numpy as np
import pytest
from project import ROOT, fresh_tree, shipped
from runs import rows
from verdicts import said

from pipeline.records.artifacts import load

KIND = {
    "src/pseudorigid/figures/kinds/returns.py": '''
"""x of each impact against x of the one before."""

from ..axes.limits import complete, of_data
from ..axes.plane import Plane
from ..canvas import style
from ..canvas.ragged_rows import rows


@style.pinned()
def draw(scene, orbits):
    """Return the Figure of x' against x, one hue an orbit."""
    x = orbits["x"].values
    scene = complete(scene, x=lambda: of_data(x), next=lambda: of_data(x))
    picture = Plane(scene, ("x", "next"), ("$x$", "$x'$"))
    for i, span in enumerate(rows(orbits)):
        hue = style.HUES[i % len(style.HUES)]
        picture.dots(x[span][:-1], x[span][1:], hue, 1.5)
    return picture.figure
''',
    "src/pipeline/config/schema/kinds/returns.py": '''
"""x of each impact against x of the one before."""

from typing import Literal

from ..fields import Axis
from ..scene import OfOrbits


class Returns(OfOrbits):
    """the next position against the present one

    Positions of {{ s.starts|length }} orbits: the next one, x', against the present one, x.

    What to see: regular orbits are closed lines.
    """

    stages = ("orbits",)
    headline = "orbits"
    example = "energy: 0.001\\nstarts: [0.1]\\nimpacts: 50"

    axes: dict[Literal["x", "next"], Axis] = None
    """Limits and ticks."""

    @staticmethod
    def numbers(block, orbits):
        """How many orbits."""
        return {"orbits": f"{orbits.sizes['orbit']}"}
''',
    "tests/figures/test_returns.py": '''
"""The next position against the present one."""

import numpy as np
import xarray as xr

from pseudorigid.figures.kinds import returns


def test_each_pair_is_a_dot():
    x = np.array([0.1, 0.2, 0.4, 0.3, 0.5])
    data = xr.Dataset({"x": ("point", x), "row_size": ("orbit", np.array([3, 2]))})
    scene = {"energy": 0.01, "ball": {"k": 0.2, "g": 0.04}}
    dots = [a for a in returns.draw(scene, data).artists if a.get_marker() == "o"]
    assert [len(line.get_xdata()) for line in dots] == [2, 1]
''',
}
ROW = """    "flights": Stage(f"{_DYNAMICS}.flights", "mean_flights", (), ("orbits",), False),
}
"""
STAGE = {
    "src/pseudorigid/dynamics/flights.py": '''
"""How long an orbit flies."""

import numpy as np
import xarray as xr

from .variables import variables


def mean_flights(ball, energy, orbits):
    """The mean time of flight of each orbit."""
    ends = np.cumsum(orbits["row_size"].values)[:-1]
    means = [part.mean() for part in np.split(orbits["tau"].values, ends)]
    return xr.Dataset(variables("orbit", [np.array(means)], {"mean": "mean time of flight"}))
''',
    "tests/dynamics/test_flights.py": '''
"""How long an orbit flies."""

from pseudorigid import Ball
from pseudorigid.dynamics.flights import mean_flights
from pseudorigid.dynamics.orbits import scene_orbits


def test_the_mean_is_that_of_each_orbit():
    ball = Ball(0.2, 0.04)
    orbits = scene_orbits(ball, 0.01, [0.1, 0.5], [3, 5])
    found = mean_flights(ball, 0.01, orbits)["mean"].values
    assert found.tolist() == [orbits["tau"][:3].mean(), orbits["tau"][3:].mean()]
''',
}
SCENE = {"picture": "returns", "energy": 0.01, "starts": [0.1, 0.6], "impacts": 50}
DOCUMENT = {
    "ball": {"k": 0.2, "g": 0.04},
    "scenes": {"map": SCENE},
    "variants": {"low": {"energy": 0.0017}},
}


def follow(tree, *recipes):
    """Write the files of the recipes; only new ones, the row of a stage apart."""
    for name, text in (item for recipe in recipes for item in recipe.items()):
        path = tree.path / name
        assert not path.exists()
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.lstrip())
    if STAGE in recipes:
        table = tree.path / "src" / "pipeline" / "config" / "schema" / "stages.py"
        text = table.read_text()
        assert text.count("\n}\n") == 1
        table.write_text(text.replace("\n}\n", ROW))
    tree.warm()


def python(tree, *arguments):
    result = subprocess.run(
        [sys.executable, *arguments],
        env=tree.environment(),
        cwd=tree.path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def docs(tree):
    """The page of fields, made anew."""
    (tree.path / "docs").mkdir(exist_ok=True)
    python(tree, "-P", "-m", "pipeline.config.reference")
    return (tree.path / "docs" / "config.md").read_text()


@pytest.fixture
def copy(tmp_path):
    return fresh_tree(tmp_path / "recipes", DOCUMENT)


@pytest.mark.slow
def test_a_kind_of_three_files(copy):
    """Its figure, caption, number, refusals, row of the docs, variant and line of verify."""
    follow(copy, KIND)
    python(copy, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/figures/test_returns.py")
    made = copy.run("report")
    assert made.returncode == 0, made.stdout
    assert rows(made.stdout) == {"paper_figures/map.png": "recomputed"}
    page = (copy.path / "results" / "report" / "report.html").read_text()
    assert "Positions of 2 orbits: the next one" in page
    assert '<th scope="row">orbits</th><td>not printed</td><td>2</td>' in page

    for change, line in (
        ({"start": [0.1]}, "map.start: unknown key: did you mean starts?"),
        (
            {"starts": [1.5], "impacts": 50},
            "map.starts[0]: 1.5 is not allowed: expected a fraction",
        ),
        ({"axes": {"y": {}}}, "map.axes.y: unknown key: allowed here: x, next"),
    ):
        copy.write(DOCUMENT | {"scenes": {"map": SCENE | change}})
        result = copy.run()
        assert (result.returncode, result.stdout.count("\n")) == (1, 1)
        assert result.stdout.startswith(f"config.yaml: scenes.{line}")
    copy.write(DOCUMENT)

    page = docs(copy)
    assert "### picture: returns\n\nThe next position against the present one." in page
    assert "a mapping with the keys x and next, or some of them." in " ".join(page.split())

    variant = copy.run("variant", "low")
    assert variant.returncode == 0, variant.stdout
    drawn = "results/low/figures/map.png"
    assert rows(variant.stdout) == {drawn: "recomputed"}
    assert (copy.path / drawn).read_bytes() != (copy.path / "paper_figures/map.png").read_bytes()

    assert copy.run("accept").returncode == 0
    result = copy.run("verify")
    assert said(result.stdout, result.returncode)[:4] == (0, {}, [], [])
    assert "map.png  identical\n" in result.stdout


@pytest.mark.slow
def test_a_stage_of_three_files(copy):
    """Asked for by a kind of picture, whose declaration and drawing name it."""
    kind = dict(KIND)
    for name in list(kind)[:2]:
        kind[name] = kind[name].replace('stages = ("orbits",)', 'stages = ("orbits", "flights")')
        kind[name] = kind[name].replace("(scene, orbits)", "(scene, orbits, flights)")
        kind[name] = kind[name].replace("(block, orbits)", "(block, orbits, flights)")
    follow(copy, kind, STAGE)
    python(copy, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/dynamics/test_flights.py")
    made = copy.run()
    assert made.returncode == 0, made.stdout
    orbits = load(copy.path / "results" / "paper" / "orbits_map.nc")
    flights = load(copy.path / "results" / "paper" / "flights_map.nc")
    assert flights["mean"].values.tolist() == [
        np.mean(orbits["tau"].values[:50]),
        np.mean(orbits["tau"].values[50:]),
    ]
    assert flights.attrs["stage"] == "flights"
    assert "| `flights` |  | `orbits` | does not depend on it |" in docs(copy)
    with (copy.path / "src" / "pseudorigid" / "dynamics" / "flights.py").open("a") as file:
        file.write("_EDITED = 1\n")
    assert copy.planned() == {"results/paper/flights_map.nc", "results/paper/figures/map.png"}


def test_the_page_of_fields_is_up_to_date(tmp_path):
    tree = fresh_tree(tmp_path / "as it is", shipped())
    page = ROOT / "docs" / "config.md"
    shutil.copytree(ROOT / "docs", tree.path / "docs")
    assert docs(tree) == page.read_text(), "renew it: python -m pipeline.config.reference"
