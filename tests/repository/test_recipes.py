"""The recipes of CONTRIBUTING, in a copy: a kind, a stage, and an extension in one folder."""

import numpy as np
import pytest
from project import APART, fresh_tree
from runs import rows

from pipeline.records.artifacts import load

FILES = {
    "src/pseudorigid/figures/kinds/returns.py": '''
"""Next position against the present one."""

from ..axes.limits import complete, of_data
from ..axes.plane import Plane
from ..canvas import style


@style.pinned()
def draw(scene, orbits, flights):
    """Return the Figure of x' against x."""
    x = orbits["x"].values
    scene = complete(scene, x=lambda: of_data(x), next=lambda: of_data(x))
    picture = Plane(scene, ("x", "next"), ("$x$", "$x'$"))
    picture.dots(x[:-1], x[1:], style.HUES[0], 1.5)
    return picture.figure
''',
    "src/pipeline/config/schema/kinds/returns.py": '''
"""Next position against the present one."""

from typing import Literal

from ..fields import Axis
from ..scene import OfOrbits


class Returns(OfOrbits):
    """the next position against the present one"""

    stages = ("orbits", "flights")
    headline = "orbits"

    axes: dict[Literal["x", "next"], Axis] = None
    """Limits and ticks."""
''',
    "src/pseudorigid/dynamics/flights.py": '''
"""Mean time of flight of orbits."""

import numpy as np
import xarray as xr

from .variables import variables


def mean_flights(ball, energy, orbits):
    """Compute the mean time of flight of each orbit."""
    ends = np.cumsum(orbits["row_size"].values)[:-1]
    means = [part.mean() for part in np.split(orbits["tau"].values, ends)]
    return xr.Dataset(variables("orbit", [np.array(means)], {"mean": "mean time of flight"}))
''',
}
ROW = """
STAGES["flights"] = Stage(f"{_DYNAMICS}.flights.mean_flights", inputs=("orbits",))
"""
REPORT = '''

def returns(block, orbits, flights):
    """Give how many orbits there are."""
    return {"orbits": f"{orbits.sizes['orbit']}"}
'''
RULES = {
    "data": '''

use rule orbits as flights with:
    """pseudorigid.dynamics.flights.mean_flights"""
    input:
        orbits=dataset("orbits"),
        why=reason("results/{variant}/flights_{scene}.nc"),
    output:
        **made("results/{variant}/flights_{scene}.nc"),
    log:
        log_path("results/{variant}/flights_{scene}.nc"),
''',
    "figures": '''

use rule draw_portrait as draw_returns with:
    """pseudorigid.figures.kinds.returns.draw"""
    input:
        orbits=dataset("orbits"),
        flights=dataset("flights"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("returns"),
''',
}
SCENE = {"picture": "returns", "energy": 0.01, "starts": [0.1, 0.6], "impacts": 50}
DOCUMENT = {
    "ball": {"k": 0.2, "g": 0.04},
    "scenes": {"map": SCENE},
    "variants": {"low": {"energy": 0.0017}},
    **{part: {} for part in APART},
}
CAPTION = """
[kinds.returns]
title = "the next position against the present one"
shows = "Positions of {{ s.starts|length }} orbits: the next one, x', against the present one, x."
see = "Regular orbits are closed lines."
"""
EXAMPLE = """
returns:
  picture: returns
  energy: 0.001
  starts: [0.1]
  impacts: 50
"""


@pytest.mark.slow
def test_a_kind_and_a_stage(tmp_path):
    """They have data, a figure, a caption, a number, refusals, docs, and are recomputed alone."""
    tree = fresh_tree(tmp_path / "recipes", DOCUMENT)
    tree.append("pipeline/checks/report/captions.toml", CAPTION)
    tree.append("pipeline/config/schema/kinds/examples.yaml", EXAMPLE)
    for name, text in FILES.items():
        assert not (tree.path / name).exists()
        (tree.path / name).write_text(text.lstrip())
    tree.append("pipeline/config/schema/stages.py", ROW)
    tree.append("pseudorigid/figures/kinds/reports.py", REPORT)
    for name, text in RULES.items():
        with (tree.path / "workflow" / "rules" / f"{name}.smk").open("a") as file:
            file.write(text)
    assert rows(tree.succeed("report")) == {"paper_figures/map.png": "recomputed"}
    report = (tree.path / "results" / "report" / "report.html").read_text()
    assert "Positions of 2 orbits: the next one" in report
    assert '<th scope="row">orbits</th><td>not printed</td><td>2</td>' in report
    results = tree.path / "results" / "paper"
    orbits, flights = (load(results / f"{name}_map.nc") for name in ("orbits", "flights"))
    assert flights["mean"].values.tolist() == [
        np.mean(part) for part in np.split(orbits["tau"].values, 2)
    ]
    tree.write(DOCUMENT | {"scenes": {"map": SCENE | {"axes": {"y": {}}}}})
    line = "map.axes.y: unknown key: allowed here: x, next"
    assert tree.run().stdout == f"config.yaml: scenes.{line}\n"
    tree.write(DOCUMENT)
    assert "### picture: returns\n\nThe next position against the present one." in page_of(tree)
    assert rows(tree.succeed("variant", "low")) == {"results/low/figures/map.png": "recomputed"}
    tree.append("pseudorigid/dynamics/flights.py")
    edited = "made by other code than this tree's: src/pseudorigid/dynamics/flights.py differs"
    assert tree.succeed("-n") == f"map: {edited}: flights; perhaps drawing\n"


def page_of(tree):
    """The page of the config's fields, generated in a tree."""
    (tree.path / "docs").mkdir()
    result = tree.python("-P", "-m", "pipeline.config.reference")
    assert result.returncode == 0, result.stderr
    return (tree.path / "docs" / "config.md").read_text()


def of_an_extension(text):
    """Code of the core as it stands in the folder of an extension."""
    for part in ("axes", "canvas"):
        text = text.replace(f"from ..{part}", f"from pseudorigid.figures.{part}")
    for module in ("fields", "scene"):
        text = text.replace(f"from ..{module}", f"from pipeline.config.schema.{module}")
    return text.replace("from .variables", "from pseudorigid.dynamics.variables").lstrip()


EXTENSION = '''
"""What returns add to the pipeline."""

from pipeline.declaration import Extension, SceneSet, SnakemakeCommand, Stage

EXTENSION = Extension(
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
'''
SHIPPED = """
returns:
  twice: {picture: returns, energy: 0.01, starts: [0.1, 0.6], impacts: 50}
"""
KIND, PICTURE, FLIGHTS = (
    FILES[f"src/{name}.py"]
    for name in (
        "pipeline/config/schema/kinds/returns",
        "pseudorigid/figures/kinds/returns",
        "pseudorigid/dynamics/flights",
    )
)
FOLDER = {
    "__init__.py": '"""Returns of orbits."""',
    "extension.py": EXTENSION,
    "flights.py": FLIGHTS,
    "kinds.py": KIND,
    "figures/__init__.py": '"""Pictures of returns."""',
    "figures/returns.py": PICTURE,
    "figures/reports.py": f'"""What they report."""{REPORT}',
    "rules.smk": "".join(RULES.values())
    .replace("pseudorigid.dynamics", "extensions.returns")
    .replace("pseudorigid.figures.kinds", "extensions.returns.figures"),
    "scenes.yaml": SHIPPED,
    "captions.toml": CAPTION,
    "examples.yaml": EXAMPLE,
    "datasets.toml": "[small.flights]\n",
}


@pytest.mark.slow
def test_an_extension_is_one_folder(tmp_path):
    """It has a stage, a kind, a command and a published picture, in each list and each check."""
    paper = {"picture": "portrait", "energy": 0.01, "starts": [0.1, 0.6], "impacts": 50}
    parts = {part: {} for part in APART}
    document = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"map": paper}} | parts
    tree = fresh_tree(tmp_path / "one more", document)
    folder = tree.path / "src/extensions/returns"
    (folder / "figures").mkdir(parents=True)
    for name, text in FOLDER.items():
        (folder / name).write_text(of_an_extension(text))
    published = "more_figures/returns/twice.png"
    assert "\n  returns " in tree.succeed("help")
    assert rows(tree.succeed()) == {"paper_figures/map.png": "recomputed"}
    assert rows(tree.succeed("returns")) == {published: "recomputed"}
    assert rows(tree.succeed("returns")) == {published: "current"}
    assert load(tree.path / "results/returns/flights_twice.nc")["mean"].size == 2
    assert published in tree.succeed("list")
    tree.succeed("accept")
    result = tree.run("verify")
    assert (result.returncode, "note" in result.stdout) == (0, False), result.stdout
    assert "twice.png  identical\n" in result.stdout
    (tree.path / published).write_bytes(b"damaged")
    assert tree.run("verify").returncode == 1
    tree.succeed("report")
    assert "Positions of 2 orbits" in (tree.path / "results/report/report.html").read_text()
    assert "### picture: returns\n" in page_of(tree)
    result = tree.python("-P", "-m", "pipeline.checks.report.figures_page")
    assert result.returncode == 0, result.stderr
    tree.edit("map", impacts=40)
    (folder / "extension.py").unlink()
    assert "returns" not in tree.succeed("help")
